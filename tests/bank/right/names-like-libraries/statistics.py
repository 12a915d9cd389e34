"""Notes on statistics; a bad name for this file, but nothing of mine imports it."""

SEEN = "statistics"
