"""Pictures as bytes."""

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
