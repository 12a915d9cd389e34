"""Test a class from the export to the gradebook and back: no student is lost or silently 0."""

import csv
import io
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import classes
import msgspec
import packed
import pytest
from classes import TITLE, Student
from command_line import run_in_class
from points_pool import Inline
from rich.console import Console
from samples import sample

from grader.classroom import grading
from grader.classroom.batch import Run
from grader.classroom.book import compare_results
from grader.classroom.grading import ClassOptions, run_class
from grader.intake import archives, repack
from grader.intake.learning_systems import BY_NAME
from grader.intake.roster import ClassList
from grader.intake.systems import read_roster
from grader.judge.course import Course
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.task import Options
from grader.report.files import read_result

QUIET = Console(quiet=True)
SYSTEMS = list(classes.SYSTEMS)


@dataclass
class Class:
    """A graded class, and its students."""

    system: str
    folder: Path
    roster: Path
    students: list[Student]
    run: Run

    @property
    def results(self) -> Path:
        return self.run.book.folder

    def called(self, student: Student) -> str:
        """Brightspace has no identifier of the class list, so two students of one name do not
        match."""
        if self.system == "brightspace" and student.full == "Ann Lee":
            return f"Ann Lee_{1001 + self.students.index(student)}-77"
        return self.name(student)

    def mark(self, student: Student) -> int | None:
        """Return the mark that the gradebook must have: none for students who may be confused."""
        known = self.called(student) == self.name(student)
        return student.mark if known else None

    def name(self, student: Student) -> str:
        return name_in(self.system, student)


def name_in(system: str, student: Student) -> str:
    """Return a student's name in the class list."""
    return student.email if system in classes.BY_EMAIL else student.login


@pytest.fixture
def in_one_process(monkeypatch) -> None:
    monkeypatch.setattr(grading, "open_executor", lambda wanted: Inline())
    here(monkeypatch)


def here(monkeypatch) -> None:
    """Read archives in this process: `test_pieces.py` reads them in processes, as in real use."""
    monkeypatch.setattr(repack, "set_limits", lambda seconds: None)
    make = lambda path, target, bounds: repack.main(str(path), str(target)) and []  # noqa: E731
    monkeypatch.setattr(archives, "repack_as_zip", lambda *args: make(*args) or [])


def exported(place: Path, system: str) -> tuple[Path, Path, list[Student]]:
    folder, students = place / f"{system} class", classes.students()
    folder.mkdir(parents=True)
    roster = place / ("list.xls" if system == "blackboard" else "list.csv")
    roster.write_text(classes.SYSTEMS[system](folder, students), encoding="utf-8")
    decisions = classes.decisions(students, lambda each: name_in(system, each))
    (folder / "adjustments.toml").write_text(decisions, encoding="utf-8")
    return folder, roster, students


def with_list(folder: Path, roster: Path) -> ClassOptions:
    return ClassOptions(Options(), people=ClassList(read_roster(roster)))


def test_people_are_listed_by_their_names_as_people_sort_and_all_of_them(tmp_path, in_one_process):
    """Brightspace's # is not part of an identifier, and no warning ends in the middle of a list."""
    names = {"a10": "Öz,Cem", "a2": "Park,Ann", "b1": "Orr,Bob"}
    absent = {f"c{number}": f"Zed,Student number {number}" for number in range(40)}
    rows = [f"#{id},{name},#" for id, name in (names | absent).items()]
    head = "OrgDefinedId,Last Name,First Name,End-of-Line Indicator"
    folder = tmp_path / "class"
    for id, points in zip(names, (5, 10, 20), strict=True):
        classes.put(folder / f"{id}.zip", packed.as_zip(classes.work(points)))
    (folder / "roster.csv").write_text("\n".join([head, *rows, ""]), encoding="utf-8")
    course, said = Course(title="Lab 3", out_of=10), io.StringIO()
    run = run_class(folder, ClassOptions(Options(course=course)), Console(file=said, width=60))
    labels = ["Orr, Bob (b1)", "Öz, Cem (a10)", "Park, Ann (a2)"]
    assert [each.label for each in run.outcomes] == labels
    assert "c39" in said.getvalue() and "…" not in said.getvalue()
    with open(run.book.table, encoding="utf-8-sig") as table:
        assert [row["student"] for row in csv.DictReader(table)] == [
            "Orr, Bob",
            "Öz, Cem",
            "Park, Ann",
        ]
    page = run.book.folder.with_name("class-results.class.html").read_text(encoding="utf-8")
    assert "<h1>Lab 3</h1>" in page
    assert sorted(labels, key=page.index) == labels
    report = (run.book.folder / "a10.html").read_text(encoding="utf-8")
    assert "<h1>Öz, Cem (a10)</h1>" in report
    assert "Mark: <strong>5</strong> of 20 points, which is 2.5 of 10 in the gradebook" in report
    (tmp_path / "course.toml").write_text('title = "Lab 3"\nout_of = 10\n', encoding="utf-8")
    lines = {"roster": folder / "roster.csv", "results": run.book.folder, "course": "course.toml"}
    assert run_in_class(tmp_path, "marks", **lines).exit_code == 0
    assert "#a10,2.5,#" in (tmp_path / "marks.csv").read_text(encoding="utf-8")
    (tmp_path / "marks.toml").write_text("total = 50\nshares = { engine = 1 }\n", encoding="utf-8")
    other = run_in_class(tmp_path, "marks", **lines)
    assert "these marks count to 50, and the students' pages count to 10" in other.output


