"""The forms that other systems read: a function each, from one result, every word escaped."""

from grader.judge.result import TodoResult


def named(todo: TodoResult, title: str) -> str:
    """A title with the number of its TODO; the whole program has none."""
    return title if todo.id == "whole" else f"TODO {todo.id}: {title}"
