"""Hold a submission, and the judge that reads it, within one outer limit.

A child has limits from its start. The judge's own work on a submission runs in a process too, and
another process measures it from outside, with all that it started: processor time, memory and the
time on the clock. A submission that reaches a limit needs manual review; the rest of its class goes
on.
"""

import os
import pickle
import queue
import re
import select
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import IO, Any, NoReturn, TypeVar

import msgspec
import psutil
from msgspec import Struct

from grader.errors import Stop, say_error
from grader.judge.wall.processes import end_family
from grader.judge.wall.starting import start_server
from grader.judge.wall.workplace import work_folder

try:
    import resource
except ImportError:  # Windows
    resource = None  # type: ignore[assignment]

MEGABYTE = 1024 * 1024
READING_CPU, GRADING_CPU = 15.0, 105.0  # s of processor time; both together make two minutes
MOST_MEMORY = 1024  # MB, of all processes of a submission; twice as much of addresses
MOST_SECONDS = 1800.0  # s on the clock: the last resort
LOOK_SECONDS = 0.5
TOGETHER = 50  # pieces of work in one process, unless one fails
SECONDS_TO_END = 5.0  # s that a process has to clean up
WATCHES_FORKS = sys.platform.startswith("linux")  # elsewhere files are read without limits
TICKS = os.sysconf("SC_CLK_TCK") if hasattr(os, "sysconf") else 100
PAGE = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 4096
LISTS_CHILDREN = Path(f"/proc/self/task/{os.getpid()}/children").exists()
LENGTH = struct.Struct(">Q")

Reply = TypeVar("Reply")
Family = dict[int, tuple[float, int]]  # seconds and bytes, by number of process


@dataclass(frozen=True)
class Allowance:
    """Limits for one call: processor seconds, MB of memory, seconds on the clock."""

    what: str  # such as "grading it"
    cpu: float
    memory: int = MOST_MEMORY
    seconds: float = MOST_SECONDS


READING = Allowance("reading it", READING_CPU)
WHOLE = Allowance("grading it", READING_CPU + GRADING_CPU)
GRADING = Allowance("grading it", GRADING_CPU)
HELD: list[Allowance] = []  # the limits around this process


class Exceeded(Stop):
    """A submission reached an outer limit; the message says which."""

    cannot = "grade"


class Lost(Exception):
    """The process ended by itself without an answer."""


class Failed(Exception):
    """The function raised an exception; the message has its type and its words."""


class Answer(Struct, tag=True):
    """The value that a call returned, as MessagePack."""

    value: bytes


class Refusal(Struct, tag=True):
    """The exception that a call raised: the name of its class, and its words."""

    error: str
    words: str


reply_decoder = msgspec.msgpack.Decoder(Answer | Refusal)


# ---------------------------------------------------------------- measuring


class Watch:
    """Measures a process with all that it started, and compares it with an allowance."""

    def __init__(self, pid: int, allowance: Allowance) -> None:
        self.pid, self.allowance = pid, allowance
        self.began = time.monotonic()
        self.before = sum(cpu for cpu, _ in measure_family(pid).values())

    def look(self) -> str:
        """Return the limit that the process has reached, in words; empty while there is none."""
        allowance, family = self.allowance, measure_family(self.pid)
        if sum(cpu for cpu, _ in family.values()) - self.before > allowance.cpu:
            return say_limit(allowance, f"{allowance.cpu:g} s of processor time")
        most = allowance.memory * MEGABYTE
        if sum(memory for _, memory in family.values()) > most and add_shares(family) > most:
            return say_limit(allowance, f"{allowance.memory} MB of memory")
        if time.monotonic() - self.began > allowance.seconds:
            return say_limit(allowance, f"{allowance.seconds:g} s")
        return ""


def say_limit(allowance: Allowance, limit: str) -> str:
    return f"needs manual review: {allowance.what} takes more than {limit}"