def result_with(**points: tuple[int, int]) -> Result:
    """Return a result whose TODOs have these points, each with a passed and a failed check."""

    def check(name: str, got: int, most: int) -> CheckResult:
        return CheckResult(name, name, "unit", "passed" if got else "not yet", got, most)

    def todo(name: str, got: int, most: int) -> TodoResult:
        checks = [check("right", got, got), check("wrong", 0, most - got)]
        return TodoResult(name, "", "not yet", got, most, None, checks)

    return Result(1, "", 0, 0, 0, [], [todo(name, *each) for name, each in points.items()])


def test_other_points_in_the_course_are_said_once_for_each_todo():
    old = result_with(a=(5, 8), b=(2, 4), c=(1, 2))
    assert list(compare_results(old, result_with(a=(10, 16), b=(0, 4), d=(3, 6)))) == [
        "TODO a has other points in the course: 5 of 8 → 10 of 16",
        "TODO b, right: 2 → 0 of 0",
        "TODO d is new: 3 of 6",
        "TODO c is not asked any more: it had 1 of 2",
    ]


def test_grading_again_shows_what_changed_and_keeps_what_was(tmp_path, in_one_process):
    folder, said = tmp_path / "class", io.StringIO()

    def grade_again(points: int) -> Run:
        classes.put(folder / "ann.zip", packed.as_zip(classes.work(points)))
        classes.put(folder / "ben.zip", packed.as_zip(classes.work(3)))
        return run_class(folder, ClassOptions(Options()), Console(file=said, width=200))

    first = grade_again(5)
    assert not any(each.before or each.changed for each in first.outcomes)
    for _ in range(2):  # the second time nothing is graded, but the note remains
        run = grade_again(9)
        ann, ben = run.outcomes
        assert ann.before == "5 / 20" and ann.changed == ["TODO 8a, A title: 5 → 9 of 20"]
        assert not ben.before
    assert said.getvalue().count("other marks than in the run before: ann (5 / 20 → 9 / 20)") == 1
    (earlier,) = (tmp_path / "class-results.earlier" / "ann").iterdir()
    assert (
        read_result(earlier).points == 5 and read_result(run.book.locate_result("ann")).points == 9
    )
    page = (run.book.folder / "ann.html").read_text(encoding="utf-8")
    assert "<dt>Before</dt><dd>5 / 20</dd>" in page
    assert "<dt>Changed</dt><dd>TODO 8a, A title: 5 → 9 of 20</dd>" in page
    table = run.book.folder.with_name("class-results.class.html").read_text(encoding="utf-8")
    assert "before: 5 / 20<br>TODO 8a, A title: 5 → 9 of 20" in table
    (folder / "ann.zip").write_bytes(b"PK\3\4")
    (ann, _) = run_class(folder, ClassOptions(Options()), QUIET).outcomes
    assert ann.mark is None and ann.before == "9 / 20" and not ann.changed
    assert len(list((tmp_path / "class-results.earlier" / "ann").iterdir())) == 2


def test_there_is_a_class_of_every_system():
    assert set(SYSTEMS) == set(BY_NAME)


@pytest.fixture(params=sample(SYSTEMS, 3))
def graded_class(request, tmp_path_factory, in_one_process) -> Iterator[Class]:
    place = tmp_path_factory.mktemp("term")
    folder, roster, students = exported(place, request.param)
    run = run_class(folder, with_list(folder, roster), QUIET)
    yield Class(request.param, folder, roster, students, run)


