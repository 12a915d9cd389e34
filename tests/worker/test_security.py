"""Test each layer around a submission alone, so that none can stop working unnoticed."""

import ctypes
import os
import platform
import re
import socket
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from contextlib import suppress
from io import FileIO
from pathlib import Path

import msgspec
import pytest
from whole_bank import bank

from grader.judge.task import KIT
from grader.judge.wall.children import Child, WarmWorker, Worker, start_worker
from grader.judge.wall.isolation import list_unconfined
from grader.protocol import Call, ChildSetup, Import, Limits, Raised, Returned
from grader.worker import confinement
from grader.worker.filter import ALLOWED, AUDIT_ARCH, CHECKED
from grader.worker.root import TOPS

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="Linux's layers")

PROBES = """
import ctypes, os, resource, socket, subprocess
libc = ctypes.CDLL(None, use_errno=True)
def limit(name): return resource.getrlimit(getattr(resource, name))[1]
def session(): return os.getsid(0) == os.getpid()
def own_number(): return os.getpid()
def parents_number(): return os.getppid()
def visible(path): return os.path.exists(path) and bool(os.listdir(path))
def read(path): return open(path, "rb").read(100).decode("latin-1")
def send(port):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
        return out.sendto(b"x", ("127.0.0.1", port))
def listen():
    with socket.socket() as server:
        server.bind(("127.0.0.1", 0))
        return True
def abstract(name): socket.socket(socket.AF_UNIX).connect("\\0" + name); return True
def make_memory(key): return libc.shmget(key, 4096, 0o1666) >= 0
def has_memory(key): return libc.shmget(key, 0, 0) >= 0
def make_key(name): return libc.syscall(248, b"user", name.encode(), b"x", 1, -4) >= 0
def has_key(name): return libc.syscall(250, 10, -4, b"user", name.encode(), 0) >= 0
def run(program): return subprocess.run([program], capture_output=True).returncode
def fill(megabytes):
    for number in range(megabytes):
        with open(f"part{number}", "wb") as file: file.write(bytes(1024 * 1024))
    return True
def threads(most):
    import threading
    libc.mallopt(-8, 1)  # M_ARENA_MAX: or each would want memory of its own
    threading.stack_size(65536)
    stop = threading.Event()
    for number in range(most):
        try: threading.Thread(target=stop.wait, daemon=True).start()
        except RuntimeError: return number
    return most
def fill_at(path):
    with open(path, "wb") as file: file.write(b"x")
    return True
def many(files):
    for number in range(files): open(f"file{number}", "w").close()
    return True
def look(path): return os.stat(path).st_size
def connect(path): socket.socket(socket.AF_UNIX).connect(path); return True
def change_mode(path): os.chmod(path, 0o4777); return True
def change_times(path): os.utime(path, (1, 1)); return True
def change_attribute(path): os.setxattr(path, "user.seen", b"1"); return True
def a_library(): return os.__file__
def in_root(): return " ".join(sorted(os.listdir("/")))
def mount_anew(): return libc.mount(None, b"/", None, 0x1020, None)  # bound again, and writable
def bounding(capability): return libc.prctl(23, capability, 0, 0, 0)
def capabilities():
    sets = ctypes.create_string_buffer(24)
    libc.capget((0x20080522).to_bytes(4, "little") + bytes(4), sets)
    return sum(sets.raw)
def host(): return " ".join(os.uname()[1:2]) + libc_name()
def libc_name():
    name = ctypes.create_string_buffer(64)
    libc.gethostname(name, 64)
    return " " + name.value.decode()
def arguments():
    import sys
    return " ".join([*sys.orig_argv, *sys.argv[1:]])
def signal_all():
    os.kill(-1, 0)
    return True
"""


# Layers that can be switched off, and the layers that each one needs.
SWITCHES = {
    "landlock-files",
    "network-namespace",
    "own-root",
    "own-user",
    "pid-namespace",
    "system-calls",
    "user-namespace",
}
NEEDS = {
    "ipc-namespace": "user-namespace",
    "mount-namespace": "user-namespace",
    "own-root": "user-namespace",
    "landlock-tcp": "landlock-files",
    "landlock-scope": "landlock-files",
}


