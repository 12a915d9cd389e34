"""Check TODO B4: hits in pymunk."""
