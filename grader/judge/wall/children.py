"""Start, ask and end the worker's children, from the judge's side of the wall."""

import math
import os
import re
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import Protocol

import msgspec

from grader.judge.wall.processes import end_family
from grader.judge.wall.starting import (
    Started,
    clean_environment,
    command,
    count_cores,
    start_clean,
    start_warm,
)
from grader.protocol import (
    NOT_A_MESSAGE,
    Answered,
    Asked,
    Call,
    Channel,
    ChannelClosed,
    ChannelTimeout,
    ChildSetup,
    End,
    Ended,
    Get,
    MakeBody,
    MakeWorld,
    Open,
    ProtocolError,
    Ready,
    Record,
    Request,
    Returned,
    Set,
    Setup,
    Value,
)

START_SECONDS = 60.0  # to start a child on the slowest machine
WALL_FACTOR, WALL_EXTRA = 4, 20.0  # the last resort, s: CPU budget x factor + extra
AHEAD = min(4, count_cores())  # processes that load while others work, without fork
STOPPED_SECONDS = 2  # s after which a stopped warm process counts as stopped by a child
REST_SECONDS = 8.0  # s, the longest sleep of a child in all
# Checks keep answers, which take up to thirty times their length in memory. Real children send at
# most 1 MB in all.
MAX_HEARD = 8 * 1024 * 1024  # bytes
LOOK_SECONDS = 1.0  # s of waiting for answers, between two checks whether the child sleeps

ready_decoder = msgspec.msgpack.Decoder(Ready)
answer_decoder = msgspec.msgpack.Decoder(Answered)

OUT_OF_TIME = (-24, -9)  # exit statuses: SIGXCPU, and SIGKILL a second later


class ChildEnded(Exception):
    """A child gave no answer; the message says why.

    `late`: its time was over; then the message holds nothing that the child could choose.
    """

    def __init__(self, why: str, late: bool = False) -> None:
        super().__init__(why)
        self.late = late


