"""Taking a class in: folders, git checkouts and zips, as people or an LMS put them together.

A class is listed first, without reading any submission; each is then packed when its turn comes, so
that a class of any size takes the memory of a few. What cannot be taken is said, never dropped.
"""

import hashlib
import re
import shutil
import stat
import tempfile
import unicodedata
import zipfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from dataclasses import field as of_dataclass
from datetime import UTC, datetime
from pathlib import Path, PurePosixPath
from typing import Any

import msgspec
import yaml
from msgspec import Struct, field

try:
    from yaml import CSafeLoader as SafeLoader
except ImportError:  # a PyYAML without its C library
    from yaml import SafeLoader  # type: ignore[assignment]

from grader.classroom.roster import Roster, folded, names_of
from grader.judge.rubric import load_rubric
from grader.judge.submission import (
    IGNORED,
    MAX_BYTES,
    MAX_FILES,
    CannotGrade,
    plain_files,
)

DEEPEST = 3  # folders around a program, and zips inside zips
MAX_ZIP = 200 * 1024**2  # bytes of one zip: somebody's virtual environment fits
MAX_DIRECTORY = 16 * 1024**2  # bytes of the list of files in a zip: about 200,000 of them
METADATA = "submission_metadata.yml"  # Gradescope's
SIDE_FILES = {METADATA, "adjustments.toml", "roster.csv"}  # of the class folder itself
DROPPINGS = {"thumbs.db", "desktop.ini", "__macosx"}  # and all that is hidden
ARCHIVES = {".7z", ".bz2", ".gz", ".rar", ".tar", ".tgz", ".xz"}
WORK = ARCHIVES | {".py", ".ipynb"}  # what is somebody's, though it cannot be graded like this
PORTS = {f"{port}{number}" for port in ("com", "lpt") for number in range(10)}
DEVICES = PORTS | {"con", "prn", "aux", "nul"}  # what Windows takes for no file
MENTIONED = 5  # of the files that are left out
UNPRINTED = re.compile(r'[<>:"/\\|?*]')  # what Windows has in no name

CANVAS = re.compile(r"(?P<name>\w+?)_(?P<late>LATE_)?(?P<user>\d+)_\d+_(?P<file>.+)")
CANVAS_ANONYMOUS = re.compile(r"(?P<late>LATE_)?(?P<name>anon)_(?P<user>[^\W_]+)_\d+_(?P<file>.+)")
CANVAS_NO_FILE = re.compile(r"(?P<name>\w+)_(text|link)\.html")
MOODLE = re.compile(r"(?P<name>.+)_(?P<id>\d+)_assignsubmission_(?P<kind>[a-z]+)(_(?P<file>.*))?")
COPY = re.compile(r"-\d+(?=\.py$)")  # what Canvas adds to the name of a file that comes again


class CannotTake(Exception):
    """One submission that cannot be read; the message says why and what to do."""


@dataclass(frozen=True)
class Found:
    """One submission where it lies, before anything of it is read."""

    name: str  # of its result; a file name on every platform
    sources: tuple[Path, ...]  # a folder, or what was handed in
    late: bool = False  # so marked by the LMS
    handed_in: datetime | None = None


@dataclass
class Intake:
    """A class as it lies in a folder."""

    found: list[Found] = of_dataclass(default_factory=list)
    troubles: dict[str, str] = of_dataclass(default_factory=dict)  # name -> why it cannot be graded
    notes: list[str] = of_dataclass(default_factory=list)


class Package(Struct, frozen=True):
    """A submission that can travel: its files, the same bytes for the same files."""

    name: str
    files: list[tuple[str, bytes]]  # sorted by path, which is relative and has forward slashes
    notes: list[str] = []

    @property
    def digest(self) -> str:
        """The same for the same files, whoever handed them in."""
        return hashlib.sha256(msgspec.msgpack.encode(self.files)).hexdigest()

    def unpack(self, folder: Path) -> Path:
        """Write it into a new folder named after it."""
        target = folder / self.name
        target.mkdir()
        for name, content in self.files:
            path = target / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        return target


