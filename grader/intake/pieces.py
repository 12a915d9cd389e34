"""Find the lab's files in a submission, at any depth and under changed names.

Browsers and learning systems put `(1)`, `-2` or `copy` into a name, and people put `final` or their
name. Python cannot import such a name, so the file is taken as the lab's, with a note. If two files
could be the same program, a person must choose.
"""

import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass, field
from functools import cache, lru_cache
from pathlib import Path, PurePosixPath
from typing import NoReturn
from urllib.parse import unquote

from grader.intake.found import CannotTake
from grader.intake.names import fold
from grader.intake.places import ARCHIVES, list_modules
from grader.judge.plain import read_plain
from grader.judge.submission import load_given, plain_files
from grader.protocol import MAX_UPLOAD
from grader.source.regions import regions_in

PACKAGE = "mini_engine"
INIT = "__init__.py"
NUMBER = r"\(\d{1,3}\)"
WORD = r"(copy|copie|copia|kopie)"  # in several languages
# No sign fits two parts of it: each such sign would double the time to read a name.
ADDED = re.compile(
    rf"(\s*{NUMBER}|(\s+|\s*-\s+){WORD}(\s+\d{{4,}})?|-\d{{1,3}}|\s+\d{{1,3}})+", re.I
)
BEFORE = re.compile(rf"({WORD} (of|de|di|von) )+", re.I)
MENTIONED = 5
MOST_READ = MAX_UPLOAD + 1  # of a file, to compare it with another one
SIGNS = {  # the beginnings of files that are not Python
    b"pk\x03\x04": "a zip or an Office document",
    b"%pdf": "a PDF",
    b"{\\rtf": "a text of a word processor",
    b"<!doctype": "a web page",
    b"<html": "a web page",
    b"<?xml": "XML",
    b'{"cells"': "a notebook",
}


class ManyPrograms(CannotTake):
    """Raised for two programs of one name in a submission: a person must choose."""

    def __init__(self, words: str, paths: Iterable[PurePosixPath] = ()) -> None:
        super().__init__(words)
        self.paths = list(paths)


@dataclass
class Layout:
    """The files of a submission by their names in the lab."""

    files: dict[str, Path]
    notes: list[str] = field(default_factory=list)


def strip_additions(name: str) -> str:
    """Return a name without the additions of browsers and learning systems."""
    name = unquote(name)
    name = re.sub(r"(?i)\.py\.txt$", ".py", name)
    stem, dot, suffix = name.partition(".py") if name.lower().endswith(".py") else (name, "", "")
    stem = BEFORE.sub("", stem)
    end = re.match(r"\w*", stem)
    if end and stem[end.end() :] and ADDED.fullmatch(stem[end.end() :]):
        stem = stem[: end.end()]
    return stem + dot + suffix


def match_name(name: str, names: Iterable[str]) -> str | None:
    """Return the one of `names` that `name` stands for, or None."""
    plain = fold(strip_additions(name))
    return next((each for each in names if each == name), None) or next(
        (each for each in names if fold(each) == plain), None
    )


@cache
def list_package_files() -> frozenset[str]:
    """Return the names of the files in the lab's package."""
    given = (PurePosixPath(name).parts for name in load_given())
    return frozenset(parts[1] for parts in given if len(parts) == 2 and parts[0] == PACKAGE)


@cache
def list_package_work() -> frozenset[str]:
    """Return the names of the files in the package that have a TODO."""
    names = (name for name in list_package_files() if name != INIT)
    return frozenset(n for n in names if regions_in(load_given()[f"{PACKAGE}/{n}"]))


@dataclass(frozen=True)
class Piece:
    """A program of the lab in a submission."""

    module: str
    path: PurePosixPath  # of a file or a folder
    files: tuple[tuple[str, PurePosixPath], ...]  # its name, and its path
    exact: bool

    def is_same(self, other: "Piece", folder: Path) -> bool:
        mine, others = (
            {n: read_plain(folder, p, MOST_READ) for n, p in x.files} for x in (self, other)
        )
        return mine == others