class Prober:
    """Calls a probe in a new child of the worker."""

    def __init__(self, tmp_path: Path, worker: Worker) -> None:
        self.worker = worker
        folders = [tmp_path / name for name in ("submission", "scratch", "bytecode")]
        for folder in folders:
            folder.mkdir()
        (folders[0] / "probes.py").write_text(PROBES, encoding="utf-8")
        submission, scratch, bytecode = map(str, folders)
        hidden = [str(KIT / "grader"), str(KIT / "solution")]
        self.setup = ChildSetup(submission, scratch, Limits(10), True, hidden, bytecode, False)
        self.children: list[Child] = []

    def __call__(self, name: str, *args: int | str) -> object:
        child = self.open()
        child.ask(Import("probes"))
        reply = child.ask(Call(f"probes:{name}", list(args))).reply
        return reply.value if isinstance(reply, Returned) else reply

    def open(self) -> Child:
        """Open a child with a scratch folder of its own."""
        scratch = Path(self.setup.scratch).with_name(f"scratch{len(self.children)}")
        scratch.mkdir()
        self.setup = msgspec.structs.replace(self.setup, scratch=str(scratch))
        child = self.worker.open(self.setup)
        self.children.append(child)
        return child

    @property
    def layers(self) -> set[str]:
        return {*self.open().ready.layers, *self.worker.layers}


@pytest.fixture(scope="module")
def workers() -> Iterator[dict[frozenset[str], Worker]]:
    """Workers by the layers that they leave out; each starts when a test asks for it."""
    started: dict[frozenset[str], Worker] = {}
    yield started
    for worker in started.values():
        worker.close()


@pytest.fixture
def layer(request: pytest.FixtureRequest) -> str:
    """Return the layer of a test, or none; skip the test if the machine lacks that layer."""
    name: str = getattr(request, "param", "")
    if name and name not in expected_layers():
        pytest.skip(f"this kernel or account has no {name}, so none can fail")
    return name


@pytest.fixture
def probe(tmp_path: Path, layer: str, workers: dict[frozenset[str], Worker]) -> Iterator[Prober]:
    """Yield a prober of children with all layers, or with the layer of the test alone."""
    without = frozenset(SWITCHES - {layer, NEEDS.get(layer, layer)} if layer else ())
    if without not in workers:
        workers[without] = start_worker(without=without)
    prober = Prober(tmp_path, workers[without])
    yield prober
    for child in prober.children:
        child.end()


def is_refused(reply: object, *errors: str) -> bool:
    return isinstance(reply, Raised) and reply.error in errors


# ---------------------------------------------------------------- what this machine has


def can(flags: int) -> bool:
    """Return whether a process of this user may enter these namespaces; a new process tries."""
    program = f"import ctypes; exit(ctypes.CDLL(None).unshare({flags}) != 0)"
    return subprocess.run([sys.executable, "-c", program]).returncode == 0


def landlock_version() -> int:
    return ctypes.CDLL(None).syscall(444, None, 0, 1)


def expected_layers() -> set[str]:
    layers = {"process-group", "rlimits"}
    if can(confinement.CLONE_NEWUSER | confinement.CLONE_NEWIPC | confinement.CLONE_NEWNS):
        layers |= {"user-namespace", "ipc-namespace", "mount-namespace", "own-root"}
    if can(confinement.CLONE_NEWUSER | confinement.CLONE_NEWNET | confinement.CLONE_NEWPID):
        layers |= {"network-namespace", "pid-namespace"}
    if platform.machine() in AUDIT_ARCH:
        layers.add("system-calls")
    since = {1: "landlock-files", 4: "landlock-tcp", 6: "landlock-scope"}
    return layers | {name for version, name in since.items() if landlock_version() >= version}


def test_every_layer_this_machine_has_is_used(probe: Prober):
    assert probe.layers == expected_layers()


def needs(name: str) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("layer", [name], indirect=True)


# ---------------------------------------------------------------- always


def test_limits_hold_and_cannot_be_lifted(probe: Prober):
    limits = Limits(cpu_seconds=10)
    assert probe("limit", "RLIMIT_CPU") == limits.cpu_seconds + 1
    assert probe("limit", "RLIMIT_AS") == limits.memory_mb * 1024**2
    assert probe("limit", "RLIMIT_DATA") == limits.data_mb * 1024**2
    assert probe("limit", "RLIMIT_FSIZE") == limits.file_mb * 1024**2
    assert probe("limit", "RLIMIT_NOFILE") == limits.open_files
    assert probe("limit", "RLIMIT_NPROC") == limits.processes
    assert probe("limit", "RLIMIT_CORE") == 1  # see core(5): 0 does not keep a pipe from it


def test_a_child_leads_a_session_of_its_own(probe: Prober):
    assert probe("session") is True


# ---------------------------------------------------------------- namespaces


@needs("pid-namespace")
def test_no_other_process_has_a_number_in_there(probe: Prober):
    assert isinstance(number := probe("own_number"), int) and number < 1000
    assert probe("parents_number") == 1


@needs("pid-namespace")
def test_a_signal_to_all_processes_stays_inside(probe: Prober):
    probe("signal_all")
    assert isinstance(probe.worker, WarmWorker) and probe.worker.process.poll() is None


