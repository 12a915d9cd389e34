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
from functools import cache, lru_cache
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


class KnownPrograms(PassedPrograms):
    """The programs that have passed; no program is added."""

    def __init__(self, programs: PassedPrograms) -> None:
        super().__init__(programs.folder)

    def add(self, key: str) -> None:
        """Remember nothing."""


class PassedBefore(KnownPrograms):
    """The programs that have passed, up to the first that has not: it may affect all after it."""

    over = False

    def holds(self, key: str) -> bool:
        self.over = self.over or not super().holds(key)
        return not self.over


PASSED = PassedPrograms(Path(__file__).parents[2] / "build" / "passed")


def program_key(
    todo: Todo, module: str, submission: Submission, right: Sequence[Piece], seed: int | None
) -> str:
    """Hash the program that a TODO's checks of `module` run, with the checks, grader and Python.

    Imported files of the submission count, and all files that are not Python.
    `right`: the reference's versions of other TODOs, which count instead of the submission's own
    if they have the same parameters.
    """
    program, tree = submission.program, submission.folder
    replaced: dict[Path, list[Function]] = {}
    for piece in right:
        defined = program.definition(*piece.target.split(":"))
        if defined is None or defined.function is None:
            continue
        if list(defined.function.parameters) == piece.parameters:
            replaced.setdefault(program.paths[defined.module], []).append(defined.function)
    contents = {}
    for path in program.list_files([module]):
        text, data = program.texts[path], (tree / path).read_bytes()
        as_usual = data == text.encode("utf-8", "replace")  # else another encoding, or CRLF
        usual = without_bodies(text, tuple(replaced.get(path, ()))).encode("utf-8", "replace")
        contents[path.as_posix()] = usual if as_usual else data
    for file in tree.rglob("*"):
        if file.is_file() and file.suffix not in (".py", ".ipynb"):
            contents[file.relative_to(tree).as_posix()] = file.read_bytes()
    digest = hashlib.sha256(surroundings().encode())
    digest.update(msgspec.json.encode([todo, module, seed, right]))
    for name, content in sorted(contents.items()):
        digest.update(f"{name}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()


@lru_cache(maxsize=256)  # most files of the bank are those of the solution
def without_bodies(text: str, functions: tuple[Function, ...]) -> str:
    """Return a file's text without the bodies of some functions."""
    lines: list[str | None] = [*text.splitlines()]
    for function in functions:
        node = next(iter(statements(source_of(text, function))), None)
        if isinstance(node, ast.FunctionDef) and node.body[0].lineno > 1:
            begin = function.lineno + node.body[0].lineno - 2
            body = slice(begin, function.end_lineno)
            lines[body] = [REPLACED, *[None] * (len(lines[body]) - 1)]
    return "\n".join(line for line in lines if line is not None)


@cache
def surroundings() -> str:
    """Name the grader, the Python and the machine, which answers also depend on."""
    return f"{fingerprint()} {sys.version} {platform.platform()}"
