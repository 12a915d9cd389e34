"""Notes on msgspec; a bad name for this file, but nothing of mine imports it."""

SEEN = "msgspec"
