"""How a program is started: as the lab sheet says it, by what Python runs of it as `__main__`.

The module has been imported, with its TODOs swapped and its steps watched, and a second import
under another name would know nothing of that. So of a package its `__main__.py` is run, and of a
single file, in the module that is there, the statements that ask for `__name__`.
"""

import ast
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from types import CodeType

from grader.worker.subject import Subject


def start(subject: Subject, module: str, has_run: Callable[[], bool]) -> None:
    """Start a program; by its main() where that has run no frame of it, as a test has not."""
    package = subject.folder / module / "__main__.py"
    with suppress(SystemExit):
        if package.exists():
            names = {"__name__": "__main__", "__package__": module, "__file__": str(package)}
            exec(compile(package.read_bytes(), package, "exec"), names)
        elif (code := main_block(subject.folder / f"{module}.py")) is not None:
            exec(code, vars(sys.modules[module]))
    if not has_run():
        subject.find(f"{module}:main")()


def main_block(path: Path) -> CodeType | None:
    """What a file does only when it is started: its `if __name__ == "__main__":`."""
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
