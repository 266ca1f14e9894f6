"""The shared belief: nodes, edges, frames, transactions, working memory, queries, topology."""
