"""The bank: submissions that are wrong, right or hostile, and the marks each must get.

- `tests/bank/wrong/4-clamps-the-increment.py`: the solution with this one region put in; TODO 4
  must lose points and no other TODO may. Graded as a package and as a single file. The name is the
  mistake's; `+` and more follow where the same one is made in another way.
- `tests/bank/wrong/whole-one-pass.toml`: the solution with some of its given text replaced, so that
  a promise of the lesson's is broken. The program as a whole must lose points, and no TODO may, but
  for those whose checks need that very text.
- `tests/bank/ladders/6/2-keeps-the-rest.py`: a rung of a ladder, graded on its TODO alone. Rung 0
  earns nothing, the last one all, and none less than the one before. See ladders.py.
- `tests/bank/lesson/`: the lesson's programs as printed, which have all points, and in
  variants.toml what may be different about them. `verify` grades these first.
- `tests/bank/right/NAME.py` or `NAME/`: different, and worth every point.
- `tests/bank/hostile/NAME.py`, `NAME.toml` or `NAME/`: an attack, and the marks in `bank.toml`.
- `tests/bank/old_package/`: the package as it was handed out before its bonus tasks had a folder.
"""

import os
import re
import shutil
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from graphlib import TopologicalSorter
from pathlib import Path
from typing import Literal

import msgspec
from msgspec import Struct

from grader.judge.course import FULL, Course
from grader.judge.grade import KIT
from grader.judge.result import Result, is_bonus
from grader.judge.rubric import load_rubric
from grader.source.regions import Region, python_files, read_source, regions_in, replaced

Kind = Literal["wrong", "right", "hostile", "ladder"]
Form = Literal["package", "single file"]
Base = Literal["solution", "starter", "old package", "lesson", "empty"]


CONSTANTS = "all-constants"  # the member that is made of the ladders' constants
MOST_FOR_CONSTANTS = 3  # points, of all TODOs together


class Entry(Struct, frozen=True, forbid_unknown_fields=True):
    """What bank.toml says of a member that is more than a patch of the solution."""

    why: str = ""
    base: Base = "solution"
    points: int | None = None  # exactly; None: all of them
    transform: str = ""
    single_file: bool = True  # whether a wrong member is wrong as a single file as well
    seconds: int = 120  # the longest it may keep the judge busy; a limit on harm, not a score


class Book(Struct, frozen=True, forbid_unknown_fields=True):
    wrong: dict[str, Entry] = {}
    right: dict[str, Entry] = {}
    hostile: dict[str, Entry] = {}


class Replacement(Struct, frozen=True, forbid_unknown_fields=True):
    file: str
    old: str  # stands there `times` times
    new: str
    times: int = 1


class Edits(Struct, frozen=True, forbid_unknown_fields=True):
    """What the file of a right or hostile member holds: where it is not what it is made from."""

    replace: list[Replacement] = []
    everywhere: str = ""  # code for every TODO
    files: dict[str, str] = {}  # more files, by name

    @property
    def modules(self) -> set[str]:
        """The programs it is made in."""
        return {each.file.partition("/")[0].removesuffix(".py") for each in self.replace}


class Breach(Edits, frozen=True, kw_only=True):
    """What the file of a wrong member holds that breaks a promise of the lesson's."""

    breaks: str  # the promise
    also: list[str] = []  # TODOs that may lose points too: their checks need what is broken


