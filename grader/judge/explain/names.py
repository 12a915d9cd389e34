"""Find names and arguments that a submission has changed, by its text alone.

A renamed function, or one whose arguments are in another order, counts as the cause of a failure
only if it is the TODO's own, or if the failure names it.
"""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from difflib import SequenceMatcher
from functools import cache
from itertools import islice
from pathlib import Path

from grader.judge.explain.error_words import explain_error
from grader.judge.result import CheckResult
from grader.judge.rubric import Todo
from grader.judge.submission import Submission, load_given
from grader.source.definitions import MAX_READ, list_functions, statements
from grader.source.regions import python_files, read_source

MOST = 1000  # functions of a program; the lesson's have sixty
LONGEST = 80  # letters that two names of the same thing must share
SIMILAR = 0.6  # minimum similarity of two names of the same thing


@dataclass(frozen=True)
class Signature:
    """A function's name, with the class before it, and its arguments."""

    path: str
    names: tuple[str, ...]
    least: int  # arguments without a default
    open: bool  # it takes any number of arguments

    @property
    def name(self) -> str:
        return self.path.rpartition(".")[2]

    @property
    def owner(self) -> str:
        return self.path.rpartition(".")[0]

    @property
    def call(self) -> str:
        names = self.names[1:] if self.owner and self.names[:1] == ("self",) else self.names
        return f"{self.name}({', '.join(names)})"


def list_signatures(text: str) -> Iterator[Signature]:
    """Yield the signatures of the functions and methods of a source text."""
    for path, node in list_functions(statements(text)):
        names = tuple(each.arg for each in (*node.args.posonlyargs, *node.args.args))
        least = len(names) - len(node.args.defaults)
        yield Signature(path, names, least, node.args.vararg is not None)


@cache
def load_signatures(module: str) -> dict[str, Signature]:
    """Return the functions of the handed-out program, by their paths."""
    given = load_given().items()
    texts = [text for name, text in given if name.partition("/")[0] in (module, f"{module}.py")]
    return {each.path: each for text in texts for each in list_signatures(text)}


class Names:
    """The names of a submission, compared with those that were handed out."""

    def __init__(self, submission: Submission) -> None:
        self.submission = submission
        self.found: dict[str, dict[str, Signature]] = {}
        self.changes: dict[str, dict[str, str]] = {}

    def hint(self, todo: Todo, module: str, check: CheckResult) -> str:
        """Name the changed name or argument that fails a check, or explain its error."""
        own = todo.function.partition(":")[2]
        for path, words in self.changed(module).items():
            name = path.rpartition(".")[2]
            if path == own or re.search(rf"\b{re.escape(name)}\b", check.got):
                return words
        return explain_error(check.got, self.read, todo.id)

    def read(self, file: str) -> str:
        """Return the text of a file of the submission; empty if there is none.

        The name comes from the words of an error, which may say anything.
        """
        held = self.submission.holds(file)
        return read_source(self.submission.folder / file) if held else ""

    def changed(self, module: str) -> Mapping[str, str]:
        """Return the sentence about each changed function, by its path."""
        if module not in self.changes:
            self.changes[module] = self._changed(module)
        return self.changes[module]

    def _changed(self, module: str) -> dict[str, str]:
        theirs, ours = load_signatures(module), self.of(module)
        words = {
            path: compare_arguments(meant, ours[path])
            if path in ours
            else find_new_name(meant, module, theirs, ours)
            for path, meant in theirs.items()
        }
        return {path: each for path, each in words.items() if each and ours}

    def of(self, module: str) -> dict[str, Signature]:
        """Return the functions of a program of the submission."""
        if module not in self.found:
            folder = self.submission.folder
            package, single = folder / module, folder / f"{module}.py"
            paths = python_files(package) if package.is_dir() else [single]
            texts = read_bounded(path for path in paths if path.is_file())
            all_of_them = (each for text in texts for each in list_signatures(text))
            self.found[module] = {each.path: each for each in islice(all_of_them, MOST)}
        return self.found[module]


def read_bounded(paths: Iterable[Path]) -> Iterator[str]:
    """Yield the texts of files until their sizes add up to MAX_READ."""
    read = 0
    for path in paths:
        read += path.stat().st_size
        if read > MAX_READ:
            return
        yield read_source(path)


def find_new_name(
    meant: Signature, module: str, theirs: Mapping[str, Signature], ours: Mapping[str, Signature]
) -> str:
    """Suggest a similar name: `World has no apply_damping; it has apply_damp: renamed?`."""
    new = [
        each
        for path, each in ours.items()
        if path not in theirs and each.owner == meant.owner and len(each.name) <= LONGEST
    ]
    near = max(new, key=lambda each: measure_likeness(each.name, meant.name), default=None)
    if near is None or measure_likeness(near.name, meant.name) < SIMILAR:
        return ""
    place = meant.owner or module
    return f"{place} has no {meant.name}; it has {near.name}: renamed?"


def measure_likeness(first: str, second: str) -> float:
    return SequenceMatcher(None, first, second).ratio()


def compare_arguments(meant: Signature, found: Signature) -> str:
    """Return a sentence about a function whose arguments do not fit its calls."""
    if found.open or found.names == meant.names:
        return ""
    if sorted(found.names) == sorted(meant.names):
        return f"It is {found.call} here, and it is called as {meant.call}: keep the order."
    if found.least > len(meant.names) or len(found.names) < meant.least:
        return f"It is {found.call} here, and it is called as {meant.call}: keep its arguments."
    return ""
