"""Notes on pytest; a bad name for this file, but nothing of mine imports it."""

SEEN = "pytest"
