"""My own todo_1 module; nothing else uses it."""

NAME = "todo_1"
