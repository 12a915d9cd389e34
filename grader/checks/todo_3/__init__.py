"""Check TODO 3: the distance joint."""
