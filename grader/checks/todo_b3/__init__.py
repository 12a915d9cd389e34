"""Check TODO B3: the broad phase."""
