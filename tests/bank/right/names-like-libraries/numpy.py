"""Notes on numpy; a bad name for this file, but nothing of mine imports it."""

SEEN = "numpy"
