"""My own protocol module; nothing else uses it."""

NAME = "protocol"
