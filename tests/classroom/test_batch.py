"""Test grading a class: kept results, repeated grades, and recovery from a kill."""

import ast
import csv
import io
import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import nullcontext
from pathlib import Path

import psutil
import pytest
from command_line import run_grader
from fragile_pool import CountingPool, FragilePool, ImpatientPool, result_of
from rich.console import Console

from grader.bank.members import add_odd_names
from grader.classroom import batch, grading
from grader.classroom.adjustments import Adjust, Adjustments
from grader.classroom.batch import Run, grade_class
from grader.classroom.book import Book
from grader.classroom.executor import Answer, grade_package, shared_worker
from grader.classroom.fingerprint import make_key
from grader.classroom.grading import ClassOptions, run_class, write_page
from grader.errors import Stop
from grader.intake.found import Intake, Package, Work
from grader.intake.listing import open_class
from grader.intake.packing import pack
from grader.judge.fingerprint import DECIDING, deciding_files
from grader.judge.grade import grade
from grader.judge.task import KIT, Options, shipped_reference
from grader.report import progress
from grader.report.files import as_json

QUIET = Console(quiet=True)
ONLY_8A = Options(shipped_reference(), only=frozenset({"8a"}))  # a second instead of five


class Inline:
    """Grades at once, and records the names."""

    def __init__(self) -> None:
        self.names: list[str] = []

    def capacity(self) -> int:
        return 1

    def submit(self, package: Package) -> "Future[Answer]":
        self.names.append(package.name)
        future: Future[Answer] = Future()
        future.set_result((result_of(package), 0.0))
        return future


class InThisProcess(Inline):
    """Really grades."""

    def submit(self, package: Package) -> "Future[Answer]":
        future: Future[Answer] = Future()
        future.set_result(grade_package(package, ONLY_8A))
        return future


@pytest.fixture
def classroom(tmp_path: Path) -> Path:
    for name in ("ann", "ben", "cem"):
        (tmp_path / "class" / name).mkdir(parents=True)
        (tmp_path / "class" / name / "integrators.py").write_text(f"# {name}\n", encoding="utf-8")
    return tmp_path / "class"


def start(intake: Intake, classroom: Path) -> Run:
    return Run(intake, Book(classroom.parent / "out"), "key")


def grade_once(classroom: Path, key: str = "key", adjustments: Adjustments | None = None) -> Run:
    """Run once; the executor's `.names` are the newly graded ones."""
    executor = Inline()
    with open_class(classroom) as intake:
        run = Run(intake, Book(classroom.parent / "out"), key, adjustments or Adjustments())
        grade_class(run, executor, QUIET)
    run.names = executor.names
    return run


# ---------------------------------------------------------------- progress


@pytest.mark.parametrize("pause, lines", [(0.0, ["1 of 3, 1 graded", "2 of 3, 2 graded"]), (9, [])])
def test_a_log_gets_a_line_now_and_then(classroom, monkeypatch, pause, lines):
    monkeypatch.setattr(progress, "NOW_AND_THEN", pause)
    log = Console(record=True, force_terminal=False, file=io.StringIO())
    with open_class(classroom) as intake:
        grade_class(start(intake, classroom), Inline(), log)
    assert log.export_text().splitlines()[:2] == [f"grading: {line}" for line in lines]


# ---------------------------------------------------------------- kept results


def test_only_what_changed_is_graded_again(classroom):
    run = grade_once(classroom)
    assert run.names == ["ann", "ben", "cem"]
    assert grade_once(classroom).names == []
    (classroom / "ben" / "helper.py").write_text("", encoding="utf-8")
    assert grade_once(classroom).names == ["ben"]
    run.book.locate_result("ann").unlink()
    run.book.locate_result("cem").write_text("{}", encoding="utf-8")
    assert grade_once(classroom).names == ["ann", "cem"]
    assert grade_once(classroom, key="another seed").names == ["ann", "ben", "cem"]


def test_a_line_cut_off_by_a_kill_costs_that_submission_only(classroom):
    book = grade_once(classroom).book
    whole = book.path.read_bytes()
    book.path.write_bytes(whole[:-40])
    (book.folder / f".ann.json.{'0' * 16}").write_text("half", encoding="utf-8")
    assert grade_once(classroom).names == ["cem"]
    assert sorted(path.name for path in book.folder.iterdir()) == [
        "ann.json",
        "ben.json",
        "cem.json",
    ]


