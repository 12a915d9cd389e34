"""Check TODO 6: the fixed-step accumulator."""