def measure_family(pid: int) -> Family:
    """Return the processor seconds and the bytes of a process and of all that it started.

    Ended processes count with the one that waited for them. Pages of files do not count.
    """
    if LISTS_CHILDREN:
        return dict(read_family(pid))
    found: Family = {}
    with suppress(psutil.Error):
        top = psutil.Process(pid)
        for each in [top, *top.children(recursive=True)]:
            with suppress(psutil.Error):
                found[each.pid] = sum(each.cpu_times()[:4]), each.memory_info().rss
    return found


def read_family(pid: int) -> Iterator[tuple[int, tuple[float, int]]]:
    """Yield the seconds and the bytes of each process on Linux; see proc(5)."""
    waiting = [pid]
    while waiting:
        process = Path(f"/proc/{waiting.pop()}")
        with suppress(OSError):
            about = (process / "stat").read_bytes().rpartition(b")")[2].split()
            pages = (process / "statm").read_bytes().split()
            memory = (int(pages[1]) - int(pages[2])) * PAGE
            yield int(process.name), (sum(map(int, about[11:15])) / TICKS, memory)
            for task in os.listdir(process / "task"):
                children = (process / "task" / task / "children").read_bytes()
                waiting += map(int, children.split())


def add_shares(family: Family) -> int:
    """Return the bytes of these processes; a shared page counts once.

    This takes the kernel longer. If it is impossible, each page counts as often as it is used.
    """
    total = 0
    for pid, (_, memory) in family.items():
        with suppress(OSError):
            about = Path(f"/proc/{pid}/smaps_rollup").read_text("ascii")
            if found := re.search(r"^Pss:\s+(\d+) kB$", about, re.MULTILINE):
                memory = min(memory, int(found[1]) * 1024)
        total += memory
    return total


def limit_addresses(allowance: Allowance) -> None:
    """Let the kernel refuse allocations far above the limit, between two looks."""
    if resource is not None and sys.platform.startswith("linux"):
        most = 2 * allowance.memory * MEGABYTE
        with suppress(ValueError, OSError):
            resource.setrlimit(resource.RLIMIT_AS, (most, most))


# ---------------------------------------------------------------- one call, in a fork


def call_within(
    allowance: Allowance,
    kind: Any,
    work: Callable[[], Reply],
    errors: tuple[type[Exception], ...] = (),
) -> Reply:
    """Run `work` in a fork; return its value, of type `kind`.

    Raises Exceeded at a limit, one of `errors` if `work` does, and Failed for any other exception.
    If forks cannot be watched, or this process is watched already, `work` runs here.
    """
    if not WATCHES_FORKS or HELD:
        return work()
    with work_folder() as place:
        let_children_enter(place)
        ours, theirs = os.pipe()
        flush()
        pid = os.fork()
        if not pid:
            try:
                tempfile.tempdir = str(place)
                limit_addresses(allowance)
                with open(theirs, "wb") as out:
                    out.write(answer(work))
                flush()
            finally:
                os._exit(0)
        os.close(theirs)
        try:
            reply = hear(ours, Watch(pid, allowance))
        finally:
            os.close(ours)
            end_family(pid)
            os.waitpid(pid, 0)
    returned: Reply = read_reply(reply, allowance, kind, errors)
    return returned


def call_each_within(
    allowance: Allowance, kind: Any, works: Sequence[Callable[[], Reply]]
) -> "Iterator[Reply | Exceeded | Failed]":
    """Run each of `works`, maybe twice; yield its value or the reason why there is none.

    Several run in one process. If that fails, each gets a process of its own.
    """
    for first in range(0, len(works), TOGETHER):
        some = works[first : first + TOGETHER]
        try:
            yield from call_within(allowance, list[kind], partial(do_all, some))
        except (Exceeded, Failed, Lost):
            yield from (call_alone(allowance, kind, each) for each in some)


def do_all(works: Sequence[Callable[[], Reply]]) -> list[Reply]:
    return [each() for each in works]


