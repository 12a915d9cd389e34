"""Test `make verify`: the records it keeps, its counts, and the traces of a grade."""

import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import msgspec
import pytest
from whole_bank import bank
from msgspec.structs import replace as replace_in
from rich.console import Console

from grader.bank import store, traces, verify
from grader.bank.halfway import list_states
from grader.bank.store import Record, Store, make_key
from grader.bank.members import BESIDES, Entry, Member
from grader.bank.verify import (
    Report,
    Verdict,
    find_complaint,
    grade_member,
    judge,
    run_in_processes,
    summarize,
)
from grader.errors import Stop
from grader.judge.task import KIT
from grader.judge.result import CheckResult, Result, TodoResult

RIGHT = Result(1, "ann", 100, 100, 16, [], [])
BANK = [Member("right", name, "package", Entry(), None) for name in ("a", "b", "c", "d")]


# ---------------------------------------------------------------- records


@pytest.fixture
def graded_names(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """List the names of graded members; all but z get the right marks."""
    names = []

    def grade_all(chosen: list[Member], jobs: int, passed: object) -> Iterator[Verdict]:
        for member in chosen:
            names.append(member.name)
            yield Verdict(member, RIGHT, 1.0, "took too long" if member.name == "z" else "")

    monkeypatch.setattr(verify, "grade_all", grade_all)
    return names


def test_a_run_that_was_stopped_goes_on_where_it_was(tmp_path: Path, graded_names: list[str]):
    stopped = judge(BANK, 1, Store(tmp_path), fresh=False)
    first = [next(stopped), next(stopped)]
    stopped.close()
    again = [*judge(BANK, 1, Store(tmp_path), fresh=False)]
    assert graded_names == ["a", "b", "c", "d"]
    assert [each.member.name for each in again if each.earlier] == ["a", "b"]
    assert [(each.result, each.seconds) for each in again] == [(RIGHT, 1.0)] * 4
    assert again[:2] == [replace(each, earlier=True) for each in first]


def test_what_changes_while_it_is_graded_is_graded_again(tmp_path: Path, graded_names, monkeypatch):
    source = tmp_path / "5-x.py"
    source.write_text("# TODO 5: damp\npass\n# END TODO 5\n", encoding="utf-8")
    member = Member("right", "5-x", "package", Entry(), source)

    def edit_source(chosen: list[Member], jobs: int, passed: object) -> Iterator[Verdict]:
        source.write_text("# TODO 5: damp\nreturn\n# END TODO 5\n", encoding="utf-8")
        yield from usual(chosen, jobs, passed)

    usual = verify.grade_all
    with monkeypatch.context() as patched:
        patched.setattr(verify, "grade_all", edit_source)
        assert len([*judge([member], 1, Store(tmp_path / "kept"), fresh=True)]) == 1
    for _ in range(2):
        assert (
            len([*judge([member], 1, Store(tmp_path / "kept"), fresh=False)]) == 1
        )
    assert graded_names == ["5-x", "5-x"]


def test_a_complaint_is_looked_into_again(tmp_path: Path, graded_names: list[str]):
    bad = [replace(BANK[0], name="z")]
    for _ in range(2):
        (verdict,) = judge(bad, 1, Store(tmp_path), fresh=False)
        assert verdict.complaint and not verdict.earlier
    assert graded_names == ["z", "z"]


def test_marks_that_are_no_longer_the_right_ones_are_not_taken_over(tmp_path: Path, graded_names):
    failed = CheckResult("falls", "It falls", "unit", "not yet", 0, 1)
    todo = TodoResult("5", "Damping", "not yet", 0, 1, None, [failed])
    Store(tmp_path).write(BANK[0], 1.0, replace_in(RIGHT, todos=[todo]))
    (verdict,) = judge(BANK[:1], 1, Store(tmp_path), fresh=False)
    assert graded_names == ["a"] and verdict.result == RIGHT
    list(judge(BANK[:1], 1, Store(tmp_path), fresh=True))
    assert graded_names == ["a", "a"]


@pytest.mark.parametrize("content", [b"", b'{"key": 3}', b"\xff\xfe", b"[]"])
def test_a_bad_file_is_as_good_as_none(tmp_path: Path, content: bytes):
    store = Store(tmp_path)
    store.write(BANK[0], 1.0, RIGHT)
    assert store.read(BANK[0]) == Record(store.key(BANK[0]), 1.0, RIGHT)
    path = store.file(BANK[0])
    assert [each for each in tmp_path.rglob("*") if each.is_file()] == [path]
    path.write_bytes(content)
    assert store.read(BANK[0]) is None


def test_each_form_of_a_member_has_a_file_of_its_own():
    files = [Store(Path()).file(member) for member in bank()]
    assert len(files) == len(set(files))


def test_all_that_decides_about_marks_is_in_the_key(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    source = tmp_path / "5-x.py"
    source.write_text("# TODO 5: damp\npass\n# END TODO 5\n", encoding="utf-8")
    member = Member("wrong", "5-x", "package", Entry(), source)
    usual = make_key(member)
    assert make_key(replace(member, form="single file")) != usual
    assert make_key(replace(member, entry=Entry(loses=("5",)))) != usual
    source.write_text("# TODO 5: damp\n\n# END TODO 5\n", encoding="utf-8")
    assert make_key(member) != usual
    rest = store.hash_surroundings.__wrapped__
    monkeypatch.setattr(store, "fingerprint", lambda: "the judge, changed")
    assert rest() != store.hash_surroundings()
    monkeypatch.undo()
    assert rest() == store.hash_surroundings()
    monkeypatch.setattr(sys, "version", "another Python")
    assert rest() != store.hash_surroundings()
    monkeypatch.undo()
    monkeypatch.setattr(store, "DECIDING", ("bank.py",))
    assert rest() != store.hash_surroundings()


def test_every_file_of_a_folder_counts_but_those_left_out(tmp_path: Path):
    tree = tmp_path / "tree"
    for name in ("a.py", "mini/b.py", ".cache/c", "mini/__pycache__/b.pyc"):
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        (tree / name).write_text(name, encoding="utf-8")
    rows = store.hash_contents(tree, *BESIDES)
    assert [row.partition(" ")[0] for row in rows] == ["tree/a.py", "tree/mini/b.py"]
    (tree / "mini" / "b.py").write_text("other", encoding="utf-8")
    assert store.hash_contents(tree, *BESIDES) != rows


def test_verify_grades_once_and_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    some = [each for each in bank() if each.todos == {"8a"}]
    monkeypatch.setattr(verify, "RESULTS", tmp_path)
    monkeypatch.setattr(verify, "list_members", lambda *_: some)
    monkeypatch.setattr(verify, "check_kit", lambda: [])  # test_bank.py asks it
    told = []
    for _ in range(2):
        console = Console(file=io.StringIO(), width=120)
        assert verify.verify(1, "8a-position-first", console).sound
        told.append(console.file.getvalue())  # type: ignore[attr-defined]
    assert "1 member: 1 graded now, 0 taken from an earlier run" in told[0]
    assert "1 member: 0 graded now, 1 taken from an earlier run" in told[1]
    table = re.compile("│ wrong.*")
    assert table.findall(told[0]) == table.findall(told[1]) != []


def test_members_are_written_as_submissions_to_grade_by_hand(tmp_path: Path):
    paths = verify.write_members("wrong/5-spin-is-not-damped", tmp_path)
    names = ["5-spin-is-not-damped", "5-spin-is-not-damped-single"]
    assert [path.name for path in paths] == names == sorted(p.name for p in tmp_path.iterdir())
    with pytest.raises(Stop, match="nothing in the bank has 'no-such-member'"):
        verify.write_members("no-such-member", tmp_path)


def test_what_a_half_way_state_must_say_is_in_the_key():
    state = next(list_states("5"))
    other = replace(state, entry=replace_in(state.entry, says=("another",)))
    assert make_key(state) != make_key(other)


@pytest.mark.parametrize(("jobs", "processes"), [(0, 2), (1, 1)])
def test_members_that_sleep_get_one_more_process(jobs: int, processes: int, monkeypatch):
    monkeypatch.setattr(verify, "count_cores", lambda: 1)
    names = ["echo $PPID", "echo $PPID  # sleeps"] * 2
    ran = run_in_processes(subprocess.getoutput, names, jobs, lambda name: "sleeps" in name)
    assert len(set(ran)) == processes


def test_members_with_numpy_come_last(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(verify, "run_in_processes", lambda run, chosen, jobs, sleeps: chosen)
    ordered = ["numpy" in member.name for member in verify.grade_all(bank(), 1)]
    assert sum(ordered[-15:]) == sum(ordered) > 2


# ---------------------------------------------------------------- counts


def test_every_kind_is_counted_by_itself():
    wrong = Member("wrong", "5-x", "package", Entry(), None)
    hostile = Member("hostile", "x", "package", Entry(), None)
    right = [Verdict(member, RIGHT, 1.0, "") for member in BANK]
    lines = [*summarize(Report([*right, Verdict(wrong, RIGHT, 1.0, "loses nothing")]))]
    assert lines[:2] == [
        "right: 4, of which 0 with a complaint",
        "wrong: 1, of which 1 with a complaint",
    ]
    fell_over = Verdict(hostile, None, 1.0, "the judge fell over")
    assert next(summarize(Report([fell_over]))) == "hostile: 1, of which 1 with a complaint"


def test_an_edit_that_no_longer_fits_the_solution_is_a_complaint():
    path = KIT / "tests" / "bank" / "wrong" / "5.toml"
    member = Member("wrong", "5-gone", "package", Entry(change=[("no such line", "")]), path)
    table = io.StringIO()
    verdicts = [*judge([member], 1, Store(path.parent / "none"), fresh=False)]
    verify.show(Report(verdicts), Console(file=table, width=200))
    assert "cannot be built: 'no such line' stands there 0 times, not once" in table.getvalue()


def test_a_wrong_name_for_a_mistake_is_a_complaint():
    member = next(each for each in bank() if each.name == "5-spin-is-not-damped")
    lost = [TodoResult("5", "Damping", "not yet", 0, 8, "spin-is-not-damped", [])]
    result = replace_in(RIGHT, todos=lost)
    assert find_complaint(member, result, 1.0) == ""
    other = replace(member, name="5-rates-are-swapped")
    assert find_complaint(other, result, 1.0) == "its mistake is named spin-is-not-damped"


def judge_rung(sheet: Path, name: str, points: int) -> Verdict:
    member = Member("ladder", f"5-{name}", "package", Entry(code="pass"), sheet)
    todo = TodoResult("5", "Damping", "not yet", points, 8, None, [])
    return Verdict(member, replace_in(RIGHT, points=points, todos=[todo]), 1.0, "")


@pytest.mark.parametrize(
    ("points", "complaint"),
    [
        ((0, 0, 5, 8), ""),
        ((0, 5, 4, 8), "2-c earns less than 1-b"),
        ((1, 2, 3, 8), "0-a earns 1 points for nothing"),
        ((0, 2, 3, 7), "3-d earns 7 of 8 points"),
    ],
)
def test_a_ladder_must_rise_from_nothing_to_all(tmp_path: Path, points, complaint: str):
    names, sheet = ("0-a", "1-b", "2-c", "3-d"), tmp_path / "5.toml"
    sheet.write_text("".join(f'[{each}]\ncode = "pass"\n' for each in names), encoding="utf-8")
    rungs = zip(names, points, strict=True)
    report = Report([judge_rung(sheet, *each) for each in rungs])
    (ladder,) = report.ladders
    assert ladder.complaint == complaint
    assert report.sound == (not complaint)
    assert (
        next(summarize(report)) == f"ladder: 1, of which {int(not report.sound)} with a complaint"
    )
    assert not Report(report.verdicts[1:2]).ladders[0].complaint  # as `--only` may have it


# ---------------------------------------------------------------- traces


@pytest.fixture
def shared_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Replace the folders where every account may write by a new one."""
    folder = tmp_path / "shared"
    folder.mkdir()
    monkeypatch.setattr(traces, "OPEN_TO_ALL", (str(folder),))
    return folder


def left_by(tmp_path: Path, leak, name: str = "") -> str:
    with traces.watch_traces(tmp_path / "own", name) as seen:
        leak()
    return seen.complaint


def test_files_left_in_the_temporary_or_home_folder_are_seen(tmp_path: Path, shared_folder: Path):
    for leak in (lambda: tempfile.mkstemp(), lambda: (Path.home() / "left").touch()):
        assert left_by(tmp_path, leak).startswith("left behind: the file ")
        shutil.rmtree(tmp_path / "own")


def test_what_is_taken_away_again_is_no_trace(tmp_path: Path, shared_folder: Path):
    def tidy() -> None:
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "x").touch()
        (shared_folder / "x").touch()
        (shared_folder / "x").unlink()

    (shared_folder / "was-there").touch()
    assert left_by(tmp_path, tidy) == ""
    assert Path.home() != tmp_path / "own" and tempfile.gettempdir() != str(tmp_path / "own")


def test_a_file_named_after_the_submission_is_its_own(tmp_path: Path, shared_folder: Path):
    """Written by another process, as a submission is one."""

    def leak() -> None:
        for name in ("marks-from-outlives-the-grade.json", "of-another-program"):
            code = f"open({str(shared_folder / name)!r}, 'w')"
            subprocess.run([sys.executable, "-c", code], check=True)

    complaint = left_by(tmp_path, leak, "outlives-the-grade")
    assert "marks-from-outlives-the-grade.json" in complaint and "program" not in complaint
    (shared_folder / "marks-from-outlives-the-grade.json").rename(shared_folder / "outlives-the-grade.1")
    os.rmdir(tmp_path / "own")
    assert left_by(tmp_path, lambda: None, "outlives-the-grade") == ""


def test_processes_and_descriptors_left_open_are_seen(tmp_path: Path):
    kept_open = []
    complaint = left_by(tmp_path, lambda: kept_open.append(open(os.devnull)))  # noqa: SIM115
    assert complaint == "left behind: 1 open files or sockets"
    kept_open.pop().close()
    os.rmdir(tmp_path / "own")
    code = "input()"
    started = []

    def start() -> None:
        started.append(subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE))

    assert "left behind: the process " in left_by(tmp_path, start)
    started[0].communicate()


def test_members_that_leave_files_name_them_after_themselves():
    """Otherwise the watch could not separate them from files of other programs."""
    open_to_all = re.compile(
        "|".join(map(re.escape, (*traces.OPEN_TO_ALL, "expanduser", "home()")))
    )
    for member in bank():
        texts = [msgspec.json.encode(member.entry).decode()]
        if member.source is not None and member.source.suffix != ".toml":
            files = [member.source] if member.source.is_file() else member.source.rglob("*.py")
            texts += [path.read_text(encoding="utf-8", errors="replace") for path in files]
        for text in texts:
            assert not open_to_all.search(text) or member.name in text, member.name
