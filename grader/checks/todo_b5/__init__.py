"""Check TODO B5: drawing between steps."""
