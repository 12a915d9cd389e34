"""Surface: a list of draw commands, which the package's docstring explains."""

from functools import partial

from .color import Color, css
from .constants import SRCALPHA
from .errors import error
from .math import is_number
from .naming import Named, full_name
from .pixels import Pixels
from .rect import Rect, read_rect, to_int

MOST = 20_000  # commands since the last fill; the oldest are forgotten


class Nowhere(list):
    """A list that drops all commands."""

    def append(self, command):
        pass


NOWHERE = Nowhere()


class Surface(metaclass=Named):
    """A picture. Its pixels are computed when they are asked for."""

    __slots__ = ("_clip", "_drawn", "_flags", "_height", "_into", "_width", "css", "ops")

    def __init__(self, size, flags=0, depth=0, masks=None):
        self._width, self._height = read_size(size)
        self._flags = int(getattr(flags, "_flags", flags)) & SRCALPHA
        self.css = partial(css, opaque=not self._flags)
        self.ops = []
        self._into, self._clip = self.ops, None
        if not self._flags:
            self.fill((0, 0, 0))
        self._drawn = None, 0  # pixels, and the number of commands in them

    def __repr__(self):
        return f"<Surface({self._width}x{self._height}x32)>"

    # ------------------------------------------------------------ sizes

    def get_size(self):
        """Return (width, height) in px."""
        return self._width, self._height

    size = property(get_size)

    def get_width(self):
        """Return the width in px."""
        return self._width

    width = property(get_width)

    def get_height(self):
        """Return the height in px."""
        return self._height

    height = property(get_height)

    def get_rect(self, **places):
        """Return a rectangle of this size, placed by names such as center."""
        rect = Rect(0, 0, self._width, self._height)
        for name, value in places.items():
            setattr(rect, name, value)
        return rect

    # ------------------------------------------------------------ drawing

    def fill(self, color, rect=None, special_flags=0):
        """Fill the surface or a rectangle of it; return the filled rectangle."""
        color = self.css(color)
        if rect is None and self._into is self.ops:
            self.ops.clear()
            self._drawn = None, 0
            if color[7:] != "00":
                self.ops.append(("rect", 0, 0, self._width, self._height, color, 0))
            return Rect(0, 0, self._width, self._height)
        filled = self.get_clip() if rect is None else self.get_clip().clip(rect)
        self._into.append(("rect", *filled, color, 0))
        return filled

    def blit(self, source, dest=(0, 0), area=None, special_flags=0):
        """Draw another surface with its left upper corner at dest; return its rectangle."""
        if not isinstance(source, Surface):
            raise TypeError(f"argument 1 must be pygame.surface.Surface, not {full_name(source)}")
        x, y = read_place(dest)
        left, top, w, h = read_rect(area) if area is not None else (0, 0, *source.get_size())
        commands = list(source.ops)
        if area is None and len(commands) == 1 and commands[0][0] == "text":
            _, right, down, *rest = commands[0]
            self._into.append(("text", x + right, y + down, *rest))
        elif commands:
            inside = ("within", left, top, w, h, commands)
            self._into.append(("at", x - left, y - top, [inside]))
        return self.get_clip().clip((x, y, w, h))

    def set_at(self, place, color):
        """Set the colour of one pixel."""
        x, y = place
        self._into.append(("rect", int(x), int(y), 1, 1, self.css(color), 0))

    def set_clip(self, rect):
        """Draw inside this rectangle only; None for the whole surface.

        A clip of at most one pixel is too small to see: drawing does nothing.
        """
        whole = Rect(0, 0, self._width, self._height)
        self._clip = None if rect is None else whole.clip(rect)
        self._drawn = None, 0
        if self._clip is None or self._clip == whole:
            self._into = self.ops
        elif self._clip.w * self._clip.h <= 1:
            self._into = NOWHERE
        else:
            self._into = []
            self.ops.append(("within", *self._clip, self._into))

    def get_clip(self):
        """Return the rectangle that is drawn in."""
        return Rect(0, 0, self._width, self._height) if self._clip is None else self._clip.copy()

    def copy(self):
        """Return a surface with the same picture."""
        made = Surface(self.get_size(), self._flags)
        made.ops[:] = self.ops
        return made

    __copy__ = copy

    def convert(self, *_):
        """Return a copy."""
        return self.copy()

    convert_alpha = convert

    def forget(self):
        """Drop the oldest commands, except the first, if there are too many."""
        if len(self.ops) > MOST:
            del self.ops[1 : len(self.ops) - MOST // 2]
            self._drawn = None, 0

    # ------------------------------------------------------------ pixels

    def pixels(self):
        """Return the pixels of the picture, computed only once."""
        drawn, count = self._drawn
        if drawn is None or self._into is not self.ops or count > len(self.ops):
            drawn, count = Pixels(self._width, self._height), 0
        drawn.paint(self.ops[count:])
        self._drawn = drawn, len(self.ops)
        return drawn

    def get_at(self, place):
        """Return the colour of a pixel."""
        x, y = map(to_int, place)
        if not (0 <= x < self._width and 0 <= y < self._height):
            raise IndexError("pixel index out of range")
        return Color(*self.pixels()[x, y])

    def get_buffer(self):
        """Return the pixels; bytes are in `raw`."""
        return BufferProxy(self)


class BufferProxy(metaclass=Named):
    """The pixels of a surface, as get_buffer returns them."""

    def __init__(self, parent):
        self.parent = parent

    @property
    def raw(self):
        """The bytes."""
        return bytes(self.parent.pixels().bytes)


def read_size(size):
    """Return (width, height) as whole numbers."""
    if not hasattr(size, "__getitem__") or len(size) != 2 or not all(map(is_number, size)):
        raise ValueError("size needs to be (number width, number height)")
    width, height = map(to_int, size)
    if width < 0 or height < 0:
        raise error("Invalid resolution for Surface")
    return width, height


def read_place(dest):
    """Return (x, y) as whole numbers, of a place or the corner of a rectangle."""
    if not hasattr(dest, "__getitem__") or len(dest) < 2 or not all(map(is_number, dest)):
        raise TypeError("invalid destination position for blit")
    return to_int(dest[0]), to_int(dest[1])
