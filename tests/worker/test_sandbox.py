"""Test the files of a child: its own copy of the submission, and shared unchanged folders."""

import os
import sys
from pathlib import Path

import pytest

from grader.judge.grade import take_in, work_folder
from grader.judge.task import Options, as_in_reference, sandbox_for
from grader.judge.wall.children import start_worker
from grader.protocol import Call, Import, Items, Raised, Returned

PROGRAM = """
import os
import sys
import stable_engine

def describe_folders():
    folders = "experiments", "results", "stable_engine"
    return [stable_engine.VALUE, *(float(os.path.islink(each)) for each in folders)]

def write_into(folder):
    with open(os.path.join(folder, "log.txt"), "w") as log:
        return float(log.write("one line"))
"""


@pytest.fixture
def trees(tmp_path: Path) -> tuple[Path, Path]:
    """Make a submission and a reference; only the folder stable_engine is equal in both."""
    for tree in ("submission", "reference"):
        for name, text in (
            ("mini_engine.py", PROGRAM),
            ("stable_engine/__init__.py", "VALUE = 3.5\n"),
            ("stable_engine/deep/more.py", "MORE = 1\n"),
            ("experiments/mine.py", f"TREE = {tree!r}\n"),
            ("results/more.py", ""),
        ):
            path = tmp_path / tree / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
    (tmp_path / "submission" / "results" / "best.json").write_text("{}", encoding="utf-8")
    return tmp_path / "submission", tmp_path / "reference"


def test_an_unchanged_folder_is_recognised(trees):
    assert as_in_reference(*trees) == (["stable_engine"] if os.name == "posix" else [])
    assert as_in_reference(trees[0], None) == []
    (trees[0] / "stable_engine" / "deep" / "more.py").write_text("MORE = 2\n", encoding="utf-8")
    assert as_in_reference(*trees) == []


@pytest.mark.skipif(os.name != "posix", reason="Windows may not allow links, so all is copied")
@pytest.mark.parametrize("spawn", [False, True], ids=["fork", "spawn"])
def test_an_unchanged_folder_is_read_only_and_all_else_is_the_childs_own(trees, spawn):
    submission, reference = trees
    worker = start_worker(spawn)
    try:
        with work_folder() as work:
            taken = take_in(submission, work / "submission")
            options = Options(reference=reference, trusted=True)
            child = sandbox_for(taken, work, worker, options).open_child(5)

            def ask(target: str, *args: str) -> object:
                return child.ask(Call(f"mini_engine:{target}", list(args))).reply

            assert isinstance(child.ask(Import("mini_engine", [])).reply, Returned)
            reply = ask("describe_folders")
            assert isinstance(reply, Returned) and reply.value == Items([3.5, 0.0, 0.0, 1.0])
            assert isinstance(ask("write_into", "results"), Returned)
            assert isinstance(ask("write_into", "experiments"), Returned)
            assert isinstance(ask("write_into", "stable_engine"), Raised)
            child.end()
        assert not list(submission.rglob("log.txt"))
    finally:
        worker.close()


@pytest.mark.skipif(sys.platform != "linux", reason="the layers are Linux's")
@pytest.mark.parametrize("without", [[], ["user-namespace"]], ids=["covered", "bare"])
def test_a_scratch_folder_serves_again_only_where_no_child_can_see_it(trees, without):
    worker = start_worker(without=without)
    try:
        with work_folder() as work:
            taken = take_in(trees[0], work / "submission")
            sandbox = sandbox_for(taken, work, worker, Options(trusted=True))
            for _ in range(3):
                child = sandbox.open_child(5)
                child.ask(Import("mini_engine", []))
                written = child.ask(Call("mini_engine:write_into", [".."])).reply
                assert isinstance(written, Returned)
                child.end()
            covered = "mount-namespace" in sandbox.layers
            places = [path for path in work.iterdir() if path.name.startswith("tmp")]
            # The child that compiles has a folder of its own.
            assert len(places) == 2
            # The next child removes what an ended one wrote on the disk.
            assert len(list(work.rglob("log.txt"))) == (0 if covered else 1)
    finally:
        worker.close()