@dataclass(frozen=True)
class Member:
    """One submission of the bank in one form."""

    kind: Kind
    name: str
    form: Form
    entry: Entry
    source: Path | None  # a patch, edits, a folder to lay over, or nothing but a transform
    course: Course = field(default=FULL, compare=False)  # by which it is graded
    variant: Edits | None = field(default=None, compare=False)  # of the lesson's programs

    @property
    def is_patch(self) -> bool:
        """Whether it replaces the regions of TODOs and nothing else."""
        return self.source is not None and self.source.suffix == ".py"

    @property
    def edits(self) -> Edits | None:
        if self.variant is not None:
            return self.variant
        if self.source is None or self.source.suffix != ".toml":
            return None
        kind = Breach if self.kind == "wrong" else Edits
        return msgspec.toml.decode(self.source.read_bytes(), type=kind)

    @property
    def breach(self) -> Breach | None:
        edits = self.edits
        return edits if isinstance(edits, Breach) else None

    @property
    def todos(self) -> frozenset[str]:
        """What it is about: the TODOs whose regions a patch replaces, or the program as a whole."""
        if self.breach is not None:
            return frozenset({"whole"})
        if self.source is None or not self.is_patch:
            return frozenset()
        return frozenset(region.id for region in regions_in(read_source(self.source)))

    @property
    def bonus(self) -> bool:
        """Whether it is about bonus tasks and nothing else."""
        return self.kind != "hostile" and bool(self.todos) and all(map(is_bonus, self.todos))

    @property
    def judged_by(self) -> frozenset[str]:
        """The TODOs to grade; empty for all.

        A patch changes regions of some programs, and the programs share no file: the others are
        the solution's, letter by letter. The whole may suffer from a wrong member or not, so it is
        left out; from a bonus task it must not suffer.
        """
        if self.kind == "ladder":
            return self.todos
        todos = [todo for todo in load_rubric().todos if todo.function]
        edits = self.breach or self.variant
        if edits is not None:
            near = {t.id for t in todos if t.module in edits.modules and not t.bonus}
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

    def belongs_to(self, course: Course) -> bool:
        """Whether a course has the TODOs that it is about, and the programs it is wrong in."""
        asked = {todo.id for todo in course.rubric.todos}
        if self.breach is not None:
            return "whole" in asked and self.breach.modules <= set(course.modules)
        if self.kind == "right":
            return not self.todos or not asked.isdisjoint(self.todos)
        return self.todos <= asked

    def build(self, kit: Path, folder: Path) -> None:
        """Write the submission into `folder`, which must not exist."""
        base = self.entry.base
        if base == "empty":
            folder.mkdir(parents=True)
        elif base == "lesson":
            ignored = shutil.ignore_patterns("*.toml", "__pycache__")
            shutil.copytree(kit / "tests" / "bank" / "lesson", folder, ignore=ignored)
        else:
            ignored = shutil.ignore_patterns("__pycache__", "notebooks", ".*")
            tree = "starter" if base == "starter" else "solution"
            shutil.copytree(kit / tree, folder, ignore=ignored)
        if base == "old package":
            use_old_package(kit, folder)
        if self.form == "single file":
            use_single_file(kit, folder)
        if self.kind == "ladder" and self.source is not None and self.source.is_dir():
            for rung in constants(self.source):
                patch(rung, folder)
        elif self.source is not None and self.source.is_dir():
            lay_over(self.source, folder)
        elif self.edits is not None:
            replace_text(self.edits, folder)
        elif self.source is not None:
            patch(self.source, folder)
        if self.entry.transform:
            TRANSFORMS[self.entry.transform](folder)

    def complaint(self, result: Result, seconds: float) -> str:
        """What is wrong with the marks this member got; empty when they are what they must be."""
        lost = {t.id: t.max_points - t.points for t in result.todos if t.points != t.max_points}
        if self.kind == "ladder":  # a rung is held against the others of its ladder
            many = not self.is_patch and result.points > MOST_FOR_CONSTANTS
            return f"{result.points} points, more than {MOST_FOR_CONSTANTS}" if many else ""
        if self.kind == "wrong":
            allowed = self.todos.union(self.breach.also if self.breach else ())
            unharmed = sorted(self.todos - set(lost))
            others = sorted(set(lost) - allowed)
            if unharmed:
                return f"TODO {', '.join(unharmed)} loses nothing"
            return f"TODO {', '.join(others)} must not lose anything" if others else ""
        points = result.max_points if self.entry.points is None else self.entry.points
        begun = {todo.id for todo in result.todos if todo.state != "not started"} | self.todos
        if self.entry.points is None and any(map(is_bonus, set(lost) & begun)):
            return f"not the whole bonus; lost: {lost}"
        if result.points != points:
            return f"{result.points} points instead of {points}; lost: {lost}"
        if seconds > self.entry.seconds:
            return f"took {seconds:.0f} s, more than {self.entry.seconds} s"
        return ""

    def misnamed(self, result: Result) -> Literal["right", "wrong", "none"]:
        """How the mistake of a wrong member was named."""
        names = {todo.misconception for todo in result.todos} - {None}
        if not names:
            return "none"
        return "right" if names == {self.name.partition("-")[2].partition("+")[0]} else "wrong"


