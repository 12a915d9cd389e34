"""Restore given code: `check --restore`."""

import os
from collections.abc import Iterable
from pathlib import Path, PurePosixPath

from grader.errors import Stop
from grader.judge.failures import MOST_NAMES
from grader.judge.plain import read_plain
from grader.judge.result import CheckResult, Result
from grader.judge.submission import load_given
from grader.judge.wording import command
from grader.report.files import write_whole
from grader.source.flaws import find_flaw
from grader.source.given import GivenChange, compare_files, keep_regions, undo_changes
from grader.source.regions import RegionError, encode, read_source


def find_changes(tree: Path) -> list[GivenChange]:
    own = {name: tree / name for name in load_given() if (tree / name).is_file()}
    return compare_files({name: read_source(path) for name, path in own.items()}, load_given())


def list_notes(tree: Path, result: Result) -> list[str]:
    """Return lines on changed given code, or none if a check names it.

    Given code in a TODO's function counts only while the TODO fails; it cannot be restored.
    """
    checks = [check for todo in result.todos for check in todo.checks]
    if any(check.failed and check.where is not None and check.where.given for check in checks):
        return []
    unread = {check.where.file for check in checks if check.where and is_unread(check)}
    found = [each for each in find_changes(tree) if each.file not in unread]
    failing = {todo.id for todo in result.todos if todo.failed}
    said = " ".join(check.meaning for check in checks)
    notes = [each.outside for each in found if each.todo in failing and each.outside not in said]
    names = [*dict.fromkeys(each.to_type for each in found if not each.todo)]
    if names:
        more = f" and {len(names) - MOST_NAMES} more" * (len(names) > MOST_NAMES)
        shown = ", ".join(names[:MOST_NAMES]) + more
        undo = command("check", restore=names[0])
        notes.append(f"Given code was changed: {shown}. Undo it: {undo}")
    return notes


def is_unread(check: CheckResult) -> bool:
    """Return whether a check failed because Python cannot read its file."""
    return check.failed and check.ran.startswith("reading ")


def restore(tree: Path, name: str) -> list[str]:
    """Restore the function, constant or file of this name; return a line on each file.

    TODO regions stay, and a copy of each old file is kept beside it.
    """
    texts = make_texts(tree, name)
    if not texts:
        return [f"{name} is unchanged: there is nothing to restore."]
    for file, text in texts.items():  # write both files or none
        if flaw := find_flaw(text):
            raise Stop(
                f"{file} would be no Python with that (line {flaw.line}: {flaw.message}): correct "
                f"it, or restore all of its given code with --restore {file}"
            )
    return [write_text(tree, name, file, text) for file, text in texts.items()]


def make_texts(tree: Path, name: str) -> dict[str, str]:
    """Return the files to write, with the given code of this name."""
    given = load_given()
    file = name.replace("\\", "/").removeprefix("./")
    if file in given:
        own = read_source(tree / file) if (tree / file).is_file() else given[file]
        try:
            text = keep_regions(own, given[file])
        except RegionError as error:
            raise Stop(f"the TODO markers of {file} do not pair up: {error}") from None
        return {file: text} if text != own or not (tree / file).is_file() else {}
    found = find_changes(tree)
    named = [each for each in found if name in (each.name, each.name.rpartition(".")[2])]
    if not named and not is_given(name, given.values()):
        names = ", ".join(dict.fromkeys(each.to_type for each in found))
        more = f"changed are {names}" if names else "nothing that was given is changed"
        raise Stop(f"no given function, constant or file is called {name}; {more}")
    files = dict.fromkeys(each.file for each in named)
    return {
        file: undo_changes(read_source(tree / file), [each for each in named if each.file == file])
        for file in files
    }


def is_given(name: str, texts: Iterable[str]) -> bool:
    short = name.rpartition(".")[2]
    return any(f"def {short}(" in text or f"\n{short} = " in text for text in texts)


def write_text(tree: Path, name: str, file: str, text: str) -> str:
    """Write a file, keep a copy of the old one, and return a line on it."""
    path, content = tree / file, encode(text)
    if link := find_link(tree, file):
        raise Stop(f"{link} is a link, and links are not followed: put there what it leads to")
    if not path.is_file():
        write_whole(content, path)
        return f"{file} is there again, as it was handed out."
    copy = find_free_name(path)
    write_whole(read_plain(tree, file), copy)
    write_whole(content, path)
    kept = copy.relative_to(tree).as_posix()
    what = "its given code" if name.endswith(".py") else name
    return f"{file}: {what} is as it was handed out. The file as it was is kept as {kept}."


def find_link(tree: Path, file: str) -> str:
    """Return the first link in a file's path inside the tree; empty without one."""
    inside = PurePosixPath(file)
    parts = [*reversed(inside.parents), inside][1:]  # the first is the tree itself
    return next((str(each) for each in parts if (tree / each).is_symlink()), "")


def find_free_name(path: Path) -> Path:
    """Return an unused name beside `solver.py`, such as `solver_old.py`."""
    names = [f"{path.stem}_old.py", *(f"{path.stem}_{n}_old.py" for n in range(2, 1000))]
    return next(path.with_name(name) for name in names if not os.path.lexists(path.with_name(name)))