# ---------------------------------------------------------------- the class list


class ClassList:
    """Who is in the class, by everything that an LMS may call them; empty without a roster."""

    def __init__(self, roster: Roster | None = None, key: str = "") -> None:
        self.names: list[str] = []
        self._known: dict[tuple[str, str], set[str]] = {}
        if roster is None:
            return
        key = roster.key(key)
        for row in roster.rows:
            if not row[key].strip():
                continue
            self.names.append(row[key].strip())
            for column, label in [*row.items(), *(("name", name) for name in names_in(row))]:
                self._known.setdefault((column, folded(label)), set()).add(row[key].strip())

    def name_of(self, columns: Iterable[str], *labels: object) -> str | None:
        """The one student whom one of the labels means."""
        for column in columns:
            for label in labels:
                names = self._known.get((column, folded(str(label or ""))), set())
                if label and len(names) == 1:
                    return next(iter(names))
        return None

    def absent(self, found: Iterable[Found]) -> list[str]:
        """Those who handed in nothing."""
        here = {folded(each.name) for each in found}
        return [name for name in self.names if not here & set(names_of(name))]

    def strangers(self, found: Iterable[Found]) -> list[str]:
        """Those who handed in and are not in the class list."""
        known = {each for name in self.names for each in names_of(name)}
        return [each.name for each in found if self.names and folded(each.name) not in known]


def names_in(row: dict[str, str]) -> Iterator[str]:
    """Someone's full name, first name first and last name first."""
    last, _, first = row.get("Student", "").partition(", ")
    last, first = row.get("Last name", row.get("Surname", last)), row.get("First name", first)
    if first and last:
        yield from (f"{first} {last}", f"{last} {first}")


# ---------------------------------------------------------------- listing a class


@contextmanager
def opened_class(path: Path, people: ClassList | None = None) -> Iterator[Intake]:
    """List the submissions in a folder or a zip of them; unpacked ones are there until the end."""
    if path.is_dir():
        yield listed(path, people or ClassList())
    elif is_zip(path) and path.is_file():
        with tempfile.TemporaryDirectory(prefix="class-") as temporary:
            try:
                unzip_class(path, Path(temporary))
            except CannotTake as error:
                raise CannotGrade(f"{path}: {error}") from error
            yield listed(without_wrapper(Path(temporary)), people or ClassList())
    else:
        raise CannotGrade(f"there is no folder of submissions at {path}, nor a zip of them")


def listed(folder: Path, people: ClassList) -> Intake:
    inner = entries_of(folder)
    if len(inner) == 1 and (inner[0] / METADATA).is_file():
        folder = inner[0]  # Gradescope's zip holds one folder
    if holds_program(folder):
        raise CannotGrade(f"{folder} is one submission, not a folder of them: leave out --class")
    intake = Intake()
    found = list(gradescope(folder, people, intake) if (folder / METADATA).is_file() else [])
    taken = {source for each in found for source in each.sources}
    left = [path for path in entries_of(folder) if path not in taken]
    found += in_files(left, people, intake)
    intake.found = sorted(without_doubles(found, intake), key=lambda each: each.name)
    if not intake.found and not intake.troubles:
        raise CannotGrade(f"{folder} holds no submission: each must be a folder or a zip")
    return intake


def entries_of(folder: Path) -> list[Path]:
    """What lies in a class folder, in a fixed order, without what desktops leave behind."""
    return sorted(path for path in folder.iterdir() if not is_dropping(path.name))


def is_dropping(name: str) -> bool:
    return name.startswith(".") or name.lower() in DROPPINGS


