"""Compile what the page loads: by the page's own Python, when the page is made.

lab.pyc.zip holds the compiled files of /parts/lab.zip that the page loads. Two more are of
python_stdlib.zip: booted.pyc.zip holds what Python loads at its start, loaded.pyc.zip what the
page loads later. Docstrings that are titles of checks stay. The page does not check whether a file
is newer.
"""

import ast
import importlib.util
import lzma  # noqa: F401 - the page unpacks with it
import shutil
import sys
import zipfile
from importlib._bootstrap_external import _code_to_hash_pyc
from pathlib import Path

STDLIB = "/lib/python314.zip/"  # where the page has it
TITLED = "kit/grader/checks/"
DESCRIBED = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef


def list_loaded():
    return {getattr(each, "__file__", None) for each in [*sys.modules.values()]}


def load_page():
    """Load all that the page loads before it answers."""
    sys.path[:0] = ["/shims", "/kit", "/site"]
    importlib.invalidate_caches()
    import page

    page.start(None)
    page.warm()


def compile_archive(path, place, loaded, target):
    """Compile the programs of an archive whose files are among those that were loaded."""
    with (
        zipfile.ZipFile(path) as archive,
        zipfile.ZipFile(f"/parts/{target}.pyc.zip", "w") as compiled,
    ):
        for name in archive.namelist():
            if name.endswith(".py") and place + name in loaded:
                source = archive.read(name)
                tree = ast.parse(source)
                if not name.startswith(TITLED):
                    strip(tree)
                code = compile(tree, place + name, "exec", dont_inherit=True)
                mark = importlib.util.source_hash(source)
                compiled.writestr(f"{name}c", _code_to_hash_pyc(code, mark, False))


def strip(tree):
    """Take the docstrings out of a program."""
    for node in ast.walk(tree):
        if isinstance(node, DESCRIBED) and len(node.body) > 1 and ast.get_docstring(node, False):
            del node.body[0]


LAB, LIBRARY = Path("/parts/lab.zip"), Path("/parts/python_stdlib.zip")
shutil.unpack_archive(LAB, "/")
booted = list_loaded()
load_page()
loaded = list_loaded() - booted
compile_archive(LAB, "/", loaded, "lab")
compile_archive(LIBRARY, STDLIB, booted, "booted")
compile_archive(LIBRARY, STDLIB, loaded, "loaded")
