"""Grade a class on a Dask cluster, if one machine is not enough.

A submission is sent to a worker with everything needed to grade it, so no disk is shared. All
machines need the same version of the grader. If a worker is lost, Dask gives its work to another
one.
"""

import asyncio
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

from grader.classroom.executor import AHEAD, LOST, Answer, ExecutorFailed, grade_package
from grader.classroom.fingerprint import pack_reference
from grader.errors import Stop
from grader.intake.found import Package
from grader.judge.fingerprint import fingerprint
from grader.judge.task import Options

CONNECT_SECONDS = 20
ONE_AT_A_TIME = threading.Lock()  # a process has one worker for all its threads


# ---------------------------------------------------------------- on a worker


def grade_here(package: Package, options: Options, reference: Package | None, made: str) -> Answer:
    """Grade one submission; refuse if our fingerprint is not `made`."""
    if fingerprint() != made:
        raise ExecutorFailed(describe_versions([socket.gethostname()]))
    if reference is not None:
        options = replace(options, reference=unpack_reference(reference))
    with ONE_AT_A_TIME:
        return grade_package(package, options)


UNPACKED: dict[str, Path] = {}


def unpack_reference(reference: Package) -> Path:
    """Unpack the reference into a folder that lasts as long as this process."""
    digest = reference.digest
    with ONE_AT_A_TIME:
        if digest not in UNPACKED:
            folder = Path(tempfile.mkdtemp(prefix="reference-"))
            atexit.register(shutil.rmtree, folder, ignore_errors=True)
            UNPACKED[digest] = reference.unpack(folder)
        return UNPACKED[digest]


def describe_versions(places: list[str]) -> str:
    where = ", ".join(places[:5])
    return f"another version of the grader or its libraries is on {where}: install the same on all"


# ---------------------------------------------------------------- on the instructor's machine


class Cluster:
    def __init__(self, client: Any, options: Options) -> None:
        self.client = client
        self.dask = client.get_executor(pure=False)
        self.reference = pack_reference(options.reference)
        self.options = replace(options, reference=None)

    def capacity(self) -> int:
        try:
            return max(1, len(self.client.nthreads())) * (1 + AHEAD)
        except OSError as error:
            raise Stop(LOST) from error

    def submit(self, package: Package) -> "Future[Answer]":
        future: Future[Answer] = self.dask.submit(
            grade_here, package, self.options, self.reference, fingerprint()
        )
        return future


@contextmanager
def connect(address: str, options: Options) -> Iterator[Cluster]:
    """Connect to the cluster at `address`, and check its workers."""
    try:
        from distributed import Client
    except ImportError as error:
        raise Stop("--cluster needs Dask: python -m pip install dask distributed") from error
    find_scheduler(address)
    try:
        client: Any = Client(  # type: ignore[no-untyped-call]
            address, timeout=CONNECT_SECONDS, set_as_default=False
        )
    except (OSError, ValueError) as error:
        raise Stop(describe_silence(address, error)) from error
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)  # Stop says it in a sentence
    with client:
        check_workers(client, address)
        yield Cluster(client, options)


def find_scheduler(address: str) -> None:
    """Raise Stop if no scheduler answers; Dask's client would wait for minutes."""
    from distributed import Security, rpc

    async def ask() -> None:
        how = Security().get_connection_args("client")  # type: ignore[no-untyped-call]
        async with rpc(address, connection_args=how) as scheduler:  # type: ignore[no-untyped-call]
            await scheduler.identity()

    try:
        asyncio.run(asyncio.wait_for(ask(), CONNECT_SECONDS))
    except Exception as error:  # any other server may answer there
        raise Stop(describe_silence(address, error)) from error


def describe_silence(address: str, error: Exception) -> str:
    why = " ".join(str(error).split())[:200] or f"no answer in {CONNECT_SECONDS} s"
    check = "check the address that it printed, and that this machine may reach it"
    return f"there is no Dask scheduler at {address} ({why}): {check}"


def check_workers(client: Any, address: str) -> None:
    """Raise Stop unless all workers have this grader version."""
    if not client.nthreads():
        raise Stop(f"the scheduler at {address} has no workers yet: start some")
    found = client.run(fingerprint, on_error="return")
    lacking = [place for place, made in found.items() if isinstance(made, ImportError)]
    if lacking:
        raise Stop(f"the grader is not installed on {', '.join(lacking[:5])}")
    other = [place for place, made in found.items() if made != fingerprint()]
    if other:
        raise Stop(describe_versions(other))