def call_alone(
    allowance: Allowance, kind: Any, work: Callable[[], Reply]
) -> "Reply | Exceeded | Failed":
    """Run one piece of work; return its value or the reason why there is none."""
    try:
        return call_within(allowance, kind, work)
    except (Exceeded, Failed) as error:
        return error
    except Lost:
        return Failed(f"needs manual review: {allowance.what} ended the grader's own process")


def let_children_enter(place: Path) -> None:
    """Let children with users of their own enter a folder, but not list it."""
    place.chmod(0o711)


def hear(descriptor: int, watch: Watch) -> bytes:
    """Read all that a process writes until it ends; raises Exceeded at a limit."""
    heard = bytearray()
    while True:
        if not select.select([descriptor], [], [], LOOK_SECONDS)[0]:
            if why := watch.look():
                raise Exceeded(why)
        elif part := os.read(descriptor, MEGABYTE):
            heard += part
        else:
            return bytes(heard)


def flush() -> None:
    """Write printed text before a fork, or it would be written twice."""
    for stream in (sys.stdout, sys.stderr):
        stream.flush()


def answer(work: Callable[[], object]) -> bytes:
    """Return the message with the value of `work`, or with its exception."""
    reply: Answer | Refusal
    try:
        reply = Answer(msgspec.msgpack.encode(work()))
    except (KeyboardInterrupt, SystemExit):
        raise
    except BaseException as error:
        reply = Refusal(type(error).__name__, say_error(error))
    return msgspec.msgpack.encode(reply)


def read_reply(
    message: bytes, allowance: Allowance, kind: Any, errors: tuple[type[Exception], ...] = ()
) -> Any:
    """Return the value in a message, or raise its exception."""
    if not message:
        raise Lost
    reply = reply_decoder.decode(message)
    if isinstance(reply, Answer):
        return msgspec.msgpack.decode(reply.value, type=kind)
    if reply.error == "MemoryError":
        raise Exceeded(say_limit(allowance, f"{allowance.memory} MB of memory"))
    error = next((each for each in errors if each.__name__ == reply.error), None)
    raise error(reply.words) if error else Failed(f"{reply.error}: {reply.words}")


# ---------------------------------------------------------------- many calls, one after another


class WatchedProcess:
    """A process for many calls, which keeps results such as a warm process.

    It restarts after a call that reached a limit. Its temporary files are removed with it.
    `module`: its program, which calls `serve`.
    """

    def __init__(self, module: str = "grader.judge.wall.outer") -> None:
        self.module = module
        self.process: subprocess.Popen[bytes] | None = None
        self.stack = ExitStack()
        self.closed = False

    def begin(self) -> "subprocess.Popen[bytes]":
        """Return the process, started if need be; it loads until the first call."""
        if self.closed:
            raise Failed("stopped before the end")
        self.process = self.process or self.start()
        return self.process

    def start(self) -> "subprocess.Popen[bytes]":
        place = self.stack.enter_context(work_folder())
        let_children_enter(place)
        process = start_server(self.module)
        self.send(process, (sys.path, str(place)))
        return process

    def send(self, process: "subprocess.Popen[bytes]", what: object) -> None:
        assert process.stdin is not None
        with suppress(OSError):  # it is gone, and will not reply
            write_message(process.stdin, pickle.dumps(what))

    def call(
        self, allowance: Allowance, kind: Any, function: Callable[..., Reply], *args: object
    ) -> Reply:
        """Call an importable function in the process; raises as `call_within`, and Lost."""
        process, done, reasons = self.begin(), threading.Event(), list[str]()
        watch = Watch(process.pid, allowance)
        threading.Thread(target=end_at_limit, args=(watch, done, reasons), daemon=True).start()
        try:
            self.send(process, (allowance, function, args))
            assert process.stdout is not None
            reply = read_message(process.stdout)
        finally:
            done.set()
        if not reply:
            self.end()
            raise Exceeded(reasons[0]) if reasons else Lost
        returned: Reply = read_reply(reply, allowance, kind)
        return returned

    def close(self) -> None:
        """End the process for good, and a call that is running."""
        self.closed = True
        self.end()

    def end(self) -> None:
        """End the process with all that it started, and remove its files."""
        process, self.process = self.process, None
        if process is not None:
            end_family(process.pid)
            process.wait()
            for pipe in (process.stdin, process.stdout):
                with suppress(OSError):
                    pipe.close() if pipe else None
        self.stack.close()


