"""Pictures as bytes and files."""

import struct
import zlib

from .errors import error
from .naming import refuse

CHANNELS = {"RGB": (0, 1, 2), "RGBA": (0, 1, 2, 3)}


def tobytes(surface, format):
    """Return the pixels of a surface row by row, as RGB or RGBA."""
    if format not in CHANNELS:
        raise ValueError(f"the pygame of this page has no {format!r}; it has RGB and RGBA")
    pixels, channels = surface.pixels().bytes, CHANNELS[format]
    made = bytearray(len(pixels) // 4 * len(channels))
    for number, channel in enumerate(channels):
        made[number :: len(channels)] = pixels[channel::4]
    return bytes(made)


tostring = tobytes


def save(surface, filename):
    """Write a surface to a file, as PNG."""
    if not str(filename).lower().endswith(".png"):
        raise error("the pygame of this page writes PNG files only")
    rows, width = tobytes(surface, "RGBA"), 4 * surface.get_width()
    lines = b"".join(b"\0" + rows[at : at + width] for at in range(0, len(rows), width or 1))
    head = struct.pack(">IIBBBBB", *surface.get_size(), 8, 6, 0, 0, 0)
    chunks = (b"IHDR", head), (b"IDAT", zlib.compress(lines)), (b"IEND", b"")
    content = b"\x89PNG\r\n\x1a\n" + b"".join(make_chunk(*each) for each in chunks)
    with open(filename, "wb") as file:
        file.write(content)


def make_chunk(kind, content):
    """Return a chunk of a PNG file."""
    check = zlib.crc32(kind + content)
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", check)