def without_wrapper(folder: Path) -> Path:
    """A zip often holds one folder, and all submissions in that."""
    inner = entries_of(folder)
    wrapped = len(inner) == 1 and inner[0].is_dir() and not holds_program(inner[0])
    return inner[0] if wrapped else folder


def in_files(paths: list[Path], people: ClassList, intake: Intake) -> Iterator[Found]:
    """Folders and zips of any name, and what Canvas and Moodle make of names."""
    groups: dict[str, list[tuple[Path, bool]]] = {}
    wordless: dict[str, Path] = {}
    for path in paths:
        name, late = named(path, people)
        if path.is_symlink():
            intake.notes.append(f"{path.name} is a link, and links are not followed")
        elif no_file(path):
            wordless[name] = path
        elif path.is_dir() or is_zip(path) or is_canvas(path) or is_moodle(path):
            groups.setdefault(name, []).append((path, late))
        elif path.suffix.lower() in WORK:
            intake.troubles[name] = f"{path.name} is no folder and no zip: put it into a folder"
        elif path.name not in SIDE_FILES and path.suffix.lower() != ".csv":
            intake.notes.append(f"{path.name} is no submission: left out")
    for name, group in groups.items():
        handed_in = tuple(path for path, _ in group)
        late = any(late for _, late in group)
        if all(is_canvas(path) or is_moodle(path) for path in handed_in):
            yield Found(name, handed_in, late)
        else:
            yield from (Found(name, (path,), late) for path in handed_in)
    for name, path in wordless.items():
        if name not in groups:
            intake.troubles[name] = f"{path.name}: a text or a link was handed in, and no file"


def named(path: Path, people: ClassList) -> tuple[str, bool]:
    """Whose submission a file or folder is, by its name, and whether it is marked as late."""
    moodle, canvas = is_moodle(path), is_canvas(path)
    if moodle:
        name = people.name_of(["name"], moodle["name"])
        return portable(name or f"{moodle['name']}_{moodle['id']}"), False
    if canvas:
        name = people.name_of(["ID"], canvas["user"])
        return portable(name or f"{canvas['name']}_{canvas['user']}"), bool(canvas["late"])
    empty = CANVAS_NO_FILE.fullmatch(path.name)
    if empty:
        name = people.name_of(["ID"], empty["name"].rpartition("_")[2])
        return portable(name or empty["name"].replace("_LATE_", "_")), False
    return portable(path.name if path.is_dir() else path.stem), False


def is_canvas(path: Path) -> re.Match[str] | None:
    if path.is_dir():
        return None
    return CANVAS_ANONYMOUS.fullmatch(path.name) or CANVAS.fullmatch(path.name)


def is_moodle(path: Path) -> re.Match[str] | None:
    return MOODLE.fullmatch(path.name)


def no_file(path: Path) -> bool:
    """What an LMS makes of a submission that is a text or a link."""
    moodle = is_moodle(path)
    return moodle["kind"] != "file" if moodle else bool(CANVAS_NO_FILE.fullmatch(path.name))


def portable(words: str) -> str:
    """A name that every file system takes, and as near to the given one as can be."""
    text = "".join(c if c.isprintable() else "_" for c in unicodedata.normalize("NFC", words))
    text = UNPRINTED.sub("_", text).strip(" .")
    text = text.encode()[:180].decode("utf-8", "ignore")
    return f"_{text}" if not text or text.partition(".")[0].lower() in DEVICES else text


class MetadataLoader(SafeLoader):
    """YAML as Ruby writes it; what bears the tag of a class of its own is left out."""


MetadataLoader.add_constructor(None, lambda loader, node: None)


class Submitter(Struct):
    """What Gradescope says of one person: words, mostly."""

    name: Any = field(default=None, name=":name")
    sid: Any = field(default=None, name=":sid")
    email: Any = field(default=None, name=":email")

    def known_as(self, people: ClassList) -> str:
        addresses = self.email, str(self.email or "").partition("@")[0]
        known = people.name_of(["Email address", "SIS Login ID"], *addresses)
        known = known or people.name_of(["SIS User ID", "ID number"], self.sid)
        return portable(str(known or self.email or self.sid or self.name))


