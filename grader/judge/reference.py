"""The reference's functions, cut out one by one, to stand in for a submission's unfinished ones."""

import ast
import builtins
import dis
from collections.abc import Iterator
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

Source = tuple[str, str, list[ast.stmt]]  # a file's module, its text, and that text parsed


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
                self.pieces[todo.id] = cut_out(sources, folder, todo)
                self.shapes[todo.id] = shape_of(self.pieces[todo.id].source)

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
            yield module, text, statements(text)


def cut_out(sources: list[Source], folder: Path, todo: Todo) -> Piece:
    path = todo.function.partition(":")[2]
    for module, text, body in sources:
        found = function_named(body, path) if module == todo.module else None
        if found is not None:
            source = source_of(text, found)
            parameters = [each.arg for each in found.args.args]
            names = sorted(global_names(compile(source, "<reference>", "exec")))
            return Piece(todo.function, source, plain_imports(text), parameters, names)
    raise CannotGrade(f"the reference at {folder} has no {path}, which TODO {todo.id} is about")


def global_names(code: CodeType) -> set[str]:
    """The global names that a piece of code reads, its inner functions' included."""
    names = {each.argval for each in dis.get_instructions(code) if each.opname == "LOAD_GLOBAL"}
    inner = [each for each in code.co_consts if isinstance(each, CodeType)]
    return names.union(*map(global_names, inner)) - set(vars(builtins))


def plain_imports(text: str) -> str:
    """The imports of libraries; the program's own names are found in the submission."""
    return "\n".join(
        ast.unparse(node)
        for node in ast.parse(text).body
        if isinstance(node, ast.Import | ast.ImportFrom)
        and not getattr(node, "level", 0)
        and "lab_runtime" not in ast.unparse(node)
    )
