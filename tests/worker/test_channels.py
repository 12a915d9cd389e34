"""Test that no child finds data left by another child: try each possible channel.

The first child leaves a word in one way and stays alive; the second one looks for it. A world is a
set of layers: all of them, all but the filter, or the filter alone.
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

soak = pytest.mark.soak
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="Linux's layers")

# `leave` gets the folder that the judge keeps for the submission, `find` answers whether the word
# is there. What the system refuses is an OSError, and means that nothing was left or found.
CHANNELS = '''
import ctypes, fcntl, mmap, os, resource, socket, struct, sys, tempfile, threading
libc = ctypes.CDLL(None, use_errno=True)
NAME, NUMBER = "word-of-a-channel", 77_321
ADD_KEY, KEYCTL, REQUEST_KEY = {"x86_64": (248, 250, 249)}.get(os.uname().machine, (217, 219, 218))
held = []

def places(work):
    """Return files and folders that a later child may see."""
    here = os.path.dirname(os.path.abspath(__file__))
    return [work, work + "/tree", work + "/tree/channels.py", work + "/bytecode", here, __file__,
            here + "/__pycache__", os.path.realpath(here + "/__pycache__"), os.__file__,
            os.path.dirname(os.__file__), "/dev/null"]

def tried(*calls):
    answers = []
    for call in calls:
        try: answers.append(call())
        except (OSError, ValueError): pass
    return any(answers)

def on_all(work, do): return tried(*[lambda path=path: do(path) for path in places(work)])

def leave_attribute(work): on_all(work, lambda path: os.setxattr(path, "user." + NAME, b"1"))
def find_attribute(work): return on_all(work, lambda path: os.getxattr(path, "user." + NAME))

def leave_time(work): on_all(work, lambda path: os.utime(path, (NUMBER, NUMBER)))
def find_time(work): return on_all(work, lambda path: int(os.stat(path).st_mtime) == NUMBER)

def leave_mode(work): on_all(work, lambda path: os.chmod(path, 0o1757))
def find_mode(work): return on_all(work, lambda path: os.stat(path).st_mode & 0o7777 == 0o1757)

def leave_owner(work): on_all(work, lambda path: os.chown(path, -1, 4711))
def find_owner(work): return on_all(work, lambda path: os.stat(path).st_gid == 4711)

def flags(path, change=0):
    descriptor, number = os.open(path, os.O_RDONLY), bytearray(8)
    try:
        fcntl.ioctl(descriptor, 0x80086601, number)
        if change:  # FS_NODUMP_FL
            fcntl.ioctl(descriptor, 0x40086602, struct.pack("q", number[0] | change))
        return number[0] & 0x40
    finally: os.close(descriptor)
def leave_flag(work): on_all(work, lambda path: flags(path, 0x40))
def find_flag(work): return on_all(work, flags)

def write(path):
    with open(path, "w") as file: file.write(NAME)
def leave_file(work):
    on_all(work, lambda path: write(os.path.join(path, NAME)))
    tried(lambda: write(os.path.join(tempfile.gettempdir(), NAME)))
def find_file(work):
    here = lambda path: os.path.exists(os.path.join(path, NAME))
    return on_all(work, here) or here(tempfile.gettempdir())

def leave_bytecode(work):
    folder = os.path.dirname(os.path.abspath(__file__)) + "/__pycache__/"
    for name in ["channels." + sys.implementation.cache_tag + ".pyc", NAME + ".pyc"]:
        tried(lambda: os.remove(folder + name), lambda: write(folder + name))
def find_bytecode(work):
    folder = os.path.dirname(os.path.abspath(__file__)) + "/__pycache__/"
    with open(folder + "channels." + sys.implementation.cache_tag + ".pyc", "rb") as file:
        return NAME.encode() == file.read(len(NAME)) or NAME + ".pyc" in os.listdir(folder)

def leave_link(work):
    on_all(work, lambda path: os.symlink("/" + NAME, path + "/" + NAME))
    on_all(work, lambda path: os.mkfifo(path + "/" + NAME))
def find_link(work): return on_all(work, lambda path: os.path.lexists(path + "/" + NAME))

def keyrings(): return (-3, -4, -5)
def leave_key(work):
    for ring in keyrings():
        key = libc.syscall(ADD_KEY, b"user", NAME.encode(), b"1", 1, ring)
        if key > 0: libc.syscall(KEYCTL, 5, key, 0x3f3f3f3f)
def find_key(work):
    found = [libc.syscall(KEYCTL, 10, ring, b"user", NAME.encode(), 0) for ring in keyrings()]
    return max(found) > 0 or libc.syscall(REQUEST_KEY, b"user", NAME.encode(), None, 0) > 0

def leave_memory(work): libc.shmget(NUMBER, 4096, 0o1666)
def find_memory(work): return libc.shmget(NUMBER, 0, 0) >= 0
def leave_semaphore(work): libc.semget(NUMBER, 1, 0o1666)
def find_semaphore(work): return libc.semget(NUMBER, 0, 0) >= 0
def leave_queue(work): libc.msgget(NUMBER, 0o1666)
def find_queue(work): return libc.msgget(NUMBER, 0) >= 0
def leave_posix_queue(work): libc.mq_open(b"/" + NAME.encode(), 0o102, 0o666, None)
def find_posix_queue(work): return libc.mq_open(b"/" + NAME.encode(), 0) >= 0

def leave_abstract_socket(work):
    held.append(socket.socket(socket.AF_UNIX)); held[-1].bind("\\0" + NAME); held[-1].listen()
def find_abstract_socket(work):
    socket.socket(socket.AF_UNIX).connect("\\0" + NAME); return True
def leave_named_socket(work):
    held.append(socket.socket(socket.AF_UNIX))
    held[-1].bind(work + "/" + NAME); held[-1].listen()
def find_named_socket(work):
    socket.socket(socket.AF_UNIX).connect(work + "/" + NAME); return True
def leave_port(work):
    held.append(socket.socket()); held[-1].bind(("127.0.0.1", 47_321)); held[-1].listen()
def find_port(work): socket.create_connection(("127.0.0.1", 47_321), 1); return True

def leave_lock(work):
    held.append(open(os.__file__)); fcntl.flock(held[-1], fcntl.LOCK_EX)
def find_lock(work):
    with open(os.__file__) as file:
        try: fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError: return True

def leave_descriptor(work):
    for descriptor in range(3, 100): tried(lambda: os.dup2(2, descriptor, inheritable=True))
    raise OSError("its own channel is gone now")
def find_descriptor(work):
    return sum(tried(lambda: os.fstat(each) and True) for each in range(1000)) > 4

def leave_environment(work):
    os.environ[NAME] = "1"; libc.setenv(NAME.encode(), b"1", 1)
def find_environment(work): return NAME in os.environ or libc.secure_getenv(NAME.encode()) != 0
def leave_module(work): sys.modules[NAME] = sys; sys.path.append(NAME)
def find_module(work): return NAME in sys.modules or NAME in sys.path

def leave_number(work):
    threading.stack_size(65536)
    for _ in range(200):
        thread = threading.Thread(target=int); thread.start(); thread.join()
def find_number(work): return os.getpid() > 150

def leave_process(work):
    if os.fork() == 0:
        import select
        select.select([], [], [], 60)
        os._exit(0)
def find_process(work):
    others = [number for number in range(2, 60) if number != os.getpid()]
    return tried(*[lambda: os.kill(number, 0) or True for number in others])

def leave_limit(work): resource.prlimit(os.getppid(), resource.RLIMIT_NOFILE, (99, 128))
def find_limit(work): return resource.getrlimit(resource.RLIMIT_NOFILE)[0] == 99
def leave_priority(work): os.setpriority(os.PRIO_PROCESS, os.getppid(), 7)
def find_priority(work): return os.getpriority(os.PRIO_PROCESS, 0) == 7

def leave(name, work): return tried(lambda: globals()["leave_" + name](work))
def find(name, work): return tried(lambda: globals()["find_" + name](work))
'''
NAMES = [line[10:].split("(")[0] for line in CHANNELS.splitlines() if line[:10] == "def leave_"]
ALL_BUT_FILTER = (
    "landlock-files",
    "network-namespace",
    "own-user",
    "pid-namespace",
    "user-namespace",
)
WORLDS = {"all": (), "no filter": ("system-calls",), "filter alone": ALL_BUT_FILTER}
# Open channels: shared writable files and process numbers; without the filter, also effects between
# children that live at the same time.
OPEN = {
    ("file", "filter alone"),
    ("number", "filter alone"),
    ("process", "no filter"),
    ("lock", "no filter"),
    ("limit", "no filter"),
    ("priority", "no filter"),
}


@pytest.fixture(
    scope="module",
    params=["all", *(pytest.param(name, marks=soak) for name in ("no filter", "filter alone"))],
)
def world(request: pytest.FixtureRequest) -> str:
    name: str = request.param
    return name


@pytest.fixture(scope="module")
def sandbox(world: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Sandbox]:
    """Make a sandbox as for a grade: a read-only tree, and a folder beside it."""
    work = tmp_path_factory.mktemp("channels")
    tree = work / "tree"
    tree.mkdir()
    (tree / "channels.py").write_text(CHANNELS, encoding="utf-8")
    (tree / "channels.py").chmod(0o444)
    tree.chmod(0o555)
    worker = start_worker(without=WORLDS[world])
    yield sandbox_for(
        Submission("channels", tree), work, worker, Options(KIT / "solution", trusted=True)
    )
    worker.close()


def ask(child: Child, function: str, *arguments: str) -> bool:
    child.ask(Import("channels"))
    reply = child.ask(Call(f"channels:{function}", list(arguments))).reply
    assert isinstance(reply, Returned), reply
    return bool(reply.value)


@pytest.mark.parametrize("name", NAMES)
def test_nothing_is_carried_to_the_next_child(name: str, sandbox: Sandbox, world: str):
    if (name, world) in OPEN:
        pytest.skip(f"where there is {world}, {name} is open, as OPEN says: another layer shuts it")
    work = str(sandbox.work)
    first = sandbox.open_child(10)
    holding = {"no filter": "own-root"}.get(world, "system-calls")
    if holding not in sandbox.layers:  # only this keeps the word from the machine itself
        first.end()
        pytest.skip(f"this machine has no {holding}")
    if name == "descriptor":
        with pytest.raises(ChildEnded):  # it has closed its own channel
            ask(first, "leave", name, work)
    else:
        ask(first, "leave", name, work)
    assert is_found(sandbox, name) is False
    first.end()
    assert is_found(sandbox, name) is False


def is_found(sandbox: Sandbox, name: str) -> bool:
    """Return whether a new child finds the word."""
    child = sandbox.open_child(10)
    try:
        return ask(child, "find", name, str(sandbox.work))
    finally:
        child.end()


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