class Exported(Struct):
    """What Gradescope says of one submission, as far as it matters here."""

    submitters: list[Submitter] = field(name=":submitters")
    created_at: Any = field(default=None, name=":created_at")


def gradescope(folder: Path, people: ClassList, intake: Intake) -> Iterator[Found]:
    """The submissions of Gradescope's export: one for each of those who handed in together."""
    try:
        with open(folder / METADATA, "rb") as file:
            export = msgspec.convert(yaml.load(file, MetadataLoader), dict[str, Exported])
    except (yaml.YAMLError, UnicodeError, ValueError, msgspec.ValidationError) as error:
        words = f"{folder / METADATA} is not as Gradescope writes it ({error!s:.200})"
        raise CannotGrade(f"{words}: export the submissions again") from error
    for place, entry in export.items():
        path = folder / portable(place)
        for name in [person.known_as(people) for person in entry.submitters]:
            if path.is_dir() and not path.is_symlink():
                yield Found(name, (path,), handed_in=aware(entry.created_at))
            else:
                intake.troubles[name] = f"{path.name} is in {METADATA}, and no such folder is here"


def aware(when: Any) -> datetime | None:
    """A moment; Gradescope's own are in UTC where they do not say otherwise."""
    if not isinstance(when, datetime):
        return None
    return when if when.tzinfo else when.replace(tzinfo=UTC)


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
            words = f"handed in more than once, as {' and '.join(places)}: leave one"
            intake.troubles[group[0].name] = words


def digest_or_trouble(each: Found) -> str:
    try:
        return pack(each).digest
    except CannotTake as error:
        return str(error)


# ---------------------------------------------------------------- one submission


@contextmanager
def opened_submission(path: Path) -> Iterator[Path]:
    """The submission at `path`; what a zip holds is there, in a folder of its name, until the end.

    Raises CannotGrade where a zip cannot be taken.
    """
    if not is_zip(path) or not path.is_file():
        yield path
        return
    with tempfile.TemporaryDirectory(prefix="submission-") as temporary:
        try:
            package = pack(Found(portable(path.stem), (path,)))
        except CannotTake as error:
            raise CannotGrade(f"{path}: {error}") from error
        yield package.unpack(Path(temporary))


def pack(found: Found) -> Package:
    """Read what may be taken of a submission, wherever in it the program lies."""
    bounds, files = Bounds(), []
    try:
        with laid_out(found) as (root, left_out):
            for path in python_first(plain_files(root)):
                name = path.relative_to(root).as_posix()
                if bounds.take(name, path.stat().st_size):
                    files.append((name, path.read_bytes()))
    except OSError as error:
        raise CannotTake(f"it cannot be read: {error}") from error
    return Package(found.name, sorted(files), [*left_out, *bounds.left_out])


@contextmanager
def laid_out(found: Found) -> Iterator[tuple[Path, list[str]]]:
    """The folder that holds the program, zips unpacked, and what had to be left out."""
    folder = found.sources[0]
    if len(found.sources) == 1 and folder.is_dir() and holds_program(root_of(folder)):
        yield root_of(folder), []
        return
    with tempfile.TemporaryDirectory(prefix="unpacked-") as temporary:
        bounds = Bounds()
        lay_out(found, Path(temporary), bounds)
        yield root_of(Path(temporary)), bounds.left_out


def lay_out(found: Found, folder: Path, bounds: "Bounds") -> None:
    """Gather what was handed in under the names it had, and unpack it until a program is there."""
    for source in found.sources:
        if source.is_dir():
            for path in python_first(plain_files(source)):
                gather(path, folder / path.relative_to(source), bounds)
        else:
            gather(source, folder / first_name(source), bounds)
    for _ in range(DEEPEST):
        zips = sorted(path for path in plain_files(folder) if is_zip(path))
        if holds_program(root_of(folder)) or not zips:
            return
        for path in zips:
            unzip(path.rename(path.with_name(f".{path.name}")), path, bounds)


