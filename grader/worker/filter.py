"""Let a child make the system calls that honest programs make, and no others.

A filter of seccomp(2), for x86-64 and aarch64. It needs no right, no library and no namespace, so
it also holds in a container that refuses them. Its tables list the calls of Python, its libraries
and the right submissions of the bank, and close relatives. Every other call gets the error
"operation not permitted" (EPERM), which honest code sees as an exception. A call newer than the
tables gets "function not implemented" (ENOSYS), as on an older kernel.

The filter is a program for the kernel's classic BPF machine. It reads the fields of struct
seccomp_data: the call's number, the architecture, and six arguments. The numbers of calls are those
of <asm/unistd.h>.
"""

import ctypes
import errno
import os
import platform
import struct
import sys
from collections.abc import Sequence
from functools import cache

from grader.worker.root import libc

PR_SET_SECCOMP, SECCOMP_MODE_FILTER = 22, 2
PR_SET_NO_NEW_PRIVS = 38
CLONE_THREAD = 0x00010000
CLONE_NEW = 0x7E020000  # every namespace that clone could make
AF_UNIX = 1

Numbers = tuple[int | None, int | None]  # of a call on x86-64 and aarch64


def read_table(text: str) -> dict[str, Numbers]:
    """Return the calls of a table, each with its two numbers; - where there is no such call."""
    words = iter(text.split())
    return {
        name: (None if x86 == "-" else int(x86), None if arm == "-" else int(arm))
        for name, x86, arm in zip(words, words, words, strict=True)
    }


# These calls are reported as unknown, so the C library makes others. The arguments of clone3 and
# openat2 lie in memory, where no filter sees them; statx returns the numbers of mounts, which count
# for the whole machine.
UNSEEN = read_table("""
    clone3 435 435                  openat2 437 437                 statx 332 291
""")
LAST = 450  # set_mempolicy_home_node: later calls count as unknown

# Open files, and names in the child's own folders; other layers restrict the names. No call changes
# modes, owners, times or attributes: each would be a message to a later check.
FILES = read_table("""
    read 0 63                       write 1 64                      readv 19 65
    writev 20 66                    pread64 17 67                   pwrite64 18 68
    preadv 295 69                   pwritev 296 70                  lseek 8 62
    open 2 -                        openat 257 56                   creat 85 -
    close 3 57                      close_range 436 436             stat 4 -
    fstat 5 80                      lstat 6 -                       newfstatat 262 -
    fstatat - 79                    access 21 -                     faccessat 269 48
    faccessat2 439 439              readlink 89 -                   readlinkat 267 78
    getdents 78 -                   getdents64 217 61               getcwd 79 17
    chdir 80 49                     fchdir 81 50                    mkdir 83 -
    mkdirat 258 34                  rmdir 84 -                      rename 82 -
    renameat 264 38                 renameat2 316 276               unlink 87 -
    unlinkat 263 35                 truncate 76 45                  ftruncate 77 46
    fallocate 285 47                fsync 74 82                     fdatasync 75 83
    sendfile 40 71                  copy_file_range 326 285         umask 95 166
    dup 32 23                       dup2 33 -                       dup3 292 24
""")
# The process's own memory. Files without a name and memory of System V count towards no limit.
MEMORY = read_table("""
    brk 12 214                      munmap 11 215                   mremap 25 216
    mprotect 10 226                 msync 26 227
""")
# Threads, and the end. No call starts a process or changes a share of the processors.
THREADS = read_table("""
    futex 202 98                    set_robust_list 273 99          set_tid_address 218 96
    rseq 334 293                    gettid 186 178                  sched_yield 24 124
    sched_getparam 143 121          sched_getscheduler 145 120      sched_get_priority_max 146 125
    sched_get_priority_min 147 126  getcpu 309 168                  exit 60 93
    exit_group 231 94
""")
# Signals to itself, and waiting for a child that never exists.
SIGNALS = read_table("""
    rt_sigaction 13 134             rt_sigprocmask 14 135           rt_sigreturn 15 139
    rt_sigpending 127 136           rt_sigsuspend 130 133           rt_sigtimedwait 128 137
    sigaltstack 131 132             restart_syscall 219 128         pause 34 -
    alarm 37 -                      setitimer 38 103                getitimer 36 102
    wait4 61 260                    waitid 247 95
""")
# Its own clocks and alarms.
TIME = read_table("""
    gettimeofday 96 169             time 201 -                      nanosleep 35 101
    times 100 153                   timer_settime 223 110           timer_gettime 224 108
    timer_getoverrun 225 109        timer_delete 226 111
""")
# Facts about itself. The load of the machine and the space on its disks stay hidden.
ITSELF = read_table("""
    getpid 39 172                   getppid 110 173                 getuid 102 174
    geteuid 107 175                 getgid 104 176                  getegid 108 177
    getresuid 118 148               getresgid 120 150               getgroups 115 158
    getpgrp 111 -                   getrusage 98 165                getrlimit 97 163
    capget 125 90                   uname 63 160                    getrandom 318 278
""")
# Waiting for its channel and for pairs of sockets. No pipe: a pipe keeps a whole huge page for one
# byte, and many of them change a number that counts for the whole machine.
WAITING = read_table("""
    poll 7 -                        ppoll 271 73                    select 23 -
    pselect6 270 72                 epoll_create 213 -              epoll_create1 291 20
    epoll_ctl 233 21                epoll_wait 232 -                epoll_pwait 281 22
    epoll_pwait2 441 441            recvfrom 45 207                 getsockname 51 204
    getpeername 52 205              shutdown 48 210
""")
ALLOWED = FILES | MEMORY | THREADS | SIGNALS | TIME | ITSELF | WAITING
# Calls that depend on their arguments: see `checked`.
CHECKED = read_table("""
    clone 56 220                    kill 62 129                     tgkill 234 131
    prlimit64 302 261               sendto 44 206                   socketpair 53 199
    fcntl 72 25                     ioctl 16 29                     madvise 28 233
    preadv2 327 286                 prctl 157 167                   mmap 9 222
    sched_getaffinity 204 123       getpgid 121 155                 getsid 124 156
    clock_gettime 228 113           clock_getres 229 114            clock_nanosleep 230 115
    timer_create 222 107
""")
# F_DUPFD, F_GETFD, F_SETFD, F_GETFL, F_SETFL, F_GETLK, F_SETLK, F_SETLKW, F_DUPFD_CLOEXEC. Others
# signal or watch other processes, or take memory of the kernel.
ALLOWED_FCNTL = (*range(8), 1030)
# TCGETS, TCGETS2, TIOCGWINSZ, FIONREAD, FIONBIO, FIONCLEX, FIOCLEX: Python's calls on its files.
# Others change attributes of files, or the process that gets signals.
ALLOWED_IOCTL = (0x5401, 0x802C542A, 0x5413, 0x541B, 0x5421, 0x5450, 0x5451)

