"""Grading one submission. Trusted: nothing in here ever imports it."""
