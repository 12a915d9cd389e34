"""Grading a class on a Dask cluster, where one machine is not enough.

A submission travels to a worker with all that grading it needs, so the machines share no disk; they
need this grader, the same on all. A worker that is lost takes nothing with it: Dask gives what it
had under way to another one.
"""

import atexit
import logging
import shutil
import socket
import tempfile
import threading
from collections.abc import Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from grader.classroom.executor import AHEAD, LOST, ExecutorFailed, Graded, grade_package
from grader.classroom.fingerprint import packed_reference
from grader.intake.found import Package
from grader.judge.fingerprint import fingerprint
from grader.judge.grade import Options
from grader.judge.submission import CannotGrade

CONNECT_SECONDS = 20
ONE_AT_A_TIME = threading.Lock()  # pytest runs once in a process, however many threads that has


# ---------------------------------------------------------------- on a worker


def grade_here(package: Package, options: Options, reference: Package | None, made: str) -> Graded:
    """Grade one submission with a grader that must be the one whose fingerprint is `made`."""
    if fingerprint() != made:
        raise ExecutorFailed(other_version([socket.gethostname()]))
    if reference is not None:
        options = replace(options, reference=unpacked(reference.digest, reference))
    with ONE_AT_A_TIME:
        return grade_package(package, options)


UNPACKED: dict[str, Path] = {}


def unpacked(digest: str, reference: Package) -> Path:
    """The reference in a folder that stays for as long as this process does."""
    with ONE_AT_A_TIME:
        if digest not in UNPACKED:
            folder = Path(tempfile.mkdtemp(prefix="reference-"))
            atexit.register(shutil.rmtree, folder, ignore_errors=True)
            UNPACKED[digest] = reference.unpack(folder)
        return UNPACKED[digest]


def other_version(places: list[str]) -> str:
    where = ", ".join(places[:5])
    return f"another version of the grader or its libraries is on {where}: install the same on all"


# ---------------------------------------------------------------- on the instructor's machine


class Cluster:
    """The workers of a Dask scheduler."""

    def __init__(self, client: Any, options: Options) -> None:
        self.client = client
        self.dask = client.get_executor(pure=False)
        self.reference = packed_reference(options.reference)
        self.options = replace(options, reference=None)

    def capacity(self) -> int:
        try:
            return max(1, len(self.client.nthreads())) * (1 + AHEAD)
        except OSError as error:
            raise CannotGrade(LOST) from error

    def submit(self, package: Package) -> "Future[Graded]":
        future: Future[Graded] = self.dask.submit(
            grade_here, package, self.options, self.reference, fingerprint()
        )
        return future

    def restart(self) -> None:
        pass

    def run_alone(self, package: Package) -> Graded:
        return self.submit(package).result()


@contextmanager
def connected(address: str, options: Options) -> Iterator[Cluster]:
    """The cluster at `address`, its workers looked at; raises CannotGrade where that fails."""
    try:
        from distributed import Client
    except ImportError as error:
        raise CannotGrade("--cluster needs Dask: python -m pip install dask distributed") from error
    try:
        client: Any = Client(  # type: ignore[no-untyped-call]
            address, timeout=CONNECT_SECONDS, set_as_default=False
        )
    except (OSError, ValueError) as error:
        raise CannotGrade(f"there is no Dask scheduler at {address} ({error})") from error
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)  # we say it in a sentence
    with client:
        check_workers(client, address)
        yield Cluster(client, options)


def check_workers(client: Any, address: str) -> None:
    """All that are there must have this very grader."""
    if not client.nthreads():
        raise CannotGrade(f"the scheduler at {address} has no workers yet: start some")
    found = client.run(fingerprint, on_error="return")
    lacking = [place for place, made in found.items() if isinstance(made, ImportError)]
    if lacking:
        raise CannotGrade(f"the grader is not installed on {', '.join(lacking[:5])}")
    other = [place for place, made in found.items() if made != fingerprint()]
    if other:
        raise CannotGrade(other_version(other))
