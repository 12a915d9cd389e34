"""My own checks module; nothing else uses it."""

NAME = "checks"