def gather(path: Path, target: Path, bounds: "Bounds") -> None:
    """Copy one file; a zip may be larger than a submission, its files may not."""
    if is_zip(path):
        check_size(path)
    elif not bounds.take(path.name, path.stat().st_size):
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(path, target)


def is_zip(path: Path) -> bool:
    return path.suffix.lower() == ".zip"


def python_first(paths: Iterable[Path]) -> list[Path]:
    return sorted(paths, key=lambda each: (each.suffix != ".py", each))


def first_name(path: Path) -> str:
    """A file's name as the student gave it."""
    match = is_canvas(path) or is_moodle(path)
    return portable(COPY.sub("", match["file"] or "file") if match else path.name)


def root_of(folder: Path) -> Path:
    """The folder that holds the work: zips and people often put more folders around it."""
    level = [folder]
    for _ in range(DEEPEST + 1):
        holding = [path for path in level if holds_program(path)]
        if len(holding) > 1:
            places = ", ".join(path.relative_to(folder).as_posix() for path in holding[:5])
            raise CannotTake(f"there is more than one program, in {places}: leave one")
        if holding:
            return holding[0]
        level = [inner for path in level for inner in folders_in(path)]
    return unwrapped(folder)


def unwrapped(folder: Path) -> Path:
    """Where there is no program: as far in as each folder holds but one other."""
    for _ in range(DEEPEST):
        inside = [path for path in folder.iterdir() if not is_dropping(path.name)]
        if len(inside) != 1 or inside != folders_in(folder) or inside[0].name == "notebooks":
            break
        folder = inside[0]
    return folder


def folders_in(folder: Path) -> list[Path]:
    return [
        path
        for path in entries_of(folder)
        if path.is_dir() and not path.is_symlink() and path.name not in IGNORED
    ]


def holds_program(folder: Path) -> bool:
    """Whether one of the modules that the rubric asks for lies in this folder itself."""
    return any(
        (folder / name).is_dir() or (folder / f"{name}.py").is_file()
        for name in {todo.module for todo in load_rubric().todos}
    )


# ---------------------------------------------------------------- zips


@dataclass
class Bounds:
    """What is left of a submission's allowance, over all of its zips."""

    files: int = MAX_FILES
    bytes: int = MAX_BYTES
    left_out: list[str] = of_dataclass(default_factory=list)

    def take(self, name: str, length: int) -> bool:
        if not self.files or length > self.bytes:
            if len(self.left_out) < MENTIONED:
                self.left_out.append(f"{name}: too much")
            return False
        self.files, self.bytes = self.files - 1, self.bytes - length
        return True


def unzip(path: Path, folder: Path, bounds: Bounds) -> None:
    """Unpack what may be part of a submission, Python's files first, within the bounds."""
    check_size(path)
    with checked_zip(path) as archive:
        members = sorted(members_of(archive), key=lambda each: (each[0].suffix != ".py", each[0]))
        environments = {name.parent for name, _ in members if name.name == "pyvenv.cfg"}
        folder.mkdir(parents=True, exist_ok=True)
        for name, member in members:
            ignored = any(part in IGNORED or is_dropping(part) for part in name.parts)
            if ignored or environments & set(name.parents):
                continue
            if bounds.take(name.as_posix(), member.file_size):
                write_member(archive, member, folder / name)


def unzip_class(path: Path, folder: Path) -> None:
    """Unpack an LMS's download of a whole class; each submission in it is looked at later."""
    with checked_zip(path) as archive:
        for member in plain_members(archive):
            parts = [part for part in text_of(member).split("/") if part]
            if not any(is_dropping(part) for part in parts):
                write_member(archive, member, folder.joinpath(*map(portable, parts)))


