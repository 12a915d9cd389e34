"""Register known mistakes with their sentences for students in `mistakes.toml`."""

import tomllib
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from grader.judge.explain.misconceptions import Model, mistake

MEANINGS: dict[str, dict[str, str]] = tomllib.loads(
    Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")
)
Models = Iterable[tuple[str, Model]]  # each with the name of its mistake; a name may have several


def meaning_of(todo: str, name: str) -> str:
    """Return the sentence of a mistake, or both sentences for `one+other`."""
    meanings = MEANINGS[todo]
    if name in meanings:
        return meanings[name]
    return " Also: ".join(meanings[each] for each in name.split("+"))


def register(
    todos: str,
    about: str,
    models: Models,
    view: Callable[..., tuple[Any, ...]] | None = None,
    apart: bool = True,
) -> None:
    """Register the models of mistakes in answers to one kind of question.

    The first of the `todos` has the sentences. `view` turns the inputs of a question into those
    of the models. See `mistake` for `apart`.
    """
    for name, model in models:
        seen = model if view is None else look_through(view, model)
        mistake(todos, about, name, meaning_of(todos.split()[0], name), seen, apart=apart)


def look_through(view: Callable[..., tuple[Any, ...]], model: Model) -> Model:
    return lambda *inputs: model(*view(*inputs))