def test_a_class_from_export_to_gradebook_and_back(graded_class: Class):
    check_marks_and_reasons(graded_class)
    check_tables_and_pages(graded_class)
    check_gradebook(graded_class)
    check_feedback(graded_class)


def check_marks_and_reasons(graded_class: Class) -> None:
    outcomes = {each.name: each for each in graded_class.run.outcomes}
    for student in graded_class.students:
        if student.login == "hana":
            assert graded_class.name(student) not in outcomes
            assert any(
                "nothing was handed in by" in n and "hana" in n for n in graded_class.run.notes
            )
            continue
        outcome = outcomes.pop(graded_class.called(student))
        assert outcome.mark == student.mark, (student.login, outcome)
        if student.points is None:
            says = "nothing" if student.text and graded_class.system != "canvas" else student.says
            assert says in outcome.trouble or "no file" in outcome.trouble, student.login
        else:
            assert not outcome.trouble and outcome.points == student.points, student.login
    assert not outcomes, "somebody who is not in the class"


def check_tables_and_pages(graded_class: Class) -> None:
    with open(graded_class.run.book.table, encoding="utf-8-sig", newline="") as file:
        rows = {row["name"]: row for row in csv.DictReader(file)}
    for student in graded_class.students:
        name = graded_class.called(student)
        if student.login == "hana":
            continue
        row, page = rows[name], (graded_class.results / f"{name}.html").read_text(encoding="utf-8")
        assert row["points"] == ("" if student.mark is None else str(student.mark))
        if student.mark is None:
            assert row["trouble"] and "No points yet" in page
        elif student.by_hand is not None:
            assert "shown in the lab: set to" in row["adjusted"] and "shown in the lab" in page
        if student.late:
            assert "1 day late: -5" in row["adjusted"] and "1 day late: -5" in page
        if student.login == "joy":
            assert "taken as pymunk_scene.py" in row["notes"] and "taken as" in page


def check_gradebook(graded_class: Class) -> None:
    settings = graded_class.folder.parent / "marks.toml"
    settings.write_text(
        f'title = "{TITLE}"\ntotal = {classes.FULL}\ndecimals = 0\nshares.engine = 1\n'
    )
    done = run_in_class(
        settings.parent, "marks", roster=graded_class.roster, results=graded_class.results
    )
    assert done.exit_code == 1, done.output
    content = settings.with_suffix(".csv").read_bytes()
    told = list(classes.read_marks(graded_class.system, content).values())
    for student, cells in zip(graded_class.students, told, strict=True):
        wanted = graded_class.mark(student)
        assert cells.mark == ("" if wanted is None else str(wanted)), student.login
        if wanted is None:
            assert f"{graded_class.name(student)}: no mark" in done.output


def check_feedback(graded_class: Class) -> None:
    here = [student for student in graded_class.students if student.files]
    if BY_NAME[graded_class.system].takes_feedback:
        done = send_back(graded_class, graded_class.system)
        assert done.exit_code in (0, 1), done.output
        with zipfile.ZipFile(graded_class.folder.parent / "feedback.zip") as archive:
            names = archive.namelist()
        given = {path.name for path in graded_class.folder.iterdir()}
        if graded_class.system == "canvas":
            assert set(names) <= given and len(names) == len(here)
        elif graded_class.system == "moodle":
            number = {name.split("_")[1] for name in names}
            paged = [each for each in graded_class.students if has_page(graded_class, each)]
            assert {f"{graded_class.students.index(each) + 1}" for each in paged} == number
        else:
            assert {name.partition("/")[0] for name in names} <= given
        for student in graded_class.students:
            text = student.text and graded_class.system == "brightspace"  # has a folder there
            without = not (student.files or text) and has_page(graded_class, student)
            named = f"{graded_class.name(student)}: skipped, " in done.output
            assert named == (without and graded_class.system != "moodle"), student.login
    elif graded_class.system in classes.BY_EMAIL:
        send_back(graded_class, "email")
        names = {path.name for path in (graded_class.folder.parent / "feedback").iterdir()}
        assert {f"{each.email}.html" for each in here} <= names


def send_back(graded_class: Class, recipient: str):
    """Write each student's page for a recipient, into the folder around the class."""
    lines = {
        "roster": graded_class.roster,
        "results": graded_class.results,
        "submissions": graded_class.folder,
    }
    return run_in_class(graded_class.folder.parent, "feedback", "--for", recipient, **lines)


def has_page(graded_class: Class, student: Student) -> bool:
    return (graded_class.results / f"{graded_class.name(student)}.html").is_file()


