"""Where in a folder the work lies, and what lies about there besides."""

from pathlib import Path

from grader.judge.rubric import load_rubric
from grader.judge.submission import IGNORED

DEEPEST = 3  # folders around a program, and archives inside archives
SYSTEM_FILES = {"thumbs.db", "desktop.ini", "__macosx"}  # and all that is hidden
SIGNS = (b"7z\xbc\xaf", b"Rar!", b"\x1f\x8b", b"BZh", b"\xfd7zXZ")  # of what is no zip
ARCHIVES = (".zip", ".7z", ".rar", ".tar", ".tgz", ".tbz2", ".txz", ".gz", ".bz2", ".xz")


def entries_of(folder: Path) -> list[Path]:
    """What lies in a folder, in a fixed order, without what desktops leave behind."""
    return sorted(path for path in folder.iterdir() if not is_system_file(path.name))


def is_system_file(name: str) -> bool:
    return name.startswith(".") or name.lower() in SYSTEM_FILES


def is_archive(path: Path) -> bool:
    """By its name; what has no suffix is looked into."""
    if path.suffix or not path.is_file():
        return path.suffix.lower() in ARCHIVES
    with open(path, "rb") as file:
        return file.read(8).startswith((b"PK\x03\x04", *SIGNS))


def stem_of(path: Path) -> str:
    """A file's name without its suffix, of which `work.tar.gz` has two."""
    packed = path.suffix.lower() in ARCHIVES
    stem = path.stem if packed else path.name
    return stem[:-4] if packed and stem.lower().endswith(".tar") else stem


def unwrapped(folder: Path) -> Path:
    """Where there is no program: as far in as each folder holds but one other."""
    for _ in range(DEEPEST):
        inside = [path for path in folder.iterdir() if not is_system_file(path.name)]
        if len(inside) != 1 or inside != folders_in(folder) or inside[0].name == "notebooks":
            break
        folder = inside[0]
    return folder


def folders_in(folder: Path) -> list[Path]:
    return [
        path
        for path in entries_of(folder)
        if path.is_dir() and not path.is_symlink() and path.name not in IGNORED
    ]


def holds_program(folder: Path) -> bool:
    return bool(programs_in(folder))


def programs_in(folder: Path) -> frozenset[str]:
    """The modules that the rubric asks for and that lie in this folder itself."""
    return frozenset(
        name for name in modules() if (folder / name).is_dir() or (folder / f"{name}.py").is_file()
    )


def modules() -> frozenset[str]:
    return frozenset(todo.module for todo in load_rubric().todos)
