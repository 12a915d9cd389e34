"""Test the filter on system calls: its numbers, its program on both machines, honest programs."""

import errno
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.judge.task import KIT
from grader.judge.wall.children import Child, start_worker
from grader.protocol import Call, ChildSetup, Import, Limits, Returned
from grader.worker import filter as wall

MACHINES = list(wall.AUDIT_ARCH)
CALLS = wall.ALLOWED | wall.CHECKED | wall.UNSEEN
# Calls on no list, each of another kind; getsockopt reads SO_COOKIE.
REFUSED_CALLS = wall.read_table("""
    vfork 58 -                      execve 59 221                   ptrace 101 117
    pidfd_open 434 434              socket 41 198                   sendmsg 46 211
    getsockopt 55 209               shmget 29 194                   memfd_create 319 279
    keyctl 250 219                  pipe2 293 59                    splice 275 76
    io_submit 209 2                 fchmodat 268 53                 utimensat 280 88
    fsetxattr 190 7                 symlinkat 266 36                inotify_init1 294 26
    name_to_handle_at 303 264       mount 165 40                    setuid 105 146
    sysinfo 99 179                  fstatfs 138 44                  membarrier 324 283
    io_uring_setup 425 425          landlock_create_ruleset 444 444 syncfs 306 267
""")
HEADERS = {
    "x86_64": "/usr/include/x86_64-linux-gnu/asm/unistd_64.h",
    "aarch64": "/usr/include/asm-generic/unistd.h",
}
PID = 4711

# ---------------------------------------------------------------- the program


def verdict(machine: str, number: int, *arguments: int, architecture: int | None = None) -> int:
    """Return the kernel's answer to a call: 0 if it is allowed, else the error's number."""
    given = [*arguments, *[0] * (6 - len(arguments))]
    words = {wall.NUMBER: number, wall.ARCHITECTURE: architecture or wall.AUDIT_ARCH[machine]}
    for index, value in enumerate(given):
        words[wall.ARGUMENTS + 8 * index] = value & 0xFFFFFFFF
        words[wall.ARGUMENTS + 8 * index + 4] = value >> 32
    text, at, seen = wall.program(machine, PID), 0, 0
    tests = {
        wall.EQUAL: lambda value: seen == value,
        wall.GREATER: lambda value: seen > value,
        wall.ANY_BIT: lambda value: bool(seen & value),
    }
    while True:
        code, yes, no, value = text[at]
        assert yes < 256 and no < 256
        at += 1
        if code == wall.RETURN:
            return 0 if value == wall.ALLOW else value & 0xFFFF
        if code == wall.LOAD:
            seen = words[value]
        else:
            at += yes if tests[code](value) else no


@pytest.mark.parametrize("machine", MACHINES)
def test_numbers_are_those_of_the_kernel(machine: str):
    if not Path(HEADERS[machine]).exists():
        pytest.skip(
            f"Linux's headers for {machine} are not installed, and its numbers come from there"
        )
    text = Path(HEADERS[machine]).read_text(encoding="utf-8")
    numbers = read_numbers(text)
    column = MACHINES.index(machine)
    wrong = {
        name: (each[column], numbers.get(name))
        for name, each in (CALLS | REFUSED_CALLS).items()
        if each[column] is not None and numbers.get(name) != str(each[column])
    }
    assert wrong == {}
    there = {name for name, each in CALLS.items() if each[column] is None} & set(numbers)
    assert there == set()  # None would leave such a call out


def read_numbers(text: str) -> dict[str, str]:
    """Return the numbers of calls by name, from one of Linux's headers."""
    return dict(re.findall(r"#define __NR(?:3264)?_(\w+)[ \t]+(\d+)[ \t]*$", text, re.MULTILINE))


@pytest.mark.parametrize("machine", MACHINES)
def test_calls_on_no_list_are_refused(machine: str):
    column = MACHINES.index(machine)
    for name, numbers in REFUSED_CALLS.items():
        if numbers[column] is not None:
            assert verdict(machine, numbers[column]) == errno.EPERM, name
    for numbers in wall.UNSEEN.values():
        assert verdict(machine, numbers[column]) == errno.ENOSYS
    for unknown in (wall.LAST + 1, 1000, 0x40000000 + REFUSED_CALLS["execve"][0], 0xFFFFFFFF):
        assert verdict(machine, unknown) == errno.ENOSYS


