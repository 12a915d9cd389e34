"""Test the release: students can use it at once, it marks like the instructor's grader, and it has
no line of the solution and no hidden check."""

import io
import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import msgspec
import pytest
from page_readers import barriers, chromium
from rich.console import Console
from whole_bank import bank

from grader.bank import verify
from grader.bank.members import Member
from grader.bank.sync import is_laid_in, list_students_files
from grader.bank.verify import shared_worker
from grader.checks import exact
from grader.judge import recorded
from grader.judge.course import FULL, Course
from grader.judge.explain import misconceptions
from grader.judge.grade import grade
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.rubric import CHECKS, Rubric, drop_hidden, load_rubric
from grader.judge.task import KIT, Options
from grader.release import build as releases
from grader.release import students_copy
from grader.release.build import (
    Refused,
    build,
    look_for_leaks,
    prove,
    strip_build_packages,
)
from grader.release.handed_out import FOR_CI
from grader.release.leaks import Secret, find_leaks_in_text, read_texts
from grader.release.pages import MEASURED, make_page
from grader.release.students_copy import Tree, cut_checks, list_hidden_checks, record_answers
from grader.source.cut import prune, replace_bodies
from grader.source.regions import replace_regions

WRONG = [m for m in bank() if m.kind == "wrong" and m.form == "package" and m.replaced_todos]
REGIONS = {todo.id: todo.folder for todo in load_rubric().todos if todo.function}
for todo in REGIONS:
    misconceptions.load_known(todo)
KNOWN = {f"{mistake.todo}-{mistake.id}" for mistake in misconceptions.known_mistakes}
NAMED = [member for member in WRONG if not member.bonus and member.name in KNOWN]
SOAK = pytest.mark.soak
SAMPLE = [min((m for m in NAMED if m.todos == {todo}), key=str) for todo in ("2", "8c")]

ASKED = frozenset({"8a"}).union(*(member.todos for member in SAMPLE))  # of the copy in `make test`

GRADE = """
import json, sys
from pathlib import Path
from grader.judge.wall.children import start_worker
from grader.judge.course import read_course
from grader.judge.grade import grade
from grader.report.files import as_json
from grader.cli.student import make_options
worker = start_worker()
for line in sys.stdin:
    path, todos = json.loads(line)
    result = grade(Path(path), make_options(frozenset(todos), read_course()), worker)
    print(as_json(result).decode().replace("\\n", ""))
worker.close()
"""


@dataclass
class Released:
    built: Path
    archive: Path
    tree: Path  # the archive, unpacked
    installed: Path  # the wheel, unpacked
    wrong: dict[str, Path]  # the submissions used for recording

    @property
    def wheel(self) -> Path:
        (wheel,) = self.tree.glob("*.whl")
        return wheel

    def check(self, submissions: list[tuple[Path, frozenset[str]]]) -> list[Result]:
        """Return the results of `check` in the students' copy."""
        asked = "\n".join(json.dumps([str(path), sorted(todos)]) for path, todos in submissions)
        done = subprocess.run(
            releases.make_command(self.installed, f"exec({GRADE!r})"),
            cwd=self.installed,
            input=asked,
            capture_output=True,
            text=True,
        )
        assert not done.returncode, done.stderr
        return [msgspec.json.decode(line, type=Result) for line in done.stdout.splitlines()]


def make(work: Path, chosen: list[Member]) -> Released:
    wrong = wrong_in(work, chosen)

    def written() -> Iterator[tuple[Path, frozenset[str]]]:
        for member in chosen:
            member.build(wrong[member.name])
            yield wrong[member.name], member.todos

    (archive,) = build(work, written()).glob("*.zip")
    with zipfile.ZipFile(archive) as packed:
        packed.extractall(work / "unpacked")
    return released_in(work, chosen)


def released_in(work: Path, chosen: list[Member]) -> Released:
    """Return the release that `make` wrote into a folder."""
    (archive,) = (work / "built").glob("*.zip")
    tree = work / "unpacked" / releases.NAME
    return Released(work / "built", archive, tree, work / "installed", wrong_in(work, chosen))


def wrong_in(work: Path, chosen: list[Member]) -> dict[str, Path]:
    return {member.name: work / "wrong" / member.name for member in chosen}


