"""The bank: wrong, right and hostile submissions, and the marks each must get.

To add a wrong member, add a table to `tests/bank/wrong/TODO.toml`, named by the mistake. If another
member makes the same mistake, add `+` and more. TODO must lose points, and no other TODO may:

    [clamps-the-increment]
    why = "Clamps each pass's change to the limit instead of the accumulated total."
    change = [["total = clamp(total)", "total = c.jt + clamp(total - c.jt)"]]

- `change` lists pairs of an old and a new text. The old one must stand once in the solution's
  region. A line `...` in it stands for any number of lines.
- `code` holds the whole region instead, where little of the solution is left.
- `says` and `never` make it a half-way state as well (see halfway.py), under its own name or under
  the one in `state`.
- Most members are graded as a package and, for TODO 1 to 6, as a single file too.
  `single_file = false` leaves that out.

To read the report of a member, write it as a submission and grade that:

    .venv/bin/python -m grader verify --only wrong/3-only-pulls --write build/members
    .venv/bin/python -m grader grade build/members/3-only-pulls --todo 3

A member of `wrong/whole.toml` breaks a promise of the lesson in given code, by `files`. The program
as a whole must lose points; only the TODOs in `also` may lose some.

Right and hostile members lose exactly what `loses` names: TODOs, checks of them, or "everything".
By default it names nothing. Where a right member differs from the solution in one TODO, add a table
to `right/TODO.toml`, with `why`, and `change` or `code`. The other members:

- `right/NAME.py` and `hostile/NAME.py` hold regions that take the place of the solution's.
- `right/NAME.toml` and `hostile/NAME.toml` edit a whole tree: `base` is the tree or right member to
  begin with. Then come `copy` (new = old file or folder, of the member or of the kit), `remove`,
  `files` (pairs as in `change`, by file), `add` (new files) and `everywhere` (code for every TODO).
- `lesson.toml` holds variants of the lesson's programs in the same form. `verify` grades the
  programs as printed, `right/lesson-as-printed/`, and these before all others.
- `right/NAME/` and `hostile/NAME/` hold files to add or replace, beside or without a NAME.toml. A
  mini_engine.py there replaces the package.
- `hostile/8a.toml` holds attacks in TODO 8a: `code`, or `tries` if the answer is right unless the
  attack raises OSError. They lose TODO 8a unless `loses` names something else. With the `numbers`
  of a system call on x86_64 and aarch64, `tries` can `call(number, ...)` it. One that does more
  than the system refuses `lasts`: `verify` then runs all later checks after it.
- `bank.toml` has the marks of members without a TOML.
- `ladders/TODO.toml` holds the rungs of a ladder, lowest first (see ladders.py).
"""

import os
import re
import shutil
import textwrap
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path
from typing import Literal, TypeVar

import msgspec
from msgspec import Struct
from msgspec.structs import replace as replace_in

from grader.bank.sync import LAID_IN
from grader.judge.course import FULL, Course
from grader.judge.result import Result, is_bonus
from grader.judge.rubric import load_rubric
from grader.judge.task import KIT
from grader.source.regions import Region, python_files, read_source, regions_in, replace_regions

Kind = Literal["wrong", "right", "hostile", "ladder", "halfway"]
Form = Literal["package", "single file"]
Pairs = list[tuple[str, str]]  # old text, which must stand once, and new text
Regions = Mapping[str, tuple[str, ...]]  # lines of code, by TODO

BANK = KIT / "tests" / "bank"
CONSTANTS = "all-constants"  # the member that is made of the ladders' constants
MOST_FOR_CONSTANTS = 3  # points of all TODOs together
LESSON = "lesson-"  # prefix of the lesson's programs and their variants
BESIDES = ("__pycache__", "notebooks", ".*", *LAID_IN)  # files of a tree that no mark depends on
CLEAN = shutil.ignore_patterns(*BESIDES)
TREES = ("solution", "starter")
IS_TODO = re.compile(r"[0-9]+[a-z]?|B[0-9]+|whole")
ATTACKED = "8a"  # the TODO of the attacks
TRIED = """{imports}

try:
{deed}
except OSError:
    return x, v  # refused: no points
{usual}"""
SYSTEM_CALL = """import ctypes
import os

libc = ctypes.CDLL(None, use_errno=True)


def call(*arguments):
    answer = libc.syscall(*arguments)
    if answer < 0:
        raise OSError(ctypes.get_errno(), "refused")
    return answer


number = {{"x86_64": {}, "aarch64": {}}}[os.uname().machine]
"""
SKIPPED_LINES = r"\n(?:.*\n)*?"  # for a line `...`