def members(kit: Path, course: Course = FULL) -> Iterator[Member]:
    """Every member of the bank that a course has to do with.

    Attacks are on the judge, whatever it asks: they are graded by all that there is.
    """
    for member in every_member(kit):
        if member.kind == "hostile":
            yield member
        elif member.belongs_to(course):
            yield replace(member, course=course)


def every_member(kit: Path) -> Iterator[Member]:
    """All of the bank, wrong ones in each form they can take."""
    bank = kit / "tests" / "bank"
    yield from lesson_members(bank / "lesson")
    book = msgspec.toml.decode((bank / "bank.toml").read_bytes(), type=Book)
    for path in sorted((bank / "wrong").glob("*.py")):
        entry = book.wrong.get(path.stem, Entry())
        member = Member("wrong", path.stem, "package", entry, path)
        yield member
        if entry.single_file and member.todos <= set("123456"):
            yield Member("wrong", path.stem, "single file", Entry(), path)
    for path in sorted((bank / "wrong").glob("whole-*.toml")):
        yield Member("wrong", path.stem, "package", Entry(), path)
    kinds: list[tuple[Kind, dict[str, Entry]]] = [("right", book.right), ("hostile", book.hostile)]
    for kind, entries in kinds:
        files = {path.stem: path for path in sorted((bank / kind).glob("*"))}
        for name in sorted(files | entries):
            yield Member(kind, name, "package", entries.get(name, Entry()), files.get(name))
    yield Member("right", "single-file", "single file", Entry(), None)
    yield from rungs(bank / "ladders")


def lesson_members(folder: Path) -> Iterator[Member]:
    """The lesson's programs as printed, under both names of their files, and their variants."""
    entry = Entry(base="lesson")
    yield Member("right", "lesson-as-printed", "package", entry, None)
    renamed = Entry(base="lesson", transform="printed-names")
    yield Member("right", "lesson-under-printed-names", "package", renamed, None)
    variants = msgspec.toml.decode((folder / "variants.toml").read_bytes(), type=dict[str, Edits])
    for name, edits in variants.items():
        yield Member("right", f"lesson-{name}", "package", entry, None, variant=edits)


def rungs(folder: Path) -> Iterator[Member]:
    """Each rung of each ladder, lowest first, and all of their constants in one submission."""
    for path in sorted(folder.glob("*/*.py")):
        yield Member("ladder", f"{path.parent.name}-{path.stem}", "package", Entry(), path)
    if any(constants(folder)):
        yield Member("ladder", CONSTANTS, "package", Entry(base="starter"), folder)


def constants(ladders: Path) -> Iterator[Path]:
    """The rungs that answer the same to every question."""
    yield from sorted(ladders.glob("*/*-constant*.py"))


def use_single_file(kit: Path, folder: Path) -> None:
    shutil.rmtree(folder / "mini_engine")
    shutil.copyfile(
        kit / "tests" / "bank" / "single_file" / "mini_engine.py", folder / "mini_engine.py"
    )


def use_old_package(kit: Path, folder: Path) -> None:
    shutil.rmtree(folder / "mini_engine")
    old = kit / "tests" / "bank" / "old_package" / "mini_engine"
    shutil.copytree(old, folder / "mini_engine", ignore=shutil.ignore_patterns("__pycache__"))


def lay_over(source: Path, folder: Path) -> None:
    """A single mini_engine.py takes the place of the package."""
    if (source / "mini_engine.py").exists():
        shutil.rmtree(folder / "mini_engine", ignore_errors=True)
    shutil.copytree(source, folder, dirs_exist_ok=True)


def replace_text(edits: Edits, folder: Path) -> None:
    """Edit the files of `folder`; ValueError where an old text is not there as often as it says."""
    for each in edits.replace:
        path = folder / each.file
        text = read_source(path)
        if text.count(each.old) != each.times:
            raise ValueError(
                f"{each.file} holds {each.old!r} {text.count(each.old)} times, not {each.times}"
            )
        path.write_text(text.replace(each.old, each.new), encoding="utf-8")
    for name, text in edits.files.items():
        (folder / name).write_text(text, encoding="utf-8")
    if edits.everywhere:
        fill_every_todo(folder, edits.everywhere)


