"""The result as a file."""

import os
from pathlib import Path

import msgspec

from grader.judge.result import Result


def as_json(result: Result) -> bytes:
    """The JSON of `--json`, indented for people."""
    return msgspec.json.format(msgspec.json.encode(result)) + b"\n"


def write_json(result: Result, path: Path) -> None:
    write_whole(as_json(result), path)


def write_whole(content: bytes, path: Path) -> None:
    """Write it whole or not at all: a reader never meets half a file, and no link is followed."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{os.urandom(8).hex()}")
    with open(part, "xb") as file:
        file.write(content)
    os.replace(part, path)