Read = TypeVar("Read", bound=Struct)


class Variant(Struct, frozen=True, forbid_unknown_fields=True):
    """Code that differs from the usual code: in the region of one TODO, or elsewhere."""

    why: str = ""
    code: str = ""  # of the whole region
    change: Pairs = []  # in the region's usual code
    files: dict[str, Pairs] = {}  # in other text, by file

    def rewrite(self, usual: str) -> str:
        """Return the region's code, made from the usual one."""
        return change_text(self.code or usual, self.change)


class Entry(Variant, frozen=True):
    """A member, as TOML describes it: what it changes, and the marks it must get."""

    base: str = "solution"  # or "starter", "empty", or the name of a right member
    add: dict[str, str] = {}  # new files
    remove: list[str] = []
    copy: dict[str, str] = {}  # new file or folder, old one
    everywhere: str = ""  # code for every TODO
    transform: str = ""
    loses: tuple[str, ...] = ()  # TODOs and checks without points, or "everything"
    single_file: bool = True  # a wrong member is graded as a single file as well
    seconds: int = 120  # the longest time it may take; a limit on harm, not a score
    sleeps: bool = False  # for many seconds, in which other members can use the processor

    @property
    def modules(self) -> set[str]:
        """Return the programs it changes."""
        return {file.partition("/")[0].removesuffix(".py") for file in self.files}


class Printed(Entry, frozen=True):
    """A variant of the lesson's programs."""

    base: str = f"{LESSON}as-printed"


class Wrong(Entry, frozen=True):
    """A wrong member; with `says`, also a half-way state."""

    breaks: str = ""  # the promise of the lesson that it breaks in given code
    also: list[str] = []  # TODOs that may lose points too: their checks need what is broken
    state: str = ""  # the name of the half-way state, if it has one of its own
    says: tuple[str, ...] = ()
    never: tuple[str, ...] = ()


class Attack(Entry, frozen=True):
    """A hostile member that attacks in the region of TODO 8a."""

    loses: tuple[str, ...] = (ATTACKED,)
    tries: str = ""  # imports, an empty line, and code that must raise OSError
    numbers: tuple[int, int] | None = None  # of the system call that `tries` makes
    lasts: bool = False  # whether it works in other ways before it raises OSError

    @property
    def only_tries(self) -> bool:
        """Return whether it does nothing outside its process if the system refuses it."""
        return bool(self.tries) and not self.lasts

    def rewrite(self, usual: str) -> str:
        if not self.tries:
            return super().rewrite(usual)
        setup = SYSTEM_CALL.format(*self.numbers) if self.numbers else ""
        imports, deed = f"{setup}{self.tries}".split("\n\n", 1)
        return TRIED.format(imports=imports, deed=textwrap.indent(deed, "    "), usual=usual)


class Rung(Variant, frozen=True):
    """A rung of a ladder, by default with the solution's code."""

    wrong: str = ""  # the wrong member whose code it has


