"""Grade a whole class, and turn results into pages and marks; students get none of this room."""
