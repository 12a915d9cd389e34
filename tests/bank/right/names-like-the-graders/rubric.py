"""My own rubric module; nothing else uses it."""

NAME = "rubric"
