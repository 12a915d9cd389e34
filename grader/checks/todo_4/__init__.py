"""Check TODO 4: the friction limit."""
