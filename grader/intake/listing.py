"""List a class: each submission once with its owner, and work that cannot be graded."""

import pickle
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path

from grader.errors import Stop
from grader.intake.archives import unzip_class
from grader.intake.found import CannotTake, Intake, Upload, Work
from grader.intake.groups import share_work
from grader.intake.learning_systems import SYSTEMS
from grader.intake.lms import Lms
from grader.intake.names import fold, make_portable
from grader.intake.packing import pack, read_first_name
from grader.intake.places import cut_suffix, has_program, is_archive, list_folder
from grader.intake.roster import CALLED, KEYS, ClassList, find_student
from grader.intake.systems import ANY_OTHER
from grader.judge.wall.outer import Allowance, Exceeded, Failed, Lost, call_each_within, call_within
from grader.judge.wall.workplace import work_folder

SIDE_FILES = {"adjustments.toml", "roster.csv"}.union(*(each.side_files for each in SYSTEMS))
WORK = {".py", ".ipynb"}  # the suffixes of students' work
UNREAD = {".zst", ".lz", ".lzma", ".z", ".lzh", ".arj", ".ace", ".cab", ".iso", ".dmg", ".001"}

UNPACKING = Allowance("unpacking the class", cpu=1200)
LISTING = Allowance("listing the class", cpu=120)
NAMING = Allowance("reading its name", cpu=5)


@contextmanager
def open_class(path: Path, people: ClassList | None = None) -> Iterator[Intake]:
    """List the submissions in a folder or an archive, which stays unpacked till the end."""
    if path.is_dir():
        yield list_class(path, people or ClassList())
    elif is_archive(path) and path.is_file():
        with work_folder() as temporary:
            try:
                unzip = partial(unzip_class, path, temporary)
                call_within(UNPACKING, None, unzip, (CannotTake,))
            except (CannotTake, Exceeded, Failed, Lost) as error:
                raise Stop(f"{path}: {error}") from error
            yield list_class(enter_wrapper(temporary), people or ClassList())
    else:
        raise Stop(f"there is no folder of submissions at {path}, nor an archive of them")


def list_class(folder: Path, people: ClassList) -> Intake:
    """Return the submissions in a folder, and notes on everything else."""
    inner = list_folder(folder)
    if len(inner) == 1 and find_export(inner[0]).is_whole_export(inner[0]):
        folder = inner[0]  # Gradescope's zip holds one folder
    if has_program(folder):
        raise Stop(f"{folder} is one submission, not a folder of them: leave out --class")
    intake = read_names(folder, people)
    intake.found = list(drop_doubles(intake.found, intake))
    apply_choices(intake, people)
    share_work(intake, people, hash_files)
    intake.found.sort(key=lambda each: each.name)
    if not intake.found and not intake.troubles:
        raise Stop(f"{folder} holds no submission: each must be a folder or an archive")
    return intake


def read_names(folder: Path, people: ClassList) -> Intake:
    """Return the owner of each file and folder, by names and the lists of an export.

    A name that reaches a limit needs manual review; the rest of the class goes on.
    """
    paths = list_folder(folder)
    try:
        return read_within_limits(folder, paths, people)
    except (Exceeded, Failed, Lost):
        odd = find_odd_names(paths, people)
    try:
        intake = read_within_limits(folder, [each for each in paths if each not in odd], people)
    except (Exceeded, Failed, Lost) as error:
        raise Stop(f"{folder}: {error}") from error
    for path, words in odd.items():
        name = make_portable(path.name)
        intake.refuse(name, f"its name cannot be read: {words}", Work(name, (path,)))
    return intake


def read_within_limits(folder: Path, paths: list[Path], people: ClassList) -> Intake:
    def read() -> bytes:
        intake = Intake()
        intake.found += find_export(folder).read_export(folder, people, intake)
        taken = {source for each in intake.found for source in each.sources}
        left = [path for path in paths if path not in taken]
        intake.found += list_uploads(left, people, intake)
        return pickle.dumps(intake)

    intake: Intake = pickle.loads(call_within(LISTING, bytes, read, (Stop,)))
    return intake


