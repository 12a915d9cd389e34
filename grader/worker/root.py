"""Make a root folder for one child: Python, its packages and the child's folder, nothing else.

Landlock restricts opening. A file that has no name in a child's root cannot be listed, changed in
its mode, or used as a socket either.

The warm process makes the shared part once, in its own mount namespace: a file system in memory, to
which the folders that Python needs are bound, read-only. A child copies it into namespaces of its
own, adds its own folders, and makes it its root. The numbers are those of <sys/mount.h> and
<linux/capability.h>; see mount(2), pivot_root(2), capabilities(7).
"""

import ctypes
import os
import platform
import struct
from collections.abc import Iterable
from functools import cache
from pathlib import Path

import msgspec

from grader.protocol import ChildSetup, Limits

CLONE_NEWNS = 0x00020000
MS_RDONLY, MS_NOSUID, MS_NODEV, MS_NOEXEC = 1 << 0, 1 << 1, 1 << 2, 1 << 3
MS_REMOUNT, MS_BIND, MS_REC, MS_SLAVE = 1 << 5, 1 << 12, 1 << 14, 1 << 19
LOCKED = MS_NOSUID | MS_NODEV | MS_NOEXEC  # the flags that a copy of a mount must keep
MNT_DETACH = 2
PR_CAPBSET_DROP, CAPABILITIES = 24, 64  # the size of a set of two words
CAPABILITY_VERSION_3 = 0x20080522
PIVOT_ROOT = {"x86_64": 155, "aarch64": 41}

# Folders without Python and submissions: the new root is mounted over one of them.
PLACES = ("/sys", "/mnt", "/media", "/srv", "/boot")
TOPS = ("/check", "/check-of-a-grade")  # a child's own folders are below one of them


@cache
def libc() -> ctypes.CDLL:
    """Return the C library, for calls that Python lacks; load it once, before the fork."""
    return ctypes.CDLL(None, use_errno=True)


def mount(source: str | None, target: str, kind: str | None, flags: int, data: str = "") -> None:
    """Call mount(2); raises OSError."""
    words = [each and os.fsencode(each) for each in (source, target, kind)]
    if libc().mount(*words, flags, data.encode() or None):
        raise OSError(ctypes.get_errno(), "mount", target)


def show(source: str, target: str, flags: int = MS_RDONLY) -> None:
    """Bind a file or folder to `target`; read-only unless other flags are given."""
    mount(source, target, None, MS_BIND | MS_REC)
    kept = os.statvfs(target).f_flag & LOCKED
    mount(None, target, None, MS_BIND | MS_REMOUNT | MS_NOSUID | flags | kept)


def file_system_in_memory(target: str, limits: Limits) -> None:
    """Mount a file system in memory, which ends with the last process that sees it."""
    size = f"size={limits.scratch_mb}m,nr_inodes={limits.scratch_files}"
    mount("tmpfs", target, "tmpfs", LOCKED, size)


class Root:
    """The shared part, mounted at `place`; a child's own folders are below `top`."""

    def __init__(self, place: str, top: str) -> None:
        self.place, self.top = place, top

    def lay_out(self, paths: Iterable[Path], links: Iterable[Path]) -> None:
        """Bind the paths, and make the links to them, such as /lib."""
        mount("tmpfs", self.place, "tmpfs", LOCKED, "size=1m,mode=755")
        bound: list[Path] = []
        for path in sorted(paths):
            if any(path.is_relative_to(each) for each in bound):
                continue
            target = Path(self.place + str(path))
            folder = target if path.is_dir() else target.parent
            folder.mkdir(parents=True, exist_ok=True)
            if not path.is_dir():
                target.touch()
            show(str(path), str(target))
            bound.append(path)
        for link in links:
            target = Path(self.place + str(link))
            if not os.path.lexists(target):
                target.parent.mkdir(parents=True, exist_ok=True)
                target.symlink_to(os.path.relpath(link.resolve(), link.parent))
        for name in ("submission", "bytecode", "scratch"):
            Path(self.place + self.top, name).mkdir(parents=True)
        mount(None, self.place, None, MS_BIND | MS_REMOUNT | MS_RDONLY | LOCKED)

    def enter(self, setup: ChildSetup) -> ChildSetup:
        """Make it the root of this process, in its own mount namespace; return the new paths.

        Raises OSError; only failures of the last two calls leave changes behind.
        """
        mount(self.place, self.place, None, MS_BIND | MS_REC)  # of this namespace
        own = self.place + self.top
        show(setup.submission, f"{own}/submission")
        show(setup.bytecode, f"{own}/bytecode", flags=0 if setup.compiles else MS_RDONLY)
        file_system_in_memory(f"{own}/scratch", setup.limits)
        os.chdir(self.place)
        if libc().syscall(PIVOT_ROOT[platform.machine()], b".", b"."):
            raise OSError(ctypes.get_errno(), "pivot_root", self.place)
        if libc().umount2(b".", MNT_DETACH):  # the old root lies over the new one
            os._exit(1)
        os.chdir("/")
        return msgspec.structs.replace(
            setup,
            submission=f"{self.top}/submission",
            bytecode=f"{self.top}/bytecode",
            scratch=f"{self.top}/scratch",
        )


LAID_OUT: dict[tuple[Path, ...], Root] = {}  # with the paths in it


def shared_root(paths: tuple[Path, ...], links: tuple[Path, ...]) -> Root | None:
    """Make the shared part in a new mount namespace; return None if that is not allowed.

    Children inherit the part that the warm process made. If the warm process was not allowed to, a
    child with a user namespace is.
    """
    if paths in LAID_OUT:
        return LAID_OUT[paths]
    used = [*paths, *links, *(Path(each.place) for each in LAID_OUT.values())]
    place = next((each for each in PLACES if os.path.isdir(each) and free(each, used)), None)
    top = next((each for each in TOPS if free(each, used)), None)
    if platform.machine() not in PIVOT_ROOT or place is None or top is None:
        return None
    if libc().unshare(CLONE_NEWNS):
        return None
    root = Root(place, top)
    try:
        mount(None, "/", None, MS_REC | MS_SLAVE)  # our mounts stay invisible outside
        root.lay_out(paths, links)
    except OSError:
        return None
    LAID_OUT[paths] = root
    return root


def free(folder: str, used: Iterable[Path]) -> bool:
    """Return whether no path that we use lies in this folder."""
    return not any(each.is_relative_to(folder) for each in used)


def drop_capabilities() -> None:
    """Give up for good the rights of a namespace's root."""
    for capability in range(CAPABILITIES):
        libc().prctl(PR_CAPBSET_DROP, capability, 0, 0, 0)
    header = struct.pack("Ii", CAPABILITY_VERSION_3, 0)
    libc().capset(header, bytes(24))
