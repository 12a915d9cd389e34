"""Check TODO 7: the pymunk scene."""