@pytest.mark.parametrize("machine", MACHINES)
def test_calls_of_another_architecture_are_refused(machine: str):
    i386_getpid, i386 = 20, 0x40000003
    assert verdict(machine, i386_getpid, architecture=i386) == errno.EPERM


# A call, its arguments, and whether it is allowed.
THREAD = 0x3D0F00  # as the C library starts one: CLONE_VM, _FS, _FILES, _SIGHAND, _THREAD and more
FORK = 0x1200011  # CLONE_CHILD_CLEARTID, CLONE_CHILD_SETTID, SIGCHLD
BY_ARGUMENT = [
    ("clone", (THREAD,), True),
    ("clone", (FORK,), False),
    ("clone", (0x4111,), False),  # CLONE_VFORK, as subprocess does
    ("clone", (THREAD | 0x10000000,), False),
    ("kill", (PID, 15), True),
    ("kill", (0, 15), False),
    ("kill", (0xFFFFFFFF, 9), False),  # everybody
    ("kill", (1, 2), False),
    ("tgkill", (PID, PID, 6), True),
    ("tgkill", (1, 1, 2), False),
    ("prlimit64", (0, 7, 0, 0x7FFF00000000), True),
    ("prlimit64", (0, 7, 0x7FFF00000000, 0), False),  # its lower half is 0
    ("prlimit64", (0, 7, 0x1000, 0), False),
    ("sendto", (5, 0x1000, 10, 0, 0, 0), True),
    ("sendto", (5, 0x1000, 10, 0, 0x7FFF00000000, 16), False),
    ("socketpair", (1, 1, 0), True),
    ("socketpair", (30, 1, 0), False),  # TIPC
    ("fcntl", (5, 1, 0), True),
    ("fcntl", (5, 4, 0x800), True),
    ("fcntl", (5, 8, 1), False),
    ("fcntl", (5, 1032, 0), False),  # F_GETPIPE_SZ
    ("fcntl", (5, 1024, 0), False),
    ("ioctl", (5, 0x5401), True),
    ("ioctl", (5, 0x40086602), False),  # FS_IOC_SETFLAGS: chattr
    ("ioctl", (5, 0x8901), False),  # FIOSETOWN
    ("ioctl", (0, 0x5412), False),  # TIOCSTI
    ("madvise", (0x1000, 4096, 4), True),  # MADV_DONTNEED: the C library gives memory back
    ("madvise", (0x1000, 4096, 14), True),  # MADV_HUGEPAGE, for numpy
    ("madvise", (0x1000, 4096, 3), False),  # MADV_WILLNEED reads files ahead
    ("madvise", (0x1000, 4096, 20), False),  # MADV_COLD
    ("mmap", (0, 4096, 3, 0x22, 0xFFFFFFFF, 0), True),
    ("mmap", (0, 1 << 21, 3, 0x40022, 0xFFFFFFFF, 0), False),  # MAP_HUGETLB
    ("clone", (THREAD | 0x1000,), False),  # CLONE_PIDFD
    ("getsid", (0,), True),
    ("getsid", (1,), False),
    ("sched_getaffinity", (PID, 128, 0x1000), True),
    ("sched_getaffinity", (1, 128, 0x1000), False),
    ("prctl", (39,), False),  # PR_GET_NO_NEW_PRIVS: on no list
    ("madvise", (0x1000, 4096, 21), False),  # MADV_PAGEOUT
    ("prctl", (15, 0x1000), True),  # PR_SET_NAME: threads have names
    ("prctl", (1, 0), False),  # PR_SET_PDEATHSIG
    ("prctl", (4, 1), False),  # PR_SET_DUMPABLE
    ("preadv2", (5, 0x1000, 1, 0, 0, 0), True),
    ("preadv2", (5, 0x1000, 1, 0, 0, 8), False),  # RWF_NOWAIT
    ("clock_gettime", (1, 0x1000), True),  # CLOCK_MONOTONIC
    ("clock_gettime", (2, 0x1000), True),  # CLOCK_PROCESS_CPUTIME_ID, its own
    ("clock_gettime", (0xFFFFFFFFFFFFFFF2, 0x1000), False),  # that of process 1
    ("clock_getres", (0xFFFFFFF2, 0x1000), False),
    ("clock_nanosleep", (0, 0, 0x1000, 0), True),
    ("clock_nanosleep", (0xFFFFFFF2, 0, 0x1000, 0), False),
    ("timer_create", (1, 0, 0x1000), True),
    ("timer_create", (0xFFFFFFF2, 0, 0x1000), False),
]