@needs("pid-namespace")
def test_a_flood_of_threads_ends_soon_for_root_as_well(probe: Prober):
    release = tuple(map(int, re.findall(r"\d+", platform.release())[:2]))
    if os.geteuid() == 0 and release < confinement.PID_MAX_SINCE:
        pytest.skip("before Linux 6.14 only the machine as a whole has such a limit")
    limit = Path("/proc/sys/kernel/pid_max").read_text()
    started = probe("threads", 2000)
    assert isinstance(started, int) and started < confinement.MOST_NUMBERS
    assert Path("/proc/sys/kernel/pid_max").read_text() == limit


@needs("network-namespace")
def test_no_packet_gets_out(probe: Prober):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(0.3)
        assert isinstance(probe("send", receiver.getsockname()[1]), Raised | int)
        with pytest.raises(TimeoutError):
            receiver.recv(10)


@needs("network-namespace")
def test_no_abstract_socket_of_the_machine_is_there(probe: Prober):
    name = f"physics-grader-{os.getpid()}"
    with socket.socket(socket.AF_UNIX) as server:
        server.bind("\0" + name)
        server.listen()
        assert is_refused(probe("abstract", name), "ConnectionRefusedError", "PermissionError")


@needs("mount-namespace")
def test_the_scratch_folder_is_small_and_ends_with_the_child(probe: Prober):
    limits = Limits(cpu_seconds=10)
    assert is_refused(probe("fill", limits.scratch_mb + 1), "OSError")
    assert is_refused(probe("many", limits.scratch_files + 1), "OSError")
    assert probe("fill", limits.scratch_mb // 2) is True
    assert list(Path(probe.setup.scratch).iterdir()) == []


# ---------------------------------------------------------------- a root of its own


@needs("own-root")
def test_files_outside_have_no_name(probe: Prober, tmp_path: Path):
    other = tmp_path / "other" / "integrators.py"
    other.parent.mkdir()
    other.write_text("x = 1\n", encoding="utf-8")
    before = other.stat()
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(path := f"/tmp/own-root-{os.getpid()}")
        try:
            server.listen()
            assert is_refused(probe("connect", path), "FileNotFoundError")
        finally:
            os.unlink(path)
    for name in ("look", "change_mode", "change_times", "change_attribute"):
        assert is_refused(probe(name, str(other)), "FileNotFoundError")
    after = other.stat()
    assert (after.st_mode, after.st_ctime_ns) == (before.st_mode, before.st_ctime_ns)
    names = str(probe("in_root"))
    needed = [*confinement.readable_paths(()), *confinement.links_to_libraries()]
    (own,) = set(names.split()) - {each.parts[1] for each in needed} - {"dev"}
    assert own in {top.strip("/") for top in TOPS}  # the second where the kit lies below the first


@needs("own-root")
def test_files_inside_cannot_be_changed(probe: Prober):
    library, before = str(probe("a_library")), Path(os.__file__).stat()
    assert library == os.__file__
    for name in ("change_mode", "change_times", "change_attribute"):
        assert is_refused(probe(name, library), "OSError", "PermissionError")
    assert is_refused(probe("fill_at", "/new"), "OSError", "PermissionError")
    assert probe("mount_anew") == -1
    after = Path(os.__file__).stat()
    assert (after.st_mode, after.st_mtime_ns, after.st_ctime_ns) == (
        before.st_mode,
        before.st_mtime_ns,
        before.st_ctime_ns,
    )


@needs("user-namespace")
def test_no_capability_is_left(probe: Prober):
    assert probe("capabilities") == 0
    assert probe("bounding", 21) == 0  # CAP_SYS_ADMIN, which the namespace's root would have


def test_a_kit_among_the_packages_is_left_out_however_deep(tmp_path: Path):
    kit = tmp_path / "lib" / "python" / "packages" / "grader"
    for folder in (kit, kit.parent / "numpy", tmp_path / "lib" / "python" / "json"):
        folder.mkdir(parents=True)
    left = set(confinement.list_without({kit}, tmp_path))
    assert left == {kit.parent / "numpy", tmp_path / "lib" / "python" / "json"}


# ---------------------------------------------------------------- Landlock


@needs("landlock-files")
@pytest.mark.parametrize(
    "path", ["/proc/self/environ", "/etc/hostname", "/root", "/home", "/tmp", "/var", str(KIT)]
)
def test_neither_the_machine_nor_the_kit_can_be_read(probe: Prober, path: str):
    asked = probe("visible" if Path(path).is_dir() else "read", path)
    assert asked is False or is_refused(asked, "PermissionError", "FileNotFoundError")


@pytest.mark.parametrize(
    ("layer", "asked", "errors"),
    [
        ("landlock-files", ("read", "OTHER"), ["PermissionError"]),
        ("landlock-files", ("run", "/bin/true"), ["PermissionError", "FileNotFoundError"]),
        ("landlock-tcp", ("listen",), ["PermissionError"]),
    ],
    indirect=["layer"],
)
def test_a_layer_alone_refuses(
    probe: Prober, tmp_path: Path, asked: tuple[str, ...], errors: list[str]
):
    other = tmp_path / "other" / "integrators.py"  # of another submission
    other.parent.mkdir()
    other.write_text("x = 1\n", encoding="utf-8")
    name, *args = (str(other) if each == "OTHER" else each for each in asked)
    assert is_refused(probe(name, *args), *errors)


@pytest.mark.parametrize(
    ("layer", "name", "word"),
    [("ipc-namespace", "memory", 77_123), ("user-namespace", "key", "physics-grader")],
    indirect=["layer"],
)
def test_shared_memory_and_keys_end_with_a_child(probe: Prober, name: str, word: int | str):
    made = probe(f"make_{name}", word)
    assert made is True or name == "key"
    assert probe(f"has_{name}", word) is False
    assert ctypes.CDLL(None).shmget(77_123, 0, 0) < 0


# ---------------------------------------------------------------- without


@pytest.mark.parametrize("spawn", [False, True], ids=["fork", "spawn"])
def test_no_argument_or_variable_of_the_instructor_is_in_a_child(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, spawn: bool
):
    monkeypatch.setenv("PATH", f"{os.environ['PATH']}:/canary-of-paths")
    monkeypatch.setenv("TOKEN", "canary-of-tokens")
    monkeypatch.setenv("LD_LIBRARY_PATH", "/canary-of-libraries")
    worker = start_worker(spawn)
    try:
        prober = Prober(tmp_path, worker)
        said = prober("arguments")
        assert said.split()[0] == "python" and str(KIT) not in said
        pid = worker.pid_of(prober.children[-1])
        arguments = Path(f"/proc/{pid}/cmdline").read_bytes()
        assert str(KIT).encode() not in arguments.partition(b"\0")[2]
        if os.geteuid() == 0:  # an ordinary user may not look into a child
            assert b"canary" not in Path(f"/proc/{pid}/environ").read_bytes()
            memory = read_memory(pid)
            assert b"canary-of-paths" not in memory and b"canary-of-tokens" not in memory
        prober.children[-1].end()
    finally:
        worker.close()


def read_memory(pid: int) -> bytes:
    """Return the stack and the heap of a process, without the guard pages of its threads."""
    found = b""
    with open(f"/proc/{pid}/mem", "rb", buffering=0) as memory:
        for line in Path(f"/proc/{pid}/maps").read_text("ascii").splitlines():
            if "rw" in line and (line.endswith(("[stack]", "[heap]")) or line.split()[4] == "0"):
                first, last = (int(each, 16) for each in line.split()[0].split("-"))
                found += b"".join(read_pages(memory, first, last))
    assert len(found) > 1_000_000
    return found


def read_pages(memory: FileIO, first: int, last: int) -> Iterator[bytes]:
    """Yield the readable pages: newer C libraries guard a stack by pages within a mapping."""
    size = os.sysconf("SC_PAGE_SIZE")
    for start in range(first, last, size):
        with suppress(OSError):
            memory.seek(start)
            yield memory.read(size)


@needs("network-namespace")
def test_the_name_of_the_machine_is_hidden(probe: Prober):
    assert probe("host") == "check check"


def test_missing_layers_are_named():
    assert list_unconfined(["processes", "rlimits"]) == ["files", "network", "other processes"]
    assert list_unconfined(sorted(expected_layers())) == []


def test_the_page_is_short_and_names_what_is_there():
    """If the page names a missing test, its claim is untested."""
    page = (KIT / "handouts" / "instructor" / "security.md").read_text(encoding="utf-8")
    assert len(page.partition("## Layers")[0].split()) <= 300
    assert len(page.split()) <= 1250
    files = set(re.findall(r"`((?:tests|grader)/[\w/]+\.\w+)`", page))
    assert len(files) >= 20
    assert [each for each in sorted(files) if not (KIT / each).is_file()] == []
    known = {member.name for member in bank() if member.kind in ("hostile", "right")}
    assert {"brings-pytest-along", "shadows-libraries", "stale-bytecode"} <= known
    listed = tomllib.loads((KIT / "tests" / "worker" / "walls.toml").read_text("utf-8"))
    assert f"{len(listed['stopped_by'])} attacks" in page
    assert f"allows {len(ALLOWED)} calls, and {len(CHECKED)} more" in page