def find_odd_names(paths: list[Path], people: ClassList) -> dict[Path, str]:
    """Return the files and folders whose name alone reaches a limit, each with the reason."""

    def read(path: Path) -> None:
        list(list_uploads([path], people, Intake()))

    answers = call_each_within(NAMING, None, [partial(read, each) for each in paths])
    pairs = zip(paths, answers, strict=True)
    return {path: str(answer) for path, answer in pairs if isinstance(answer, Exception)}


def find_export(folder: Path) -> Lms:
    """Return the system whose list of submissions lies in a folder."""
    return next((each for each in SYSTEMS if each.is_export(folder)), ANY_OTHER)


def enter_wrapper(folder: Path) -> Path:
    """Return the only inner folder if it holds all submissions, as in many zips."""
    inner = list_folder(folder)
    if len(inner) != 1 or not inner[0].is_dir() or has_program(inner[0]):
        return folder
    export = find_export(inner[0])
    return inner[0] if export is ANY_OTHER or export.is_whole_export(inner[0]) else folder


# ---------------------------------------------------------------- by names of files


def list_uploads(paths: list[Path], people: ClassList, intake: Intake) -> Iterator[Work]:
    """Return submissions by the names of files and folders; note the rest."""
    groups: dict[tuple[str, str], list[Upload]] = {}
    empty: dict[str, Path] = {}
    # The system whose pattern fits most of these names comes first, so that no student can claim
    # another's work with a name from another system.
    systems = sorted(SYSTEMS, key=lambda each: -sum(map(bool, map(each.match, paths))))
    for path in paths:
        upload = None if path.is_symlink() else read_upload(path, people, systems)
        if any(each.is_trial(path) for each in systems):
            intake.notes.append(f"{path.name} was skipped: a test submission of the teacher")
        elif upload is None:
            mention_file(path, intake, people)
        elif upload.empty:
            empty[upload.name] = path
        else:
            groups.setdefault((upload.name, upload.owner), []).append(upload)
    for (name, _), group in groups.items():
        yield from choose_attempt(name, group, intake)
    names = {name for name, _ in groups}
    for name, path in empty.items():
        if name not in names:
            words = f"{path.name}: a text or a link was handed in, and no file"
            intake.refuse(name, words, Work(name, (path,)))


def choose_attempt(name: str, uploads: list[Upload], intake: Intake) -> Iterator[Work]:
    """Yield the last attempt: one work if the LMS named all files, else one per file."""
    attempts = sorted({each.attempt for each in uploads})
    if len(attempts) > 1 and any(each.timeless for each in uploads):
        files = " and ".join(sorted({each.path.name for each in uploads}))
        works = [Work(name, (each.path,), each.late, each.handed_in) for each in uploads]
        intake.refuse(name, f"handed in more than once, at unknown times: {files}", *works)
        return
    last = attempts[-1]
    if len(attempts) > 1:
        intake.notes.append(f"{name}: of {len(attempts)} attempts the last counts, of {last}")
    uploads = [each for each in uploads if each.attempt == last]
    paths = tuple(each.path for each in uploads)
    late = any(each.late for each in uploads)
    together = all(each.from_lms for each in uploads)
    for sources in [paths] if together else [(path,) for path in paths]:
        yield Work(name, sources, late, uploads[0].handed_in)


def read_upload(path: Path, people: ClassList, systems: Iterable[Lms] = SYSTEMS) -> Upload | None:
    """Return an upload; outside an LMS, a folder's or archive's name is its owner."""
    uploads = (each.read_upload(path, people) for each in systems)
    upload = next(filter(None, uploads), None)
    if upload is None and (path.is_dir() or is_archive(path)):
        name = path.name if path.is_dir() else cut_suffix(path)
        upload = Upload(path, make_portable(name))
    called = people.find([CALLED], upload.name) if upload else None
    return replace(upload, name=make_portable(called)) if upload and called else upload