@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize(("name", "arguments", "passes"), BY_ARGUMENT)
def test_arguments_decide(machine: str, name: str, arguments: tuple[int, ...], passes: bool):
    number = wall.CHECKED[name][MACHINES.index(machine)]
    assert verdict(machine, number, *arguments) == (0 if passes else errno.EPERM)


@pytest.mark.parametrize("machine", MACHINES)
def test_calls_of_every_program_pass(machine: str):
    needed = {  # read, write, close, mmap, munmap, futex, openat, exit_group, getrandom, recvfrom
        "x86_64": (0, 1, 3, 9, 11, 202, 257, 231, 318, 45),
        "aarch64": (63, 64, 57, 222, 215, 98, 56, 94, 278, 207),
    }
    for number in needed[machine]:
        assert verdict(machine, number) == 0


# ---------------------------------------------------------------- in a child

HONEST = """
import ctypes, os, sys
libc = ctypes.CDLL(None, use_errno=True)

def threads():
    import concurrent.futures, threading
    done = []
    thread = threading.Thread(target=lambda: done.append(1))
    thread.start(); thread.join()
    with concurrent.futures.ThreadPoolExecutor(4) as pool: done += pool.map(abs, [-1, -2])
    return sum(done) == 4

def files():
    from pathlib import Path
    with open("notes.txt", "w") as file: file.write("one"); file.flush(); os.fsync(file.fileno())
    with open("notes.txt", "a") as file: file.write(" two")
    os.rename("notes.txt", "kept.txt")
    Path("folder").mkdir(); Path("folder/new").touch(); Path("folder/new").touch()
    names = sorted(os.listdir("folder"))
    os.remove("folder/new"); os.rmdir("folder")
    return Path("kept.txt").read_text() == "one two" and names == ["new"]

def pygame_all():
    import pygame
    pygame.init()
    window = pygame.display.set_mode((64, 48))
    font = pygame.font.Font(None, 20)
    window.blit(font.render("12 px/s", True, "white"), (0, 0))
    window.blit(pygame.font.SysFont("arial", 12).render("0", True, "red"), (0, 0))
    pygame.image.save(window, "window.png")
    picture = pygame.image.load("window.png").convert()
    pygame.mixer.init(); sound = pygame.mixer.Sound(buffer=bytes(4000)); sound.play()
    pygame.mixer.quit()
    pygame.draw.circle(window, "white", (5, 5), 3); pygame.display.flip(); pygame.event.get()
    size = picture.get_size()
    pygame.quit()
    return size == (64, 48)

def pymunk_all():
    import pymunk
    space = pymunk.Space(threaded=True); space.threads = 2
    space.gravity = 0, 900
    body = pymunk.Body(1, 1); space.add(body, pymunk.Circle(body, 5)); space.step(0.01)
    return body.velocity.y > 0

def numpy_all():
    import numpy as np
    a = np.arange(90000.0).reshape(300, 300)
    np.save("a.npy", a @ a); np.linalg.solve(a + np.eye(300) * 1e6, a)
    return np.load("a.npy", mmap_mode="r").shape == (300, 300)

def temporary():
    import tempfile
    with tempfile.TemporaryDirectory() as folder, tempfile.NamedTemporaryFile() as file:
        file.write(b"x"); open(os.path.join(folder, "y"), "w").close()
    with tempfile.TemporaryFile() as file: file.write(b"z")
    return not os.path.exists(folder)

def logs():
    import logging, logging.handlers
    handler = logging.handlers.RotatingFileHandler("engine.log", maxBytes=50, backupCount=2)
    log = logging.getLogger("engine"); log.addHandler(handler)
    for step in range(9): log.warning("step %d", step)
    handler.close()
    return os.path.exists("engine.log.1")

def chance():
    import random, secrets, uuid
    random.seed(); random.SystemRandom().random(); uuid.uuid4()
    return len(os.urandom(8)) == 8 and secrets.randbelow(3) < 3

def databases():
    import sqlite3
    with sqlite3.connect("marks.db") as base:
        base.execute("create table t (x)"); base.execute("insert into t values (1)")
    return base.execute("select x from t").fetchone() == (1,)

def loops():
    import asyncio
    async def main():
        await asyncio.sleep(0)
        return await asyncio.to_thread(lambda: 3)
    return asyncio.run(main()) == 3

def machine():
    import locale, platform, resource, shutil, time
    time.sleep(0); resource.getrlimit(resource.RLIMIT_NOFILE); shutil.which("true")
    locale.setlocale(locale.LC_ALL, ""); platform.platform(); platform.processor()
    return os.cpu_count() >= 1 and bool(time.localtime().tm_year) and not sys.stdout.isatty()

def imports():
    import argparse, csv, dataclasses, decimal, fractions, json, multiprocessing, pickle, queue
    import signal, socket, statistics, subprocess, typing, zipfile, shelve, urllib.request
    signal.signal(signal.SIGINT, signal.default_int_handler)
    return decimal.Decimal("0.1") + decimal.Decimal("0.2") == decimal.Decimal("0.3")

def callbacks():
    number = ctypes.POINTER(ctypes.c_int)
    kind = ctypes.CFUNCTYPE(ctypes.c_int, number, number)
    numbers = (ctypes.c_int * 3)(3, 1, 2)
    libc.qsort(numbers, 3, ctypes.sizeof(ctypes.c_int), kind(lambda a, b: a[0] - b[0]))
    return list(numbers) == [1, 2, 3]

def errno_of(number): ctypes.set_errno(0); libc.syscall(number, -1, 0, 0); return ctypes.get_errno()
"""