def arrange(folder: Path, asked: Collection[str], taken: Collection[str]) -> Layout:
    """Return the submission in `folder` as the lab lays it out.

    Raises ManyPrograms if two files at the same depth could be the same program, unless a person
    chose one of them or its folder, in `taken`.
    """
    left_out: set[PurePosixPath] = set()
    while True:
        try:
            return arrange_rest(folder, asked, left_out)
        except ManyPrograms as error:
            chosen = {
                path for path in error.paths if is_covered(path, set(map(PurePosixPath, taken)))
            }
            if len(chosen) != 1:
                raise
            left_out |= set(error.paths) - chosen


def list_choices(folder: Path, asked: Collection[str] = ()) -> list[list[PurePosixPath]]:
    """Return the paths to choose from, a list for each program."""
    choices: dict[PurePosixPath, list[PurePosixPath]] = {}
    left_out: set[PurePosixPath] = set()
    while True:
        try:
            arrange_rest(folder, asked, left_out)
        except ManyPrograms as error:
            first, *others = error.paths
            choices.setdefault(first, [first]).extend(others)
            left_out |= set(others)
        else:
            break
    by_folder = (list(dict.fromkeys(path.parent for path in paths)) for paths in choices.values())
    apart = zip(by_folder, choices.values(), strict=True)
    found = [at if len(at) == len(paths) else paths for at, paths in apart]
    return [each for number, each in enumerate(found) if each not in found[:number]]


def arrange_rest(folder: Path, asked: Collection[str], left_out: set[PurePosixPath]) -> Layout:
    """Arrange all files except those `left_out`.

    Two files for an optional program are no problem: either is taken.
    """
    found_paths = (PurePosixPath(p.relative_to(folder).as_posix()) for p in plain_files(folder))
    paths = sorted(path for path in found_paths if not is_covered(path, left_out))
    notes = [f"{path} was skipped: another was chosen" for path in sorted(left_out)]
    found = find_candidates(paths)
    asked = asked or list_modules()
    by_module: dict[str, list[Piece]] = {}
    for each in [*found, *find_renamed(paths, found)]:
        by_module.setdefault(each.module, []).append(each)
    pieces = [
        choose_piece(by_module[module], folder, notes, module in asked)
        for module in sorted(by_module)
    ]
    if PACKAGE not in {piece.module for piece in pieces}:
        pieces += find_loose_package(paths, folder)
    if not pieces:
        return Layout({})
    top = find_top(pieces)
    files: dict[str, Path] = {}
    elsewhere: set[PurePosixPath] = set()
    for piece in pieces:
        for name, path in list_files(piece, folder, notes):
            files[name] = folder / path
            elsewhere.add(path)
        target = PurePosixPath(piece.module).with_suffix(piece.path.suffix and ".py")
        if piece.path not in (target, top / target):
            notes.append(f"{piece.path} is taken as {target}")
    for path in paths:
        if path not in elsewhere and path.is_relative_to(top):
            files.setdefault(path.relative_to(top).as_posix(), folder / path)
    for parent in {piece.path.parent for piece in pieces if piece.module != PACKAGE} - {top}:
        for path in paths:
            if path.parent == parent and path.suffix == ".py" and path not in elsewhere:
                files.setdefault(path.name, folder / path)
    return Layout(files, notes)


def find_candidates(paths: list[PurePosixPath]) -> list[Piece]:
    """Return all possible programs of the lab; files inside a package are part of it."""
    found: list[Piece] = []
    taken: set[PurePosixPath] = set()  # their folder
    folders: dict[PurePosixPath, list[PurePosixPath]] = {}
    for path in paths:
        for parent in path.parents:
            folders.setdefault(parent, []).append(path)
    for folder in sorted(folders, key=lambda each: (len(each.parts), each)):
        module = match_name(folder.name, list_modules())
        if module and not is_covered(folder, taken) and is_package(folder, folders[folder]):
            inside = tuple((f"{module}/{p.relative_to(folder)}", p) for p in folders[folder])
            found.append(Piece(module, folder, inside, folder.name == module))
            taken.add(folder)
    for path in paths:
        module = match_name(path.name, {f"{name}.py" for name in list_modules()})
        if module and not is_covered(path, taken):
            name = module.removesuffix(".py")
            found.append(Piece(name, path, ((module, path),), path.name == module))
            taken.add(path)
    return found


