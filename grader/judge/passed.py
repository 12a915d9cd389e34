"""Remember the programs that have passed all checks of a TODO, so that none runs twice.

With the reference's code in the other TODOs, many submissions become the same program: if only
TODO 4 is wrong, all other checks run the solution. This is only for the user's own work and for
the bank: another program could read its own files and behave differently.
"""

import ast
import hashlib
import platform
import sys
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import msgspec

from grader.judge.fingerprint import fingerprint
from grader.judge.rubric import Todo
from grader.judge.submission import Submission
from grader.protocol import Piece
from grader.source.definitions import Function, source_of, statements

REPLACED = "<the reference's>"


class PassedPrograms:
    """The programs that have passed, as empty files in a folder, named by the program's key."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def holds(self, key: str) -> bool:
        return bool(key) and (self.folder / key).exists()

    def add(self, key: str) -> None:
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / key).touch()


PASSED = PassedPrograms(Path(__file__).parents[2] / "build" / "passed")


def program_key(
    todo: Todo, submission: Submission, right: Sequence[Piece], seed: int | None
) -> str:
    """Hash the program that the checks of a TODO run, with the checks, the grader and Python.

    Imported files of the submission count, and all files that are not Python.
    `right`: the reference's versions of other TODOs, which count instead of the submission's own
    if they have the same parameters.
    """
    program, tree = submission.program, submission.folder
    texts = {path: program.texts[path] for path in program.list_files(todo.modules)}
    for piece in right:
        defined = program.definition(*piece.target.split(":"))
        if defined is None or defined.function is None:
            continue
        path, function = program.paths[defined.module], defined.function
        if path in texts and list(function.parameters) == piece.parameters:
            texts[path] = without_body(texts[path], function)
    contents = {path.as_posix(): text.encode() for path, text in texts.items()}
    for file in tree.rglob("*"):
        if file.is_file() and file.suffix not in (".py", ".ipynb"):
            contents[file.relative_to(tree).as_posix()] = file.read_bytes()
    digest = hashlib.sha256(surroundings().encode())
    digest.update(msgspec.json.encode([todo, seed, right]))
    for name, content in sorted(contents.items()):
        digest.update(f"{name}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()


def without_body(text: str, function: Function) -> str:
    """Return a file's text without the body of a function."""
    lines = text.splitlines()
    node = next(iter(statements(source_of(text, function))), None)
    if not isinstance(node, ast.FunctionDef) or node.body[0].lineno == 1:
        return text
    begin = function.lineno + node.body[0].lineno - 2
    return "\n".join([*lines[:begin], REPLACED, *lines[function.end_lineno :]])


@cache
def surroundings() -> str:
    """Name the grader, the Python and the machine, which answers also depend on."""
    return f"{fingerprint()} {sys.version} {platform.platform()}"