@pytest.fixture(scope="session")
def released(once, expected_runs: bytes, practice_file: bytes, secrets: list[Secret]) -> Released:
    """Make a release once for all test processes, with the recorded runs.

    It has the answers of the TODOs in ASKED only. `make release` and `make soak` grade both trees
    with the whole copy.
    """

    def fill(work: Path) -> None:
        most = drop_hidden(load_rubric()).max_points
        marks = {"solution": most}
        with pytest.MonkeyPatch.context() as patched:
            patched.setattr(releases, "record_expected", lambda *_: expected_runs)
            patched.setattr(students_copy, "record_answers", recorded_for_some)
            patched.setattr(releases, "find_secrets", lambda *_: secrets)
            patched.setattr(students_copy, "make_practice", lambda _: practice_file)
            patched.setattr(
                releases,
                "grade_with",
                lambda _, tree: Result(1, tree.name, marks.get(tree.name, 0), most, 0, [], []),
            )
            make(work, SAMPLE)

    return released_in(once("release", fill), SAMPLE)


def recorded_for_some(wrong: Iterable[Tree], rubric: Rubric) -> recorded.RecordedAnswers:
    """Record the answers of the TODOs in ASKED only."""
    return record_answers(wrong, Rubric([todo for todo in rubric.todos if todo.id in ASKED]))


# ---------------------------------------------------------------- the students' grader


Pair = tuple[TodoResult, TodoResult]  # ours and theirs


def as_told(todo: TodoResult) -> dict[str, CheckResult]:
    """Return the checks of a TODO without their meanings and replays."""
    return {
        check.id: msgspec.structs.replace(check, meaning="", replay=None) for check in todo.checks
    }


def compare(released: Released, submissions: list[tuple[Path, frozenset[str]]]) -> list[Pair]:
    """Check submissions with the copy and the kit, and compare every visible check.

    Return both results of each TODO.
    """
    pairs: list[Pair] = []
    for (path, todos), theirs in zip(submissions, released.check(submissions), strict=True):
        ours = grade(path, Options(reference=None, only=todos), shared_worker())
        for our, their in zip(ours.todos, theirs.todos, strict=True):
            shown, here = as_told(their), as_told(our)
            assert shown == {name: here[name] for name in shown}, path.name
            assert contradicts_nothing(our, their), path.name
            pairs.append((our, their))
    return pairs


def contradicts_nothing(our: TodoResult, their: TodoResult) -> bool:
    """Return whether the kit names the copy's mistake, at least in one check.

    The kit asks more questions, and hidden checks may show that the mistake is not made there.
    """
    if their.misconception in (our.misconception, None):
        return True
    named = {check.meaning for check in their.checks if check.meaning}
    return our.misconception is None and any(
        check.meaning.endswith(meaning) for check in our.checks for meaning in named
    )


def share_named(pairs: list[Pair]) -> float:
    """Return the share of the kit's named mistakes that the copy names too."""
    named = [their.misconception for our, their in pairs if our.misconception]
    return sum(map(bool, named)) / len(named)


def of_the_bank(released: Released, chosen: list[Member]) -> list[tuple[Path, frozenset[str]]]:
    return [(released.wrong[member.name], member.todos) for member in chosen]


def test_every_visible_check_ends_as_in_the_instructors_grader(released: Released):
    assert len(SAMPLE) >= 2
    assert share_named(compare(released, of_the_bank(released, SAMPLE))) > 0.7


STEP = "v = v + accel(x) * dt\n    return x + v * dt, v"
# Submissions that may differ between copy and kit, by imports, given files or folders, and their
# states.
ON_THIS_MACHINE = {
    "imports-what-is-installed": (f"import rich\n    {STEP}", "error"),
    "tries-an-import": (
        f"try:\n        import msgspec\n    except ImportError:\n        {STEP}",
        "passed",
    ),
    "imports-its-own": (f"import own_helper\n    {STEP}", "passed"),
    "imports-the-grader": (f"from grader import grade\n    {STEP}", "error"),
    "imports-given-code": (f"import lab_runtime\n    {STEP}", "passed"),
    "reads-beside-it": (f"open('own_helper.py').close()\n    {STEP}", "passed"),
    "reads-what-is-not-handed-in": (
        f"open('build/replays/.gitignore').close()\n    {STEP}",
        "error",
    ),
    "reads-the-environment": (f"import os\n    x += 'COURSE_FILE' in os.environ\n    {STEP}", None),
    "asks-its-arguments": (f"import sys\n    x += len(sys.argv) - 1\n    {STEP}", None),
    "uses-changed-given-code": (
        "v = explicit_euler(x, v, dt, accel)[1]\n    return x + v * dt, v",
        None,
    ),
}