def find_renamed(paths: list[PurePosixPath], found: list[Piece]) -> list[Piece]:
    """Return files under other names, for programs that are missing."""
    lacking = sorted(list_modules() - {piece.module for piece in found})
    taken = {piece.path for piece in found}
    pieces = []
    for path in paths:
        module = next((each for each in lacking if is_renamed(path.name, each)), None)
        if module and not is_covered(path, taken):
            pieces.append(Piece(module, path, ((f"{module}.py", path),), exact=False))
    return pieces


def is_renamed(name: str, module: str) -> bool:
    """Return whether a file name that Python cannot import has `module` as a word.

    A text file counts too: some systems refuse names that end in `.py`.
    """
    stem, _, suffix = fold(unquote(name).strip()).rpartition(".")
    stem = stem.removesuffix(".py")
    if suffix == "txt":
        return stem == module
    alone = re.search(rf"(?<!\w){module}(?!\w)", stem)
    return suffix == "py" and not stem.isidentifier() and alone is not None


def is_covered(path: PurePosixPath, taken: set[PurePosixPath]) -> bool:
    return not taken.isdisjoint((path, *path.parents))


def is_package(folder: PurePosixPath, inside: list[PurePosixPath]) -> bool:
    """Return whether `folder` is a package, not just a folder around programs."""
    direct = {path.relative_to(folder).parts[0] for path in inside}
    around = any(match_name(name.removesuffix(".py"), list_modules()) for name in direct)
    return INIT in direct or (not around and any(name.endswith(".py") for name in direct))


def choose_piece(pieces: list[Piece], folder: Path, notes: list[str], matters: bool) -> Piece:
    """Return the candidate nearest to the top.

    Among several at that depth, a person must choose if it `matters`; if not, the exact name wins.
    """
    nearest = min(len(piece.path.parts) for piece in pieces)
    first, *others = drop_backups([p for p in pieces if len(p.path.parts) == nearest], notes)
    if others and not matters:
        first = next((piece for piece in [first, *others] if piece.exact), first)
        notes.append(f"{first.path} is taken of several {first.module}; none of them is asked for")
        others = []
    for other in others:
        if first.exact and other.exact and first.path.parent == other.path.parent:
            continue  # Python imports a package before a file
        apart = first.path.parent != other.path.parent  # possibly of two students
        if apart or not first.is_same(other, folder):
            refuse_two(first.module, [first.path, other.path])
        notes.append(f"{first.path} and {other.path} are the same")
    for other in pieces:
        if len(other.path.parts) > nearest and not first.is_same(other, folder):
            notes.append(f"{other.path} was skipped: {first.path} lies nearer to the top")
    return first


def drop_backups(pieces: list[Piece], notes: list[str]) -> list[Piece]:
    """Skip copies that a desktop made, if the original lies beside them."""
    backups = [piece for piece in pieces if not piece.exact and is_backup(piece.path.name)]
    if len(backups) == len(pieces):
        return pieces
    notes += [f"{piece.path} was skipped as a backup" for piece in backups]
    return [piece for piece in pieces if piece.exact or not is_backup(piece.path.name)]


def is_backup(name: str) -> bool:
    return re.search(rf"\b{WORD}\b", name, re.I) is not None


def refuse_two(
    what: str, paths: list[PurePosixPath], choices: Iterable[PurePosixPath] = ()
) -> NoReturn:
    """Raise ManyPrograms: a person must choose one of `choices`, or else `paths`."""
    at = sorted({path.parent.as_posix() for path in paths})
    places = ", ".join(at if len(at) == len(paths) else sorted(map(str, paths)))
    raise ManyPrograms(
        f"there is more than one program {what}, in {places}: leave one", choices or paths
    )