# MADV_NORMAL, _RANDOM, _SEQUENTIAL, _DONTNEED, _FREE, _HUGEPAGE, _NOHUGEPAGE. Others share pages
# with other processes, or move files into and out of memory for the whole machine.
ALLOWED_MADVISE = (0, 1, 2, 4, 8, 14, 15)
# PR_GET_DUMPABLE, PR_SET_NAME, PR_GET_NAME, PR_CAPBSET_READ, and PR_SET_VMA of the C library.
ALLOWED_PRCTL = (3, 15, 16, 23, 0x53564D41)
MAP_HUGETLB = 0x40000  # pages that the whole machine shares
CLONE_PIDFD = 0x1000

AUDIT_ARCH = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}
LOAD, EQUAL, GREATER, ANY_BIT, RETURN = 0x20, 0x15, 0x25, 0x45, 0x06
ALLOW, ERROR = 0x7FFF0000, 0x00050000
REFUSE, UNKNOWN = ERROR | errno.EPERM, ERROR | errno.ENOSYS
NUMBER, ARCHITECTURE, ARGUMENTS = 0, 4, 16  # offsets in struct seccomp_data

OF_ANOTHER = 0x80000000  # a clock with a negative number: the processor time of some process

ANY_PID = 0xFEDCBA98  # a placeholder: no process has this number

Instruction = tuple[int, int, int, int]  # code, jump if true, jump if false, value


class Program(ctypes.Structure):
    """struct sock_fprog: the number of instructions and their address."""

    _fields_ = [("length", ctypes.c_ushort), ("filter", ctypes.c_char_p)]


def load(offset: int) -> list[Instruction]:
    """Load four bytes of struct seccomp_data."""
    return [(LOAD, 0, 0, offset)]


def argument(index: int, upper: bool = False) -> list[Instruction]:
    """Load the lower or upper half of an argument; both machines are little-endian."""
    return load(ARGUMENTS + 8 * index + 4 * upper)


def answer(value: int) -> list[Instruction]:
    return [(RETURN, 0, 0, value)]


def when(test: int, value: int, then: list[Instruction]) -> list[Instruction]:
    """Do `then` if the test holds; else continue after it."""
    return [(test, 0, len(then), value), *then]


