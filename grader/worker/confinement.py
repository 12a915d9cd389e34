"""Confine a child, in layers. Each layer that the machine has is used and named in reports.

isolate_server runs once, in the warm process; confine runs in each child, before it imports the
submission. Each layer has its own purpose and does not depend on the others. root.py makes the root
folder of a child, filter.py the filter on system calls.

The numbers are those of <linux/landlock.h>, <sys/prctl.h> and <sched.h>; see landlock(7).
"""

import ctypes
import itertools
import os
import platform
import re
import signal
import sys
import sysconfig
from collections.abc import Collection, Iterable, Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path

from grader.protocol import ENVIRONMENT, ChildSetup, Limits
from grader.worker.filter import pack_filter, refuse_system_calls
from grader.worker.root import (
    CLONE_NEWNS,
    MS_REC,
    MS_SLAVE,
    Root,
    drop_capabilities,
    file_system_in_memory,
    libc,
    mount,
    shared_root,
)

LANDLOCK_CREATE_RULESET, LANDLOCK_ADD_RULE, LANDLOCK_RESTRICT_SELF = 444, 445, 446
LANDLOCK_CREATE_RULESET_VERSION = 1
LANDLOCK_RULE_PATH_BENEATH = 1
PR_SET_PDEATHSIG, PR_SET_DUMPABLE = 1, 4
PR_SET_NO_NEW_PRIVS = 38
PR_SET_CHILD_SUBREAPER = 36
KEYCTL, KEYCTL_JOIN_SESSION_KEYRING = {"x86_64": 250, "aarch64": 219}, 1
CLONE_NEWIPC, CLONE_NEWUSER = 0x08000000, 0x10000000
CLONE_NEWPID, CLONE_NEWNET, CLONE_NEWUTS = 0x20000000, 0x40000000, 0x04000000

EXECUTE, WRITE_FILE, READ_FILE, READ_DIR = 1 << 0, 1 << 1, 1 << 2, 1 << 3
READ_ONLY = EXECUTE | READ_FILE | READ_DIR
EVERY_RIGHT = (1 << 16) - 1
FILE_RIGHTS = {1: 13, 2: 14, 3: 15, 4: 15, 5: 16}  # their number, by version of Landlock
ON_FILES = EXECUTE | WRITE_FILE | READ_FILE | 1 << 14 | 1 << 15  # rights of a rule on a plain file
TCP_BIND_AND_CONNECT = 0b11
SCOPE_SOCKETS_AND_SIGNALS = 0b11

PID_MAX_SINCE, MOST_NUMBERS = (6, 14), 512

# No account has these user ids: systemd assigns them to services for a while (DynamicUser).
UNUSED_UIDS = range(61184, 65520)


class RulesetAttr(ctypes.Structure):
    """struct landlock_ruleset_attr: the rights that are denied unless a rule allows them."""

    _fields_ = [
        ("handled_access_fs", ctypes.c_uint64),
        ("handled_access_net", ctypes.c_uint64),
        ("scoped", ctypes.c_uint64),
    ]


class PathBeneathAttr(ctypes.Structure):
    """struct landlock_path_beneath_attr: the rights on one file or folder and all below it."""

    _pack_, _layout_ = 1, "ms"  # Python 3.14 needs the second too
    _fields_ = [("allowed_access", ctypes.c_uint64), ("parent_fd", ctypes.c_int32)]


def isolate_server(keep: int, without: Collection[str] = ()) -> list[str]:
    """Cut the warm process off from the network and other processes; return the layers.

    Otherwise a submission could send the questions out, or signal and trace the judge. The call may
    return in a child process, the first of a PID namespace, whose end ends all others in there.
    The calling process then only waits for it. `keep`, the control socket, belongs to that child
    alone, so that the judge sees its end at once.
    """
    if not sys.platform.startswith("linux"):
        return []
    libc().prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)  # stray grandchildren come back here
    layers = []
    if "network-namespace" not in without and leave_network():
        layers.append("network-namespace")
        forget_host_name()
    if "pid-namespace" not in without and libc().unshare(CLONE_NEWPID) == 0:
        layers.append("pid-namespace")
        first = os.fork()
        if first:
            os.close(keep)
            os._exit(os.waitstatus_to_exitcode(os.waitpid(first, 0)[1]) & 0xFF)
        libc().prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
        bound_namespace()
    return layers


