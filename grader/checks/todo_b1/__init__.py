"""Check TODO B1: sleeping bodies."""
