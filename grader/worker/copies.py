"""Give each child its own copy of the submission, and compile the submission once for all."""

import os
import py_compile
import re
import sys
from contextlib import suppress
from pathlib import Path

from grader.protocol import ChildSetup

OLD_FILE = os.O_RDONLY | getattr(os, "O_BINARY", 0)
WORD = re.compile(r"\w+")
NEW_FILE = os.O_WRONLY | os.O_CREAT | os.O_TRUNC | getattr(os, "O_BINARY", 0)


def copy_submission(setup: ChildSetup, folder: str) -> list[str]:
    """Copy the submission into a folder of this child; return the names of its files.

    Files keep their times, by which Python knows whether compiled files are still good. Folders
    that the child only reads become links.

    It makes system calls itself, because every child copies every file. Each child reads the files
    itself: data read by the warm process would be in the memory of the next submission's children.
    """
    found: list[str] = []
    waiting = [""]
    while waiting:
        inside = waiting.pop()
        copies = not inside.startswith(tuple(f"{each}/" for each in setup.shown))
        if copies:
            make_folder(os.path.join(folder, inside), os.path.join(setup.bytecode, inside))
        with os.scandir(os.path.join(setup.submission, inside)) as entries:
            for entry in sorted(entries, key=lambda each: each.name):
                name = inside + entry.name
                if entry.is_dir(follow_symlinks=False):
                    waiting.append(f"{name}/")
                    continue
                found.append(name)
                if copies:
                    with suppress(OSError):  # more than a child may have: the file is missing
                        copy_file(entry, os.path.join(folder, name))
    for name in setup.shown:
        os.symlink(os.path.join(setup.submission, name), os.path.join(folder, name))
    return found


def make_folder(target: str, compiled: str) -> None:
    """Make a folder of the copy, with a link to its compiled files."""
    with suppress(OSError):  # more than a child may have, or Windows may not allow links
        os.mkdir(target)
        if os.path.isdir(compiled):
            os.symlink(compiled, os.path.join(target, "__pycache__"), target_is_directory=True)


def copy_file(entry: "os.DirEntry[str]", target: str) -> None:
    about = entry.stat(follow_symlinks=False)
    source = os.open(entry.path, OLD_FILE)
    try:
        data = os.read(source, about.st_size)
    finally:
        os.close(source)
    descriptor = os.open(target, NEW_FILE, 0o666)
    try:
        os.write(descriptor, data)
    finally:
        os.close(descriptor)
    os.utime(target, ns=(about.st_mtime_ns, about.st_mtime_ns))


def compile_all(setup: ChildSetup) -> None:
    """Compile the programs into the folder of compiled files, which other children only read.

    No line of the submission runs. Folders that children do not copy are left out, and a file that
    cannot be compiled: the child that imports it says why. Compiling stops when the folder is full.
    """
    submission, bytecode = Path(setup.submission), Path(setup.bytecode)
    size = 0
    for source in list_sources(submission, setup.programs)[: setup.limits.scratch_files]:
        inside = source.relative_to(submission)
        if inside.parts[0] in setup.shown:
            continue
        target = bytecode / inside.parent / f"{source.stem}.{sys.implementation.cache_tag}.pyc"
        with suppress(py_compile.PyCompileError, OSError, ValueError, MemoryError):
            py_compile.compile(str(source), str(target), str(source), doraise=True)
            size += target.stat().st_size
        if size > setup.limits.scratch_mb * 1024 * 1024:
            return


def list_sources(submission: Path, programs: list[str]) -> list[Path]:
    """Return the files of the programs, and of the modules that these and other modules name."""
    sources = sorted(submission.rglob("*.py"), key=lambda path: (len(path.parts), path))
    if not programs:
        return sources
    modules: dict[str, list[Path]] = {}
    for source in sources:
        top = source.relative_to(submission).parts[0].removesuffix(".py")
        modules.setdefault(top, []).append(source)
    found: list[Path] = []
    waiting = list(programs)
    while waiting:
        for source in modules.pop(waiting.pop(), ()):
            found.append(source)
            waiting += WORD.findall(source.read_text("utf-8", "replace"))
    return found
