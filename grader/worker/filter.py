"""Refuse system calls of a child: a filter of seccomp(2), for x86-64 and aarch64.

It needs no right, no library and no namespace, so it also holds in a container that refuses them.
What is refused answers "operation not permitted" (EPERM), so that honest code sees an exception.
What came after the last call that the tables know answers "function not implemented" (ENOSYS), as
an older kernel would: what nobody has looked at stays shut.

The filter is a program for the kernel's classic BPF machine. It gets the fields of struct
seccomp_data: the call's number, the architecture, and six arguments. The numbers of calls are those
of <asm/unistd.h>, x86-64 first, None where an architecture has no such call.
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

# What clone3 is asked lies in memory, where no filter sees it: told ENOSYS, the C library asks
# clone. Python's threads start, processes do not: see `checked`.
UNSEEN = {"clone3": (435, 435)}
LAST = 450  # set_mempolicy_home_node: later calls are as good as unknown

# No process but this one: a flood of them starves every other grade, and one that is left writes
# marks later.
PROCESSES = {
    "fork": (57, None),
    "vfork": (58, None),
    "execve": (59, 221),
    "execveat": (322, 281),
}
# No other process is traced, signalled or slowed down, and no limit moved.
OTHERS = {
    "ptrace": (101, 117),
    "process_vm_readv": (310, 270),
    "process_vm_writev": (311, 271),
    "process_madvise": (440, 440),
    "process_mrelease": (448, 448),
    "kcmp": (312, 272),
    "migrate_pages": (256, 238),
    "move_pages": (279, 239),
    "pidfd_open": (434, 434),
    "pidfd_getfd": (438, 438),
    "pidfd_send_signal": (424, 424),
    "tkill": (200, 130),
    "rt_sigqueueinfo": (129, 138),
    "rt_tgsigqueueinfo": (297, 240),
    "setpriority": (141, 140),
    "ioprio_set": (251, 30),
    "sched_setaffinity": (203, 122),
    "sched_setattr": (314, 274),
    "sched_setparam": (142, 118),
    "sched_setscheduler": (144, 119),
    "setrlimit": (160, 164),
}
# No address of any family, vsock and sockets with a path included; no descriptor is handed over.
# The child's own channel is open already, and reading and writing suffice for it.
SOCKETS = {
    "socket": (41, 198),
    "bind": (49, 200),
    "connect": (42, 203),
    "listen": (50, 201),
    "accept": (43, 202),
    "accept4": (288, 242),
    "sendmsg": (46, 211),
    "sendmmsg": (307, 269),
    "recvmsg": (47, 212),
    "recvmmsg": (299, 243),
    "setsockopt": (54, 208),
}
# Nothing that outlives the process or counts towards no limit of it: memory of System V, message
# queues, semaphores, files without a name, keys.
LASTING = {
    "shmget": (29, 194),
    "shmat": (30, 196),
    "shmdt": (67, 197),
    "shmctl": (31, 195),
    "semget": (64, 190),
    "semop": (65, 193),
    "semctl": (66, 191),
    "semtimedop": (220, 192),
    "msgget": (68, 186),
    "msgsnd": (69, 189),
    "msgrcv": (70, 188),
    "msgctl": (71, 187),
    "mq_open": (240, 180),
    "mq_unlink": (241, 181),
    "mq_timedsend": (242, 182),
    "mq_timedreceive": (243, 183),
    "mq_notify": (244, 184),
    "mq_getsetattr": (245, 185),
    "memfd_create": (319, 279),
    "memfd_secret": (447, 447),
    "add_key": (248, 217),
    "request_key": (249, 218),
    "keyctl": (250, 219),
}
# No memory beside the limit: for a byte of a huge page that was put into it a pipe keeps it all.
PIPES = {
    "splice": (275, 76),
    "tee": (276, 77),
    "vmsplice": (278, 75),
    "io_setup": (206, 0),
    "io_submit": (209, 2),
}
# Landlock governs how files are opened, not what is written about them: modes, owners, times and
# attributes of a file outside are damage, and each of them is a message to a later check.
METADATA = {
    "chmod": (90, None),
    "fchmod": (91, 52),
    "fchmodat": (268, 53),
    "chown": (92, None),
    "fchown": (93, 55),
    "lchown": (94, None),
    "fchownat": (260, 54),
    "utime": (132, None),
    "utimes": (235, None),
    "futimesat": (261, None),
    "utimensat": (280, 88),
    "setxattr": (188, 5),
    "lsetxattr": (189, 6),
    "fsetxattr": (190, 7),
    "getxattr": (191, 8),
    "lgetxattr": (192, 9),
    "fgetxattr": (193, 10),
    "listxattr": (194, 11),
    "llistxattr": (195, 12),
    "flistxattr": (196, 13),
    "removexattr": (197, 14),
    "lremovexattr": (198, 15),
    "fremovexattr": (199, 16),
}
# No second name for a file, no pipe or device with a name, and nobody else's files watched or held.
NAMES = {
    "link": (86, None),
    "linkat": (265, 37),
    "symlink": (88, None),
    "symlinkat": (266, 36),
    "mknod": (133, None),
    "mknodat": (259, 33),
    "flock": (73, 32),
    "inotify_init": (253, None),
    "inotify_init1": (294, 26),
    "inotify_add_watch": (254, 27),
    "fanotify_init": (300, 262),
    "fanotify_mark": (301, 263),
    "name_to_handle_at": (303, 264),
    "open_by_handle_at": (304, 265),
}
# The walls themselves: namespaces, mounts and rights stay as they are.
WALLS = {
    "mount": (165, 40),
    "umount2": (166, 39),
    "pivot_root": (155, 41),
    "chroot": (161, 51),
    "unshare": (272, 97),
    "setns": (308, 268),
    "open_tree": (428, 428),
    "move_mount": (429, 429),
    "fsopen": (430, 430),
    "fsconfig": (431, 431),
    "fsmount": (432, 432),
    "fspick": (433, 433),
    "mount_setattr": (442, 442),
    "quotactl": (179, 60),
    "quotactl_fd": (443, 443),
    "swapon": (167, 224),
    "swapoff": (168, 225),
    "setuid": (105, 146),
    "setgid": (106, 144),
    "setreuid": (113, 145),
    "setregid": (114, 143),
    "setresuid": (117, 147),
    "setresgid": (119, 149),
    "setgroups": (116, 159),
    "setfsuid": (122, 151),
    "setfsgid": (123, 152),
    "capset": (126, 91),
    "seccomp": (317, 277),
    "personality": (135, 92),
}
# What the machine did before: which pages of which files it has read, how busy it is, how full its
# disks are. A child could leave a word there, by emptying a file's pages, by working or by writing,
# and a later one find it.
MEMORY = {
    "fadvise64": (221, 223),
    "mincore": (27, 232),
    "readahead": (187, 213),
    "sysinfo": (99, 179),
    "statfs": (137, 43),
    "fstatfs": (138, 44),
}
# The machine as a whole, and the parts of the kernel in which most holes were found.
MACHINE = {
    "bpf": (321, 280),
    "perf_event_open": (298, 241),
    "userfaultfd": (323, 282),
    "io_uring_setup": (425, 425),
    "io_uring_enter": (426, 426),
    "io_uring_register": (427, 427),
    "kexec_load": (246, 104),
    "kexec_file_load": (320, 294),
    "create_module": (174, None),
    "init_module": (175, 105),
    "finit_module": (313, 273),
    "delete_module": (176, 106),
    "syslog": (103, 116),
    "acct": (163, 89),
    "reboot": (169, 142),
    "settimeofday": (164, 170),
    "clock_settime": (227, 112),
    "clock_adjtime": (305, 266),
    "adjtimex": (159, 171),
    "sethostname": (170, 161),
    "setdomainname": (171, 162),
    "iopl": (172, None),
    "ioperm": (173, None),
    "modify_ldt": (154, None),
    "uselib": (134, None),
    "sysfs": (139, None),
    "ustat": (136, None),
    "_sysctl": (156, None),
    "nfsservctl": (180, 42),
    "lookup_dcookie": (212, 18),
    "vhangup": (153, 58),
    "sync": (162, 81),
    "syncfs": (306, 267),
}
REFUSED = (
    PROCESSES | OTHERS | SOCKETS | LASTING | PIPES | METADATA | NAMES | WALLS | MEMORY | MACHINE
)
# What is allowed or refused by its arguments: see `checked`.
CHECKED = {
    "clone": (56, 220),
    "kill": (62, 129),
    "tgkill": (234, 131),
    "prlimit64": (302, 261),
    "sendto": (44, 206),
    "socketpair": (53, 199),
    "fcntl": (72, 25),
    "ioctl": (16, 29),
    "madvise": (28, 233),
    "preadv2": (327, 286),
    "prctl": (157, 167),
    "clock_gettime": (228, 113),
    "clock_getres": (229, 114),
    "clock_nanosleep": (230, 115),
    "timer_create": (222, 107),
}
# F_SETOWN, F_SETSIG, F_SETOWN_EX signal others; F_SETLEASE, F_NOTIFY hold up or watch them;
# F_SETPIPE_SZ takes memory of the kernel.
REFUSED_FCNTL = (8, 10, 15, 1024, 1026, 1031)
# TCGETS, TCGETS2, TIOCGWINSZ, FIONREAD, FIONBIO, FIONCLEX, FIOCLEX: what Python asks of its own
# files. Others change attributes of files, or who is signalled.
ALLOWED_IOCTL = (0x5401, 0x802C542A, 0x5413, 0x541B, 0x5421, 0x5450, 0x5451)

# MADV_MERGEABLE, MADV_COLD, MADV_PAGEOUT: pages shared with others, and out of the memory of all.
REFUSED_MADVISE = (12, 20, 21)
# PR_SET_PDEATHSIG, PR_SET_DUMPABLE, PR_SET_CHILD_SUBREAPER, PR_SET_IO_FLUSHER, PR_SCHED_CORE and
# PR_SET_PTRACER: a child ends with its grader, leaves no image of itself and lets nobody in.
REFUSED_PRCTL = (1, 4, 36, 57, 62, 0x59616D61)

AUDIT_ARCH = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}
LOAD, EQUAL, GREATER, ANY_BIT, RETURN = 0x20, 0x15, 0x25, 0x45, 0x06
ALLOW, ERROR = 0x7FFF0000, 0x00050000
REFUSE, UNKNOWN = ERROR | errno.EPERM, ERROR | errno.ENOSYS
NUMBER, ARCHITECTURE, ARGUMENTS = 0, 4, 16  # offsets in struct seccomp_data

OF_ANOTHER = 0x80000000  # a clock whose number is negative: how long some process has worked

ANY_PID = 0xFEDCBA98  # stands for a number that no process has

Instruction = tuple[int, int, int, int]  # code, jump if true, jump if false, value


class Program(ctypes.Structure):
    """struct sock_fprog: how many instructions, and where they are."""

    _fields_ = [("length", ctypes.c_ushort), ("filter", ctypes.c_char_p)]


def load(offset: int) -> list[Instruction]:
    """Look at these four bytes of struct seccomp_data."""
    return [(LOAD, 0, 0, offset)]


def argument(index: int, upper: bool = False) -> list[Instruction]:
    """Look at the lower or upper half of an argument; both machines are little-endian."""
    return load(ARGUMENTS + 8 * index + 4 * upper)


def answer(value: int) -> list[Instruction]:
    return [(RETURN, 0, 0, value)]


def when(test: int, value: int, then: list[Instruction]) -> list[Instruction]:
    """Do `then` where the test holds, and go on after it where it does not."""
    return [(test, 0, len(then), value), *then]


def unless_equal(value: int, then: list[Instruction]) -> list[Instruction]:
    return [(EQUAL, len(then), 0, value), *then]


def null(index: int) -> list[Instruction]:
    """Allow a call where this pointer is NULL."""
    lower = argument(index) + unless_equal(0, answer(REFUSE))
    return lower + argument(index, upper=True) + unless_equal(0, answer(REFUSE)) + answer(ALLOW)


def one_of(values: Sequence[int], inside: int, outside: int) -> list[Instruction]:
    """Return `inside` for each of these values, fewer than 256, and `outside` for the rest."""
    end = len(values)
    tests = [(EQUAL, end - index, 0, value) for index, value in enumerate(values)]
    return tests + answer(outside) + answer(inside)


def checked(pid: int) -> dict[str, list[Instruction]]:
    """Return the calls that hang on their arguments, for the process with this number."""
    own = argument(0) + one_of((pid,), ALLOW, REFUSE)
    clock = argument(0) + when(ANY_BIT, OF_ANOTHER, answer(REFUSE)) + answer(ALLOW)
    return {
        "clone": argument(0)
        + when(ANY_BIT, CLONE_NEW, answer(REFUSE))
        + when(ANY_BIT, CLONE_THREAD, answer(ALLOW))
        + answer(REFUSE),
        "kill": own,
        "tgkill": own,  # abort() ends the program by it
        "prlimit64": null(2),  # limits may be read
        "sendto": null(4),  # the channel and pairs of sockets are connected: nobody else is named
        "socketpair": argument(0) + one_of((AF_UNIX,), ALLOW, REFUSE),  # of this process: asyncio
        "fcntl": argument(1) + one_of(REFUSED_FCNTL, REFUSE, ALLOW),
        "ioctl": argument(1) + one_of(ALLOWED_IOCTL, ALLOW, REFUSE),
        "madvise": argument(2) + one_of(REFUSED_MADVISE, REFUSE, ALLOW),
        "prctl": argument(0) + one_of(REFUSED_PRCTL, REFUSE, ALLOW),
        "preadv2": argument(5) + one_of((0,), ALLOW, REFUSE),  # RWF_NOWAIT tells what is read
        "clock_gettime": clock,
        "clock_getres": clock,
        "clock_nanosleep": clock,
        "timer_create": clock,
    }


def program(machine: str, pid: int) -> list[Instruction]:
    """Return the filter for a machine such as `x86_64`, and the process that takes it."""
    column = list(AUDIT_ARCH).index(machine)
    text = load(ARCHITECTURE) + unless_equal(AUDIT_ARCH[machine], answer(REFUSE)) + load(NUMBER)
    text += when(GREATER, LAST, answer(UNKNOWN))
    text += when(EQUAL, UNSEEN["clone3"][column], answer(UNKNOWN))
    for name, body in checked(pid).items():
        text += when(EQUAL, CHECKED[name][column], body)
    numbers = [each[column] for each in REFUSED.values()]
    return text + one_of([each for each in numbers if each is not None], REFUSE, ALLOW)


@cache
def packed() -> bytes:
    """Return the filter of this machine as the kernel takes it, with ANY_PID for the process; or
    nothing.

    There is none on another machine than the two, or for a Python of 32 bits. Known before a fork,
    it is known in the child: to put it together takes as long as to make a root.
    """
    machine = platform.machine()
    if sys.platform != "linux" or machine not in AUDIT_ARCH or sys.maxsize < 2**32:
        return b""
    return b"".join(struct.pack("HBBI", *each) for each in program(machine, ANY_PID))


def refuse_system_calls() -> list[str]:
    """Take the filter for good, on this thread and those it starts; returns the layer if it holds.

    Some kernels were built without filters.
    """
    text = packed().replace(struct.pack("I", ANY_PID), struct.pack("I", os.getpid()))
    if not text:
        return []
    taken = Program(len(text) // 8, text)
    libc().prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    if libc().prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, ctypes.byref(taken), 0, 0):
        return []
    return ["system-calls"]
