"""My own subject module; nothing else uses it."""

NAME = "subject"