def leave_network() -> bool:
    return libc().unshare(CLONE_NEWNET) == 0 or enter_user_namespace(CLONE_NEWNET)


def shut_in_reader(source: str, folder: str, programs: Iterable[str]) -> list[str]:
    """Confine a process that reads one file for us; return the layers in force.

    It may read that file, Python and its packages, write into one folder, and run the given
    programs or those in given folders. Without programs it starts no process.
    """
    if not sys.platform.startswith("linux"):
        return []
    programs = [each for each in programs if os.path.exists(each)]
    layers = ["network-namespace"] if leave_network() else []
    allowed = [
        (path, READ_ONLY if is_folder else READ_ONLY & ON_FILES)
        for path, is_folder in kinds_of_paths(())
    ]
    allowed += [(each, READ_ONLY) for each in programs]
    allowed += [(source, READ_FILE), (folder, EVERY_RIGHT), (os.devnull, READ_FILE | WRITE_FILE)]
    allowed += [("/proc/meminfo", READ_FILE)]  # a reader of .7z uses more if memory is free
    layers += restrict_to(allowed)
    return layers if programs else layers + refuse_system_calls()


def forget_host_name() -> None:
    """Hide the machine's host name from this process and its children, where allowed."""
    if libc().unshare(CLONE_NEWUTS) == 0:
        libc().sethostname(b"check", 5)
        libc().setdomainname(b"", 0)


def wipe_variables() -> None:
    """Overwrite in memory the values of all environment variables but the kit's."""
    if not sys.platform.startswith("linux"):
        return
    places = ctypes.POINTER(ctypes.c_void_p).in_dll(libc(), "environ")
    for place in itertools.takewhile(bool, map(places.__getitem__, itertools.count())):
        name, _, value = ctypes.string_at(place).partition(b"=")
        if name.decode("ascii", "replace") not in ENVIRONMENT:
            ctypes.memset(place + len(name) + 1, ord("x"), len(value))


def bound_namespace() -> None:
    """Limit processes and threads in this namespace: rlimits do not bind root.

    A PID namespace has its own limit since Linux 6.14; before, the limit is the machine's.
    """
    release = tuple(map(int, re.findall(r"\d+", platform.release())[:2]))
    if release >= PID_MAX_SINCE:
        with suppress(OSError):
            write("/proc/sys/kernel/pid_max", str(MOST_NUMBERS))


def confine(setup: ChildSetup, without: Collection[str] = ()) -> tuple[list[str], ChildSetup]:
    """Give up this process's rights for good; return the layers in force, and the setup.

    The setup has the paths in the child's own root, if there is one. `without` names layers to
    leave out: `landlock-files` means all of Landlock, `user-namespace` also the root and the
    namespaces that it allows.
    """
    if not setup.confine:
        return [], setup
    layers = []
    if hasattr(os, "setsid"):
        with suppress(PermissionError):  # a spawned child leads its session already
            os.setsid()
        layers.append("process-group")
    layers += set_resource_limits(setup.limits)
    if sys.platform.startswith("linux"):
        join_own_keyring()
        # A user namespace of ours has one user only. Without Landlock, a user of its own protects
        # files, so it comes first; then the namespace may be refused.
        landlock = "landlock-files" not in without and landlock_version() >= 1
        own_user = "own-user" not in without
        if not landlock and own_user:
            layers += become_own_user(setup)
        if "user-namespace" not in without:
            entered, setup = enter_own_namespaces(setup, root="own-root" not in without)
            layers += entered
        if "user-namespace" not in layers and own_user and "own-user" not in layers:
            layers += become_own_user(setup)
        if landlock:
            layers += restrict_with_landlock(setup)
        drop_capabilities()
        # The child ends with its parent. A change of user would undo this, so it comes last.
        libc().prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
    return layers, setup


def join_own_keyring() -> None:
    """Join a session keyring of this process alone, so that no key remains for the next check."""
    number = KEYCTL.get(platform.machine())
    if number is not None:
        libc().syscall(number, KEYCTL_JOIN_SESSION_KEYRING, None)


