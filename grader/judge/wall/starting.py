"""Start Python processes of the worker.

This module loads little: the command line starts a worker before it loads anything else.
"""

import os
import socket
import subprocess
import sys
from collections.abc import Sequence
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import NamedTuple

from grader.protocol import ENVIRONMENT

BOOT = """
import runpy, sys
sys.orig_argv[:] = ["python"]
sys.path.insert(0, {root!r})
sys.argv[1:] = {args!r}
runpy.run_module({module!r}, run_name="__main__")
"""


def command(module: str, *args: str) -> list[str]:
    """Return a command for isolated Python, which reads no variable and no submission's folder."""
    return [sys.executable, "-I", "-c", program(module, *args)]


def program(module: str, *args: str) -> str:
    root = str(Path(__file__).parents[3])
    return BOOT.format(root=root, args=list(args), module=module)


def count_cores() -> int:
    """Return how many processors this process may use."""
    usable = getattr(os, "sched_getaffinity", None)  # not on Windows and macOS
    return len(usable(0)) if usable else os.cpu_count() or 1


# ---------------------------------------------------------------- processes for calls

ahead: dict[str, "subprocess.Popen[bytes]"] = {}  # processes without calls yet, by their module


def start_server(module: str) -> "subprocess.Popen[bytes]":
    """Return a process that answers calls; see `WatchedProcess`."""
    if module in ahead:
        return ahead.pop(module)
    return subprocess.Popen(command(module), stdin=subprocess.PIPE, stdout=subprocess.PIPE)


def start_server_ahead(module: str) -> None:
    """Start the process for the first calls; it ends with this one if no call comes."""
    ahead[module] = start_server(module)


# ---------------------------------------------------------------- clean processes


class Started(NamedTuple):
    """A process that is still loading, and the judge's ends of its channels."""

    process: "subprocess.Popen[bytes]"
    ends: list[socket.socket]


def start_clean(
    module: str, without: Sequence[str] = (), channels: int = 1, out: int | None = None
) -> Started:
    """Start Python with the other ends of channels, and nothing of the judge in its arguments.

    A child can read its process's arguments and variables in memory, so the program comes by
    standard input. `out`: where it prints, as in Popen.
    """
    pairs = [socket.socketpair() for _ in range(channels)]
    with ExitStack() as stack:
        theirs = [stack.enter_context(each).fileno() for _, each in pairs]
        process = subprocess.Popen(
            [sys.executable, "-I", "-"],
            pass_fds=theirs,
            stdin=subprocess.PIPE,
            stdout=out,
            stderr=out,
            start_new_session=True,
            env=clean_environment(),
        )
    assert process.stdin is not None
    with suppress(OSError), process.stdin as boot:  # if it is gone, opening a child will fail
        boot.write(program(module, ",".join(map(str, theirs)), *without).encode())
    return Started(process, [ours for ours, _ in pairs])


def clean_environment() -> dict[str, str]:
    """Return an environment without the instructor's tokens, paths and Python settings.

    Python may need the path of libraries to start; the warm process wipes it out of its memory.
    """
    needed = ("PATH", "SYSTEMROOT") if sys.platform == "win32" else ("LD_LIBRARY_PATH",)
    return {name: os.environ[name] for name in needed if name in os.environ} | ENVIRONMENT


# ---------------------------------------------------------------- the warm process

WARM = "grader.worker.warm"
waiting: dict[int, Started] = {}  # warm processes without a worker yet, by their number of servers


def start_ahead(servers: int) -> None:
    """Start the warm process of the next worker, where processes can fork."""
    if hasattr(os, "fork"):
        waiting[servers] = start_clean(WARM, channels=servers)


def start_warm(without: Sequence[str], servers: int) -> Started:
    """Return a warm process with one channel for each of its servers."""
    if not without and servers in waiting:
        return waiting.pop(servers)
    return start_clean(WARM, without, servers)
