"""Check TODO B6: heavier balls."""
