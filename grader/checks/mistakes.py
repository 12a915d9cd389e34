"""Register known mistakes by the sentences of `mistakes.toml`, which name them to students."""

import tomllib
from collections.abc import Callable
from pathlib import Path

from grader.judge.misconceptions import Model, mistake

MEANINGS: dict[str, dict[str, str]] = tomllib.loads(
    Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")
)


def meaning_of(todo: str, name: str) -> str:
    """Return the sentence of a mistake; of two at once, `one+other`, both sentences."""
    meanings = MEANINGS[todo]
    if name in meanings:
        return meanings[name]
    return " Also: ".join(meanings[each] for each in name.split("+"))


def known_in(todos: str, about: str, apart: bool = True) -> Callable[..., None]:
    """Return a function that registers mistakes of these TODOs, in observations called `about`.

    Call it with the name of a mistake and its models. Of several TODOs, the first one's table has
    the sentences. See `mistake` for `apart`.
    """

    def known(name: str, *models: Model, meaning: str = "", apart: bool = apart) -> None:
        meaning = meaning or meaning_of(todos.split()[0], name)
        mistake(todos, about, name, meaning, *models, apart=apart)

    return known