@pytest.mark.parametrize(
    "names", [tuple(ON_THIS_MACHINE)[::3], pytest.param(tuple(ON_THIS_MACHINE), marks=SOAK)]
)
def test_a_machine_with_other_things_on_it_changes_nothing(
    released: Released, tmp_path: Path, names: tuple[str, ...]
):
    """`check` in the student's folder, on any machine, agrees with `grade`."""
    text = (KIT / "starter" / "integrators.py").read_text(encoding="utf-8")
    trees = []
    for name, body in ((name, ON_THIS_MACHINE[name][0]) for name in names):
        tree = tmp_path / name
        (tree / "build" / "replays").mkdir(parents=True)
        (tree / "build" / "replays" / ".gitignore").write_text("*\n", encoding="utf-8")
        (tree / "own_helper.py").write_text("", encoding="utf-8")
        mine = replace_regions(text, {"8a": tuple(f"    {body}".splitlines())})
        if name == "uses-changed-given-code":
            mine = mine.replace("    return x + v * dt, v + accel(x) * dt", "    return x, v", 1)
        (tree / "integrators.py").write_text(mine, encoding="utf-8")
        trees.append((tree, frozenset({"8a"})))
    for name, (_, their) in zip(names, compare(released, trees), strict=True):
        assert ON_THIS_MACHINE[name][1] in (None, their.state), name


@SOAK
def test_so_it_is_for_all_wrong_submissions(tmp_path: Path):
    released = make(tmp_path, WRONG)
    assert share_named(compare(released, of_the_bank(released, WRONG))) > 0.9


def test_the_wheel_has_the_visible_rubric(released: Released):
    text = (released.installed / "grader" / "checks" / "rubric.toml").read_bytes()
    assert msgspec.toml.decode(text, type=Rubric) == drop_hidden(load_rubric())


def test_a_release_is_proved_by_the_course_in_it_and_refused_if_it_marks_wrongly(
    released: Released, monkeypatch
):
    """`make release COURSE_FILE=…` passes the file on to the copy."""
    monkeypatch.setenv("COURSE_FILE", str(KIT / "tests" / "courses" / "integrators.toml"))
    none = releases.grade_with(released.installed, KIT / "starter")
    assert none.max_points == drop_hidden(load_rubric()).max_points
    monkeypatch.setattr(releases, "grade_with", lambda *_: none)
    with pytest.raises(Refused, match=rf"the solution 0 / \d+ instead of {none.max_points} / "):
        prove(released.installed)


# ---------------------------------------------------------------- nothing is given away


def test_every_region_has_something_to_look_for(secrets: list[Secret]):
    named = " ".join(secret.what for secret in secrets)
    assert not [todo for todo in REGIONS if f"TODO {todo}" not in named]
    assert {f"{name}" for name in list_hidden_checks(load_rubric())} <= {
        each.text for each in secrets
    }


def test_hidden_checks_mistakes_and_closed_forms_are_not_in_the_wheel(released: Released):
    names = [path.name for path in released.installed.rglob("*")]
    assert not {"bank", "bench", "classroom", "intake", "release"} & set(names)
    assert not [name for name in names if name.startswith(("mistakes", "cases"))]
    questions = {path.stem for path in released.installed.glob("grader/questions/*.py")}
    assert questions == {
        *("__init__", "films", "page", "pictures", "practice"),
        *("program", "question", "reasons", "scene", "sheet"),
    }
    texts = [path.read_text(encoding="utf-8") for path in released.installed.rglob("*.py")]
    for name in list_hidden_checks(load_rubric()):
        assert not [text for text in texts if name in text]
    theirs = (released.installed / "grader" / "checks" / "exact.py").read_text(encoding="utf-8")
    for name in recorded.oracles:
        found = re.search(rf'^def {name}\(.*\n    """.*"""\n    (.*)\n', theirs, re.M)
        assert f"def {name}(" not in theirs or (found and "recorded.answer(" in found[1])


