"""Test one child: calls over its channel to a hostile module."""

import ctypes
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest

from grader.judge.submission import Submission
from grader.judge.task import KIT, Options, sandbox_for
from grader.judge.wall import children
from grader.judge.wall.children import Child, ChildEnded, SpawnWorker, WarmWorker, start_worker
from grader.protocol import (
    Call,
    ChildSetup,
    Import,
    Limits,
    Raised,
    Returned,
    Vec,
)
from grader.worker.copies import compile_all, list_sources

SOAK = pytest.mark.soak
MODULE = """
import os, select, socket, sys, threading, time
def variable(name): return os.environ.get(name, "")
def environment(): return ",".join(sorted(os.environ))
def folder(): return os.getcwd() + " " + ",".join(sorted(os.listdir(".")))
def read(path): return open(path).read(20)
def write(path): open(path, "w").write("x")
def listing(path): return str(len(os.listdir(path)))
def leave(status): os._exit(status)
def quit(): sys.exit(0)
def forever():
    while True: pass
def wait_for_nothing(): threading.Event().wait()
def recurse(): return recurse()
def swallow(): return len(bytearray(4 * 1024**3))
def leave_behind():
    pid = os.fork()
    if pid == 0:
        os.setsid()
        if os.fork(): os._exit(0)
        open("part", "w").write(str(os.getpid()))
        os.rename("part", "pid")
        select.select([], [], [], 30)
        os._exit(0)
    while not os.path.exists("pid"): select.select([], [], [], 0.01)
    return 1
def flood_disk():
    with open("big", "wb") as f:
        for _ in range(64): f.write(bytes(1024 * 1024))
def clock(): return (time.time(), time.perf_counter())
"""


class Asker:
    """Calls a function of MODULE, each in a new child."""

    def __init__(self, tmp_path: Path, worker: WarmWorker | SpawnWorker) -> None:
        folder, scratch, bytecode = (tmp_path / n for n in ("submission", "scratch", "bytecode"))
        for each in (folder, scratch, bytecode):
            each.mkdir()
        (folder / "hostile.py").write_text(MODULE, encoding="utf-8")
        self.worker = worker
        limits = Limits(cpu_seconds=1, memory_mb=1024)
        hidden = [str(KIT / "grader")]
        self.setup = ChildSetup(
            str(folder), str(scratch), limits, True, hidden, str(bytecode), False
        )
        self.children: list[Child] = []

    def __call__(self, name: str, *args: int | str) -> object:
        child = self.worker.open(self.setup)
        self.children.append(child)
        child.ask(Import("hostile"))
        answered = child.ask(Call(f"hostile:{name}", list(args)))
        return answered.reply.value if isinstance(answered.reply, Returned) else answered.reply

    def end(self) -> None:
        for child in self.children:
            child.end()


@pytest.fixture(scope="module")
def workers() -> Iterator[dict[bool, WarmWorker | SpawnWorker]]:
    """Workers that fork or spawn; each starts when a test asks for it."""
    started: dict[bool, WarmWorker | SpawnWorker] = {}
    yield started
    for worker in started.values():
        worker.close()


@pytest.fixture(params=[False, pytest.param(True, marks=SOAK)], ids=["fork", "spawn"])
def spawn(request: pytest.FixtureRequest) -> bool:
    return bool(request.param)


@pytest.fixture
def ask(spawn: bool, tmp_path: Path, workers: dict[bool, WarmWorker]) -> Iterator[Asker]:
    if spawn not in workers:
        workers[spawn] = start_worker(spawn)
    asker = Asker(tmp_path, workers[spawn])
    yield asker
    asker.end()


forked = pytest.mark.parametrize("spawn", [False], ids=["fork"])
both = pytest.mark.parametrize("spawn", [False, True], ids=["fork", "spawn"])
NO_SUCH_THING = ("PermissionError", "FileNotFoundError")  # shut, or in no root of a child's own
linux = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="the layer named in the test is Linux's"
)


