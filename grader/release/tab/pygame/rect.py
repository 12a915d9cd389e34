"""Rect: a rectangle of whole numbers."""

from .math import is_number, read_pair
from .naming import Named, full_name

STYLE = "Argument must be rect style object"


def read_rect(*values):
    """Return (x, y, w, h) of any rectangle that pygame accepts, as whole numbers."""
    if len(values) == 1:
        (values,) = values
        if isinstance(values, Rect):
            return values._x, values._y, values._w, values._h
        if not hasattr(values, "__getitem__") or not hasattr(values, "__len__"):
            values = read_rect_of(values)
    if len(values) == 2:
        place, size = map(read_pair, values)
        if place is None or size is None:
            raise TypeError(STYLE)
        values = (*place, *size)
    if len(values) != 4 or not all(map(is_number, values)):
        raise TypeError(STYLE)
    return tuple(map(to_int, values))


def read_rect_of(thing):
    """Return the `rect` of an object."""
    if not hasattr(thing, "rect"):
        raise TypeError(STYLE)
    return thing.rect


def to_int(value):
    """Return a number truncated as in C: NaN and overflow become the lowest number."""
    try:
        number = int(value)
    except (ValueError, OverflowError):
        return -(1 << 31)
    return number if -(1 << 31) <= number < 1 << 31 else -(1 << 31)


def side(get, put):
    """Make an attribute of a rectangle from `get` and `put`, which take it first."""

    def set_to(r, value):
        put(r, *map(to_int, value)) if hasattr(value, "__getitem__") else put(r, to_int(value))

    return property(get, set_to)


def half(number):
    """Return half a number, truncated as in C."""
    return int(number / 2)


class Rect(metaclass=Named):
    """A rectangle: x, y, w and h, and its corners, sides and centres."""

    __slots__ = ("_h", "_w", "_x", "_y")
    __hash__ = None

    def __init__(self, *values):
        self._x, self._y, self._w, self._h = read_rect(*values) if values else (0, 0, 0, 0)

    def _place(self, x, y):
        self._x, self._y = x, y

    def _resize(self, w, h):
        self._w, self._h = w, h

    x = left = side(lambda r: r._x, lambda r, x: r._place(x, r._y))
    y = top = side(lambda r: r._y, lambda r, y: r._place(r._x, y))
    w = width = side(lambda r: r._w, lambda r, w: r._resize(w, r._h))
    h = height = side(lambda r: r._h, lambda r, h: r._resize(r._w, h))
    size = side(lambda r: (r._w, r._h), _resize)
    right = side(lambda r: r._x + r._w, lambda r, x: r._place(x - r._w, r._y))
    bottom = side(lambda r: r._y + r._h, lambda r, y: r._place(r._x, y - r._h))
    centerx = side(lambda r: r._x + half(r._w), lambda r, x: r._place(x - half(r._w), r._y))
    centery = side(lambda r: r._y + half(r._h), lambda r, y: r._place(r._x, y - half(r._h)))

    def corner(one, two):
        """Join two attributes into a pair."""

        def put(r, x, y):
            setattr(r, one, x)
            setattr(r, two, y)

        return side(lambda r: (getattr(r, one), getattr(r, two)), put)

    topleft, topright = corner("left", "top"), corner("right", "top")
    bottomleft, bottomright = corner("left", "bottom"), corner("right", "bottom")
    midtop, midbottom = corner("centerx", "top"), corner("centerx", "bottom")
    midleft, midright = corner("left", "centery"), corner("right", "centery")
    center = corner("centerx", "centery")
    del corner

    def __repr__(self):
        return f"Rect({self._x}, {self._y}, {self._w}, {self._h})"

    def __iter__(self):
        return iter((self._x, self._y, self._w, self._h))

    def __len__(self):
        return 4

    def __getitem__(self, index):
        try:
            return [self._x, self._y, self._w, self._h][index]
        except IndexError:
            raise IndexError("Invalid rect Index") from None

    def __bool__(self):
        return self._w != 0 and self._h != 0

    def __eq__(self, other):
        try:
            return tuple(self) == read_rect(other)
        except TypeError:
            return NotImplemented

    def __copy__(self):
        return type(self)(self._x, self._y, self._w, self._h)

    copy = __copy__

    def move(self, *by):
        """Return a copy, moved."""
        x, y = map(to_int, by if len(by) == 2 else by[0])
        return type(self)(self._x + x, self._y + y, self._w, self._h)

    def inflate(self, *by):
        """Return a copy that is larger by x and y, around the same centre."""
        w, h = map(to_int, by if len(by) == 2 else by[0])
        return type(self)(self._x - half(w), self._y - half(h), self._w + w, self._h + h)

    def clip(self, *other):
        """Return the overlap of two rectangles, or an empty one."""
        x, y, w, h = read_rect(*other)
        left, top = max(self._x, x), max(self._y, y)
        wide, high = min(self.right, x + w) - left, min(self.bottom, y + h) - top
        if wide < 0 or high < 0:
            return type(self)(self._x, self._y, 0, 0)
        return type(self)(left, top, wide, high)

    def collidepoint(self, *point):
        """Return whether a point is inside, or on the left or top edge."""
        x, y = point if len(point) == 2 else point[0]
        return self._x <= x < self.right and self._y <= y < self.bottom

    def colliderect(self, *other):
        """Return whether two rectangles overlap."""
        x, y, w, h = read_rect(*other)
        if not (w and h and self):
            return False
        return max(self._x, x) < min(self.right, x + w) and max(self._y, y) < min(
            self.bottom, y + h
        )