def become_own_user(setup: ChildSetup) -> list[str]:
    """Turn root into a user who owns only the scratch folder; each child gets another user.

    Root could write anywhere, and children of the same user could signal and trace each other. Does
    nothing if that user could not read Python or the submission.
    """
    if os.geteuid() != 0:
        return []
    user = UNUSED_UIDS[os.getpid() % len(UNUSED_UIDS)]
    needed = [*map(str, readable_paths(tuple(setup.hidden))), setup.submission, setup.scratch]
    own = [setup.scratch] + [setup.bytecode] * setup.compiles
    reached = False
    with suppress(OSError):  # a container may lack the right or the user id
        os.chmod(Path(setup.submission).parent, 0o711)  # may be entered, not listed
        for folder in own:
            os.chown(folder, user, user)
        os.setgroups([])
        os.setegid(user)
        os.seteuid(user)
        reached = all(os.access(each, os.R_OK, effective_ids=True) for each in needed)
    os.seteuid(0)
    os.setegid(0)
    if not reached:
        with suppress(OSError):
            for folder in own:
                os.chown(folder, 0, 0)
        return []
    os.setresgid(user, user, user)
    os.setresuid(user, user, user)
    libc().prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    libc().prctl(PR_SET_DUMPABLE, 1, 0, 0, 0)  # owns /proc/self again, for the namespaces to come
    return ["own-user"]


def prepare(setup: ChildSetup, without: Collection[str] = ()) -> None:
    """Compute in the warm process, once, what every forked child needs."""
    kinds_of_paths(tuple(setup.hidden))
    pack_filter()
    if sys.platform.startswith("linux") and not {"own-root", "user-namespace"} & set(without):
        own_root(setup)


def own_root(setup: ChildSetup) -> Root | None:
    """Return the shared part of the roots; None if this process may not mount."""
    hidden = tuple(setup.hidden)
    paths = (*readable_paths(hidden), Path(os.devnull))
    return shared_root(paths, tuple(links_to_libraries()))


def enter_own_namespaces(setup: ChildSetup, root: bool) -> tuple[list[str], ChildSetup]:
    """Give this child its own files, shared memory, keys and scratch folder.

    Otherwise one check could leave a message there for a later one, such as answers of the
    reference. The scratch folder becomes a small file system in memory, which ends with the child.
    Returns the layers, and the setup with the new paths.
    """
    if not enter_user_namespace(CLONE_NEWIPC | CLONE_NEWNS):
        return [], setup
    layers = ["user-namespace", "ipc-namespace"]
    with suppress(OSError):  # some systems allow namespaces, and no mounts in them
        mount(None, "/", None, MS_REC | MS_SLAVE)
        made = own_root(setup) if root else None
        if made is not None:
            return [*layers, "mount-namespace", "own-root"], made.enter(setup)
    with suppress(OSError):
        file_system_in_memory(setup.scratch, setup.limits)
        layers.append("mount-namespace")
    return layers, setup


def enter_user_namespace(others: int) -> bool:
    """Enter a user namespace and, as it allows this, the `others` (CLONE_ flags).

    User and group are mapped to themselves. Returns whether the kernel allowed it.
    """
    user, group = os.getuid(), os.getgid()
    if libc().unshare(CLONE_NEWUSER | others) != 0:
        return False
    with suppress(OSError):  # unmapped, files keep their owners
        write("/proc/self/setgroups", "deny")
        write("/proc/self/uid_map", f"{user} {user} 1")
        write("/proc/self/gid_map", f"{group} {group} 1")
    return True


def write(path: str, text: str) -> None:
    """Write into a file of the kernel's, in one call."""
    descriptor = os.open(path, os.O_WRONLY)
    try:
        os.write(descriptor, text.encode())
    finally:
        os.close(descriptor)


def set_resource_limits(limits: Limits) -> list[str]:
    """Limit processor time, memory, file sizes, open files and processes, in units of Limits.

    At the soft limit of processor time a child gets SIGXCPU; one that ignores it is killed a second
    later.
    """
    try:
        import resource
    except ImportError:
        return []
    megabyte = 1024 * 1024
    seconds = limits.cpu_seconds
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    for name, value in (
        (resource.RLIMIT_AS, limits.memory_mb * megabyte),
        (resource.RLIMIT_DATA, limits.data_mb * megabyte),
        (resource.RLIMIT_FSIZE, limits.file_mb * megabyte),
        (resource.RLIMIT_NOFILE, limits.open_files),
        (resource.RLIMIT_NPROC, limits.processes),
        (resource.RLIMIT_CORE, 1),  # a byte: with 0 Linux may still hand the image to a program
    ):
        with suppress(ValueError, OSError):  # macOS knows no limit on memory
            resource.setrlimit(name, (value, value))
    return ["rlimits"]


