"""Notes on json; a bad name for this file, but nothing of mine imports it."""

SEEN = "json"
