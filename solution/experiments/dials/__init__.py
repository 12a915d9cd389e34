"""A window with dials: any scene in any engine, or in up to three of them side by side."""