@linux
@forked
def test_a_library_of_sdl_is_loaded_before_the_fork(ask: Asker):
    """Otherwise children would load this library 2,000 times in a grade."""
    try:
        ctypes.CDLL("libudev.so.1")
    except OSError:
        pytest.skip("no libudev here, so SDL does not load it either")
    ask("folder")
    child = psutil.Process(ask.worker.pid_of(ask.children[0]))
    assert any("libudev" in each.path for each in child.memory_maps())


@both
def test_the_environment_tells_nothing(ask: Asker, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("SECRET_TOKEN", "x")
    names = set(str(ask("environment")).split(","))
    assert "SECRET_TOKEN" not in names and "PYTHONPATH" not in names and "USER" not in names
    assert os.name == "nt" or ask("variable", "PATH") == os.defpath  # Windows finds libraries by it


def test_a_child_works_in_a_copy_of_the_submission(ask: Asker, tmp_path: Path):
    folder, _, names = str(ask("folder")).partition(" ")
    assert Path(folder).parts[-2:] == ("scratch", "submission")
    assert names == "__pycache__,hostile.py"
    assert ask("listing", "..") == "1"


@both
def test_leaving_with_status_0_is_no_answer(ask: Asker):
    with pytest.raises(ChildEnded, match="exit status 0"):
        ask("leave", 0)


@both
def test_an_endless_loop_uses_up_its_processor_time(ask: Asker):
    with pytest.raises(ChildEnded, match="1 s of processor time"):
        ask("forever")


def test_waiting_for_nothing_is_noticed_before_the_last_resort(ask: Asker, monkeypatch):
    monkeypatch.setattr(children, "REST_SECONDS", 0.5)
    with pytest.raises(ChildEnded, match="it sleeps"):
        ask("wait_for_nothing")


@pytest.mark.parametrize(
    ("name", "error"),
    [
        ("quit", "SystemExit"),
        ("recurse", "RecursionError"),
        pytest.param("swallow", "MemoryError", marks=linux),
        ("flood_disk", "OSError"),
    ],
)
def test_a_limit_raises_an_exception(ask: Asker, name: str, error: str):
    reply = ask(name)
    assert isinstance(reply, Raised) and reply.error == error
    assert len(reply.frames) <= 12


@linux
@both
def test_nothing_can_be_written_outside_the_scratch_folder(ask: Asker, tmp_path: Path):
    for path in (tmp_path / "out.txt", tmp_path / "submission" / "hostile.py"):
        reply = ask("write", str(path))
        assert isinstance(reply, Raised) and reply.error in NO_SUCH_THING
    assert ask("write", "../mine.txt") is None


@linux
@forked
def test_a_process_left_behind_is_ended(ask: Asker):
    assert isinstance(ask.worker, WarmWorker)
    server = psutil.Process(ask.worker.process.pid)
    ask("folder")  # the child is there
    before = set(server.children(recursive=True))
    ask("leave_behind")
    left = set(server.children(recursive=True)) - before
    assert left
    ask.end()
    assert not any(process.is_running() for process in left)


@linux
def test_a_process_left_behind_is_ended_without_a_pid_namespace(tmp_path: Path):
    """On macOS and in a bare container, strays are found by their parents."""
    worker = start_worker(without=("pid-namespace", "system-calls"))
    asker = Asker(tmp_path, worker)
    server = psutil.Process(worker.process.pid)
    asker("leave_behind")
    assert len(server.children(recursive=True)) >= 2
    asker.end()
    assert server.children(recursive=True) == []
    assert asker("folder")  # the warm process lives
    asker.children[-1].end()
    worker.close()


@linux
def test_a_child_ends_with_the_process_that_forked_it(tmp_path: Path):
    worker = start_worker(without=("pid-namespace",))
    child = worker.open(Asker(tmp_path, worker).setup)
    child.ask(Import("hostile"))
    server = psutil.Process(worker.process.pid)
    (process,) = server.children()
    server.kill()
    psutil.wait_procs([process], timeout=600)
    assert not process.is_running()
    child.channel.close()
    worker.close()


@both
def test_all_clocks_stand_at_the_same_scripted_time(ask: Asker):
    shown = ask("clock")
    assert isinstance(shown, Vec) and shown.x == shown.y < 10


def test_the_warm_process_is_replaced_when_it_is_killed(tmp_path: Path):
    worker = start_worker()
    assert isinstance(worker, WarmWorker)
    worker.process.kill()
    worker.process.wait()
    child = worker.open(
        ChildSetup(str(tmp_path), str(tmp_path), Limits(10), True, [], str(tmp_path), False)
    )
    child.end()
    worker.close()


# ---------------------------------------------------------------- compiled files


def test_compiling_runs_nothing_and_stops_when_the_folder_is_full(tmp_path: Path):
    tree, bytecode = tmp_path / "tree", tmp_path / "bytecode"
    (tree / "deep").mkdir(parents=True)
    (tree / "a_first.py").write_text(f"open({str(tmp_path / 'ran')!r}, 'w')\n", encoding="utf-8")
    (tree / "broken.py").write_text("def (:\n", encoding="utf-8")
    for number in range(8):
        (tree / f"big{number}.py").write_text(f"x = {'x' * 300_000!r}\n", encoding="utf-8")
    (tree / "deep" / "late.py").write_text("x = 1\n", encoding="utf-8")
    limits = Limits(cpu_seconds=10, scratch_mb=1)
    compile_all(ChildSetup(str(tree), "", limits, False, [], str(bytecode), True))
    made = sorted(path.name.partition(".")[0] for path in bytecode.rglob("*.pyc"))
    assert made == ["a_first", "big0", "big1", "big2", "big3"]
    assert not (tmp_path / "ran").exists()


def test_programs_are_compiled_with_the_files_that_they_name(tmp_path: Path):
    files = {
        "engine/__init__.py": "from engine.body import Body",
        "engine/body.py": "import helper",
        "helper.py": "def help(): import late",
        "late.py": "",
        "other.py": "import engine",
        "unused/__init__.py": "",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    found = [each.relative_to(tmp_path).as_posix() for each in list_sources(tmp_path, ["engine"])]
    assert sorted(found) == ["engine/__init__.py", "engine/body.py", "helper.py", "late.py"]
    assert len(list_sources(tmp_path, [])) == len(files)


@pytest.mark.parametrize(
    ("todos", "programs"),
    [
        ("8a", "integrators"),
        ("4 7a", "mini_engine pymunk_scene"),
        ("whole", "mini_engine pymunk_scene"),
    ],
)
def test_the_programs_of_the_todos_are_compiled(
    tmp_path: Path, ask: Asker, todos: str, programs: str
):
    options = Options(only=frozenset(todos.split()))
    sandbox = sandbox_for(Submission("tree", tmp_path), tmp_path, ask.worker, options)
    assert sandbox.programs == programs.split()


@linux
@forked
def test_children_read_what_was_compiled_and_cannot_write_it(tmp_path: Path, ask: Asker):
    work = tmp_path / "work"
    tree = work / "tree"
    tree.mkdir(parents=True)
    (tree / "hostile.py").write_text(MODULE, encoding="utf-8")
    sandbox = sandbox_for(Submission("tree", tree), work, ask.worker, Options(trusted=True))
    sandbox.programs = ["hostile"]
    child = sandbox.open_child(5)
    child.ask(Import("hostile"))
    (compiled,) = (work / "bytecode").glob("hostile.*.pyc")
    before = compiled.read_bytes()
    for name in (compiled.name, "new.pyc"):
        reply = child.ask(Call("hostile:write", [f"__pycache__/{name}"])).reply
        assert isinstance(reply, Raised) and reply.error in ("PermissionError", "OSError")
    child.end()
    assert compiled.read_bytes() == before and len(list(compiled.parent.iterdir())) == 1


WAITING = """
import os
from grader.worker.warm import wait_for_children
pid = os.fork() or os._exit(0)
os.waitid(os.P_PID, pid, os.WEXITED | os.WNOWAIT)
wait_for_children()
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_the_loaded_process_may_wait_for_servers_that_have_ended():
    done = subprocess.run([sys.executable, "-c", WAITING], cwd=KIT, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
