"""My own lab module; nothing else uses it."""

NAME = "lab"