@dataclass(frozen=True)
class Member:
    """One submission of the bank in one form."""

    kind: Kind
    name: str
    form: Form
    entry: Entry = field(hash=False)
    source: Path | None  # its regions (.py), the folder with its files, or its TOML
    course: Course = field(default=FULL, compare=False)  # by which it is graded

    @property
    def regions(self) -> Regions:
        """Return the code that replaces regions, by TODO."""
        if self.source is not None and self.source.suffix == ".py":
            return regions_of(self.source)
        return {
            todo: tuple(self.entry.rewrite(solution_code()[todo]).split("\n"))
            for todo in self.replaced_todos
        }

    @property
    def replaced_todos(self) -> frozenset[str]:
        """Return the TODOs whose regions it replaces, even if its edits do not fit the solution."""
        if self.source is not None and self.source.suffix == ".py":
            return frozenset(regions_of(self.source))
        if isinstance(self.entry, Attack):
            return frozenset({ATTACKED})
        by_edits = self.entry.code or self.entry.change or self.is_rung
        return frozenset({self.name.partition("-")[0]} if by_edits else ())

    @property
    def is_patch(self) -> bool:
        """Return whether it is the solution with other code in some regions, given in one file."""
        entry = self.entry
        edits = (
            entry.files,
            entry.add,
            entry.copy,
            entry.remove,
            entry.everywhere,
            entry.transform,
        )
        one_file = self.source is not None and self.source.suffix == ".py"
        return one_file and entry.base == "solution" and not any(edits)

    @property
    def is_rung(self) -> bool:
        return self.kind == "ladder" and self.name != CONSTANTS

    @property
    def breach(self) -> Wrong | None:
        """Return the entry of a member that breaks one of the lesson's promises."""
        return self.entry if isinstance(self.entry, Wrong) and self.entry.breaks else None

    @property
    def todos(self) -> frozenset[str]:
        """Return the TODOs whose regions it replaces, or "whole" for the program as a whole."""
        return frozenset({"whole"}) if self.breach else self.replaced_todos

    @property
    def bonus(self) -> bool:
        """Return whether it is about bonus tasks and nothing else."""
        return self.kind != "hostile" and bool(self.todos) and all(map(is_bonus, self.todos))

    @property
    def judged_by(self) -> frozenset[str]:
        """Return the TODOs to grade; empty for all.

        A patch changes regions of some programs. Programs share no file, so the others equal the
        solution. `whole` is graded for right members and bonus tasks only: a wrong member may
        affect it.
        """
        if self.kind == "ladder":
            return self.todos
        todos = [todo for todo in load_rubric().todos if todo.function]
        if self.breach is not None or (is_of_lesson(self.name) and self.entry.files):
            near = {t.id for t in todos if t.module in self.entry.modules and not t.bonus}
            return frozenset(near | {"whole"})
        if self.kind == "hostile" or not self.todos:
            return frozenset()
        touched = {todo.module for todo in todos if todo.id in self.todos}
        wanted = {
            todo.id
            for todo in todos
            if todo.module in touched and (todo.id in self.todos or not todo.bonus)
        }
        whole = self.kind == "right" or self.bonus
        return frozenset(wanted | {"whole"} if whole else wanted)

    @property
    def uses_numpy(self) -> bool:
        """Return whether its code names numpy, which its children then load."""
        texts = [str(self.entry)]
        if self.source is not None and self.source.is_dir():
            texts += map(read_source, python_files(self.source))
        elif self.source is not None and self.source.suffix == ".py":
            texts.append(read_source(self.source))
        return any("numpy" in text for text in texts)

    @property
    def lineage(self) -> Iterator["Member"]:
        """Yield the member itself and the right members that it is based on."""
        yield self
        if self.entry.base not in (*TREES, "empty"):
            yield from base_of(self).lineage

    def belongs_to(self, course: Course) -> bool:
        """Return whether a course has the TODOs and programs that it is about."""
        asked = {todo.id for todo in course.rubric.todos}
        if self.breach is not None:
            return "whole" in asked and self.entry.modules <= set(course.modules)
        if self.kind == "right":
            return not self.todos or not asked.isdisjoint(self.todos)
        return self.todos <= asked

    def build(self, folder: Path) -> None:
        """Write the submission into `folder`, which must not exist."""
        if self.entry.base == "empty":
            folder.mkdir(parents=True)
        elif self.entry.base in TREES:
            shutil.copytree(KIT / self.entry.base, folder, ignore=CLEAN)
        else:
            base_of(self).build(folder)
        if self.form == "single file":
            use_single_file(folder)
        if self.name == CONSTANTS:
            for rung in list_constants():
                put_regions(rung.regions, folder)
        put_regions(self.regions, folder)
        edit_tree(self.entry, folder)
        if self.source is not None and self.source.is_dir():
            lay_over(self.source, folder)
        if self.entry.transform:
            TRANSFORMS[self.entry.transform](folder)

    def complaint(self, result: Result, seconds: float) -> str:
        """Return the fault in its marks, or an empty text."""
        lost = {t.id: t.max_points - t.points for t in result.todos if t.points != t.max_points}
        if self.kind == "ladder":  # a rung is compared with the others of its ladder
            many = not self.is_rung and result.points > MOST_FOR_CONSTANTS
            return f"{result.points} points, more than {MOST_FOR_CONSTANTS}" if many else ""
        if self.kind == "wrong":
            allowed = self.todos.union(self.breach.also if self.breach else ())
            unharmed = sorted(self.todos - set(lost))
            others = sorted(set(lost) - allowed)
            if unharmed:
                return f"TODO {', '.join(unharmed)} loses nothing"
            return f"TODO {', '.join(others)} must not lose anything" if others else ""
        if wrong := self.compare_losses(result):
            return wrong
        if seconds > self.entry.seconds:
            return f"took {seconds:.0f} s, more than {self.entry.seconds} s"
        return ""

    def compare_losses(self, result: Result) -> str:
        """Return the checks that wrongly lose or keep their points; empty if there are none.

        Bonus tasks that the member does not begin do not count.
        """
        lost, meant = set(), set()
        for todo in result.todos:
            if todo.bonus and todo.state == "not started" and todo.id not in self.todos:
                continue
            for check in todo.checks:
                if check.points < check.max_points:
                    lost.add(f"{todo.id}: {check.id}")
                if not {"everything", todo.id, check.id}.isdisjoint(self.entry.loses):
                    meant.add(f"{todo.id}: {check.id}")
        if wrongly := sorted(lost - meant):
            return f"must not lose {', '.join(wrongly)}"
        return f"must lose {', '.join(sorted(meant - lost))}" if meant > lost else ""

    def compare_name(self, result: Result) -> Literal["right", "wrong", "none"]:
        """Return whether a report names the mistake of a wrong member, another one, or none."""
        names = {todo.misconception for todo in result.todos} - {None}
        if not names:
            return "none"
        return "right" if names == {self.name.partition("-")[2].partition("+")[0]} else "wrong"


