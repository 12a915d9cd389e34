"""Test grading a class on a Dask cluster: two worker processes of this machine."""

import os
import shutil
import signal
import socket
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console

from grader.classroom import cluster
from grader.classroom.cluster import grade_here
from grader.classroom.executor import ExecutorFailed
from grader.classroom.fingerprint import pack_reference
from grader.classroom.grading import ClassOptions, run_class
from grader.errors import Stop
from grader.intake.found import Package
from grader.judge import fingerprint
from grader.judge.grade import grade
from grader.judge.rubric import load_rubric
from grader.judge.task import KIT, Options, shipped_reference
from grader.report.files import as_json

QUIET = Console(quiet=True)
ONLY_8A = Options(shipped_reference(), only=frozenset({"8a"}))
SIZE = 8


@pytest.fixture(scope="module", autouse=True)
def distributed() -> Any:
    """Return the library. Imported while tests are collected, it would slow down every fork."""
    return pytest.importorskip("distributed", reason="needs the extra `cluster`")


@pytest.fixture(scope="module")
def workers(distributed: Any) -> Iterator[Any]:
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as local:
        yield local


@pytest.fixture
def classroom(tmp_path: Path) -> Path:
    """Make a class of solution and starter copies in turns, each slightly different."""
    for number in range(SIZE):
        folder = tmp_path / "class" / f"student-{number}"
        folder.mkdir(parents=True)
        shutil.copy(KIT / ("solution", "starter")[number % 2] / "integrators.py", folder)
        (folder / "name.py").write_text(f"# {number}\n", encoding="utf-8")
    return tmp_path / "class"


def grade_files(classroom: Path, out: str, **how: object) -> dict[str, bytes]:
    """Return every result and the table, byte by byte."""
    wanted = ClassOptions(ONLY_8A, classroom.parent / out, **how)
    run = run_class(classroom, wanted, QUIET)
    assert not any(each.trouble for each in run.outcomes)
    files = {path.name: path.read_bytes() for path in run.book.folder.glob("*.json")}
    assert len(files) == SIZE
    return {**files, "table": run.book.table.read_bytes()}


@pytest.mark.soak
def test_a_cluster_gives_the_same_bytes_though_a_worker_is_killed(distributed, workers, classroom):
    here = grade_files(classroom, "here", jobs=1)
    with distributed.Client(workers, set_as_default=False) as client:
        victim = next(iter(client.run(os.getpid).values()))
    results = classroom.parent / "there"

    def kill_when_two_are_graded() -> None:
        while len(list(results.glob("*.json"))) < 2:
            time.sleep(0.02)
        killed.append(len(list(results.glob("*.json"))))
        os.kill(victim, signal.SIGKILL)

    killed: list[int] = []
    threading.Thread(target=kill_when_two_are_graded, daemon=True).start()
    there = grade_files(classroom, "there", cluster=workers.scheduler_address)
    assert there == here
    assert killed


def test_no_scheduler_is_a_sentence(classroom, monkeypatch):
    monkeypatch.setattr(cluster, "CONNECT_SECONDS", 1)
    with pytest.raises(Stop, match="there is no Dask scheduler"):
        grade_files(classroom, "out", cluster="tcp://127.0.0.1:9")


def test_what_never_answers_is_no_scheduler(monkeypatch):
    monkeypatch.setattr(cluster, "CONNECT_SECONDS", 1)
    with socket.create_server(("127.0.0.1", 0)) as silent:
        address = f"tcp://127.0.0.1:{silent.getsockname()[1]}"
        with pytest.raises(Stop, match="no answer in 1 s"), cluster.connect(address, Options()):
            pass


def test_workers_with_another_grader_are_refused(distributed, workers, classroom):
    with distributed.Client(workers, set_as_default=False) as client:
        client.run(setattr, fingerprint, "fingerprint", partial(str, "another"))
        try:
            with pytest.raises(Stop, match=r"another version .* on tcp://"):
                grade_files(classroom, "out", cluster=workers.scheduler_address)
        finally:
            client.restart()


def test_a_worker_with_another_grader_that_joins_later_stops_the_class():
    with pytest.raises(ExecutorFailed, match="another version"):
        grade_here(Package("ann", []), ONLY_8A, None, "made elsewhere")


def test_the_reference_that_travels_is_enough(tmp_path):
    reference = pack_reference(shipped_reference())
    assert reference is not None
    modules = {todo.module for todo in load_rubric().todos}
    assert {Path(name).parts[0].removesuffix(".py") for name, _ in reference.files} == modules
    package = Package("ann", [("integrators.py", b"")])
    content, _ = grade_here(
        package, replace(ONLY_8A, reference=None), reference, fingerprint.fingerprint()
    )
    assert content == as_json(grade(package.unpack(tmp_path), ONLY_8A))
