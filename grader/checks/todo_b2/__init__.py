"""Check TODO B2: springs."""