def base_of(member: Member) -> Member:
    """Return the right member that another one is based on."""
    return read_submission("right", member.entry.base)


# ---------------------------------------------------------------- reading the bank


def list_members(course: Course = FULL) -> Iterator[Member]:
    """Yield the members that concern a course.

    Attacks target the judge, not a course: they are graded on every TODO.
    """
    for member in list_all():
        if member.kind == "hostile":
            yield member
        elif member.belongs_to(course):
            yield replace(member, course=course)


def list_all() -> Iterator[Member]:
    """Yield the whole bank, wrong members in each form they can take."""
    right = list(list_submissions("right"))
    yield from (each for each in right if is_of_lesson(each.name))
    yield from list_tables("right", BANK / "lesson.toml", Printed, LESSON)
    for sheet in list_sheets("wrong"):
        for member in list_tables("wrong", sheet, Wrong):
            yield member
            if member.entry.single_file and member.todos <= set("123456"):
                yield replace(
                    member, form="single file", entry=replace_in(member.entry, base="solution")
                )
    for sheet in list_sheets("right"):
        yield from list_tables("right", sheet, Entry)
    yield from (each for each in right if not is_of_lesson(each.name))
    yield from list_submissions("hostile")
    yield from list_attacks()
    yield Member("right", "single-file", "single file", Entry(), None)
    yield from list_rungs()
    if any(list_constants()):
        yield Member("ladder", CONSTANTS, "package", Entry(base="starter"), None)


def list_tables(
    kind: Kind, sheet: Path, entries: type[Entry], prefix: str | None = None
) -> Iterator[Member]:
    """Yield the members that are tables of one file, by default named after its TODO."""
    start = f"{sheet.stem}-" if prefix is None else prefix
    for name, entry in read_tables(sheet, entries).items():
        yield Member(kind, f"{start}{name}", "package", entry, sheet)


def read_tables(sheet: Path, entries: type[Read]) -> dict[str, Read]:
    return msgspec.toml.decode(sheet.read_bytes(), type=dict[str, entries])  # type: ignore[valid-type]


def is_of_lesson(name: str) -> bool:
    return name.startswith(LESSON)


def list_sheets(kind: Kind) -> list[Path]:
    """Return the files that hold members of one TODO each."""
    paths = sorted((BANK / kind).glob("*.toml"))
    return [path for path in paths if IS_TODO.fullmatch(path.stem)]


def list_submissions(kind: Literal["right", "hostile"]) -> Iterator[Member]:
    """Yield the members with their own file or folder, or with marks in bank.toml alone."""
    names = {path.stem for path in (BANK / kind).glob("*")} | set(read_marks()[kind])
    for name in sorted(names):
        if not IS_TODO.fullmatch(name):
            yield read_submission(kind, name)


def list_attacks() -> Iterator[Member]:
    """Yield the hostile members that attack in the region of one TODO."""
    return list_tables("hostile", BANK / "hostile" / f"{ATTACKED}.toml", Attack, prefix="")


