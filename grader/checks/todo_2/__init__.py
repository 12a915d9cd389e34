"""Check TODO 2: spin terms."""
