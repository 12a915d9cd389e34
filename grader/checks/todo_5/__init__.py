"""Check TODO 5: damping per second."""
