"""Make archives of every kind."""

import io
import tarfile
import zipfile
import zlib
from collections.abc import Iterable
from pathlib import Path
from unittest.mock import patch

import py7zr

Files = dict[str, str | bytes]


def as_bytes(content: str | bytes) -> bytes:
    return content.encode() if isinstance(content, str) else content


def put(folder: Path, files: Files) -> Path:
    """Write files into a folder, and return it."""
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(as_bytes(content))
    return folder


def as_zip(files: Files, how: int = zipfile.ZIP_DEFLATED) -> bytes:
    return as_zip_of(files.items(), how)


def as_zip_of(members: Iterable[tuple[str, str | bytes]], how: int = zipfile.ZIP_DEFLATED) -> bytes:
    """Make a zip with these members; two may have the same name."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", how) as archive:
        for name, content in members:
            archive.writestr(name, content)
    return out.getvalue()


def as_tar(files: Files, how: str = "gz", *links: tarfile.TarInfo) -> bytes:
    out = io.BytesIO()
    with tarfile.open(fileobj=out, mode=f"w:{how}") as archive:
        for link in links:
            archive.addfile(link)
        for name, content in files.items():
            member = tarfile.TarInfo(name)
            member.size = len(as_bytes(content))
            archive.addfile(member, io.BytesIO(as_bytes(content)))
    return out.getvalue()


def as_7z(files: Files, password: str | None = None) -> bytes:
    out = io.BytesIO()
    anything = patch("py7zr.py7zr.check_archive_path", return_value=True)
    with anything, py7zr.SevenZipFile(out, "w", password=password) as archive:
        for name, content in files.items():
            archive.writestr(as_bytes(content), name)
    return out.getvalue()


def as_rar(files: Files) -> bytes:
    """Make a RAR 5 archive of uncompressed files."""
    out = bytearray(b"Rar!\x1a\x07\x01\x00" + block(number(1) + number(0) + number(0)))
    for name, content in files.items():
        body, title = as_bytes(content), name.encode()
        head = number(2) + number(2) + number(len(body))  # a file, with data behind it
        head += number(4) + number(len(body)) + number(0o100644)  # a checksum stands below
        head += zlib.crc32(body).to_bytes(4, "little") + number(0) + number(1)  # stored, on Unix
        out += block(head + number(len(title)) + title) + body
    return bytes(out + block(number(5) + number(0) + number(0)))


def block(head: bytes) -> bytes:
    sized = number(len(head)) + head
    return zlib.crc32(sized).to_bytes(4, "little") + sized


def number(value: int) -> bytes:
    """Encode a number as RAR 5 does: seven bits a byte, the lowest first."""
    out = bytearray()
    while value > 0x7F:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes([*out, value])
