"""Hash the grader: results stay valid while the hash is the same.

A file counts if points may depend on it: the checks, the judge, the worker and shared files.
Reports and commands do not count.
"""

import hashlib
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

DECIDING = (  # of grader/
    *("checks", "judge", "source", "worker"),
    *("errors.py", "protocol.py", "text.py"),
)
READ = (".py", ".toml", ".json", ".ini")  # loaded by Python and by the checks
LIBRARIES = ("hypothesis", "msgspec", "pygame-ce", "pymunk", "pytest")


@cache
def fingerprint() -> str:
    """Return the hash of the grader and its libraries, as far as points depend on them."""
    from importlib.metadata import version  # slow to load

    top = Path(__file__).parents[1]
    digest = hashlib.sha256()
    for path in deciding_files(top):
        digest.update(f"{path.relative_to(top).as_posix()}\0".encode() + path.read_bytes() + b"\0")
    releases = [f"{name} {version(name)}" for name in LIBRARIES]
    digest.update(f"{sys.version_info[:2]} {releases}".encode())
    return digest.hexdigest()


def deciding_files(top: Path) -> Iterator[Path]:
    """Yield the files of the grader that count, in a fixed order."""
    for path in sorted(top.rglob("*")):
        if path.suffix in READ and path.relative_to(top).parts[0] in DECIDING:
            yield path