class Child:
    """One child and the private channel to it."""

    def __init__(self, channel: Channel, worker: "Worker", cpu_seconds: int) -> None:
        self.channel, self.worker = channel, worker
        self.wall_seconds = cpu_seconds * WALL_FACTOR + WALL_EXTRA
        self.cpu_seconds = cpu_seconds
        self.rest_seconds = REST_SECONDS
        self.cpu = 0.0  # s, of processor time that it used; known when it has ended
        self.rested = 0.0  # s of sleep while it owed an answer
        self.waited = self.looked = 0.0  # s spent on its answers: in all, and until the last look
        self.began = seconds_in_queue(os.getpid())  # s that the judge had queued before it began
        self.asked = self.sent = self.answered = 0  # questions
        self.posted: list[Asked] = []  # questions to be sent
        self.heard = 0  # bytes of its answers
        self.first: list[Setup] = []  # changes to send before the next request
        self.seen: dict[int, Value] = {}  # states from the last answer, by object
        self.over = ""  # the reason why it no longer answers
        self.late = False  # whether it was ended because its time was over
        try:
            self.ready = ready_decoder.decode(channel.receive(START_SECONDS))
        except (ChannelClosed, ChannelTimeout, *NOT_A_MESSAGE) as error:
            raise ChildEnded(f"the worker could not start a child: {error}") from error

    def ask(self, request: Request | Record) -> Answered:
        """Return the answer to a request; any error ends the child and raises ChildEnded."""
        return self.answer_at_once(request) or self.answer(self.post(request))

    def answer_at_once(self, request: Request | Record) -> Answered | None:
        """Return the answer to a request that needs no message of its own, or None.

        A message costs more than most requests. So objects are set up with the next question, and a
        state that came with the last answer is not asked for again.
        """
        if self.over:
            raise ChildEnded(self.over, self.late)
        match request:
            case Set() | MakeBody() | MakeWorld() | Call(quiet=True):
                self.first.append(request)
                self.seen = {}
                return Answered(self.asked, Returned(None))
            case Get(ref, "" | "jn" | "jt" as name) if ref in self.seen:
                state = self.seen[ref]
                return Answered(self.asked, Returned(getattr(state, name, None) if name else state))
        return None

    def post(self, request: Request | Record) -> Asked:
        """Queue and return a question; one message sends all when an answer is needed."""
        if self.over:
            raise ChildEnded(self.over, self.late)
        self.asked += 1
        asked = Asked(self.asked, request, self.first)
        self.posted.append(asked)
        self.first = []
        return asked

    def answer(self, asked: Asked) -> Answered:
        """Return the answer to a posted question; drop answers that nobody waits for."""
        answered = self._receive()
        while self.answered < asked.number:
            answered = self._receive()
        match asked.request, answered.reply:
            case Call(), Returned():
                states = zip(asked.request.states, answered.reply.states, strict=False)
                self.seen = {ref: state for ref, state in states if state is not None}
            case _:
                self.seen = {}
        return answered

    def _receive(self) -> Answered:
        """Return the next answer; if none is due, send the questions."""
        if self.over:
            raise ChildEnded(self.over, self.late)
        try:
            deadline = self.waited + self.wall_seconds
            if self.sent == self.answered:
                self._send_posted(deadline)
            # A child may send half an answer: this does not wait for one that sleeps.
            self._wait_for(self.channel.complete, deadline)
            body = self.channel.receive()
            self.answered += 1
            self.heard += len(body)
            if self.heard > MAX_HEARD:
                raise ProtocolError(f"more than {MAX_HEARD >> 20} MB of answers")
            answered = answer_decoder.decode(body)
            if answered.number != self.answered:
                raise ProtocolError("an answer to another question")
        except ChannelTimeout as error:
            self._give_up(str(error) or "it did not answer in time", gone=False, late=True)
        except ChannelClosed:
            self._give_up("", gone=True)
        except NOT_A_MESSAGE as error:
            self._give_up(f"what it sent is not an answer ({error})", gone=False)
        else:
            return answered
        raise ChildEnded(self.over, self.late)

    def _send_posted(self, deadline: float) -> None:
        """Send the posted questions; a child that sleeps may not read them."""
        if self.channel.wait(0):
            raise ProtocolError("an answer came before its question")
        self.channel.post(self.posted)
        self.posted, self.sent = [], self.asked
        self._wait_for(self.channel.flush, deadline)

    def _wait_for(self, happens: Callable[[float], bool], deadline: float) -> None:
        """Wait until `happens` holds; a child that sleeps has less time than one that works."""
        while self.waited < deadline:
            began = time.monotonic()
            happened = happens(min(LOOK_SECONDS, self.rest_seconds))
            self.waited += time.monotonic() - began
            if not happened or self.waited - self.looked >= LOOK_SECONDS:
                self._look()
            if self.rested > self.rest_seconds:
                raise ChannelTimeout("it sleeps, waiting for something that does not come")
            if happened:
                return
        raise ChannelTimeout

    def _look(self) -> None:
        """Update `rested`: the time for its answers minus work and queueing."""
        busy = busy_seconds(self.worker.pid_of(self))
        if busy is None:  # it has ended
            return
        # While the judge queues for a processor, an answer waits for the judge.
        ours = seconds_in_queue(os.getpid()) - self.began
        self.rested, self.looked = max(self.rested, self.waited - busy - ours), self.waited

    def _give_up(self, why: str, gone: bool, late: bool = False) -> None:
        code = self.worker.end(self, gone)
        self.over = why or explain(self.cpu_seconds, code)
        self.late = late or (not why and code in OUT_OF_TIME)

    def end(self) -> None:
        if not self.over:
            self._give_up("the child was ended", gone=False)

    def finish(self) -> None:
        """Wait within its time until a child without requests ends."""
        with suppress(ChannelClosed, ChannelTimeout, *NOT_A_MESSAGE):
            self.channel.receive(self.wall_seconds)
        self.end()


# psutil takes 0.01 s to load and few grades need it, so functions import it.
STOPPED = {"stopped", "tracing-stop"}
IDLE = {"sleeping", *STOPPED}


def busy_seconds(pid: int) -> float | None:
    """Return the seconds that a process worked or waited for a processor; None if it is gone.

    If the system does not measure waiting, a process that is not asleep counts as busy.
    """
    import psutil

    try:
        process = psutil.Process(pid)
        times = process.cpu_times()
        queue = seconds_in_queue(pid)
        if not MEASURES_QUEUES and process.status() not in IDLE:
            return math.inf
    except (psutil.Error, OSError):
        return None
    return times.user + times.system + queue


MEASURES_QUEUES = Path("/proc/self/schedstat").exists()


def seconds_in_queue(pid: int) -> float:
    """Return the time for which a process has waited for a processor, s; 0 except on Linux.

    The longest wait of its threads counts: a hundred threads that wait in the same second count as
    one second. Raises OSError if the process is gone.
    """
    return max(list_waits(pid), default=0.0)


