"""From words to readings: a lattice of what each word may be, and a chart parser for a grammar in Lark's notation."""
