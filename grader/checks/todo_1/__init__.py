"""Check TODO 1: circle against box."""