def fill_every_todo(folder: Path, code: str) -> None:
    """Put the same code in the place of every TODO's."""
    lines = tuple(code.strip().splitlines())
    for path in python_files(folder):
        text = read_source(path)
        if here := {region.id: indented(lines, text, region) for region in regions_in(text)}:
            path.write_text(replaced(text, here), encoding="utf-8")


def patch(source: Path, folder: Path) -> None:
    """Put the regions of `source` in the place of those in the files of `folder`."""
    wanted = {region.id: region.lines for region in regions_in(read_source(source))}
    for path in python_files(folder):
        text = read_source(path)
        here = {
            region.id: indented(wanted[region.id], text, region)
            for region in regions_in(text)
            if region.id in wanted
        }
        if here:
            path.write_text(replaced(text, here), encoding="utf-8")
            wanted = {name: lines for name, lines in wanted.items() if name not in here}
    if wanted:
        raise ValueError(f"{source.name} patches TODO {', '.join(wanted)}, which is nowhere")


def indented(lines: Iterable[str], text: str, region: Region) -> tuple[str, ...]:
    """Lines that begin where those of a region of this text do."""
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
    """The package as one mini_engine.py, in which each part follows those that it imports."""
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
    """The files of the package that one of them imports from, as in `from ..world import World`."""
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


def add_environment(folder: Path) -> None:
    packages = folder / "env" / "lib" / "site-packages"
    packages.mkdir(parents=True)
    (folder / "env" / "pyvenv.cfg").write_text("home = /usr/bin\n", encoding="utf-8")
    for name in ("integrators.py", "mini_engine.py", "pygame.py"):
        (packages / name).write_text("raise SystemExit\n", encoding="utf-8")


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
        except OSError:  # a file system that knows text only
            return


def copies_beside(folder: Path) -> None:
    """What people keep before they begin, beside what they then work on."""
    ignored = shutil.ignore_patterns("__pycache__", "notebooks", ".*")
    for name in ("backup", "original"):
        shutil.copytree(KIT / "starter", folder / name, ignore=ignored)
    shutil.copytree(KIT / "starter" / "mini_engine", folder / "mini_engine copy", ignore=ignored)
    for name in ("integrators_original.py", "pymunk_scene2.py", "z_integrators.py"):
        source = "pymunk_scene.py" if "scene" in name else "integrators.py"
        shutil.copyfile(KIT / "starter" / source, folder / name)


def copies_inside(folder: Path) -> None:
    package = folder / "mini_engine"
    shutil.copytree(KIT / "starter" / "mini_engine", package / "mini_engine")
    for name in ("contacts", "solver", "world"):
        starter = KIT / "starter" / "mini_engine" / f"{name}.py"
        shutil.copyfile(starter, package / f"{name}_old.py")


def use_printed_names(folder: Path) -> None:
    for name in ("mini_engine", "pymunk_scene"):
        (folder / f"{name}.py").rename(folder / f"{name}_starter.py")


def leave_out_given_files(folder: Path) -> None:
    """Hand in only what has a TODO."""
    for path in [folder / "lab_runtime.py", *(folder / "mini_engine").rglob("*.py")]:
        if not regions_in(read_source(path)):
            path.unlink()


TRANSFORMS: dict[str, Callable[[Path], None]] = {
    "copies-beside": copies_beside,
    "copies-inside": copies_inside,
    "printed-names": use_printed_names,
    "given-files-missing": leave_out_given_files,
    "crlf": rewrite(lambda data: data.replace(b"\n", b"\r\n")),
    "bom": rewrite(lambda data: b"\xef\xbb\xbf" + data),
    "tabs": rewrite(lambda data: data.replace(b"    ", b"\t")),
    "one-file": into_one_file,
    "symlink": link_out,
    "many-files": many_files,
    "video": add_video,
    "virtual-environment": add_environment,
    "stale-bytecode": add_stale_bytecode,
    "odd-names": add_odd_names,
}
