"""Find the work in a folder, without files that desktops leave there."""

from pathlib import Path, PurePath

from grader.judge.plain import open_plain
from grader.judge.rubric import load_rubric

DEEPEST = 3  # archives inside archives
SYSTEM_FILES = {"thumbs.db", "desktop.ini", "__macosx", "icon\r"}  # and all that is hidden
SIGNS = (
    b"7z\xbc\xaf",
    b"Rar!",
    b"\x1f\x8b",
    b"BZh",
    b"\xfd7zXZ",
)  # the first bytes of archives that are no zip
ARCHIVES = (".zip", ".7z", ".rar", ".tar", ".tgz", ".tbz2", ".txz", ".gz", ".bz2", ".xz")


def list_folder(folder: Path) -> list[Path]:
    """Return the sorted contents of a folder, without files that desktops leave there."""
    return sorted(path for path in folder.iterdir() if not is_system_file(path.name))


def is_system_file(name: str) -> bool:
    return name.startswith(".") or name.lower() in SYSTEM_FILES


def is_archive(path: Path) -> bool:
    """Return whether a path is an archive, by its suffix or, without one, its first bytes."""
    if path.suffix or not path.is_file():
        return is_packed(path, b"")
    real = path.resolve()
    with open_plain(real.parent, real.name) as file:
        return is_packed(path, file.read(8))


def is_packed(name: PurePath, head: bytes) -> bool:
    """Return whether a file is an archive, by its name or, without a suffix, by its first bytes."""
    if name.suffix:
        return name.suffix.lower() in ARCHIVES
    return head.startswith((b"PK\x03\x04", *SIGNS))


def cut_suffix(path: Path) -> str:
    """Return a name without an archive's suffix, such as `.tar.gz`."""
    packed = path.suffix.lower() in ARCHIVES
    stem = path.stem if packed else path.name
    return stem[:-4] if packed and stem.lower().endswith(".tar") else stem


def has_program(folder: Path) -> bool:
    """Return whether a program of the lab lies in this folder itself."""
    return any(
        (folder / name).is_dir() or (folder / f"{name}.py").is_file() for name in list_modules()
    )


def list_modules() -> frozenset[str]:
    return frozenset(load_rubric().modules)
