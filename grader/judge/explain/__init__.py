"""Explain a failed check: what it means, which mistake it is, and where to look."""