def list_waits(pid: int) -> Iterator[float]:
    """Yield the waiting time of each thread, s; see proc(5), schedstat."""
    for thread in os.listdir(f"/proc/{pid}/task") if MEASURES_QUEUES else ():
        with suppress(FileNotFoundError, ProcessLookupError):  # it has just ended
            schedule = Path(f"/proc/{pid}/task/{thread}/schedstat").read_text("ascii")
            yield int(schedule.split()[1]) / 1e9


class Worker(Protocol):
    """A source of children."""

    layers: list[str]  # layers of isolation around all children, beside those that each child names

    def helpers(self, count: int) -> Sequence["Worker"]:
        """Return at most `count` other workers, which open children at the same time."""
        ...

    def open(self, setup: ChildSetup) -> Child: ...

    def pid_of(self, child: Child) -> int: ...

    def end(self, child: Child, gone: bool) -> int | None:
        """End a child; return its status, a signal as negative; None if the worker ended."""

    def hang_up(self) -> None:
        """Let all processes end, while the judge does other work; `close` waits for them."""

    def close(self) -> None: ...


def explain(cpu_seconds: int, code: int | None) -> str:
    """Return the reason why a child ended, by its status `code`: None if its worker ended too."""
    if code is None:
        return "it took the worker down with it"
    if code in OUT_OF_TIME:
        return f"it used up its {cpu_seconds} s of processor time: a loop that never ends?"
    if code == -11:
        return "it crashed (segmentation fault)"
    if code < 0:
        return f"it was ended by signal {-code}"
    return f"it ended the program (exit status {code}) instead of answering"


class WarmWorker:
    """A process that loads everything once, then forks a child per check.

    It loads while the judge does other work; opening the first child waits for it. Workers started
    together are forks of one loaded process. Layers of isolation in `without` are
    left out, to test the others.
    """

    def __init__(
        self, without: Collection[str] = (), count: int = 1, started: Started | None = None
    ) -> None:
        """Start a worker, with `count` - 1 helpers."""
        self.without = sorted(without)
        self.beside: list[WarmWorker] = []
        self._use(started or start_warm(self.without, count))

    def _use(self, started: Started) -> None:
        """Talk to the first server of a process; helpers talk to the others."""
        self.process, (ours, *others) = started
        self.pid = self.process.pid  # process number of the server, once known
        self.control = Channel(ours)
        self.loading = True
        self.layers: list[str] = []  # layers around all children, once one was opened
        self.beside += [WarmWorker(self.without, 1, Started(self.process, [o])) for o in others]

    def helpers(self, count: int) -> Sequence["WarmWorker"]:
        """Return helpers, which also serve the next grade and close with this worker."""
        while len(self.beside) < count:
            self.beside.append(WarmWorker(self.without))
        return self.beside[:count]

    def wait_until_loaded(self) -> None:
        if self.loading:
            loaded = self.control.receive(START_SECONDS)
            self.pid, self.layers = msgspec.msgpack.decode(loaded, type=tuple[int, list[str]])
            self.loading = False

    def open(self, setup: ChildSetup) -> Child:
        try:
            return self._open(Open(setup), setup)
        except (ChannelClosed, ChildEnded):  # the warm process was killed: start a new one
            self._kill()
            self._use(start_warm(self.without, 1))
            return self._open(Open(setup), setup)

    def _open(self, message: object, setup: ChildSetup) -> Child:
        self.wait_until_loaded()
        ours, theirs = socket.socketpair()
        with ExitStack() as undone:
            undone.enter_context(ours)
            with theirs:
                self.control.send(message)
                try:
                    socket.send_fds(self.control.sock, [b"!"], [theirs.fileno()])
                except OSError as error:
                    raise ChannelClosed(str(error)) from error
            child = Child(Channel(ours), self, setup.limits.cpu_seconds)
            undone.pop_all()  # the child keeps its end
        return child

    def pid_of(self, child: Child) -> int:
        """Return a child's process number here: in a namespace of its own it has another one."""
        import psutil

        for process in psutil.Process(self.pid).children(recursive=True):
            with suppress(OSError):
                status = Path(f"/proc/{process.pid}/status").read_text(encoding="utf-8")
                numbers = re.search(r"^NSpid:(.*)$", status, re.MULTILINE)
                if numbers and int(numbers[1].split()[-1]) == child.ready.pid:
                    return process.pid
        return child.ready.pid

    def end(self, child: Child, gone: bool) -> int | None:
        child.channel.close()
        try:
            self.control.send(End(child.ready.pid, gone))
            ended = msgspec.msgpack.decode(self._hear(), type=Ended)
        except (ChannelClosed, ChannelTimeout):
            self._kill()
            return None
        child.cpu = ended.cpu
        return ended.status

    def _hear(self) -> bytes:
        """Await a message of the warm process; give up early if a child suspended it."""
        stopped = 0
        for _ in range(int(START_SECONDS)):
            if self.control.wait(1.0):
                return self.control.receive(START_SECONDS)
            stopped = stopped + 1 if self._is_stopped() else 0
            if stopped >= STOPPED_SECONDS:
                break
        raise ChannelTimeout

    def _is_stopped(self) -> bool:
        """Return whether the server is suspended; in a PID namespace it is pid's only child."""
        import psutil

        try:
            process = psutil.Process(self.pid)
            if "pid-namespace" in self.layers:
                process = process.children()[0]
            return process.status() in STOPPED
        except (psutil.Error, IndexError):
            return False

    def _kill(self) -> None:
        """End the server with all its children, in any state."""
        self.control.close()
        end_family(self.pid)
        if self.pid == self.process.pid:
            self.process.wait()

    def hang_up(self) -> None:
        for each in [self, *self.beside]:
            each.control.close()  # the server then ends its children and itself

    def close(self) -> None:
        self.hang_up()
        for each in [self, *self.beside]:
            try:
                each.process.wait(5)
            except subprocess.TimeoutExpired:
                end_family(each.process.pid)
                each.process.wait()


