"""Grade a whole class, and turn results into pages and marks; students do not get this package."""
