"""Register known mistakes with their sentences for students in `mistakes.toml`."""

import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Protocol, TypeVar

from grader.judge.explain.misconceptions import Model, mistake

MEANINGS: dict[str, dict[str, str]] = tomllib.loads(
    Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")
)
Decorated = TypeVar("Decorated", bound=Model)


class Known(Protocol):
    """Register the models of a mistake, or the function that this decorates."""

    def __call__(
        self, name: str, *models: Model, meaning: str = "", apart: bool = ...
    ) -> Callable[[Decorated], Decorated]: ...


def meaning_of(todo: str, name: str) -> str:
    """Return the sentence of a mistake, or both sentences for `one+other`."""
    meanings = MEANINGS[todo]
    if name in meanings:
        return meanings[name]
    return " Also: ".join(meanings[each] for each in name.split("+"))


def known_in(todos: str, about: str, apart: bool = True) -> Known:
    """Return a function that registers mistakes of these TODOs, in observations called `about`.

    The first TODO's table has the sentences. See `mistake` for `apart`.
    """

    def known(
        name: str, *models: Model, meaning: str = "", apart: bool = apart
    ) -> Callable[[Decorated], Decorated]:
        meaning = meaning or meaning_of(todos.split()[0], name)

        def register(model: Decorated) -> Decorated:
            mistake(todos, about, name, meaning, model, apart=apart)
            return model

        for model in models:
            register(model)
        return register

    return known
