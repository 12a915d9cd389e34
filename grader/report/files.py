"""Write results and archives as files."""

import os
import zipfile
from pathlib import Path

import msgspec

from grader.errors import Stop
from grader.judge.result import Result

DAY_ONE = (1980, 1, 1, 0, 0, 0)  # the earliest time in an archive
PLAIN, SCRIPT = 0o100644, 0o100755  # modes of a file


def as_json(result: Result) -> bytes:
    """Return the JSON of `--json`, indented for people."""
    return msgspec.json.format(msgspec.json.encode(result)) + b"\n"


def write_json(result: Result, path: Path) -> None:
    write_whole(as_json(result), path)


def read_result(path: Path) -> Result:
    """Read a result. Raises Stop if there is none in the file."""
    try:
        return msgspec.json.decode(path.read_bytes(), type=Result)
    except OSError as error:
        raise Stop(f"there is no result at {path} ({error.strerror})") from error
    except msgspec.MsgspecError as error:
        raise Stop(f"{path} is no result of the grader ({error})") from error


def write_whole(content: bytes, path: Path) -> None:
    """Write a file completely or not at all, and never through a link."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{os.urandom(8).hex()}")
    try:
        with open(part, "xb") as file:
            file.write(content)
        os.replace(part, path)
    except OSError:
        part.unlink(missing_ok=True)
        raise


def put_in(
    archive: zipfile.ZipFile,
    name: str,
    content: bytes,
    mode: int = PLAIN,
    method: int = zipfile.ZIP_DEFLATED,
) -> None:
    """Put a file into an archive; the same files make the same archive on any day."""
    member = zipfile.ZipInfo(name, DAY_ONE)
    member.compress_type = method
    member.external_attr = mode << 16
    archive.writestr(member, content)
