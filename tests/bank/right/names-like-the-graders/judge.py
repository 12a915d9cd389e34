"""My own judge module; nothing else uses it."""

NAME = "judge"
