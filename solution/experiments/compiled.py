"""The stable engine's own source, compiled to machine code: the same bits, several times faster.

It needs mypy (python -m pip install mypy setuptools) and a C compiler. The folder stable_engine
stays as it is; the compiled copy is the package stable_compiled in build/compiled. The window and
the leaderboard use it once it is built, and accuracy.py times it beside the plain source.

    python -m experiments.compiled

A wheel that pip installed is used as well, if it is of the same source.

Compiled worlds cannot be copied or pickled: copy.deepcopy raises TypeError. mypyc's switch for that
makes attributes slower, and a copy would call methods of the effects it was copied from.
"""

import argparse
import importlib
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from .engines import ENGINES, Stable
from .measures import bits, run
from .scenes import NAMED

TREE = Path(__file__).parents[1]
WHEEL = Path(__file__).with_name("wheel")  # for a wheel and a trial of it
OUT = Path("build/compiled")
FOLDERS = (TREE / OUT, TREE.parent / OUT, Path(sysconfig.get_path("platlib")))  # where it is
NAME = "stable_compiled"
LEFT_PLAIN = ("reading.py", "validate.py")  # their classes inherit from plain ones
CONSTANT = re.compile(r"^([A-Z][A-Z_]*) = ", re.MULTILINE)
FUTURE = "from __future__ import annotations\n"
EFFECT = "\nclass Effect:"
KEPT_OPEN = """
from mypy_extensions import mypyc_attr

@mypyc_attr(allow_interpreted_subclasses=True)"""

SETUP = """\
from mypyc.build import mypycify
from setuptools import setup

setup(ext_modules=mypycify({modules!r}))
"""


def sources():
    """Return the files of the engine by name, as prepared for compiling.

    In the compiled copy alone, Effect says that classes of plain Python may inherit from it, and
    constants are Final, so that mypyc need not look them up.
    """
    paths = sorted((TREE / "stable_engine").glob("*.py"))
    found = {path.name: with_final_constants(path.read_text("utf-8")) for path in paths}
    found["effect.py"] = found["effect.py"].replace(EFFECT, KEPT_OPEN + EFFECT)
    return found


def with_final_constants(text):
    """Return a module's text with its constants declared Final, below its docstring."""
    text, count = CONSTANT.subn(r"\1: Final = ", text)
    if not count:
        return text
    docstring, quotes, rest = text[3:].partition('"""\n')
    future, rest = (FUTURE, rest.replace(FUTURE, "", 1)) if FUTURE in rest else ("", rest)
    return f'"""{docstring}{quotes}{future}from typing import Final\n{rest}'


def write_sources(folder):
    """Write the prepared package into folder; return the paths of the files to compile."""
    package = folder / NAME
    shutil.rmtree(package, ignore_errors=True)
    package.mkdir(parents=True)
    files = sources()
    for name, text in files.items():
        (package / name).write_text(text, "utf-8")
    return [f"{NAME}/{name}" for name in files if name not in LEFT_PLAIN]


def write_project(folder):
    """Write a project into folder from which pip or cibuildwheel makes a wheel of the package."""
    modules = write_sources(folder)
    (folder / "setup.py").write_text(SETUP.format(modules=modules), "utf-8")
    shutil.copyfile(WHEEL / "pyproject.toml", folder / "pyproject.toml")
    trial = folder / "trial"  # not beside the sources, which Python would import for the wheel
    trial.mkdir(exist_ok=True)
    shutil.copyfile(WHEEL / "falls.py", trial / "falls.py")


def build(folder):
    """Compile the engine in folder. Raises RuntimeError with the compiler's messages."""
    command = [sys.executable, "-m", "mypyc", *write_sources(folder)]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(
            f"mypyc could not compile {folder}. It needs mypy and a C compiler.\n"
            f"{done.stdout}{done.stderr}"
        )


def load(folder):
    """Return the compiled engine in folder, or None if it is of another source or Python."""
    package = folder / NAME
    try:
        if any((package / name).read_text("utf-8") != t for name, t in sources().items()):
            return None
    except FileNotFoundError:
        return None
    before = list(sys.path)
    sys.path.append(str(folder))
    try:
        engine = importlib.import_module(NAME)
    except ImportError:
        return None
    finally:
        sys.path[:] = before
    return None if engine.world.__file__.endswith(".py") else engine


class Compiled(Stable):
    """The stable engine, compiled. Its package is set once one is found."""

    package = None


PLAIN = "The stable engine runs as plain source; python -m experiments.compiled makes a faster one."


def use_compiled(folders=FOLDERS):
    """Use the compiled stable engine where there is one. Return a sentence that says so."""
    folder = find(folders)
    if folder is None:
        return PLAIN
    ENGINES[Stable.name] = Compiled
    return f"The stable engine is the compiled one in {folder}: the same bits, in less time."


def time_compiled(folders=FOLDERS):
    """Time the compiled engine beside the plain one. Return a sentence that says so."""
    folder = find(folders)
    timed = f"The compiled stable engine in {folder} is timed beside the plain source."
    return timed if folder else PLAIN


def find(folders):
    """Let Compiled use the first engine found in `folders`. Return its folder or None."""
    for folder in folders:
        Compiled.package = load(folder)
        if Compiled.package:
            return folder
    return None


def same_bits(seconds=2.0):
    """Return the named scenes in which the two builds differ in a bit after so many seconds."""
    differ = []
    for name, make in NAMED.items():
        plain, compiled = Stable(make()), Compiled(make())
        for engine in (plain, compiled):
            run(engine, seconds)
        if bits(plain) != bits(compiled):
            differ.append(name)
    return differ


def main(arguments=None):
    """Compile, compare and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--out", type=Path, default=OUT)
    parser.add_argument("--project", type=Path, help="only write what a wheel is made from")
    options = parser.parse_args(arguments)
    if options.project:
        write_project(options.project)
        return
    folder = options.out.resolve()
    print(f"compiling stable_engine into {folder} (about half a minute) ...")
    try:
        build(folder)
    except RuntimeError as error:
        sys.exit(str(error))
    Compiled.package = load(folder)
    if Compiled.package is None:
        sys.exit(f"What was compiled into {folder} cannot be imported.")
    differ = same_bits()
    answer = "NO: " + ", ".join(differ) if differ else "yes"
    print(f"the same bits in {len(NAMED)} scenes: {answer}")
    print(f"to use it, put {folder} on PYTHONPATH and import {NAME} for stable_engine")
    sys.exit(1 if differ else 0)


if __name__ == "__main__":
    main()
