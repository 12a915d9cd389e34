"""Compile what the page loads: by the page's own Python, when the page is made.

Each NAME.zip in /parts gets a NAME.pyc.zip beside it. It holds our own programs, and of others
those that are loaded by now, without what describes them. The page does not look whether a file is
newer.
"""

import ast
import importlib.util
import shutil
import sys
import zipfile
from importlib._bootstrap_external import _code_to_hash_pyc
from pathlib import Path

PLACES = {"lab": "/", "python_stdlib": "/lib/python314.zip/"}  # where the page has them
OWN = ("kit/", "shims/")
DESCRIBED = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef


def load_page():
    """Load all that the page loads before it answers."""
    shutil.unpack_archive("/parts/lab.zip", "/")
    sys.path[:0] = ["/shims", "/kit", "/site"]
    importlib.invalidate_caches()
    import page

    page.start(None)
    page.warm()


def compile_archive(path, loaded):
    place = PLACES[path.stem]
    with (
        zipfile.ZipFile(path) as archive,
        zipfile.ZipFile(path.with_suffix(".pyc.zip"), "w") as compiled,
    ):
        for name in archive.namelist():
            own = name.startswith(OWN)
            if name.endswith(".py") and (own or place + name in loaded):
                source = archive.read(name)
                tree = source if own else strip(ast.parse(source))
                code = compile(tree, place + name, "exec", dont_inherit=True)
                mark = importlib.util.source_hash(source)
                compiled.writestr(f"{name}c", _code_to_hash_pyc(code, mark, False))


def strip(tree):
    """Take the docstrings out of a program."""
    for node in ast.walk(tree):
        if isinstance(node, DESCRIBED) and len(node.body) > 1 and ast.get_docstring(node, False):
            del node.body[0]
    return tree


load_page()
loaded = {getattr(each, "__file__", None) for each in [*sys.modules.values()]}
for each in ("lab", "python_stdlib"):
    compile_archive(Path(f"/parts/{each}.zip"), loaded)
