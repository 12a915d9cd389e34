"""Cut out the reference's functions, which replace a submission's unfinished ones."""

import ast
import builtins
import dis
from collections.abc import Callable
from functools import cache, lru_cache
from pathlib import Path
from types import CodeType

import msgspec

from grader.judge.rubric import Rubric, Todo
from grader.judge.submission import CannotGrade, Submission
from grader.protocol import Piece
from grader.source.definitions import Function, Program
from grader.source.regions import python_files, read_source, shape_of

Source = tuple[Path, str]  # a file's path in the tree, and its text


class Reference:
    """A complete tree, read as text; if empty, no TODO is isolated."""

    def __init__(self, folder: Path | None, rubric: Rubric) -> None:
        self.todos = rubric.todos
        self.pieces: dict[str, Piece] = {}
        self.shapes: dict[str, str] = {}
        if folder is None:
            return
        if not folder.is_dir():
            raise CannotGrade(f"there is no reference at {folder}: name the solution's folder")
        sources = tuple((p.relative_to(folder), read_source(p)) for p in python_files(folder))
        found = functions_of(sources, tuple(t.function for t in rubric.todos if t.function))
        for todo in rubric.todos:
            if not todo.function:
                continue
            if todo.function not in found:
                raise CannotGrade(
                    f"the reference at {folder} has no {todo.function.partition(':')[2]}, "
                    f"which TODO {todo.id} is about"
                )
            self.pieces[todo.id], self.shapes[todo.id] = found[todo.function]

    def is_that_of(self, submission: Submission, todo: Todo) -> bool:
        """Return whether a submission has reference code for `todo`; `whole` means all."""
        asked = [todo.id] if todo.function else [each.id for each in self.todos if each.function]
        mine = [submission.functions.get(id) for id in asked]
        return bool(self.shapes) and mine == [self.shapes.get(id) for id in asked]

    def for_the_others(
        self,
        todo: Todo,
        module: str,
        rubric: Rubric,
        submission: Submission,
        failed: frozenset[str] = frozenset(),
        differing: bool = True,
    ) -> list[Piece]:
        """Return the right versions of other TODOs in `module` for the checks of a TODO.

        A TODO gets those of all others. The whole gets those of TODOs that have `failed`, of bonus
        tasks, and of given TODOs, which `rubric` omits. Unstarted bonus tasks do nothing, and
        stay. `differing`: only versions whose text differs from the submission's.
        """
        asked = {each.id for each in rubric.todos}

        def is_wanted(other: Todo) -> bool:
            begun = submission.begun[other.id]
            if other.bonus or todo.function:
                return begun or not other.bonus
            return other.id in failed if begun else other.id not in asked

        return [
            drop_function(
                todo.path, msgspec.structs.replace(self.pieces[other.id], asked=todo.function)
            )
            for other in self.todos
            if other.id != todo.id
            and other.module == module
            and other.id in self.pieces
            and is_wanted(other)
            and not (differing and self.shapes[other.id] == submission.functions.get(other.id))
        ]


def drop_function(function: str, piece: Piece) -> Piece:
    """Return a piece of code without the `function` that the check tests.

    A piece includes the functions that it calls, and a child can read everything sent to it.
    """
    others = {name: source for name, source in piece.given.items() if name != function}
    return msgspec.structs.replace(piece, given=others)


@lru_cache(maxsize=4)  # the reference is the same for a whole class
def functions_of(
    sources: tuple[Source, ...], targets: tuple[str, ...]
) -> dict[str, tuple[Piece, str]]:
    """Return functions of these files, by module:function, each with its shape."""
    program = Program(dict(sources))
    libraries = cache(lambda module: plain_imports(program.tree(module)))
    found = {}
    for target in targets:
        defined = program.definition(*target.split(":"))
        if defined is not None and defined.function is not None:
            piece = cut_out(program, libraries, target, defined.module, defined.function)
            found[target] = piece, shape_of(piece.source)
    return found


def cut_out(
    program: Program,
    libraries: Callable[[str], list[str]],
    target: str,
    module: str,
    function: Function,
) -> Piece:
    """Return a function with the imports and functions that it needs in another program."""
    source = program.source(module, function)
    imports = dict.fromkeys(libraries(module))
    given: dict[str, str] = {}
    names = global_names(source)
    waiting = [(module, name) for name in sorted(names)]
    while waiting:
        called = program.definition(*waiting.pop())
        if called is None or called.function is None or called.function.name in given:
            continue
        text = given[called.function.name] = program.source(called.module, called.function)
        imports |= dict.fromkeys(libraries(called.module))
        waiting += [(called.module, name) for name in sorted(global_names(text))]
    parameters = list(function.parameters)
    wanted = sorted(names.union(*map(global_names, given.values())))
    return Piece(target, source, "\n".join(imports), parameters, wanted, given)


def global_names(source: str) -> set[str]:
    """Return the global names that a function reads, its inner functions' included."""
    return names_read(compile(source, "<reference>", "exec")) - set(vars(builtins))


def names_read(code: CodeType) -> set[str]:
    names = {each.argval for each in dis.get_instructions(code) if each.opname == "LOAD_GLOBAL"}
    inner = [each for each in code.co_consts if isinstance(each, CodeType)]
    return names.union(*map(names_read, inner))


def plain_imports(body: list[ast.stmt]) -> list[str]:
    """Return the imports of libraries; the program's own names come from the submission."""
    return [
        ast.unparse(node)
        for node in body
        if isinstance(node, ast.Import | ast.ImportFrom)
        and not getattr(node, "level", 0)
        and "lab_runtime" not in ast.unparse(node)
    ]