def end_at_limit(watch: Watch, done: threading.Event, reasons: list[str]) -> None:
    """Watch a process until a call is done; at a limit, note the reason and end it."""
    while not done.wait(LOOK_SECONDS):
        if why := watch.look():
            reasons.append(why)
            end_family(watch.pid)
            return


def write_message(pipe: IO[bytes], message: bytes) -> None:
    pipe.write(LENGTH.pack(len(message)) + message)
    pipe.flush()


def read_message(pipe: IO[bytes]) -> bytes:
    """Return the next message; empty if the other side has ended."""
    head = pipe.read(LENGTH.size)
    length = LENGTH.unpack(head)[0] if len(head) == LENGTH.size else 0
    message = pipe.read(length)
    return message if len(message) == length else b""


def serve() -> None:
    """Answer the calls of the other side, until it closes or ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    out = open(os.dup(1), "wb")  # noqa: SIM115  # printed text must not get into messages
    os.dup2(2, 1)
    calls: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    threading.Thread(target=take_calls, args=(calls,), daemon=True).start()
    sys.path[:], tempfile.tempdir = pickle.loads(calls.get())
    while True:
        allowance, function, args = pickle.loads(calls.get())
        limit_addresses(allowance)
        write_message(out, answer(partial(function, *args)))


def take_calls(calls: "queue.SimpleQueue[bytes]") -> NoReturn:
    """Queue calls as they come; when the other side has ended, end at once."""
    while message := read_message(sys.stdin.buffer):
        calls.put(message)
    os._exit(1)


# ---------------------------------------------------------------- a whole command


def go_on_within(allowance: Allowance) -> None:
    """Continue in a child that this process watches; do nothing if forks cannot be watched.

    This process forwards signals. It ends as the child does, or raises Exceeded at a limit.
    """
    if not WATCHES_FORKS:
        return
    (watched, ours), (over, theirs) = os.pipe(), os.pipe()
    forwarded = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    flush()
    with held_back(forwarded):  # none comes before it can be forwarded
        pid = os.fork()
        for number in forwarded if pid else ():
            if signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, lambda number, _: os.kill(pid, number))
    if not pid:
        os.close(ours)
        os.close(over)
        os.setpgid(0, 0)  # Ctrl-C then comes from the watching process, once
        signal.signal(signal.SIGTTOU, signal.SIG_IGN)  # writing to the terminal stays allowed
        limit_addresses(allowance)
        HELD.append(allowance)
        threading.Thread(target=follow, args=(watched,), daemon=True).start()
        return
    os.close(watched)
    os.close(theirs)
    os._exit(wait_for(pid, over, Watch(pid, allowance)))


@contextmanager
def held_back(numbers: Collection[signal.Signals]) -> Iterator[None]:
    """Let these signals wait until the end of the block, in both processes of a fork."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, numbers)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def wait_for(pid: int, over: int, watch: Watch) -> int:
    """Wait until pipe `over` ends; return the child's status, or raise Exceeded at a limit."""
    while not select.select([over], [], [], LOOK_SECONDS)[0]:
        if why := watch.look():
            os.kill(pid, signal.SIGTERM)  # it may still clean up
            select.select([over], [], [], SECONDS_TO_END)
            end_family(pid)
            os.waitpid(pid, 0)
            raise Exceeded(why)
    status = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    return status if status >= 0 else 128 - status


def follow(watched: int) -> NoReturn:
    """End this process when the watching process ends."""
    os.read(watched, 1)
    os._exit(1)


if __name__ == "__main__":
    serve()
