"""Notes on time; a bad name for this file, but nothing of mine imports it."""

SEEN = "time"