def read_submission(kind: Literal["right", "hostile"], name: str) -> Member:
    """Return one member, described by its own TOML or by bank.toml."""
    described = BANK / kind / f"{name}.toml"
    sources = (BANK / kind / name, BANK / kind / f"{name}.py", described)
    source = next((path for path in sources if path.exists()), None)
    if described.exists():
        entry = msgspec.toml.decode(described.read_bytes(), type=Entry)
    else:
        entry = read_marks()[kind].get(name, Entry())
    return Member(kind, name, "package", entry, source)


@cache
def read_marks() -> dict[str, dict[str, Entry]]:
    """Return the entries of bank.toml by kind and name."""
    return msgspec.toml.decode((BANK / "bank.toml").read_bytes(), type=dict[str, dict[str, Entry]])


def list_rungs() -> Iterator[Member]:
    """Yield each rung of each ladder, lowest first."""
    for sheet in sorted((BANK / "ladders").glob("*.toml")):
        mistakes = read_tables(BANK / "wrong" / sheet.name, Wrong)
        for name, rung in read_tables(sheet, Rung).items():
            variant = mistakes[rung.wrong] if rung.wrong else rung
            entry = Entry(code=variant.code, change=variant.change)
            yield Member("ladder", f"{sheet.stem}-{name}", "package", entry, sheet)


def list_constants() -> Iterator[Member]:
    """Yield the rungs that give the same answer to every question."""
    for rung in list_rungs():
        if re.match(r"\w+-\d+-constant", rung.name):
            yield rung


@cache
def solution_code() -> dict[str, str]:
    """Return the code of the solution's regions, by TODO."""
    texts = [read_source(path) for path in python_files(KIT / "solution")]
    return {r.id: textwrap.dedent("\n".join(r.lines)) for t in texts for r in regions_in(t)}


# ---------------------------------------------------------------- edits


def use_single_file(folder: Path) -> None:
    shutil.rmtree(folder / "mini_engine")
    shutil.copyfile(BANK / "single_file" / "mini_engine.py", folder / "mini_engine.py")


def lay_over(source: Path, folder: Path) -> None:
    """Add files to a tree. A single mini_engine.py replaces the package."""
    if (source / "mini_engine.py").exists():
        shutil.rmtree(folder / "mini_engine", ignore_errors=True)
    shutil.copytree(source, folder, dirs_exist_ok=True)


def edit_tree(entry: Entry, folder: Path) -> None:
    """Copy, remove and change files of a tree."""
    for new, old in entry.copy.items():
        source = folder / old if (folder / old).exists() else KIT / old
        if source.is_dir():
            shutil.copytree(source, folder / new, ignore=CLEAN)
        else:
            (folder / new).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, folder / new)
    for name in entry.remove:
        path = folder / name
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    change_files(entry.files, folder)
    for name, text in entry.add.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    if entry.everywhere:
        fill_every_todo(folder, entry.everywhere)


def change_files(files: Mapping[str, Pairs], folder: Path) -> None:
    for name, change in files.items():
        text = change_text(read_source(folder / name), change)
        (folder / name).write_text(text, encoding="utf-8")


def change_text(text: str, change: Pairs) -> str:
    """Replace each old text by its new one; ValueError unless the old one occurs once."""
    for old, new in change:
        pattern = SKIPPED_LINES.join(map(re.escape, old.split("\n...\n")))
        found = [match.span() for match in re.finditer(pattern, text)]
        if len(found) != 1:
            raise ValueError(f"{old!r} stands there {len(found)} times, not once")
        ((start, stop),) = found
        text = text[:start] + new + text[stop:]
    return text


def fill_every_todo(folder: Path, code: str) -> None:
    """Put the same code into every TODO."""
    lines = tuple(code.strip().splitlines())
    for path in python_files(folder):
        text = read_source(path)
        if here := {region.id: indent_like(lines, text, region) for region in regions_in(text)}:
            path.write_text(replace_regions(text, here), encoding="utf-8")


def make_mistake(name: str, folder: Path) -> None:
    """Put the code of a wrong member into the files of `folder`."""
    sheet = BANK / "wrong" / f"{name.partition('-')[0]}.toml"
    (wrong,) = (each for each in list_tables("wrong", sheet, Wrong) if each.name == name)
    put_regions(wrong.regions, folder)


def regions_of(source: Path) -> Regions:
    return {region.id: region.lines for region in regions_in(read_source(source))}


