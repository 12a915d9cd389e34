"""My own worker module; nothing else uses it."""

NAME = "worker"
