"""The reference's functions, cut out one by one, to stand in for a submission's unfinished ones."""

import ast
import builtins
import dis
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from types import CodeType

from grader.judge.rubric import Rubric, Todo
from grader.judge.submission import (
    CannotGrade,
    Submission,
    function_named,
    module_of,
    source_of,
    statements,
)
from grader.protocol import Piece
from grader.todo_regions import python_files, read_source, shape_of

Source = tuple[str, str]  # a file's module and its text

parsed = lru_cache(maxsize=32)(statements)  # the same reference serves a whole class
shape = lru_cache(maxsize=64)(shape_of)


class Reference:
    """A complete tree, read as text; without one, no TODO can be isolated."""

    def __init__(self, folder: Path | None, rubric: Rubric) -> None:
        self.pieces: dict[str, Piece] = {}
        self.shapes: dict[str, str] = {}
        if folder is None:
            return
        if not folder.is_dir():
            raise CannotGrade(f"there is no reference at {folder}: name the solution's folder")
        sources = list(sources_in(folder, {todo.module for todo in rubric.todos}))
        for todo in rubric.todos:
            if todo.function:
                self.pieces[todo.id] = piece_for(todo, sources, folder)
                self.shapes[todo.id] = shape(self.pieces[todo.id].source)

    def for_the_others(
        self, todo: Todo, module: str, rubric: Rubric, submission: Submission
    ) -> list[Piece]:
        """The pieces of the other TODOs in `module`, where the submission's own differ from them.

        The whole is the submission as it is, but for its bonus tasks: a mistake there costs nothing
        elsewhere. A bonus task that was not begun does nothing, and stays.
        """
        others = [other for other in rubric.todos if other.id != todo.id and other.module == module]
        return [
            self.pieces[other.id]
            for other in others
            if other.id in self.pieces
            and (submission.begun[other.id] if other.bonus else bool(todo.function))
            and self.shapes[other.id] != submission.functions.get(other.id)
        ]


def sources_in(folder: Path, modules: set[str]) -> Iterator[Source]:
    for file in python_files(folder):
        module = module_of(file.relative_to(folder))
        if module in modules:
            text = read_source(file)
            yield module, text


def piece_for(todo: Todo, sources: list[Source], folder: Path) -> Piece:
    for module, text in sources:
        piece = cut_out(text, todo.function) if module == todo.module else None
        if piece is not None:
            return piece
    raise CannotGrade(
        f"the reference at {folder} has no {todo.function.partition(':')[2]}, "
        f"which TODO {todo.id} is about"
    )


@lru_cache(maxsize=512)
def cut_out(text: str, target: str) -> Piece | None:
    """The function that `target` names, as module:function, if this file has it."""
    found = function_named(parsed(text), target.partition(":")[2])
    if found is None:
        return None
    source = source_of(text, found)
    parameters = [each.arg for each in found.args.args]
    names = sorted(global_names(compile(source, "<reference>", "exec")))
    return Piece(target, source, plain_imports(text), parameters, names)


def global_names(code: CodeType) -> set[str]:
    """The global names that a piece of code reads, its inner functions' included."""
    names = {each.argval for each in dis.get_instructions(code) if each.opname == "LOAD_GLOBAL"}
    inner = [each for each in code.co_consts if isinstance(each, CodeType)]
    return names.union(*map(global_names, inner)) - set(vars(builtins))


def plain_imports(text: str) -> str:
    """The imports of libraries; the program's own names are found in the submission."""
    return "\n".join(
        ast.unparse(node)
        for node in parsed(text)
        if isinstance(node, ast.Import | ast.ImportFrom)
        and not getattr(node, "level", 0)
        and "lab_runtime" not in ast.unparse(node)
    )
