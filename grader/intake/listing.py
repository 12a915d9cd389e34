"""Listing a class: whose each file and folder is, each submission once, and what is left out."""

import unicodedata
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from itertools import chain
from pathlib import Path

from grader.intake import (
    blackboard,
    brightspace,
    canvas,
    folders,
    gradescope,
    groups,
    loose,
    moodle,
)
from grader.intake.archives import unzip_class
from grader.intake.found import CannotTake, Found, Intake, Upload
from grader.intake.names import folded, portable
from grader.intake.packing import laid_out, pack
from grader.intake.pieces import ManyPrograms
from grader.intake.places import (
    entries_of,
    holds_program,
    is_archive,
    modules,
    programs_in,
)
from grader.intake.roster import CALLED, ClassList
from grader.judge.submission import CannotGrade
from grader.judge.workplace import work_folder

FORMS = (  # the first that knows a name decides
    blackboard.upload,
    brightspace.upload,
    moodle.upload,
    canvas.upload,
    folders.upload,
)


@contextmanager
def opened_class(path: Path, people: ClassList | None = None) -> Iterator[Intake]:
    """List the submissions in a folder or an archive of them; unpacked ones stay till the end."""
    if path.is_dir():
        yield listed(path, people or ClassList())
    elif is_archive(path) and path.is_file():
        with work_folder() as temporary:
            try:
                unzip_class(path, temporary)
            except CannotTake as error:
                raise CannotGrade(f"{path}: {error}") from error
            yield listed(without_wrapper(temporary), people or ClassList())
    else:
        raise CannotGrade(f"there is no folder of submissions at {path}, nor an archive of them")


def listed(folder: Path, people: ClassList) -> Intake:
    inner = entries_of(folder)
    if len(inner) == 1 and gradescope.is_whole_export(inner[0]):
        folder = inner[0]  # Gradescope's zip holds one folder
    if holds_program(folder):
        raise CannotGrade(f"{folder} is one submission, not a folder of them: leave out --class")
    intake = Intake()
    found: list[Found] = []
    if gradescope.is_export(folder):
        found += gradescope.submissions(folder, people, intake)
    taken = {source for each in found for source in each.sources}
    left = [path for path in entries_of(folder) if path not in taken]
    found += by_name(left, people, intake)
    intake.found = list(without_doubles(found, intake))
    groups.share(intake, people, digest_or_trouble)
    intake.found.sort(key=lambda each: each.name)
    if not intake.found and not intake.troubles:
        raise CannotGrade(f"{folder} holds no submission: each must be a folder or an archive")
    return intake


def without_wrapper(folder: Path) -> Path:
    """A zip often holds one folder, and all submissions in that."""
    inner = entries_of(folder)
    wrapped = len(inner) == 1 and inner[0].is_dir() and not holds_program(inner[0])
    if wrapped and gradescope.is_export(inner[0]):
        wrapped = gradescope.is_whole_export(inner[0])
    return inner[0] if wrapped else folder


def by_name(paths: list[Path], people: ClassList, intake: Intake) -> Iterator[Found]:
    """Folders and archives of any name, and what learning systems make of names."""
    groups: dict[tuple[str, str], list[Upload]] = {}
    empty: dict[str, Path] = {}
    for path in paths:
        upload = None if path.is_symlink() else upload_at(path, people)
        if upload is None:
            loose.mention(path, intake, people)
        elif upload.empty:
            empty[upload.name] = path
        else:
            groups.setdefault((upload.name, upload.owner), []).append(upload)
    for (name, _), group in groups.items():
        if any(each.timeless for each in group) and len({each.attempt for each in group}) > 1:
            told = " and ".join(sorted({each.path.name for each in group}))
            intake.troubles[name] = f"handed in more than once, and when is not read: {told}"
            continue
        last = max(each.attempt for each in group)
        if before := sorted({each.attempt for each in group if each.attempt != last}):
            intake.notes.append(f"{name}: of {len(before) + 1} attempts the last counts, of {last}")
        group = [each for each in group if each.attempt == last]
        handed_in = tuple(each.path for each in group)
        late = any(each.late for each in group)
        when = group[0].handed_in
        if all(each.from_lms for each in group):
            yield Found(name, handed_in, late, when)
        else:
            yield from (Found(name, (path,), late, when) for path in handed_in)
    names = {name for name, _ in groups}
    for name, path in empty.items():
        if name not in names:
            intake.troubles[name] = f"{path.name}: a text or a link was handed in, and no file"


def upload_at(path: Path, people: ClassList) -> Upload | None:
    """Whose a file or folder is, by the first form that knows such a name."""
    upload = next(filter(None, (form(path, people) for form in FORMS)), None)
    called = people.name_of([CALLED], upload.name) if upload else None
    return replace(upload, name=portable(called)) if upload and called else upload


def without_doubles(found: Iterable[Found], intake: Intake) -> Iterator[Found]:
    """One submission each: two with the same files are one, others are for a person to choose."""
    groups: dict[str, list[Found]] = {}
    for each in found:
        groups.setdefault(folded(each.name), []).append(each)
    refused = {folded(name): words for name, words in intake.troubles.items()}
    for name, group in groups.items():
        places = [each.sources[0].name for each in group]
        if name in refused:
            places.append(refused[name].partition(" ")[0])
        if len(places) == 1:
            yield group[0]
        elif name not in refused and len({digest_or_trouble(each) for each in group}) == 1:
            intake.notes.append(f"{' and '.join(places)} are the same: the first counts")
            yield group[0]
        else:
            words = f"handed in more than once, as {' and '.join(told_apart(places))}: leave one"
            other = ", or rename one where they are two students'" * (len(set(places)) > 1)
            intake.troubles[group[0].name] = words + other


def told_apart(names: list[str]) -> list[str]:
    """Names as they are, or letter by letter where they look the same."""
    same = len({unicodedata.normalize("NFC", name) for name in names}) < len(set(names))
    return [ascii(name) for name in names] if same else names


def digest_or_trouble(each: Found) -> str:
    try:
        return pack(each).digest
    except CannotTake as error:
        return str(error)


# ---------------------------------------------------------------- a class without --class


def class_in(folder: Path) -> list[str]:
    """The submissions in a folder that is none itself; empty where it may well be one.

    One submission may lie deeper in, or a folder for each of its programs. So there is a class only
    where none of the programs is in the folder itself, and one is in two or more of what it holds.
    """
    try:
        found = [] if holds_program(folder) else listed(folder, ClassList()).found
    except (CannotGrade, OSError):
        return []
    programs = {each.name: programs_of(each) for each in found}
    count = Counter(chain.from_iterable(programs.values()))
    return [name for name, held in programs.items() if any(count[each] > 1 for each in held)]


def programs_of(found: Found) -> frozenset[str]:
    """The programs that a submission holds, wherever; all where two places have some."""
    try:
        with laid_out(found) as (root, _):
            return programs_in(root)
    except ManyPrograms:
        return modules()
    except (CannotTake, CannotGrade, OSError):
        return frozenset()
