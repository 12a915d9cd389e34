"""Start a program as the lab sheet says: run the code that Python runs as `__main__`.

The module is already imported, with its TODOs swapped and its steps counted; a second import under
another name would have neither. So a package runs its `__main__.py`. Of a single file,
only statements that test `__name__` run, inside the imported module.
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
    """Start a program; call its main() if no frame was shown before.

    The block that runs as `__main__` may be a test without a window. A program that waits for
    Enter after the last frame has ended.
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
    """Run the code that `python -m module` runs, apart from the import."""
    path = folder / module / "__main__.py"
    if path.exists():
        code: CodeType | None = compile(path.read_bytes(), path, "exec")
        program = ModuleType("__main__")
        vars(program).update(__package__=module, __file__=str(path))
    else:
        code, program = main_block(folder / f"{module}.py"), sys.modules[module]
    if code is not None:
        with replaced_main(program):
            exec(code, vars(program))


@contextmanager
def replaced_main(program: ModuleType) -> Iterator[None]:
    """Make this module `__main__` for a while: profilers and tests look there."""
    before = sys.modules["__main__"]
    sys.modules["__main__"] = program
    try:
        yield
    finally:
        sys.modules["__main__"] = before


def main_block(path: Path) -> CodeType | None:
    """Return the code that a file runs only when started: its `if __name__ == "__main__":`."""
    if not path.exists():
        return None
    tree = ast.parse(path.read_bytes())
    tree.body = [each for each in tree.body if isinstance(each, ast.If) and asks_name(each.test)]
    for each in tree.body:
        ReplaceName().visit(each)
    return compile(ast.fix_missing_locations(tree), path, "exec") if tree.body else None


def asks_name(test: ast.expr) -> bool:
    return any(isinstance(node, ast.Name) and node.id == "__name__" for node in ast.walk(test))


class ReplaceName(ast.NodeTransformer):
    """Replaces `__name__` by its value in a started program."""

    def visit_Name(self, node: ast.Name) -> ast.expr:
        return ast.copy_location(ast.Constant("__main__"), node) if node.id == "__name__" else node