def put_regions(regions: Regions, folder: Path) -> None:
    """Replace the code of these regions in the files of `folder`."""
    wanted = dict(regions)
    for path in python_files(folder) if wanted else ():
        text = read_source(path)
        here = {
            region.id: indent_like(wanted.pop(region.id), text, region)
            for region in regions_in(text)
            if region.id in wanted
        }
        if here:
            path.write_text(replace_regions(text, here), encoding="utf-8")
    if wanted:
        raise ValueError(f"no file has TODO {', '.join(wanted)}")


def indent_like(lines: Iterable[str], text: str, region: Region) -> tuple[str, ...]:
    """Indent lines like those of a region of this text."""
    first = text.splitlines()[region.start]
    indent = first[: len(first) - len(first.lstrip())]
    return tuple(indent + line if line else line for line in lines)


# ---------------------------------------------------------------- transforms


def rewrite(change: Callable[[bytes], bytes]) -> Callable[[Path], None]:
    def transform(folder: Path) -> None:
        for path in python_files(folder):
            path.write_bytes(change(path.read_bytes()))

    return transform


def into_one_file(folder: Path) -> None:
    """Merge the package into one mini_engine.py, each part after those that it imports."""
    package = folder / "mini_engine"
    texts = {path: read_source(path) for path in package.rglob("[!_]*.py")}
    needs = {path: list(imported_parts(path, text)) for path, text in texts.items()}
    parts = [texts[path] for path in TopologicalSorter(needs).static_order()]
    merged = re.sub(RENAMED_IMPORT, r"\2 = \1\n", "\n\n".join(parts))
    merged = re.sub(r"^from \..*\n", "", merged, flags=re.MULTILINE)
    shutil.rmtree(package)
    start = "" if "__main__" in merged else '\n\nif __name__ == "__main__":\n    main()\n'
    (folder / "mini_engine.py").write_text(merged + start, encoding="utf-8")


RENAMED_IMPORT = re.compile(r"^from \..* import (\w+) as (\w+)\n", re.MULTILINE)


def imported_parts(path: Path, text: str) -> Iterator[Path]:
    """Yield the files of the package that one imports from, as in `from ..world import World`."""
    for dots, name in re.findall(r"^from (\.+)(\w+)", text, re.MULTILINE):
        yield path.parents[len(dots) - 1] / f"{name}.py"


def link_out(folder: Path) -> None:
    (folder / "link").symlink_to(folder.parent, target_is_directory=True)
    (folder / "passwords.txt").symlink_to("/etc/passwd")


def many_files(folder: Path) -> None:
    (folder / "data").mkdir()
    for number in range(10_000):
        (folder / "data" / f"{number:05}.txt").write_bytes(b"x")
    (folder / "\x1b[2Jgone\n::error::.py").write_text("raise SystemExit\n", encoding="utf-8")


def add_video(folder: Path) -> None:
    with open(folder / "gameplay.mp4", "wb") as file:
        file.truncate(200 * 1024**2)  # no bytes on the disk


def add_stale_bytecode(folder: Path) -> None:
    for source in python_files(folder):
        cache = source.parent / "__pycache__"
        cache.mkdir(exist_ok=True)
        for tag in ("cpython-311", "cpython-313", "cpython-38"):
            (cache / f"{source.stem}.{tag}.pyc").write_bytes(b"\xa7\r\r\n" + bytes(40))
    (folder / "mini_engine.pyc").write_bytes(b"\xa7\r\r\n" + bytes(40))


def add_odd_names(folder: Path) -> None:
    for name in (b"notes \xe4\xf6.txt", b"\xff\xfe.py", b"\xfcbung\x1b[2J/integrators.py"):
        try:
            os.makedirs(os.path.dirname(os.path.join(os.fsencode(folder), name)), exist_ok=True)
            with open(os.path.join(os.fsencode(folder), name), "wb") as file:
                file.write(b"x")
        except OSError:  # a file system with names in Unicode only
            return


TRANSFORMS: dict[str, Callable[[Path], None]] = {
    "crlf": rewrite(lambda data: data.replace(b"\n", b"\r\n")),
    "bom": rewrite(lambda data: b"\xef\xbb\xbf" + data),
    "tabs": rewrite(lambda data: data.replace(b"    ", b"\t")),
    "one-file": into_one_file,
    "symlink": link_out,
    "many-files": many_files,
    "video": add_video,
    "stale-bytecode": add_stale_bytecode,
    "odd-names": add_odd_names,
}
