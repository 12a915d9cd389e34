"""Make a class as each learning system exports it, with all its usual problems.

The same students hand in the same work in each system. Instead of grading, tests read the points
from integrators.py: `Student.points`.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import gradebooks
import packed
from gradebooks import Marks

Files = packed.Files
TITLE = "Physics engine"
FULL = 20  # points of the stand-in


def work(points: int) -> Files:
    return {
        "mini_engine/__init__.py": "",
        "pymunk_scene.py": "",
        "integrators.py": f"points = {points}\n",
    }


@dataclass
class Student:
    """One student, the submission, and the expected result."""

    login: str
    first: str
    last: str
    files: Files = field(default_factory=dict)  # as uploaded, by their names; none: nothing
    points: int | None = None  # that grading must find; None: none
    before: Files = field(default_factory=dict)  # an earlier attempt
    text: bool = False  # only a text was handed in
    late: bool = False
    by_hand: int | None = None
    says: str = ""  # in the table, of work that could not be graded

    @property
    def full(self) -> str:
        return f"{self.first} {self.last}"

    @property
    def email(self) -> str:
        return f"{self.login}@x.edu"

    @property
    def mark(self) -> int | None:
        """Return the expected mark in the gradebook; None if a person must review first."""
        if self.by_hand is not None:
            return self.by_hand
        if not self.files and not self.text:
            return 0
        late = 5 if self.late else 0
        return None if self.points is None else max(self.points - late, 0)


def students() -> list[Student]:
    changed = {
        "deep/er/mini_engine/__init__.py": "",
        "deep/er/pymunk_scene (1).py": "",
        "deep/er/Integrators.py": "points = 12\n",
    }
    two = work(1) | {"integrators (1).py": "points = 2\n"}
    loose = work(6)
    loose["mini_engine.py"] = loose.pop("mini_engine/__init__.py")
    return [
        Student("ann", "Ann", "Lee", {"work.zip": packed.as_zip(work(3))}, 3),
        Student("ann2", "Ann", "Lee", {"work.7z": packed.as_7z(work(4))}, 4),
        Student("ben", "Ben", "Öz", {"my work.rar": packed.as_rar(work(5))}, 5),
        Student("cem_r", "Cem", "Roe", loose, 6),
        Student(
            "dora",
            "Dora",
            "O'Poe",
            {"b.tar.gz": packed.as_tar(work(8))},
            8,
            before={"a.zip": packed.as_zip(work(7))},
        ),
        Student("eve", "Eve", "Voe", {"work.zip": b"PK broken"}, says="broken"),
        Student("finn", "Finn", "Woe", {"report.docx": "words"}, says="nothing of the lab"),
        Student("gil", "Gil", "Xoe", text=True, says="no file"),
        Student("hana", "Hana", "Yoe"),
        Student("ian", "Ian", "Zoe", by_hand=9, says="nothing was handed in"),
        Student("joy", "Joy", "Abe", {"joy.zip": packed.as_zip(changed)}, 12),
        Student("kim", "Kim", "Bee", {"kim.tar.xz": packed.as_tar(work(13), "xz")}, 13, late=True),
        Student(
            "leo", "Leo", "Cee", {"l.zip": packed.as_zip(two)}, by_hand=14, says="more than one"
        ),
        Student(
            "mia", "Mia", "Dee", {"m.zip": packed.as_zip({"a.zip": packed.as_zip(work(0))})}, 0
        ),
    ]


def hour(student: Student) -> int:
    """Return the hour of the last attempt: before noon, or after it if late."""
    return 13 if student.late else 11


REASON = 'reason = "shown in the lab"'
DECISIONS = """\
zone = "UTC"
[late]
due = 2026-05-04T12:00:00Z
per_day = 5
"""


def decisions(class_: list[Student], name: Callable[[Student], str]) -> str:
    told = (
        f'[[adjust]]\nstudent = "{name(each)}"\npoints = {each.by_hand}\n{REASON}\n'
        for each in class_
        if each.by_hand is not None
    )
    return DECISIONS + "".join(told)


def put(path: Path, content: str | bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(packed.as_bytes(content))


# ---------------------------------------------------------------- the five ways


def canvas(folder: Path, class_: list[Student]) -> str:
    """Write one file for each upload of the last attempt, with numbered names."""
    for number, each in enumerate(class_, 1):
        start = f"{each.last}{each.first}".lower().replace("'", "") + "_LATE" * each.late
        for at, (name, content) in enumerate(each.files.items()):
            if each.before:
                name = name.replace(".tar.gz", "-1.tar.gz")
            put(folder / f"{start}_{number}_{number}{at:03}_{name}", content)
        if each.text:
            put(folder / f"{start}_{number}_text.html", "<p>see my page</p>")
    rows = [f'"{s.last}, {s.first}",{n},s{n},{s.login},A,' for n, s in enumerate(class_, 1)]
    head = f"Student,ID,SIS User ID,SIS Login ID,Section,{TITLE} (77)"
    return "\n".join(
        [head, f"    Points Possible,,,,,{FULL}", *rows, '"Student, Test",99,,,A,', ""]
    )


def moodle(folder: Path, class_: list[Student]) -> str:
    """Write a folder for each upload; the worksheet has its time."""
    rows = []
    for number, each in enumerate(class_, 1):
        for name, content in each.files.items():
            put(folder / f"{each.full}_{number}_assignsubmission_file_" / name, content)
        if each.text:
            place = folder / f"{each.full}_{number}_assignsubmission_onlinetext_"
            put(place / "onlinetext.html", "<p>see my page</p>")
        when = f"Monday, 4 May 2026, {hour(each) % 12 or 12:02}:59 {'AP'[hour(each) > 11]}M"
        rows.append(
            f'Participant {number},"{each.full}",s{number},{each.email},,,{FULL},Yes,"{when}",,'
        )
    head = (
        "Identifier,Full name,ID number,Email address,Status,Grade,Maximum Grade,"
        "Grade can be changed,Last modified (submission),Last modified (grade),Feedback comments"
    )
    return "\n".join([head, *rows, ""])


def gradescope(folder: Path, class_: list[Student]) -> str:
    """Write a folder for each submission, unpacked by Gradescope or not, and one list for all."""
    listed = []
    for number, each in enumerate(class_, 1):
        files = dict(each.files) or ({"text.html": "see my page"} if each.text else {})
        for name, content in files.items():
            put(folder / f"submission_{number}" / name, content)
        if files:
            listed += [
                f"submission_{number}:",
                "  :submitters:",
                f"  - :name: {each.full}",
                f"    :sid: 's{number}'",
                f"    :email: {each.email}",
                f"  :created_at: 2026-05-04 {hour(each)}:59:00 Z",
            ]
    put(folder / "submission_metadata.yml", "\n".join([*listed, ""]))
    rows = [f'{s.first},"{s.last}",s{n},{s.email}' for n, s in enumerate(class_, 1)]
    return "\n".join(["First name,Last name,ID number,Email address", *rows, ""])


def blackboard(folder: Path, class_: list[Student]) -> str:
    """Write loose files with the attempt's time in the name, and a receipt for each attempt."""
    for each in class_:
        attempts = [(hour(each), each.files, each.text), (10, each.before, False)]
        for at, files, text in attempts:
            start = f"Lab_1_{each.login}_attempt_2026-05-04-{at:02}-59-00"
            for name, content in files.items():
                put(folder / f"{start}_{name}", content)
            if files or text:
                receipt = (
                    f"Name: {each.full} ({each.login})\nAssignment: Lab_1\n"
                    f"Date Submitted: Monday, May 4, 2026 {at}:59:00 UTC\nCurrent Grade: \n\n"
                    "Submission Field:\nName: Somebody Else (eve)\n"
                )
                put(folder / f"{start}.txt", receipt)
    head = ["Last Name", "First Name", "Username", "Student ID", "Last Access", "Availability"]
    rows = [[s.last, s.first, s.login, f"s{n}", "", "Yes", ""] for n, s in enumerate(class_, 1)]
    column = f"{TITLE} [Total Pts: {FULL} Score] |4711"
    return "\n".join("\t".join(row) for row in [[*head, column], *rows, []])