RENAMED = {
    "1": "c = Vector2(max(lo.x, min(m.x, hi.x)), max(lo.y, min(m.y, hi.y)))",
    "2": "k += cross(rb,direction)**2*second.inv_inertia",
    "3": "push = self.axis * (\n    (self.bias - v) / self.k\n)",
    "4": "jt = max(-most, min(most, jt))",
    "5": "share = math.exp(-world.linear_damping*step)",
    "6": "accumulator += min(frame_seconds, MAX_FRAME)",  # given under other names
    "7a": "space.gravity = (0, 980)",
    "7b": "moment = pymunk.moment_for_circle(mass, 0, radius)",  # this one, too
    "7c": "world.add(pymunk.PinJoint(world.static_body, ball, (700, 90), (0, 0)))",
    "7d": "accumulator += min( frame_seconds,\n MAX_FRAME )",
    "8a": "speed = speed + force(place) * h",
    "8b": "p = p + speed * h + 0.5 * first * h**2",
    "8c": "s3, f3 = s + 0.5 * h * f2, force(p + 0.5 * h * s2)",
}


@pytest.mark.parametrize("todo", RENAMED)
def test_a_line_is_found_under_other_names(todo: str, secrets: list[Secret]):
    text = f"Two lines.\nWrite `{RENAMED[todo]}` there.\n"
    found = list(find_leaks_in_text("page.md", text, secrets))
    assert found and found[0].line == 2
    assert f"TODO {todo}" in found[0].what


def test_what_students_have_anyway_is_no_leak(secrets: list[Secret]):
    for path in [*list_students_files(KIT).values(), *(KIT / "handouts").glob("*.md")]:
        assert not list(find_leaks_in_text(path.name, path.read_text(encoding="utf-8"), secrets))


def zip_text(name: str, text: str | bytes) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr(name, text)
    return buffer.getvalue()


LINE = "total = max(-limit, min(limit, total))"
FORMS = {
    "page.html": b"<pre><span>total</span> = max(-limit, min(limit, total))</pre>",
    "rubric.toml": f'hints = ["{LINE}"]'.encode(),
    "cells.ipynb": json.dumps({"cells": [{"source": ["x = 1\n", LINE]}]}).encode(),
    "windows.txt": f"one\r\n{LINE}\r\n".encode(),
    "a.whl": zip_text("grader/help.py", LINE),
    "b.zip": zip_text("in.whl", zip_text("c.py", LINE)),
}


@pytest.mark.parametrize("name", FORMS)
def test_a_line_is_found_in_every_kind_of_file(name: str, secrets: list[Secret]):
    found = [
        leak
        for file, text in read_texts(name, FORMS[name])
        for leak in find_leaks_in_text(file, text, secrets)
    ]
    assert {leak.what for leak in found} == {"TODO 4"}


