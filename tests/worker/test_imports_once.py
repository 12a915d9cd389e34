"""Test children that begin after one import: they share nothing but the import."""

import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from grader.bank.halfway import Halfway, State
from grader.bank.members import Attack, Entry, Member
from grader.bank.verify import grade_member, shared_worker
from grader.judge.grade import grade
from grader.judge.passed import PassedPrograms
from grader.judge.submission import Submission
from grader.judge.task import Options, sandbox_for, shipped_reference
from grader.judge.wall.children import Child, ChildEnded, WarmWorker, Worker, start_worker
from grader.judge.wall.sandbox import Sandbox
from grader.protocol import Call, Import, Raised, Returned

pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="only Linux gives each child its own folder"
)

PROGRAM = """
import os, random, threading
print("imported")
calls = 0
def count():
    global calls
    calls += 1
    return calls
def forever():
    while True: pass
def fork(): return os.fork()
def write(): open("mine.txt", "w").write("x")
def names(): return ",".join(sorted(os.listdir(".")))
"""
WRONG = "return x, v"
STATE = State(code=WRONG, says=())
LEAVES = {
    "a thread": "threading.Thread(target=threading.Event().wait, daemon=True).start()",
    "a file": "write()",
    "a descriptor": "os.open('/dev/null', os.O_RDONLY)",
    "other random numbers": "random.seed(1)",
    "a folder": "os.chdir('..')",
    "a window": "import pygame\npygame.init()",
    "much work": "while sum(os.times()[:2]) < 0.4: pass",
}


@pytest.fixture(scope="module")
def worker() -> Iterator[WarmWorker]:
    started = start_worker()
    assert isinstance(started, WarmWorker)
    yield started
    started.close()


@pytest.fixture
def make_sandbox(tmp_path: Path, worker: WarmWorker) -> Callable[[str], Sandbox]:
    def make(more: str = "", **options: bool) -> Sandbox:
        tree = tmp_path / "tree"
        tree.mkdir()
        (tree / "program.py").write_text(f"{PROGRAM}\n{more}\n", encoding="utf-8")
        options = {"trusted": True, "imports_once": True, **options}
        sandbox = sandbox_for(Submission("tree", tree), tmp_path, worker, Options(**options))
        sandbox.programs = ["program"]
        return sandbox

    return make


def call(sandbox: Sandbox, name: str, module: str = "program") -> object:
    """Return what a function answers in a new child."""
    child = sandbox.open_child(1, module)
    try:
        return ask(child, name)
    finally:
        child.end()


def ask(child: Child, name: str) -> object:
    imported = child.ask(Import("program"))
    assert (imported.reply, imported.output) == (Returned(None), "imported\n")
    reply = child.ask(Call(f"program:{name}")).reply
    return reply.value if isinstance(reply, Returned) else reply


def test_each_child_begins_after_the_import(make_sandbox, worker: WarmWorker):
    sandbox = make_sandbox()
    assert [call(sandbox, "count") for _ in range(3)] == [1, 1, 1]
    assert worker.importer is not None and not sandbox.bytecode.exists()
    layers = sandbox.layers
    assert call(sandbox, "count", module="") == 1
    assert sandbox.layers == layers and worker.importer is None


def test_a_child_has_its_own_limits_and_filter(make_sandbox, worker: WarmWorker):
    sandbox = make_sandbox()
    reply = call(sandbox, "fork")
    assert isinstance(reply, Raised) and reply.error == "PermissionError"
    first = worker.importer
    with pytest.raises(ChildEnded, match="1 s of processor time"):
        call(sandbox, "forever")
    assert call(sandbox, "count") == 1 and worker.importer is first


@pytest.mark.parametrize("deed", LEAVES.values(), ids=LEAVES)
def test_an_import_that_leaves_more_than_modules_is_not_shared(make_sandbox, worker, deed: str):
    sandbox = make_sandbox(deed)
    assert [call(sandbox, "count") for _ in range(2)] == [1, 1]
    assert worker.importer is None and sandbox.bytecode.exists()


def test_a_file_of_one_check_is_not_there_in_the_next(make_sandbox, worker: WarmWorker):
    sandbox = make_sandbox()
    names = call(sandbox, "names")
    assert worker.importer is not None and call(sandbox, "write") is None
    assert call(sandbox, "names") == names and worker.importer is None


@pytest.mark.parametrize("options", [{"trusted": False}, {"imports_once": False}])
def test_the_work_of_others_is_imported_by_each_child(make_sandbox, options: dict[str, bool]):
    assert make_sandbox(**options).importing is None


@pytest.mark.parametrize(
    ("member", "fresh", "once"),
    [
        (Member("right", "solution", "package", Entry(), None), False, True),
        (Member("right", "solution", "package", Entry(), None), True, False),
        (Member("hostile", "attacks", "package", Attack(code=WRONG), None), False, False),
        (Halfway("halfway", "8a-x", "package", STATE, None), False, True),
    ],
    ids=["right", "fresh", "hostile", "half-way"],
)
def test_verify_imports_once_unless_a_member_is_hostile(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, member: Member, fresh: bool, once: bool
):
    asked: list[Options] = []

    def note(tree: Submission, work: Path, worker: Worker, options: Options) -> Sandbox:
        asked.append(options)
        return sandbox_for(tree, work, worker, options)

    monkeypatch.setattr("grader.judge.grade.sandbox_for", note)
    passed = None if fresh else PassedPrograms(tmp_path)
    grade_member(member, frozenset({"8a"}), passed)
    assert {each.imports_once for each in asked} == {once}


def test_a_grade_is_the_same_and_leaves_no_process(tmp_path: Path):
    only = frozenset({"1", "7d", "8a", "whole"})
    options = Options(shipped_reference(), only=only, trusted=True)
    worker, tree = shared_worker(), tmp_path / "tree"
    Member("wrong", "1-x", "package", Entry(code="return None"), None).build(tree)
    results = [grade(tree, replace(options, imports_once=once), worker) for once in (True, False)]
    assert results[0] == results[1] and 0 < results[0].points < results[0].max_points
    assert isinstance(worker, WarmWorker) and worker.importer is None
