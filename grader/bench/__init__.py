"""Measure what grading costs."""
