"""Notes on hypothesis; a bad name for this file, but nothing of mine imports it."""

SEEN = "hypothesis"