def find_loose_package(paths: list[PurePosixPath], folder: Path) -> list[Piece]:
    """Return the package's files that lie without their folder, or in one of another name."""
    work = {path for path in paths if match_name(path.name, list_package_work())}
    at = sorted({path.parent for path in work}, key=lambda each: (len(each.parts), each))
    at = [each for each in at if len(each.parts) == len(at[0].parts)]
    if not at:
        return []
    if len(at) > 1:
        refuse_two(PACKAGE, [each / INIT for each in at], at)
    inside = [path for path in paths if path.is_relative_to(at[0])]
    if at[0] / INIT not in inside:
        inside = [
            p for p in inside if p.parent == at[0] and match_name(p.name, list_package_files())
        ]
    files = tuple((f"{PACKAGE}/{path.relative_to(at[0])}", path) for path in inside)
    here = at[0] if at[0].parts else PurePosixPath(inside[0].name)
    return [Piece(PACKAGE, here, files, exact=False)]


def list_files(piece: Piece, folder: Path, notes: list[str]) -> list[tuple[str, PurePosixPath]]:
    """Return a piece's files by the lab's names."""
    if piece.module != PACKAGE or len(piece.files) == 1:
        return list(piece.files)
    files: dict[str, PurePosixPath] = {}
    for name, path in sorted(
        piece.files, key=lambda each: (strip_additions(each[0]) != each[0], each[0])
    ):
        inside = PurePosixPath(name).relative_to(PACKAGE)
        known = match_name(inside.name, list_package_files()) if len(inside.parts) == 1 else None
        target = f"{PACKAGE}/{known}" if known else name
        other = files.setdefault(target, path)
        if other != path and is_backup(path.name):
            notes.append(f"{path} was skipped as a backup")
            continue
        if other != path and read_plain(folder, other, MOST_READ) != read_plain(
            folder, path, MOST_READ
        ):
            refuse_two(target, [other, path])
        if target != name:
            notes.append(f"{path} is taken as {target}")
    return list(files.items())


def find_top(pieces: list[Piece]) -> PurePosixPath:
    """Return the folder that holds most of the programs, the first of those nearest to the top."""
    parents = [piece.path.parent for piece in pieces]
    return min(parents, key=lambda each: (-parents.count(each), len(each.parts), each))


@lru_cache(maxsize=1024)  # most files of an archive lie in the same folders
def is_program(name: str) -> bool:
    """Return whether a file or folder may be a program of the lab, by its name."""
    return (
        match_name(name, [*list_modules(), *(f"{each}.py" for each in list_modules())]) is not None
    )


def rank_file(path: PurePosixPath) -> tuple[bool, bool, int, PurePosixPath]:
    """Return a file's rank for limited space: the lab's files come first."""
    of_lab = any(map(is_program, path.parts))
    packed = path.suffix.lower() in ARCHIVES
    return not of_lab and not packed, path.suffix != ".py", len(path.parts), path


# ---------------------------------------------------------------- files that are no program


def refuse_empty(folder: Path, asked: Iterable[str], notes: Iterable[str]) -> NoReturn:
    """Raise CannotTake for a submission without a file of the lab; name its files."""
    names = sorted(path.relative_to(folder).as_posix() for path in plain_files(folder))
    more = f" and {len(names) - MENTIONED} more" if len(names) > MENTIONED else ""
    held = f"it holds {', '.join(names[:MENTIONED])}{more}"
    if not names:
        hidden = "but hidden files, links or what programs leave behind"
        held = f"it holds nothing {hidden}" if any(folder.iterdir()) else "it holds no file"
    words = "; ".join([held, *notes])
    raise CannotTake(f"nothing of the lab was found ({', '.join(sorted(asked))}): {words}")


def name_type(content: bytes) -> str:
    """Name the type of a file that is not Python; return an empty text for a possible program."""
    if not content.strip():
        return "empty"
    head = content.lstrip(b"\xef\xbb\xbf \t\r\n")[:64].lower()
    for sign, words in SIGNS.items():
        if head.startswith(sign):
            return words
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        return "text in UTF-16"
    return "no text" if b"\0" in content else ""
