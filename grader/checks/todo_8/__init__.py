"""Check TODO 8: integrators."""