@cache
def readable_paths(hidden: tuple[str, ...]) -> list[Path]:
    """Return the paths that Python and its packages need to read, without hidden ones.

    If the kit is installed among the packages, the list has the entries beside it in place of the
    folder. No path is a link.
    """
    kept_out = {Path(each).resolve() for each in hidden}
    return sorted({each for root in libraries() for each in list_without(kept_out, root.resolve())})


def list_without(kept_out: set[Path], path: Path) -> Iterator[Path]:
    """Yield the path, or if some of `kept_out` lie below it, the entries beside them."""
    if not any(each.is_relative_to(path) for each in kept_out):
        yield path
    elif path not in kept_out:
        for below in path.iterdir():
            yield from list_without(kept_out, below)


@cache
def kinds_of_paths(hidden: tuple[str, ...]) -> list[tuple[str, bool]]:
    """Return the readable paths, each with a flag for a folder."""
    return [(str(path), path.is_dir()) for path in readable_paths(hidden)]


@cache
def libraries() -> list[Path]:
    """Return the folders of Python, its packages and the C library, by their usual names."""
    paths = sysconfig.get_paths()
    roots = [Path(sys.base_prefix, "lib")]
    roots += [Path(paths[name]) for name in ("stdlib", "platstdlib", "purelib", "platlib")]
    roots += map(Path, ("/usr/lib", "/usr/lib64", "/lib", "/lib64", "/etc/ld.so.cache"))
    roots += map(Path, ("/usr/local/lib", "/usr/share/zoneinfo", "/dev/urandom"))
    return [each for each in roots if each.exists()]


@cache
def links_to_libraries() -> list[Path]:
    """Return the links among these folders, such as /lib."""
    return [each for each in libraries() if each.resolve() != each]


def landlock_version() -> int:
    """Return the version of the kernel's Landlock; less than 1 if there is none."""
    version: int = libc().syscall(LANDLOCK_CREATE_RULESET, None, 0, LANDLOCK_CREATE_RULESET_VERSION)
    return version


def restrict_with_landlock(setup: ChildSetup) -> list[str]:
    """Allow reading Python and the submission and writing the scratch folder; no TCP, no signals.

    This keeps the kit, the solution, other submissions and home folders unreadable.
    """
    allowed = [
        (path, READ_ONLY if folder else READ_ONLY & ON_FILES)
        for path, folder in kinds_of_paths(tuple(setup.hidden))
    ]
    allowed += [
        (setup.submission, READ_ONLY),
        (setup.bytecode, EVERY_RIGHT if setup.compiles else READ_ONLY),
        (setup.scratch, EVERY_RIGHT),
        (os.devnull, READ_FILE | WRITE_FILE),
    ]
    return restrict_to(allowed)


def restrict_to(allowed: Iterable[tuple[str, int]]) -> list[str]:
    """Allow these rights on these paths and no others, for good; return the layers in force.

    A ruleset denies only the rights that it handles, so it handles all that this kernel knows.
    """
    version = landlock_version()
    if version < 1:
        return []
    every_right = (1 << FILE_RIGHTS.get(version, 16)) - 1
    attr = RulesetAttr(
        every_right,
        TCP_BIND_AND_CONNECT if version >= 4 else 0,
        SCOPE_SOCKETS_AND_SIGNALS if version >= 6 else 0,
    )
    size = 8 if version < 4 else 16 if version < 6 else 24
    ruleset = libc().syscall(LANDLOCK_CREATE_RULESET, ctypes.byref(attr), size, 0)
    if ruleset < 0:
        return []
    for path, rights in allowed:
        allow_beneath(ruleset, path, rights & every_right)
    libc().prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    enforced = libc().syscall(LANDLOCK_RESTRICT_SELF, ruleset, 0) == 0
    os.close(ruleset)
    if not enforced:
        return []
    return (
        ["landlock-files"] + ["landlock-tcp"] * (version >= 4) + ["landlock-scope"] * (version >= 6)
    )


def allow_beneath(ruleset: int, path: str, rights: int) -> None:
    """Add a rule: these rights on this path and everything below it."""
    descriptor = os.open(path, os.O_PATH | os.O_CLOEXEC)
    try:
        rule = PathBeneathAttr(rights, descriptor)
        libc().syscall(
            LANDLOCK_ADD_RULE, ruleset, LANDLOCK_RULE_PATH_BENEATH, ctypes.byref(rule), 0
        )
    finally:
        os.close(descriptor)