def mention_file(path: Path, intake: Intake, people: ClassList) -> None:
    """Refuse a file that is no submission but may be a student's work; note any other."""
    name = people.find([*KEYS, "ID", CALLED, "name"], path.stem)
    suffix = path.suffix.lower()
    if path.is_symlink():
        words = f"{path.name} is a link, and links are not followed: put there what it leads to"
        name = name or path.name
    elif suffix in WORK:
        words = f"{path.name} is no folder and no archive: put it into a folder"
        name = name or path.stem
    elif suffix in UNREAD:
        words = f"{path.name} is packed in a way that is not read: a zip is needed"
        name = name or path.stem
    else:
        words = f"nothing of the lab was found: {path.name} is no folder and no archive"
    if name is not None:
        name = make_portable(name)
        intake.refuse(name, words, Work(name, (path,)))
    elif path.name not in SIDE_FILES and suffix != ".csv":
        intake.notes.append(f"{path.name} is no submission: skipped")


# ---------------------------------------------------------------- each submission once


def drop_doubles(found: Iterable[Work], intake: Intake) -> Iterator[Work]:
    """Yield one submission per student; refuse different ones of the same student."""
    groups: dict[str, list[Work]] = {}
    for each in found:
        groups.setdefault(fold(each.name), []).append(each)
    refused = {fold(name): words for name, words in intake.troubles.items()}
    for name, group in groups.items():
        places = [each.sources[0].name for each in group]
        if name in refused:
            places.append(refused[name].partition(" ")[0])
        if len(places) == 1:
            yield group[0]
        elif name not in refused and len({hash_files(each) for each in group}) == 1:
            intake.notes.append(f"{' and '.join(places)} are the same: the first counts")
            yield group[0]
        else:
            words = f"handed in more than once, as {' and '.join(places)}: leave one"
            other = ", or rename one where they are two students'" * (len(set(places)) > 1)
            intake.refuse(group[0].name, words + other, *group)


# ---------------------------------------------------------------- choices of a person


def apply_choices(intake: Intake, people: ClassList) -> None:
    """Give each student the work that a person chose for them."""
    for who, path in people.chosen:
        names = intake.names
        name = find_student(who, [*names, *people.list_absent(names)], people)
        if not choose_work(intake, people, make_portable(name), path):
            intake.notes.append(f"{who}: {path!r} was chosen, and nothing of that name is there")


def choose_work(intake: Intake, people: ClassList, name: str, path: str) -> bool:
    """Give a student the work at `path`: a submission of the class, or a file or folder in one.

    Work under a name that is not in the class list then belongs to no other student.
    """
    first = path.partition("/")[0]
    works = intake.works
    other = next((each for each in works if path == each.name != name), None)
    other = other or next((w for w in works if first in {each.name for each in w.sources}), None)
    own = [each for each in works if each.name == name]
    work = other or (own[0] if len(own) == 1 else None)
    if work is None:
        return False
    if work.name != name and (not people.names or people.list_unlisted([work.name])):
        intake.drop(work.name)
    inside = enter_source(work, path) if work.name == name or path != work.name else ""
    taken = (*work.taken, inside) if inside else work.taken
    intake.drop(name)
    others = (each for each in intake.found if each.sources == work.sources)
    mates = {e.name: replace(e, taken=taken) for e in others if work.name == name}  # of a group
    intake.found = [mates.get(each.name, each) for each in intake.found]
    intake.found.append(replace(work, name=name, taken=taken))
    return True


def enter_source(work: Work, path: str) -> str:
    """Return where `path` lies in the unpacked work; empty for all of it."""
    first, _, rest = path.partition("/")
    source = next((each for each in work.sources if each.name == first), None)
    if source is None or not rest:
        return "" if source else path
    return rest if source.is_dir() else f"{read_first_name(source)}/{rest}"


def hash_files(each: Work) -> str:
    """Return a hash of a submission's files, or the reason why it cannot be read."""
    try:
        return pack(each).digest
    except CannotTake as error:
        return str(error)