@pytest.fixture(scope="module")
def child(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Child]:
    """Yield a child with the filter alone, so that no other layer can refuse."""
    folder = tmp_path_factory.mktemp("filtered")
    places = [folder / name for name in ("submission", "scratch", "bytecode")]
    for place in places:
        place.mkdir()
    (places[0] / "program.py").write_text(HONEST, encoding="utf-8")
    submission, scratch, bytecode = map(str, places)
    others = ("user-namespace", "landlock-files", "network-namespace", "pid-namespace", "own-user")
    worker = start_worker(without=others)
    hidden = [str(KIT / "grader"), str(KIT / "solution")]
    setup = ChildSetup(submission, scratch, Limits(10), True, hidden, bytecode, False, ["numpy"])
    child = worker.open(setup)
    if "system-calls" not in child.ready.layers:
        worker.close()
        pytest.skip("no filter on this machine")
    child.ask(Import("program"))
    yield child
    child.end()
    worker.close()


@pytest.mark.parametrize("name", re.findall(r"^def (\w+)\(\):", HONEST, re.MULTILINE))
def test_honest_programs_run(child: Child, name: str):
    reply = child.ask(Call(f"program:{name}")).reply
    assert isinstance(reply, Returned) and reply.value is True, reply


def test_the_kernel_refuses_each_call(child: Child):
    """Try all calls on no list: the filter answers before the kernel reads their arguments."""
    column = MACHINES.index(wall.platform.machine())
    listed = {each[column] for each in CALLS.values()} | {335, 336}  # x86-64: uretprobe, uprobe
    for number in sorted(set(range(wall.LAST + 1)) - listed):
        reply = child.ask(Call("program:errno_of", [number])).reply
        assert isinstance(reply, Returned) and reply.value == errno.EPERM, number
    newer = child.ask(Call("program:errno_of", [wall.LAST + 1])).reply
    assert isinstance(newer, Returned) and newer.value == errno.ENOSYS