def brightspace(folder: Path, class_: list[Student]) -> str:
    """Write a folder for each attempt, and a page that lists them."""
    put(folder / "index.html", "<p>a list</p>")
    for number, each in enumerate(class_, 1):
        files = each.files or ({"text.html": "see my page"} if each.text else {})
        for at, them in ((hour(each), files), (10, each.before)):
            when = f"May 4, 2026 {at % 12 or 12}59 {'AP'[at > 11]}M"
            place = folder / f"{1000 + number}-77 - {each.full} - {when}"
            for name, content in them.items():
                put(place / name, content)
    head = (
        f"OrgDefinedId,Username,Last Name,First Name,Email,"
        f"{TITLE} Points Grade <Numeric MaxPoints:{FULL}>,End-of-Line Indicator"
    )
    rows = [f'#s{n},{s.login},"{s.last}",{s.first},{s.email},,#' for n, s in enumerate(class_, 1)]
    return "\n".join([head, *rows, ""])


SYSTEMS: dict[str, Callable[[Path, list[Student]], str]] = {
    "canvas": canvas,
    "moodle": moodle,
    "gradescope": gradescope,
    "blackboard": blackboard,
    "brightspace": brightspace,
}
BY_EMAIL = {"moodle", "gradescope"}  # their class lists identify students by addresses


def read_marks(system: str, content: bytes) -> Marks:
    return gradebooks.READERS.get(system, gradebooks.plain)(content, TITLE)
