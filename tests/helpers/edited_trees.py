"""Edit the files of a tree, and grade some of its TODOs."""

from collections.abc import Mapping
from pathlib import Path

from grader.bank.verify import shared_worker
from grader.judge.grade import grade
from grader.judge.result import Result
from grader.judge.task import Options
from grader.source.regions import read_source, replace_regions


def edit_file(tree: Path, file: str, old: str, new: str) -> Path:
    """Replace a text that occurs once in a file; return the tree."""
    text = read_source(tree / file)
    assert text.count(old) == 1, f"{old!r} is {text.count(old)} times in {file}"
    (tree / file).write_text(text.replace(old, new), encoding="utf-8")
    return tree


def set_regions(tree: Path, file: str, regions: Mapping[str, str]) -> Path:
    """Replace the regions of a file; return the tree."""
    lines = {todo: tuple(code.split("\n")) for todo, code in regions.items()}
    text = replace_regions(read_source(tree / file), lines)
    (tree / file).write_text(text, encoding="utf-8")
    return tree


def grade_todos(tree: Path, *todos: str, reference: Path | None = None) -> Result:
    """Grade these TODOs of the user's own work."""
    options = Options(reference, only=frozenset(todos), trusted=True)
    return grade(tree, options, shared_worker())