def test_no_result_outlives_its_submission_and_those_of_others_stay(classroom):
    grade_once(classroom)
    shutil.rmtree(classroom / "ann")
    (classroom / "ann.zip").write_bytes(b"not a zip")
    shutil.rmtree(classroom / "ben")
    run = grade_once(classroom)
    assert not run.book.locate_result("ann").exists() and run.book.locate_result("ben").exists()
    assert "broken" in {each.name: each.trouble for each in run.outcomes}["ann"]
    assert run.counts == {"graded": 0, "kept": 1, "not graded": 1}
    assert any("others than this class: ben" in note for note in run.notes)


def test_the_key_depends_on_all_that_decides(tmp_path):
    keys = {
        make_key(options)
        for options in (
            Options(),
            Options(seed=1),
            Options(only=frozenset({"1"})),
            Options(isolation="strict"),
            Options(shipped_reference()),
        )
    }
    assert len(keys) == 5 and make_key(Options(seed=1)) in keys


def test_what_decides_no_points_does_not_count(tmp_path):
    names = ("checks/todo_1.py", "checks/rubric.toml", "judge/grade.py", "worker/child.py")
    others = ("player/page.py", "report/terminal.py", "cli.py", "watch.py", "classroom/book.py")
    for name in (*names, *others, "protocol.py", "judge/notes.txt"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    found = [path.relative_to(tmp_path).as_posix() for path in deciding_files(tmp_path)]
    assert found == sorted([*names, "protocol.py"])


def test_what_decides_uses_nothing_that_does_not_count():
    top = KIT / "grader"
    used: dict[str, set[str]] = {}
    for path in deciding_files(top):
        if path.suffix == ".py":
            for node in ast.walk(ast.parse(path.read_bytes())):
                if isinstance(node, ast.ImportFrom) and str(node.module).startswith("grader."):
                    used.setdefault(str(node.module).split(".")[1], set()).add(path.name)
    places = {Path(name).stem for name in DECIDING}
    assert places <= {*used, "worker", "checks"}, "something counts that nothing uses"
    shown = {name: files for name, files in used.items() if name not in places}
    assert shown == {}


# ---------------------------------------------------------------- adjustments, table, notes


def test_adjustments_stay_on_top_and_results_as_they_are(classroom):
    adjustments = Adjustments(adjust=[Adjust("ann", "=ill", add=40), Adjust("eve", "x", add=1)])
    before = grade_once(classroom).book.locate_result("ann").read_bytes()
    for run in (
        grade_once(classroom, adjustments=adjustments),
        grade_once(classroom, "k", adjustments),
    ):
        assert run.book.locate_result("ann").read_bytes() == before
        with open(run.book.table, encoding="utf-8-sig", newline="") as file:
            row = next(row for row in csv.DictReader(file) if row["name"] == "ann")
        assert (row["points"], row["found"], row["adjusted"]) == ("41", "1", "'=ill: +40")
        assert "adjusted, but nothing was handed in: eve" in run.notes
    assert grade_once(classroom).outcomes[0].final == 1


def test_the_same_files_from_two_people_are_mentioned_unless_they_work_together(classroom):
    shutil.copy(classroom / "ann" / "integrators.py", classroom / "cem" / "integrators.py")
    assert "the same files were handed in by ann, cem" in grade_once(classroom).notes
    (classroom / "cem" / "integrators.py").write_text("# cem\n", encoding="utf-8")
    (classroom / "submission_metadata.yml").write_text(
        "ann: {':submitters': [{':email': a@x}, {':email': b@x}]}\n", encoding="utf-8"
    )
    run = grade_once(classroom)
    assert [each.name for each in run.outcomes] == ["a@x", "b@x", "ben", "cem"]
    assert not any("same files" in note for note in run.notes)


@pytest.mark.parametrize("name", ["pack", "make_prints"])
def test_whatever_goes_wrong_with_one_the_others_are_graded(classroom, monkeypatch, name):
    """A work that cannot be compared with others is graded too."""
    real = getattr(batch, name)

    def break_at_ben(work: Work | Package, *more: object) -> object:
        if work.name == "ben":
            raise UnicodeEncodeError("utf-8", "x", 0, 1, "surrogates")
        return real(work, *more)

    monkeypatch.setattr(batch, name, break_at_ben)
    run = grade_once(classroom)
    assert run.names == (["ann", "cem"] if name == "pack" else ["ann", "ben", "cem"])
    trouble = {each.name: each.trouble for each in run.outcomes}["ben"]
    assert ("surrogates" in trouble) is (name == "pack")


def test_names_that_are_no_text_are_graded(classroom):
    """Names of files or folders in another machine's encoding, or with terminal controls."""
    add_odd_names(classroom / "ben")
    run = grade_once(classroom)
    assert run.names == ["ann", "ben", "cem"]
    assert not any(each.trouble for each in run.outcomes)


# ---------------------------------------------------------------- processes


@pytest.mark.soak
@pytest.mark.skipif(not hasattr(os, "fork"), reason="one of them forks")
def test_a_judge_that_reaches_a_limit_leaves_the_others_as_they_were(classroom, tmp_path):
    limits = {
        "looper": "1 s of processor time",
        "worker": "1 s of processor time",
        "eater": "200 MB of memory",
        "gulper": "200 MB of memory",
    }
    nine = [*limits, "looper-2", "eater-2", "gulper-2", "killer", "raiser"]
    before = {found.name: result_of(pack(found)) for found in list_class(classroom)}
    for name in nine:
        shutil.copytree(classroom / "ann", classroom / name)
    with open_class(classroom) as intake, FragilePool(Options(), 2) as pool:
        run = grade_class(start(intake, classroom), pool, QUIET)
    assert len(run.outcomes) == 12 and run.counts["graded"] == 3
    troubles = {each.name: each.trouble for each in run.outcomes if each.trouble}
    assert troubles.keys() == set(nine)
    for name, limit in limits.items():
        assert troubles[name] == f"needs manual review: grading it takes more than {limit}"
    for name, content in before.items():
        assert run.book.locate_result(name).read_bytes() == content


def test_a_limit_that_one_reached_is_not_said_of_the_next():
    with FragilePool(Options(), 1) as pool:
        words = [str(pool.submit(Package(name, [])).exception()) for name in ("looper", "killer")]
        assert "1 s of processor" in words[0] and "twice" in words[1]
        assert pool.submit(Package("ann", [])).exception() is None
    with ImpatientPool(Options(), 1) as pool:
        future = pool.submit(Package("sleeper", []))
        assert "grading it takes more than 1 s" in str(future.exception())


def test_the_first_and_the_last_run_two_checks_at_a_time():
    with CountingPool(Options(), 2) as pool:
        futures = [pool.submit(Package(f"{number}", [])) for number in range(8)]
        counts = [int(each.result()[0]) for each in futures]
    assert counts[0] == 2 and sorted(counts[1:]) == [1, 1, 1, 1, 1, 2, 2]


def test_the_limits_are_those_of_one_check_at_a_time():
    with CountingPool(Options(), 2) as pool:
        assert pool.submit(Package("greedy", [])).result()[0] == b"1"


def list_class(classroom: Path) -> list[Work]:
    with open_class(classroom) as intake:
        return intake.found


def test_an_executor_that_is_gone_ends_the_class_and_what_is_graded_stays(classroom):
    class Leaving(Inline):
        def submit(self, package: Package) -> "Future[Answer]":
            future = super().submit(package)
            if package.name == "ben":
                future = Future()
                future.cancel()
                future.set_running_or_notify_cancel()
            return future

    with open_class(classroom) as intake, pytest.raises(Stop, match="goes on from there"):
        grade_class(start(intake, classroom), Leaving(), QUIET)
    assert grade_once(classroom).names == ["ben", "cem"]


def test_a_class_gets_the_bytes_that_each_gets_alone(tmp_path):
    for name, tree in (("anna", "solution"), ("ben", "starter")):
        (tmp_path / "class" / name).mkdir(parents=True)
        shutil.copy(KIT / tree / "integrators.py", tmp_path / "class" / name)
    run = run_class(tmp_path / "class", ClassOptions(ONLY_8A, jobs=1), QUIET)
    for name in ("anna", "ben"):
        alone = as_json(grade(tmp_path / "class" / name, ONLY_8A, shared_worker()))
        assert run.book.locate_result(name).read_bytes() == alone
    assert [each.points > 0 for each in run.outcomes] == [True, False]
    assert "anna" in (tmp_path / "class-results.class.html").read_text(encoding="utf-8")
    assert (tmp_path / "class-results" / "anna.html").is_file()


def test_a_page_of_too_many_is_left_to_its_command(classroom, monkeypatch):
    run = grade_once(classroom)
    monkeypatch.setattr(grading, "LONGEST_PAGE", 2)
    assert "more than 2, by `grader dashboard" in write_page(run)
    monkeypatch.setattr(grading, "LONGEST_PAGE", 3)
    assert write_page(run).endswith("out.class.html")


def command(classroom: Path) -> list[str]:
    grading = ["grade", "--class", str(classroom), "--todo", "8a", "--jobs", "2"]
    return [sys.executable, "-m", "grader", *grading]


def test_a_kill_in_the_middle_and_a_rerun_are_an_undisturbed_run(tmp_path, monkeypatch):
    for number in range(4):
        folder = tmp_path / "class" / f"student-{number}"
        folder.mkdir(parents=True)
        shutil.copy(KIT / "solution" / "integrators.py", folder)
        (folder / "name.py").write_text(f"# {number}\n", encoding="utf-8")
    shutil.copytree(tmp_path / "class", tmp_path / "undisturbed" / "class")

    process = subprocess.Popen(command(tmp_path / "class"), cwd=KIT, stdout=subprocess.DEVNULL)
    results = tmp_path / "class-results"
    until(lambda: len(list(results.glob("*.json"))) >= 1)
    family = psutil.Process(process.pid).children(recursive=True)
    process.kill()
    process.wait()
    stands = len(list(results.glob("*.json")))
    until(lambda: all(map(has_ended, family)))  # no process continues without its parent

    done = subprocess.run(command(tmp_path / "class"), cwd=KIT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    kept = int(done.stdout.split(" kept")[0].split()[-1])
    assert kept in (stands, stands - 1)  # one may have been written but not yet recorded
    monkeypatch.setattr(grading, "open_executor", lambda _: nullcontext(InThisProcess()))
    undisturbed = run_class(tmp_path / "undisturbed" / "class", ClassOptions(ONLY_8A), QUIET)
    assert snapshot(results) == snapshot(undisturbed.book.folder)


def has_ended(process: psutil.Process) -> bool:
    """Also if no process reads its exit status, as in a container whose first process does not."""
    try:
        return not process.is_running() or process.status() == psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return True


def snapshot(results: Path) -> dict[str, bytes]:
    table = results.with_name(f"{results.name}.class.csv")
    return {path.name: path.read_bytes() for path in (table, *results.iterdir())}


def until(true: Callable[[], bool]) -> None:
    for _ in range(6000):
        if true():
            return
        time.sleep(0.1)
    raise TimeoutError


def test_the_exit_status_says_whether_all_could_be_graded(tmp_path, monkeypatch):
    monkeypatch.setattr(grading, "open_executor", lambda _: nullcontext(InThisProcess()))
    (tmp_path / "class" / "ann").mkdir(parents=True)
    (tmp_path / "class" / "ann" / "integrators.py").write_text("x = 1\n", encoding="utf-8")
    (tmp_path / "class" / "ben.zip").write_bytes(b"")
    out = ["--out", str(tmp_path / "marks")]
    done = run_grader("grade", "--class", tmp_path / "class", "--todo", "8a", *out)
    assert done.exit_code == 2 and "the archive is broken" in done.stdout
    assert json.loads((tmp_path / "marks" / "ann.json").read_bytes())["points"] == 0
    nowhere = run_grader("grade", "--class", tmp_path / "nowhere")
    assert nowhere.exit_code == 2 and "no folder of submissions" in nowhere.stderr
