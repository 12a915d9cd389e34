"""Check the programs as a whole."""
