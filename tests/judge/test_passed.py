"""Test that the memory of passed programs changes no result."""

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from grader.bank.members import Attack, Entry, Member, list_members
from grader.bank.verify import grade_member, shared_worker
from grader.judge.grade import grade
from grader.judge.jobs import Job
from grader.judge.passed import PassedBefore, PassedPrograms, program_key, without_bodies
from grader.judge.reference import Reference
from grader.judge.rubric import load_rubric
from grader.judge.running import Outcome, Runner
from grader.judge.submission import take_in
from grader.judge.task import KIT, Options, shipped_reference
from grader.source.definitions import Function
from grader.source.regions import replace_regions

SOAK = pytest.mark.soak
DAMPING = "mini_engine/world.py"
TODOS = frozenset({"8a", "8b"})


def change(tree: Path, file: str, text: str) -> Path:
    """Return a copy of the solution with another text in one file."""
    shutil.copytree(KIT / "solution", tree)
    (tree / file).write_text(text, encoding="utf-8")
    return tree


def key_for(tree: Path, copy: Path) -> str:
    """Return the key of the program that the checks of TODO 2 run."""
    rubric = load_rubric()
    (todo,) = [each for each in rubric.todos if each.id == "2"]
    submission = take_in(tree, copy)
    reference = Reference(shipped_reference(), rubric)
    right = reference.for_the_others(todo, todo.module, rubric, submission, differing=False)
    return program_key(todo, todo.module, submission, right, None)


def test_a_wrong_todo_leaves_the_others_the_program_that_they_were(tmp_path: Path):
    text = (KIT / "solution" / "integrators.py").read_text("utf-8")
    wrong = replace_regions(text, {"8b": ("    x = x + v * dt",)})
    tree = change(tmp_path / "tree", "integrators.py", wrong)
    passed = PassedPrograms(tmp_path / "passed")
    options = Options(shipped_reference(), only=TODOS, trusted=True)
    full = grade(KIT / "solution", replace(options, passed=passed), shared_worker())
    assert full.has_full_marks
    known = set(passed.folder.iterdir())
    result = grade(tree, replace(options, passed=passed), shared_worker())
    assert [todo.state for todo in result.todos] == ["passed", "not yet"]
    assert set(passed.folder.iterdir()) == known and len(known) == len(TODOS)
    assert grade(tree, options, shared_worker()) == result


def test_nothing_is_remembered_of_the_work_of_others(tmp_path: Path):
    passed = PassedPrograms(tmp_path / "passed")
    options = Options(shipped_reference(), only=frozenset({"8a"}), passed=passed)
    assert grade(KIT / "solution", options, shared_worker()).has_full_marks
    assert not passed.folder.exists()


@pytest.mark.parametrize(
    ("file", "old", "new", "same"),
    [
        (DAMPING, "math.exp", "math.sin", True),
        pytest.param("pymunk_scene.py", "0.95", "0.94", True, marks=SOAK),
        pytest.param(
            DAMPING, "def apply_damping(self,", "def apply_damping(self, to,", False, marks=SOAK
        ),
        ("mini_engine/constants.py", "ITERATIONS = 8", "ITERATIONS = 9", False),
        ("mini_engine/solver.py", "# TODO 2", "# as in the lesson\n    # TODO 2", False),
    ],
)
def test_all_but_replaced_code_belongs_to_a_program(
    tmp_path: Path, file: str, old: str, new: str, same: bool
):
    text = (KIT / "solution" / file).read_text("utf-8")
    assert old in text
    tree = change(tmp_path / "tree", file, text.replace(old, new))
    usual = key_for(KIT / "solution", tmp_path / "usual")
    assert (key_for(tree, tmp_path / "copy") == usual) is same


def test_other_bytes_are_another_program_even_with_the_same_text(tmp_path: Path):
    usual = (KIT / "solution" / DAMPING).read_bytes()
    keys = set()
    for number, data in enumerate((usual, usual.replace(b"\n", b"\r\n"), b"\xef\xbb\xbf" + usual)):
        tree = change(tmp_path / f"tree {number}", DAMPING, "")
        (tree / DAMPING).write_bytes(data)
        keys.add(key_for(tree, tmp_path / f"copy {number}"))
    assert len(keys) == 3


def test_a_body_of_any_length_leaves_the_lines_of_the_next():
    text = "def f(x):\n    x += 1\n    return x\n\ndef g(x):\n    return 2\n\nend = 3"
    functions = (Function("f", 1, 3, ("x",)), Function("g", 5, 6, ("x",)))
    left = without_bodies(text, functions)
    assert left == "def f(x):\n<the reference's>\n\ndef g(x):\n<the reference's>\n\nend = 3"
    assert without_bodies(text, functions[::-1]) == left


def test_programs_are_known_up_to_the_first_that_is_new(tmp_path: Path):
    passed = PassedPrograms(tmp_path)
    for key in "ac":
        passed.add(key)
    before = PassedBefore(passed)
    assert [before.holds(key) for key in "aba"] == [True, False, False]
    before.add("b")
    assert not passed.holds("b") and passed.holds("c")


@pytest.mark.parametrize(
    ("attack", "after"),
    [
        (Attack(tries="import os\n\nraise OSError(os.name)"), []),
        (Attack(tries="import os\n\nraise OSError(os.name)", lasts=True), ["8b"]),
        (Attack(tries="import os\n\nos.getpid()"), ["8b"]),
        (Attack(code="raise OSError"), ["8b"]),
    ],
    ids=["refused", "lasts", "not refused", "raises"],
)
def test_later_checks_run_unless_an_attack_was_refused(
    attack: Attack, after: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    passed = PassedPrograms(tmp_path / "passed")
    right = Member("right", "solution", "package", Entry(), None)
    assert grade_member(right, TODOS, passed).complaint == ""
    ran, run = [], Runner.run

    def note(self: Runner, job: Job) -> Outcome:
        ran.append(job.todo.id)
        return run(self, job)

    monkeypatch.setattr(Runner, "run", note)
    member = Member("hostile", "attacks", "package", attack, None)
    with_memory = grade_member(member, TODOS, passed)
    assert sorted({*ran} - {"8a"}) == after
    assert with_memory.result == grade_member(member, TODOS, None).result


def test_only_hostile_code_in_regions_begins_with_their_checks():
    hostile = {each.name: each for each in list_members() if each.kind == "hostile"}
    assert hostile["recurses-forever"].is_patch  # in TODO 8b
    for name in (
        "changes-its-answers",
        "loops-in-every-todo",
        "not-utf-8",
        "blows-up-when-compiled",
    ):
        assert not hostile[name].is_patch


@pytest.mark.soak
def test_the_bank_gets_the_same_results_without_a_memory(tmp_path: Path):
    """Grade every member, without a time limit."""
    passed = PassedPrograms(tmp_path / "passed")
    differ = []
    for member in list_members():
        with_memory, without = (grade_member(member, passed=each) for each in (passed, None))
        if with_memory.result != without.result:
            differ.append(f"{member.kind}/{member.name} as {member.form}")
    assert differ == []
