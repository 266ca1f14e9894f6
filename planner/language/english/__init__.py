"""English, as data: words, verbs, courtesy, numbers, colors. Whoever adds a word edits a text file here."""
