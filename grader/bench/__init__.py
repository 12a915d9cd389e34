"""Measure what grading costs: one bench, with the figures that matter."""
