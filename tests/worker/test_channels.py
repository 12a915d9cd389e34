"""Test that no child finds data left by another child.

The first child leaves a word in one way and stays alive; the second one looks for it. Attacks
in walls.toml try channels of the system: files, keys, shared memory, locks and others.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.judge.submission import Submission
from grader.judge.task import KIT, Options, sandbox_for
from grader.judge.wall.children import Child, ChildEnded, start_worker
from grader.judge.wall.sandbox import Sandbox
from grader.protocol import Call, Import, Returned

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="Linux's layers")

CHANNELS = """
import ctypes, os, sys, tempfile, threading
libc = ctypes.CDLL(None)
NAME = "word-of-a-channel"

def leave_environment():
    os.environ[NAME] = "1"; libc.setenv(NAME.encode(), b"1", 1)
def find_environment(): return NAME in os.environ or libc.secure_getenv(NAME.encode()) != 0

def leave_module(): sys.modules[NAME] = sys; sys.path.append(NAME)
def find_module(): return NAME in sys.modules or NAME in sys.path

def leave_file(): open(os.path.join(tempfile.gettempdir(), NAME), "w").close()
def find_file(): return os.path.exists(os.path.join(tempfile.gettempdir(), NAME))

def leave_number():
    threading.stack_size(65536)
    for _ in range(200):
        thread = threading.Thread(target=int); thread.start(); thread.join()
def find_number(): return os.getpid() > 150

def leave_descriptor():
    for descriptor in range(3, 100): os.dup2(2, descriptor, inheritable=True)
    raise OSError("its own channel is gone now")
def find_descriptor():
    open_ones = 0
    for descriptor in range(1000):
        try: os.fstat(descriptor); open_ones += 1
        except OSError: pass
    return open_ones > 4
"""
NAMES = [line[10:].split("(")[0] for line in CHANNELS.splitlines() if line[:10] == "def leave_"]


@pytest.fixture(scope="module")
def sandbox(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Sandbox]:
    work = tmp_path_factory.mktemp("channels")
    tree = work / "tree"
    tree.mkdir()
    (tree / "channels.py").write_text(CHANNELS, encoding="utf-8")
    worker = start_worker()
    options = Options(KIT / "solution", trusted=True)
    yield sandbox_for(Submission("channels", tree), work, worker, options)
    worker.close()


def ask(child: Child, function: str) -> object:
    child.ask(Import("channels"))
    reply = child.ask(Call(f"channels:{function}")).reply
    assert isinstance(reply, Returned), reply
    return reply.value


@pytest.mark.parametrize("name", NAMES)
def test_nothing_is_carried_to_the_next_child(name: str, sandbox: Sandbox):
    first = sandbox.open_child(10)
    if name == "descriptor":
        with pytest.raises(ChildEnded):  # it has closed its own channel
            ask(first, "leave_descriptor")
    else:
        ask(first, f"leave_{name}")
    for ends in (False, True):
        if ends:
            first.end()
        second = sandbox.open_child(10)
        assert ask(second, f"find_{name}") is False
        second.end()


READS_MEMORY = '''
import ctypes, gc, os, socket
libc = ctypes.CDLL(None)
libc.sbrk.restype = ctypes.c_void_p
WORD = b"-of-" + b"the-first"

def find():
    """Count a word in the memory that this process was forked with."""
    top, size = libc.sbrk(0), 1 << 20
    heap = range(top // size - 64, top // size + 1)
    objects = {id(each) // size for each in gc.get_objects()}
    pair = socket.socketpair()
    reader, writer = (each.fileno() for each in pair)
    count = 0
    for start in sorted(objects.union(heap)):
        for address in range(start * size, (start + 1) * size, 4096):
            # A socket is told "bad address" where reading would end the process.
            if libc.write(writer, ctypes.c_void_p(address), ctypes.c_size_t(4096)) == 4096:
                count += os.read(reader, 4096).count(b"a-word" + WORD)
    return count
'''


def test_the_files_of_one_submission_are_in_no_memory_of_the_next(tmp_path: Path):
    """The process that forks all children of a class must not read any submission."""
    worker = start_worker()
    counts = []
    for name in ("the-first", "the-second"):
        tree = tmp_path / name
        tree.mkdir()
        (tree / "searching.py").write_text(READS_MEMORY, encoding="utf-8")
        (tree / "notes.txt").write_text(f"a-word-of-{name} " * 200, encoding="utf-8")
        options = Options(KIT / "solution", trusted=True)
        work = tmp_path / f"work-of-{name}"
        work.mkdir()
        child = sandbox_for(Submission(name, tree), work, worker, options).open_child(10)
        child.ask(Import("searching"))
        reply = child.ask(Call("searching:find")).reply
        assert isinstance(reply, Returned), reply
        counts.append(reply.value)
        child.end()
    worker.close()
    assert counts[1] == 0, counts