def test_planted_leaks_stop_the_release(
    released: Released, secrets: list[Secret], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """Plant solution lines in the starter, in a handout, in the hints and in the wheel."""
    monkeypatch.setattr(releases, "find_secrets", lambda *_: secrets)  # found out once
    tree = tmp_path / releases.NAME
    shutil.copytree(released.tree, tree)
    solver = (KIT / "solution" / "mini_engine" / "solver.py").read_text(encoding="utf-8")
    (tree / "mini_engine" / "solver.py").write_text(solver, encoding="utf-8")
    with open(tree / "handouts" / "lesson.html", "a", encoding="utf-8") as page:
        page.write("<p>\n<b>keep</b> = math.exp(-self.linear_damping * h)\n</p>\n")
    with zipfile.ZipFile(tree / released.wheel.name, "a") as wheel:
        wheel.writestr("grader/help.py", "# left over\nspace.gravity = (0, 980)\n")
        wheel.writestr("grader/checks/more.toml", 'x = "def rk4_weighs_four_samples"\n')
    built = tmp_path / "built"
    built.mkdir()
    releases.write_zip(tree, built / "release.zip")
    with pytest.raises(Refused) as refused:
        look_for_leaks(built)
    told = str(refused.value)
    top = f"release.zip/{releases.NAME}"
    assert re.search(rf"{top}/mini_engine/solver.py, line \d+, gives away TODO 2: ", told)
    assert re.search(rf"{top}/mini_engine/solver.py, line \d+, gives away TODO 4: ", told)
    assert re.search(rf"{top}/handouts/lesson.html, line \d+, gives away TODO 5: math.exp", told)
    assert re.search(r"whl/grader/help.py, line 2, gives away TODO 7a: space.gravity", told)
    assert re.search(r"more.toml, line 1, gives away a hidden check: rk4_weighs_four", told)


def test_one_verify_serves_every_course(tmp_path: Path, monkeypatch):
    """A course's members are among those that `make verify` has graded."""
    few = Course(todos=("8c",), points={"8c": 7})
    asked: dict[str, list[Member]] = {"full": [], "few": []}
    for name, course in (("full", FULL), ("few", few)):
        monkeypatch.setattr(verify.Store, "read", lambda _, member, n=name: asked[n].append(member))
        assert verify.count_unproven(course) == len(asked[name])
    assert 20 < len(asked["few"]) < len(asked["full"]) / 2
    assert {*asked["few"]} <= {*asked["full"]}


def test_nothing_is_made_of_a_kit_with_complaints(tmp_path: Path, monkeypatch):
    monkeypatch.setattr(releases, "check_kit", lambda: ["drift"])
    with pytest.raises(Refused, match="drift"):
        releases.release(tmp_path / "out", Console(file=io.StringIO()))
    assert not (tmp_path / "out").exists()


def test_a_sound_kit_is_released_and_an_older_one_replaced(tmp_path: Path, monkeypatch):
    def made(work: Path, *_: object) -> Path:
        (work / "built" / "bundle").mkdir(parents=True)
        (work / "built" / "bundle" / "new").touch()
        (work / "built" / "a.zip").write_text("new", encoding="utf-8")
        return work / "built"

    monkeypatch.setattr(releases, "count_unproven", lambda course: 3)
    monkeypatch.setattr(releases, "build", made)
    (tmp_path / "out" / "bundle").mkdir(parents=True)
    (tmp_path / "out" / "bundle" / "old").touch()
    (tmp_path / "out" / "a.zip").write_text("old", encoding="utf-8")
    told = io.StringIO()
    written = releases.release(tmp_path / "out", Console(file=told, width=300))
    assert "marks of 3 submissions of the bank are not proven" in told.getvalue()
    assert [path.name for path in written] == ["a.zip", "bundle"]
    assert written[0].read_text(encoding="utf-8") == "new"
    assert [path.name for path in written[1].iterdir()] == ["new"]


# ---------------------------------------------------------------- the student's first minute


def test_no_file_of_a_release_holds_a_condition_of_our_pages(released: Released):
    texts = [
        (name, text)
        for path in sorted(path for path in released.built.rglob("*") if path.is_file())
        for name, text in read_texts(path.name, path.read_bytes())
    ]
    assert any(name.endswith("/README.md") for name, _ in texts)
    assert not [name for name, text in texts if re.search("<!--[%=]", text)]


def test_the_readme_names_what_is_there(released: Released):
    text = (released.tree / "README.md").read_text(encoding="utf-8")
    files = set(re.findall(r"`((?:[\w-]+/)*[\w-]+\.(?:py|html|txt))`", text))
    assert {"handouts/index.html", "MANIFEST.txt", "mini_engine/world.py"} <= files
    places = (released.tree, released.tree / "mini_engine")
    assert not [name for name in files if not any((each / name).is_file() for each in places)]


MOST_FILES, MOST_WORDS = 60, 500  # of the student's folder, and of its README


def test_a_student_unpacks_few_files_and_reads_a_short_readme(released: Released):
    assert len(releases.list_files(released.tree)) <= MOST_FILES
    words = (released.tree / "README.md").read_text(encoding="utf-8").split()
    assert len(words) <= MOST_WORDS


def unpack_extra(released: Released, name: str, folder: Path) -> dict[str, Path]:
    """Unpack an archive beside the lab; return its files by name."""
    (archive,) = released.built.glob(f"*-extra/{name}.zip")
    shutil.unpack_archive(archive, folder)
    return dict(releases.list_files(folder / releases.NAME))


def test_the_engines_come_in_an_archive_of_their_own(released: Released, tmp_path: Path):
    files = unpack_extra(released, "engines", tmp_path)
    given = {name: path for name, path in list_students_files(KIT).items() if is_laid_in(name)}
    assert {"accuracy.py", "experiments/dials/window.py", "stable_engine/world.py"} < set(given)
    pages = {f"handouts/{Path(name).stem}.html" for name in MEASURED}
    assert set(files) == set(given) | pages | {"notebooks/accuracy.ipynb"}
    assert all(files[name].read_bytes() == path.read_bytes() for name, path in given.items())
    assert not set(files) & set(dict(releases.list_files(released.tree)))


def test_the_files_for_ci_come_in_an_archive_of_their_own(released: Released, tmp_path: Path):
    files = unpack_extra(released, "ci", tmp_path)
    assert set(files) == FOR_CI
    assert all(files[name].read_bytes() == (KIT / "starter" / name).read_bytes() for name in files)


def test_the_tree_is_the_starter(released: Released):
    files = {n: p for n, p in list_students_files(KIT).items() if not is_laid_in(n)}
    files = {name: files[name] for name in files.keys() - FOR_CI}
    for name in ("integrators", "journal", "quiz"):
        files[f"notebooks/{name}.ipynb"] = KIT / "starter" / "notebooks" / f"{name}.ipynb"
    made = {"requirements.txt", "pyproject.toml", "MANIFEST.txt", released.wheel.name}
    there = [name for name, _ in releases.list_files(released.tree)]
    assert {name for name in there if not name.startswith("handouts/")} == set(files) | made
    for name in set(files) - made:
        assert (released.tree / name).read_bytes() == files[name].read_bytes()


def test_every_link_of_the_pages_leads_somewhere(released: Released):
    pages = {page.name: page.read_text(encoding="utf-8") for page in released.tree.glob("*/*.html")}
    there = {path.name for path in (KIT / "handouts").glob("*.md")} - set(MEASURED)
    assert {f"{Path(name).stem}.html" for name in there} == set(pages)
    assert 'href="hints.html#todo-4' in pages["lab-sheet.html"]
    for name, text in pages.items():
        for link in re.findall(r'(?:href|src)="(?!data:)([^"]+)"', text):
            target, _, place = link.partition("#")
            assert (released.tree / "handouts" / (target or name)).is_file(), f"{name}: {link}"
            assert not place or f'id="{place}"' in pages[target or name], f"{name}: {link}"


def test_pages_follow_one_another_from_the_first_to_the_last(released: Released):
    folder, way = released.tree / "handouts", ["index.html"]
    while found := re.search(
        r'<a class="next" href="([^"]+)"', (folder / way[-1]).read_text(encoding="utf-8")
    ):
        assert f'class="previous" href="{way[-1]}"' in (folder / found[1]).read_text("utf-8")
        way.append(found[1])
    assert sorted(way) == sorted(page.name for page in folder.glob("*.html"))
    assert way[:3] == ["index.html", "lesson.html", "lab-sheet.html"]


def test_what_students_read_names_nothing_that_they_do_not_have(released: Released):
    tree = released.tree
    texts = [*tree.glob("*.md"), *tree.glob("handouts/*.html"), *tree.glob("notebooks/*.ipynb")]
    for path in texts:
        text = path.read_text(encoding="utf-8")
        assert "cd solution" not in text and "solution/" not in text, path.name
        for name in re.findall(r"(?:`|<code>)([\w.-]+/[\w./-]*)(?:`|</code>)", text):
            made_later = name.split("/")[0] in ("build", ".venv", "report")
            there = any((top / name).exists() for top in (tree, tree / "mini_engine"))
            assert made_later or there, f"{path.name} names {name}"


@SOAK
def test_the_pages_are_for_all(released: Released):
    with chromium() as browser:
        assert barriers(browser, *sorted(released.tree.glob("handouts/*.html"))) == []


def test_a_page_keeps_words_of_links_that_lead_nowhere():
    text = "# A <title>\n\n[here](b.md#c), [there](none.md)\n\n## C, d\n"
    page = make_page("a.md", {"a.md": text, "b.md": "# B\n"})
    assert '<a href="b.html#c">here</a>, there' in page
    assert "<title>A &lt;title&gt;</title>" in page and 'id="c-d"' in page


def test_the_manifest_knows_every_file(released: Released):
    head, *rows = (released.tree / "MANIFEST.txt").read_text(encoding="utf-8").splitlines()
    assert head.split()[-1] in released.wheel.name
    content = rows.pop(0).split()[-1]
    assert re.fullmatch("[0-9a-f]{64}", content) and content[:8] in released.archive.name
    sums = dict(reversed(row.split("  ")) for row in rows if not row.startswith("#"))
    files = dict(releases.list_files(released.tree))
    assert set(sums) == set(files) - {"MANIFEST.txt"}
    assert all(releases.sha256(files[name].read_bytes()) == sums[name] for name in sums)


BUILD = """
import os, sys
from pathlib import Path
os.umask(int(sys.argv[1], 8))
from grader.judge.course import read_course
from grader.release.build import build
build(Path(sys.argv[2]), [], read_course(Path(sys.argv[3])))
"""


@SOAK
def test_the_release_is_the_same_wherever_and_whenever_it_is_built(tmp_path: Path):
    """Build with other file modes, paths, time zones, locales and orders of sets.

    The course has TODOs of several files, so that a set's order would show.
    """
    course = tmp_path / "course.toml"
    course.write_text('todos = ["3", "7c", "B2"]\n', encoding="utf-8")
    archives = []
    for umask, name, zone, locale, seed in (
        ("077", "a path with spaces", "Asia/Kathmandu", "POSIX", "1"),
        ("002", "b", "America/St_Johns", "C.UTF-8", "2"),
    ):
        settings = {"TZ": zone, "LC_ALL": locale, "PYTHONHASHSEED": seed}
        command = [sys.executable, "-c", BUILD, umask, tmp_path / name, course]
        subprocess.run(command, check=True, env={**os.environ, **settings})
        archives += (tmp_path / name / "built").glob("*.zip")
    assert archives[0].name == archives[1].name
    assert archives[0].read_bytes() == archives[1].read_bytes()


def test_only_what_runs_is_required():
    lock = (
        "rich==15.0.0 \\\n    --hash=sha256:aa\n    # via\n    #   kit (pyproject.toml)\n"
        "setuptools==84.0 \\\n    --hash=sha256:bb\n    # via kit (pyproject.toml:build)\n"
        "tzdata==1.0 ; sys_platform == 'win32' \\\n    --hash=sha256:cc\n    # via rich\n"
    )
    assert strip_build_packages(lock) == (
        "rich==15.0.0 \\\n    --hash=sha256:aa\n"
        "tzdata==1.0 ; sys_platform == 'win32' \\\n    --hash=sha256:cc\n"
    )


NO_FORK = "import os; del os.fork; "  # as on Windows


def test_a_student_unpacks_checks_and_hands_in(released: Released, tmp_path: Path):
    """With the packages of this environment; `test_walk.py` has the whole lab."""
    tree = tmp_path / "a course" / releases.NAME
    shutil.copytree(released.tree, tree)

    def types(*words: str) -> tuple[int, str]:
        argv = ["grader", *words]
        code = f"import runpy; sys.argv = {argv!r}; runpy.run_module('grader', run_name='__main__')"
        command = releases.make_command(released.installed, NO_FORK + code)
        done = subprocess.run(command, cwd=tree, capture_output=True, text=True)
        assert not done.stderr
        return done.returncode, done.stdout

    shutil.copyfile(KIT / "solution" / "integrators.py", tree / "integrators.py")
    status, out = types("check", "--todo", "1", "--todo", "8a")
    assert status == 1 and re.search("^NOT STARTED 1$", out, re.M), out
    assert re.search("^PASSED +8a ", out, re.M), out
    status, out = types("hand-in")
    assert status == 0 and (tree / "hand-in.zip").is_file(), out


@SOAK
def test_uv_runs_a_check_in_an_unpacked_folder(released: Released, tmp_path: Path):
    uv = shutil.which("uv")
    if uv is None:
        pytest.skip("uv is not installed here")
    tree = tmp_path / "a course"
    shutil.copytree(released.tree, tree)
    command = [uv, "run", "grader", "check", "--todo", "8a"]
    usual = {name: value for name, value in os.environ.items() if name != "VIRTUAL_ENV"}
    done = subprocess.run(command, cwd=tree, env=usual, capture_output=True, text=True)
    if "error sending request" in done.stderr or "Failed to fetch" in done.stderr:
        pytest.skip("uv reaches no package index from here")
    assert done.stdout.startswith("NOT STARTED 8a"), done.stdout + done.stderr


# ---------------------------------------------------------------- cutting and recording

SOURCE = '''"""What it is."""

import math
from typing import Any, NamedTuple

A = 1
B = 2  # of b alone


def a(x: Any) -> float:
    """Uses A."""
    return helper(x) + A


# Above b,
# two lines.
@decorated
def b() -> float:
    return math.pi + B


def helper(x: float) -> float:
    return x
'''


def test_what_nobody_needs_is_cut_and_the_rest_is_kept_letter_by_letter():
    cut = prune(SOURCE, ["a"])
    compile(cut, "cut", "exec")
    assert cut.startswith('"""What it is."""\n\nfrom typing import Any\n\nA = 1\n\n\ndef a(')
    assert "import math" not in cut and "NamedTuple" not in cut and "# of b alone" not in cut
    assert "Above" not in cut and "two lines" not in cut and "decorated" not in cut
    kept = SOURCE[SOURCE.index("def a(") : SOURCE.index("# Above")].strip()
    assert kept in cut and cut.endswith("def helper(x: float) -> float:\n    return x\n")
    assert prune(SOURCE, ["a", "b"]).count("import math") == 1


def test_a_body_is_replaced_below_its_docstring():
    changed = replace_bodies(SOURCE, {"a": "return 5", "b": "return 6"})
    assert 'def a(x: Any) -> float:\n    """Uses A."""\n    return 5\n' in changed
    assert "def b() -> float:\n    return 6\n" in changed and "@decorated" not in changed


def test_visible_checks_are_cut_out_unchanged():
    """The students' copy asks the same as the kit."""
    cut = cut_checks(drop_hidden(load_rubric()))
    for todo in drop_hidden(load_rubric()).todos:
        text = (CHECKS / todo.folder / "checks.py").read_text(encoding="utf-8")
        for check in todo.checks:
            pattern = rf"(?:^@.+\n)*^def {check.id}\([\s\S]*?(?=\n\S|\Z)"
            found = re.search(pattern, text, re.M)
            assert found and found[0] in cut[f"{todo.folder}/checks.py"], check.id


def test_no_check_imports_an_oracle_by_its_name():
    """Checks call it as exact.NAME, so that a release can replace it."""
    names = set(recorded.oracles)
    assert names == {name for name in names if callable(getattr(exact, name))}
    for path in CHECKS.rglob("*.py"):
        if path.name == "mistakes.py":  # students do not get these
            continue
        text = path.read_text(encoding="utf-8")
        for imported in re.findall(r"from grader.checks.exact import \(?([\w, \n]+)", text):
            assert not names & set(re.findall(r"\w+", imported)), path


@pytest.mark.parametrize(
    ("first", "second", "same"),
    [
        ((1, 2.0), (1.0, 2), True),
        ([(0.0, True)], ((-0.0, True),), True),
        ((1, True), (1, 1), False),
        ((0.1 + 0.2,), (0.3,), True),
        ((100.0,), (100.000000001,), False),
        (("a", None), ("a", None), True),
    ],
)
def test_what_was_asked_is_known_again(first, second, same):
    assert (recorded.key(first) == recorded.key(second)) is same


def test_a_question_without_a_recorded_answer_is_named():
    with pytest.raises(LookupError, match=r"no recorded answer of damped to \(0.5, 7.0\)"):
        recorded.answer("damped", 0.5, 7.0)