@contextmanager
def checked_zip(path: Path) -> Iterator[zipfile.ZipFile]:
    """Open a zip; whatever goes wrong with it becomes a sentence."""
    try:
        with zipfile.ZipFile(path) as archive:
            yield archive
    except CannotTake:
        raise
    except NotImplementedError as error:
        raise CannotTake(f"{OWN_WAY} ({error})") from error
    except RuntimeError as error:
        raise CannotTake("the zip is encrypted: ask for one without a password") from error
    except Exception as error:  # zipfile and zlib have many; the bytes are a stranger's
        raise CannotTake(f"the zip is broken ({type(error).__name__}: {error!s:.100})") from error


OWN_WAY = "the zip is packed in an unusual way: ask for one as desktops make it"


def check_size(path: Path) -> None:
    """Refuse a zip that would take all memory before a single file of it is unpacked."""
    size = path.stat().st_size
    if size > MAX_ZIP:
        raise CannotTake(f"the zip has {size >> 20} MB, more than {MAX_ZIP >> 20}")
    with open(path, "rb") as file:
        file.seek(max(0, size - (1 << 16) - 64))
        end = file.read()
    at = end.rfind(b"PK\x05\x06")  # the end of the list of files, which says how long that is
    length = int.from_bytes(end[at + 12 : at + 16], "little")
    if at >= 0 and (length > MAX_DIRECTORY or end[max(0, at - 20) : at].startswith(b"PK\x06\x07")):
        raise CannotTake("the zip lists too many files: ask for the program alone")


def plain_members(archive: zipfile.ZipFile) -> Iterator[zipfile.ZipInfo]:
    """Files, not folders and not links."""
    for member in archive.infolist():
        if not member.is_dir() and stat.S_IFMT(member.external_attr >> 16) in (0, stat.S_IFREG):
            yield member


def members_of(archive: zipfile.ZipFile) -> list[tuple[PurePosixPath, zipfile.ZipInfo]]:
    """The plain files by name; of two with one name the last counts, as for every unzip."""
    found: dict[str, tuple[PurePosixPath, zipfile.ZipInfo]] = {}
    for member in plain_members(archive):
        name = PurePosixPath(checked_name(text_of(member)))
        other, _ = found.get(folded(name.as_posix()), (name, member))
        if other != name:
            raise CannotTake(f"{other} and {name} differ in case alone: ask for other names")
        found[folded(name.as_posix())] = name, member
    return list(found.values())


def text_of(member: zipfile.ZipInfo) -> str:
    """A member's name: UTF-8 where it says so or looks it, or else the old DOS letters."""
    name = member.filename
    if not member.flag_bits & 0x800:
        with suppress(UnicodeError):
            name = name.encode("cp437").decode("utf-8")
    return unicodedata.normalize("NFC", name.replace("\\", "/"))


def checked_name(name: str) -> str:
    """The name, if it stays inside its folder and every system can have it."""
    parts = [part for part in name.split("/") if part not in ("", ".")]
    if name.startswith("/") or ".." in parts or ":" in parts[0]:
        raise CannotTake(f"the zip reaches outside its folder, with {name[:100]!r}")
    for part in parts:
        if portable(part) != part.strip(" .") and not is_dropping(part):
            raise CannotTake(f"the zip holds {part[:100]!r}, a name not for every system")
    return "/".join(part if is_dropping(part) else portable(part) for part in parts)


def write_member(archive: zipfile.ZipFile, member: zipfile.ZipInfo, path: Path) -> None:
    """Unpack one file: no more of it than the zip says it has.

    Only with these two ways of packing does `zipfile` take no more memory than it gives back.
    """
    if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise CannotTake(OWN_WAY)
    path.parent.mkdir(parents=True, exist_ok=True)
    with archive.open(member) as source, open(path, "wb") as target:
        shutil.copyfileobj(source, target)