def test_a_column_of_ones_own_says_who_is_who(tmp_path, in_one_process):
    folder, roster, _ = exported(tmp_path, "brightspace")
    first, *rows = roster.read_text(encoding="utf-8").splitlines()
    called = {"#s1": "Ann Lee_1001-77", "#s2": "Ann Lee_1002-77"}
    lines = [f"{first},Called", *(f"{row},{called.get(row.split(',')[0], '')}" for row in rows)]
    roster.write_text("\n".join(lines), encoding="utf-8")
    run = run_class(folder, with_list(folder, roster), QUIET)
    marks = {each.name: each.mark for each in run.outcomes}
    assert (marks["ann"], marks["ann2"]) == (3, 4)


# ---------------------------------------------------------------- groups


def grouped(roster: Path, system: str, group: list[Student], students: list[Student]) -> None:
    """Return the class list with a column of groups, in which these students form one."""
    mark = "\t" if system == "blackboard" else ","
    first, *rows = roster.read_text(encoding="utf-8").splitlines()
    own = {name_in(system, each) for each in group}
    lines = [f"{first}{mark}Group"]
    for row in rows:
        theirs = own & {cell.strip('"') for cell in row.split(mark)}
        lines.append(f"{row}{mark}{'one' if theirs else ''}")
    roster.write_text("\n".join(lines), encoding="utf-8")


@pytest.mark.parametrize(
    "system",
    sample(SYSTEMS, 9),
)
def test_each_of_a_group_has_a_mark_and_a_page_of_their_own(tmp_path, in_one_process, system):
    """Kim was late, Hana handed in nothing, and Ian has his own decision and no files."""
    folder, roster, students = exported(tmp_path, system)
    by_login = {each.login: each for each in students}
    kim, hana, ian = (by_login[login] for login in ("kim", "hana", "ian"))
    grouped(roster, system, [kim, hana, ian], students)
    run = run_class(folder, with_list(folder, roster), QUIET)
    group = Class(system, folder, roster, students, run)
    outcomes = {each.name: each for each in run.outcomes}
    names = [name_in(system, each) for each in (kim, hana, ian)]
    assert [outcomes[name].mark for name in names] == [8, 8, 9]
    for name in names:
        page = (group.results / f"{name}.html").read_text(encoding="utf-8")
        others = [each for each in names if each != name]
        assert all(each in page for each in others) and "<dt>Group</dt>" in page
        result = msgspec.json.decode((group.results / f"{name}.json").read_bytes())
        assert (result["submission"], result["points"]) == (name, 13)
    assert f"handed in by {names[0]}" in page
    everybody_gets_a_page(group, names)
    again = run_class(folder, with_list(folder, roster), QUIET)
    assert again.counts["graded"] == 0
    assert not [n for n in run.notes if "nothing was handed in" in n and names[1] in n]


def everybody_gets_a_page(graded_class: Class, names: list[str]) -> None:
    out = graded_class.folder.parent / "feedback"
    if BY_NAME[graded_class.system].takes_feedback:
        send_back(graded_class, graded_class.system)
        archive = zipfile.ZipFile(out.with_suffix(".zip"))
        found = set(archive.namelist())
    else:
        send_back(graded_class, "nbgrader")
        found = {path.parts[-3] for path in out.rglob("*.html")}
    if graded_class.system == "canvas":
        (own,) = [name for name in found if name.startswith("beekim")]
        text = archive.read(own).decode()
        found = set(text.splitlines())
    for name in names[1:]:
        student = next(
            each for each in graded_class.students if name_in(graded_class.system, each) == name
        )
        number = graded_class.students.index(student) + 1
        moodles = f"{student.full}_{number}_assignsubmission_file_feedback.html"
        assert {name, moodles} & found or any(f"/feedback-{name}.html" in each for each in found)


@pytest.mark.parametrize(
    "system, group, marks, words",
    [
        ("moodle", ("kim", "joy", "hana"), [8, 12, None], "handed in different work"),
        ("gradescope", ("eve", "hana"), [None, None], "broken"),
    ],
)
def test_a_group_without_one_readable_work_is_for_a_person(
    tmp_path, in_one_process, system, group, marks, words
):
    folder, roster, students = exported(tmp_path, system)
    by_login = {each.login: each for each in students}
    grouped(roster, system, [by_login[login] for login in group], students)
    run = run_class(folder, with_list(folder, roster), QUIET)
    outcomes = {each.name: each for each in run.outcomes}
    found = [outcomes[f"{login}@x.edu"] for login in group]
    assert [each.mark for each in found] == marks
    assert words in found[-1].trouble
