"""Define every command line. Nothing imports this room but `__main__`."""
