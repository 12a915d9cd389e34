"""Bodies and what moves them."""
