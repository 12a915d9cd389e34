"""Start a program as the lab sheet says: run what Python runs of it as `__main__`.

The module has been imported, with its TODOs swapped and its steps watched, and a second import
under another name would know nothing of that. So of a package its `__main__.py` is run, and of a
single file, in the module that is there, the statements that ask for `__name__`.
"""

import ast
import sys
from collections.abc import Iterator, Sized
from contextlib import contextmanager
from pathlib import Path
from types import CodeType, ModuleType

from grader.worker.subject import Subject
from grader.worker.values import ContractError


def start(subject: Subject, module: str, shown: Sized, frames: int) -> None:
    """Start a program; if `shown` has counted no frame then, call its main().

    The block that runs as `__main__` may be a test, without a window. Nobody presses Enter: a
    program that waits for it after all frames has ended.
    """
    failed: Exception | None = None
    try:
        run_as_main(subject.folder, module)
    except SystemExit:
        pass
    except Exception as error:
        waits_at_the_end = isinstance(error, EOFError) and len(shown) >= frames - 1
        if len(shown) and not waits_at_the_end:
            raise
        failed = error
    if not len(shown):
        try:
            main = subject.find(f"{module}:main")
        except ContractError:
            raise failed or ContractError(f"there is no main in {module}") from None
        main()


def run_as_main(folder: Path, module: str) -> None:
    """Run what `python -m module` runs besides an import."""
    path = folder / module / "__main__.py"
    if path.exists():
        code: CodeType | None = compile(path.read_bytes(), path, "exec")
        program = ModuleType("__main__")
        vars(program).update(__package__=module, __file__=str(path))
    else:
        code, program = main_block(folder / f"{module}.py"), sys.modules[module]
    if code is not None:
        with known_as_main(program):
            exec(code, vars(program))


@contextmanager
def known_as_main(program: ModuleType) -> Iterator[None]:
    """Make `__main__` this module meanwhile, for profilers and tests that look there."""
    before = sys.modules["__main__"]
    sys.modules["__main__"] = program
    try:
        yield
    finally:
        sys.modules["__main__"] = before


def main_block(path: Path) -> CodeType | None:
    """Return what a file does only when it is started: its `if __name__ == "__main__":`."""
    if not path.exists():
        return None
    tree = ast.parse(path.read_bytes())
    tree.body = [each for each in tree.body if isinstance(each, ast.If) and asks_name(each.test)]
    for each in tree.body:
        Started().visit(each)
    return compile(ast.fix_missing_locations(tree), path, "exec") if tree.body else None


def asks_name(test: ast.expr) -> bool:
    return any(isinstance(node, ast.Name) and node.id == "__name__" for node in ast.walk(test))


class Started(ast.NodeTransformer):
    """Writes what `__name__` is in a program that is started."""

    def visit_Name(self, node: ast.Name) -> ast.expr:
        return ast.copy_location(ast.Constant("__main__"), node) if node.id == "__name__" else node