class SpawnWorker:
    """Starts a new process for every child, on platforms without fork.

    Some start ahead, since loading takes longer than most checks.
    """

    def __init__(self, without: Collection[str] = ()) -> None:
        self.without = sorted(without)
        self.layers: list[str] = []
        self.processes: dict[int, subprocess.Popen[bytes]] = {}
        self.ahead: list[tuple[subprocess.Popen[bytes], Channel]] = []
        self._start_ahead()

    def helpers(self, count: int) -> Sequence["SpawnWorker"]:
        """Return none: processes start ahead anyway."""
        return ()

    def _start_ahead(self) -> None:
        while len(self.ahead) < AHEAD:
            process, (ours,) = self._start()
            self.ahead.append((process, Channel(ours)))

    def open(self, setup: ChildSetup) -> Child:
        process, channel = self.ahead.pop(0)
        self._start_ahead()
        channel.send(setup)
        child = Child(channel, self, setup.limits.cpu_seconds)
        self.processes[id(child)] = process
        return child

    def _start(self) -> Started:
        if sys.platform != "win32":
            return start_clean("grader.worker.spawned", self.without, out=subprocess.DEVNULL)
        ours, theirs = socket.socketpair()
        process = subprocess.Popen(
            command("grader.worker.spawned"),
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env=clean_environment(),
        )
        assert process.stdin is not None
        with theirs, process.stdin as pipe:
            pipe.write(theirs.share(process.pid))
        return Started(process, [ours])

    def pid_of(self, child: Child) -> int:
        return child.ready.pid

    def end(self, child: Child, gone: bool) -> int | None:
        import psutil

        child.channel.close()
        reaped = reaped_seconds()
        process = self.processes.pop(id(child))
        if gone:
            with suppress(subprocess.TimeoutExpired):
                process.wait(0.5)
        with suppress(psutil.Error):
            times = psutil.Process(process.pid).cpu_times()
            child.cpu = times.user + times.system
        end_family(process.pid)
        if hasattr(os, "killpg"):
            with suppress(ProcessLookupError, PermissionError):
                os.killpg(process.pid, 9)
        code = process.wait()
        child.cpu = max(child.cpu, reaped_seconds() - reaped)
        return code

    def hang_up(self) -> None:
        self.close()

    def close(self) -> None:
        for process in [*self.processes.values(), *(process for process, _ in self.ahead)]:
            process.kill()
            process.wait()
        for _, channel in self.ahead:
            channel.close()


def reaped_seconds() -> float:
    """Return the processor time of all our ended processes; 0 if unknown."""
    try:
        import resource
    except ImportError:
        return 0.0
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def start_worker(spawn: bool = False, without: Collection[str] = (), count: int = 1) -> Worker:
    """Return the fastest worker of this platform, or the portable one with `spawn`.

    Its children lack the layers of isolation that `without` names. It has `count` - 1 helpers, if
    that saves time.
    """
    if spawn or not hasattr(os, "fork"):
        return SpawnWorker(without)
    return WarmWorker(without, count)