def unless_equal(value: int, then: list[Instruction]) -> list[Instruction]:
    return [(EQUAL, len(then), 0, value), *then]


def null(index: int) -> list[Instruction]:
    """Allow a call if this argument is NULL."""
    lower = argument(index) + unless_equal(0, answer(REFUSE))
    return lower + argument(index, upper=True) + unless_equal(0, answer(REFUSE)) + answer(ALLOW)


def one_of(values: Sequence[int], inside: int, outside: int) -> list[Instruction]:
    """Do `inside` for these values, fewer than 256, and `outside` for all others."""
    end = len(values)
    tests = [(EQUAL, end - index, 0, value) for index, value in enumerate(values)]
    return tests + answer(outside) + answer(inside)


def checked(pid: int) -> dict[str, list[Instruction]]:
    """Return the rules of calls that depend on their arguments, for the process `pid`."""
    own = argument(0) + one_of((pid,), ALLOW, REFUSE)
    own_or_none = argument(0) + one_of((0, pid), ALLOW, REFUSE)
    clock = argument(0) + when(ANY_BIT, OF_ANOTHER, answer(REFUSE)) + answer(ALLOW)
    return {
        "clone": argument(0)
        + when(ANY_BIT, CLONE_NEW | CLONE_PIDFD, answer(REFUSE))
        + when(ANY_BIT, CLONE_THREAD, answer(ALLOW))
        + answer(REFUSE),
        "sched_getaffinity": own_or_none,
        "getpgid": own_or_none,
        "getsid": own_or_none,
        "kill": own,
        "tgkill": own,  # abort() ends the program by it
        "prlimit64": null(2),  # limits may be read
        "sendto": null(4),  # the channel and pairs of sockets are connected: no address is needed
        "socketpair": argument(0) + one_of((AF_UNIX,), ALLOW, REFUSE),  # asyncio needs pairs
        "fcntl": argument(1) + one_of(ALLOWED_FCNTL, ALLOW, REFUSE),
        "ioctl": argument(1) + one_of(ALLOWED_IOCTL, ALLOW, REFUSE),
        "madvise": argument(2) + one_of(ALLOWED_MADVISE, ALLOW, REFUSE),
        "prctl": argument(0) + one_of(ALLOWED_PRCTL, ALLOW, REFUSE),
        "preadv2": argument(5)
        + one_of((0,), ALLOW, REFUSE),  # RWF_NOWAIT shows which files are in memory
        "mmap": argument(3) + when(ANY_BIT, MAP_HUGETLB, answer(REFUSE)) + answer(ALLOW),
        "clock_gettime": clock,
        "clock_getres": clock,
        "clock_nanosleep": clock,
        "timer_create": clock,
    }


def program(machine: str, pid: int) -> list[Instruction]:
    """Return the filter for a machine such as `x86_64` and the process `pid`."""
    column = list(AUDIT_ARCH).index(machine)
    text = load(ARCHITECTURE) + unless_equal(AUDIT_ARCH[machine], answer(REFUSE)) + load(NUMBER)
    text += when(GREATER, LAST, answer(UNKNOWN))
    for number in column_of(UNSEEN, column):
        text += when(EQUAL, number, answer(UNKNOWN))
    bodies = checked(pid)
    for name, number in zip(CHECKED, column_of(CHECKED, column), strict=True):
        text += when(EQUAL, number, bodies[name])
    return text + one_of(column_of(ALLOWED, column), ALLOW, REFUSE)


def column_of(table: dict[str, Numbers], column: int) -> list[int]:
    """Return the numbers of calls on one architecture."""
    return [number for each in table.values() if (number := each[column]) is not None]


@cache
def pack_filter() -> bytes:
    """Return this machine's filter as the kernel reads it, with ANY_PID for the process.

    Returns nothing on other machines and for a Python of 32 bits. The warm process calls this once
    before it forks, because it takes as long as making a root.
    """
    machine = platform.machine()
    if sys.platform != "linux" or machine not in AUDIT_ARCH or sys.maxsize < 2**32:
        return b""
    return b"".join(struct.pack("HBBI", *each) for each in program(machine, ANY_PID))


def refuse_system_calls() -> list[str]:
    """Install the filter for good, for this thread and those it starts; return the layer.

    Returns no layer if the kernel was built without filters.
    """
    text = pack_filter().replace(struct.pack("I", ANY_PID), struct.pack("I", os.getpid()))
    if not text:
        return []
    taken = Program(len(text) // 8, text)
    libc().prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    if libc().prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, ctypes.byref(taken), 0, 0):
        return []
    return ["system-calls"]
