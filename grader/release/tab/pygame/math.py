"""Vector2 in Python, equal to that of pygame-ce to the last bit.

A vector is made and read thousands of times in each frame, so the methods of the lab take the short
way first: both are Vector2, or the factor is a float. `to_vector` reads everything else.
"""

from math import atan2, cos, degrees, fabs, fmod, pi, radians, sin, sqrt, tau

from .naming import Named, explain, full_name

NOT_GIVEN = object()
EPSILON = 1e-6
QUARTER = pi / 2
INFINITY, NAN = float("inf"), float("nan")


def is_number(value):
    """Return whether pygame takes a value for a real number."""
    return isinstance(value, (int, float)) or (
        hasattr(value, "__float__") or hasattr(value, "__index__")
    )


def to_float(value):
    """Return a real number as a float; raise TypeError for anything else."""
    if not is_number(value):
        raise TypeError(f"must be real number, not {full_name(value)}")
    return float(value)


def read_pair(value):
    """Return a sequence of two real numbers as two floats, or None for anything else."""
    if isinstance(value, Vector2):
        return value._x, value._y
    if not hasattr(value, "__getitem__") or not hasattr(value, "__len__"):
        return None
    if isinstance(value, dict) or len(value) != 2:
        return None
    x, y = value[0], value[1]
    return (float(x), float(y)) if is_number(x) and is_number(y) else None


def to_vector(value):
    """Return a sequence of two real numbers as a Vector2, or None for anything else."""
    pair = read_pair(value)
    return None if pair is None else Vector2(*pair)


def need_vector(value):
    """Return a sequence of two real numbers as a Vector2; raise TypeError for anything else."""
    if type(value) is Vector2:
        return value
    vector = to_vector(value)
    if vector is None:
        raise TypeError(f"a Vector2 or a pair of numbers was expected, not {full_name(value)}")
    return vector


def turn(x, y, angle):
    """Return (x, y) turned by an angle in rad; multiples of 90° are exact."""
    angle = fmod(angle, tau) if fabs(angle) != INFINITY else NAN
    if angle < 0:
        angle += tau
    if fmod(angle + EPSILON, QUARTER) < 2 * EPSILON:
        quarters = int((angle + EPSILON) / QUARTER) % 4
        return ((x, y), (-y, x), (-x, -y), (y, -x))[quarters]
    s, c = sin(angle), cos(angle)
    return c * x - s * y, s * x + c * y


class Vector2(metaclass=Named):
    """A vector in the plane: Vector2(x, y), Vector2((x, y)), Vector2(number) or Vector2()."""

    __slots__ = ("_x", "_y")
    __hash__ = None

    def __init_subclass__(cls):
        raise TypeError(explain("a subclass of pygame.Vector2"))

    def __init__(self, x=0.0, y=NOT_GIVEN):
        if type(x) is float and type(y) is float:
            self._x = x
            self._y = y
        else:
            self.update(x, y)

    def update(self, x=0.0, y=NOT_GIVEN):
        """Set both numbers from the arguments of Vector2()."""
        if y is NOT_GIVEN:
            pair = (float(x), float(x)) if is_number(x) else read_pair(x)
        else:
            pair = (float(x), float(y)) if is_number(x) and is_number(y) else None
        if pair is None:
            raise ValueError("Vector2 must be set with 2 real numbers or another Vector2")
        self._x, self._y = pair

    # ------------------------------------------------------------ the two numbers

    @property
    def x(self):
        """The first number."""
        return self._x

    @x.setter
    def x(self, value):
        self._x = value if type(value) is float else to_float(value)

    @property
    def y(self):
        """The second number."""
        return self._y

    @y.setter
    def y(self, value):
        self._y = value if type(value) is float else to_float(value)

    def __getitem__(self, index):
        return [self._x, self._y][index]

    def __setitem__(self, index, value):
        numbers = [self._x, self._y]
        numbers[index] = value
        self.update(numbers)

    def __len__(self):
        return 2

    def __iter__(self):
        return iter((self._x, self._y))

    def __bool__(self):
        return self._x != 0 or self._y != 0

    def __repr__(self):
        return f"Vector2({self._x:g}, {self._y:g})"

    def __str__(self):
        return f"[{self._x:g}, {self._y:g}]"

    def copy(self):
        """Return a vector with the same numbers."""
        return Vector2(self._x, self._y)

    __copy__ = copy
    xy = property(copy, update)
    yx = property(lambda self: Vector2(self._y, self._x))

    def __deepcopy__(self, memo):
        return self.copy()

    def __reduce__(self):
        return Vector2, (self._x, self._y)

    def __eq__(self, other):
        pair = read_pair(other)
        if pair is None:
            return False
        return fabs(self._x - pair[0]) < EPSILON and fabs(self._y - pair[1]) < EPSILON

    # ------------------------------------------------------------ operators

    def __add__(self, other):
        if type(other) is not Vector2 and (other := to_vector(other)) is None:
            return NotImplemented
        return Vector2(self._x + other._x, self._y + other._y)

    __radd__ = __add__

    def __iadd__(self, other):
        if type(other) is not Vector2 and (other := to_vector(other)) is None:
            return NotImplemented
        self._x += other._x
        self._y += other._y
        return self

    def __sub__(self, other):
        if type(other) is not Vector2 and (other := to_vector(other)) is None:
            return NotImplemented
        return Vector2(self._x - other._x, self._y - other._y)

    def __rsub__(self, other):
        other = to_vector(other)
        return NotImplemented if other is None else other - self

    def __isub__(self, other):
        if type(other) is not Vector2 and (other := to_vector(other)) is None:
            return NotImplemented
        self._x -= other._x
        self._y -= other._y
        return self

    def __mul__(self, other):
        if type(other) is float:
            return Vector2(self._x * other, self._y * other)
        if is_number(other):
            return self * float(other)
        other = to_vector(other)
        return NotImplemented if other is None else self.dot(other)

    __rmul__ = __mul__

    def __imul__(self, other):
        return self._become(self * other) if is_number(other) else NotImplemented

    def __truediv__(self, other):
        if not is_number(other):
            return NotImplemented
        share = 1.0 / float(other)  # as pygame: its last bit differs from that of a division
        return Vector2(self._x * share, self._y * share)

    def __itruediv__(self, other):
        return self._become(self / other) if is_number(other) else NotImplemented

    def _become(self, other):
        self._x, self._y = other._x, other._y
        return self

    def __floordiv__(self, other):
        raise TypeError(explain("// with pygame.Vector2"))

    def __round__(self, digits=None):
        raise TypeError(explain("round() of a pygame.Vector2"))

    def __neg__(self):
        return Vector2(-self._x, -self._y)

    def __pos__(self):
        return self.copy()

    # ------------------------------------------------------------ products and lengths

    def dot(self, other):
        """Return the dot product."""
        other = need_vector(other)
        return 0.0 + self._x * other._x + self._y * other._y

    def cross(self, other):
        """Return the cross product, a number."""
        other = need_vector(other)
        return self._x * other._y - self._y * other._x

    def length_squared(self):
        """Return the square of the length."""
        return self._x * self._x + self._y * self._y

    def length(self):
        """Return the length."""
        return sqrt(self._x * self._x + self._y * self._y)

    magnitude, magnitude_squared = length, length_squared

    def normalize(self):
        """Return a vector of length 1 in the same direction."""
        length = self.length()
        if not length:
            raise ValueError("Can't normalize Vector of length zero")
        return Vector2(self._x / length, self._y / length)

    def normalize_ip(self):
        """Set the length to 1."""
        self._become(self.normalize())

    def scale_to_length(self, length):
        """Set the length."""
        length, old = to_float(length), self.length()
        if old < EPSILON:
            raise ValueError("Cannot scale a vector with zero length")
        self._x *= length / old
        self._y *= length / old

    def distance_to(self, other):
        """Return the distance to a point."""
        return (need_vector(other) - self).length()

    def distance_squared_to(self, other):
        """Return the square of the distance to a point."""
        return (need_vector(other) - self).length_squared()

    # ------------------------------------------------------------ directions

    def rotate_rad(self, angle):
        """Return the vector turned by an angle in rad."""
        return Vector2(*turn(self._x, self._y, to_float(angle)))

    def rotate(self, angle):
        """Return the vector turned by an angle in degrees."""
        return self.rotate_rad(radians(to_float(angle)))

    def rotate_ip(self, angle):
        """Turn the vector by an angle in degrees."""
        self._become(self.rotate(angle))

    def rotate_rad_ip(self, angle):
        """Turn the vector by an angle in rad."""
        self._become(self.rotate_rad(angle))

    def angle_to(self, other):
        """Return the angle to another vector in degrees."""
        other = need_vector(other)
        return degrees(atan2(other._y, other._x) - atan2(self._y, self._x))

    def as_polar(self):
        """Return (length, direction in degrees)."""
        return self.length(), degrees(atan2(self._y, self._x))

    def reflect(self, normal):
        """Return the vector after a bounce from a surface with this normal."""
        normal = need_vector(normal)
        length = normal.length_squared()
        if length < EPSILON:
            raise ValueError("Normal must not be of length zero.")
        x, y = normal if length == 1 else normal.normalize()
        along = 0.0 + self._x * x + self._y * y
        return Vector2(self._x - 2 * x * along, self._y - 2 * y * along)

    def project(self, other):
        """Return the part of the vector along another one."""
        other = need_vector(other)
        length = other.length_squared()
        if length < EPSILON:
            raise ValueError("Cannot project onto a vector with zero length")
        share = self.dot(other) / length
        return Vector2(other._x * share, other._y * share)

    def lerp(self, other, share):
        """Return the point at a share, from 0 to 1, of the way to another."""
        other, share = need_vector(other), to_float(share)
        if not 0 <= share <= 1:
            raise ValueError("Argument 2 must be in range [0, 1]")
        rest = 1 - share
        return Vector2(self._x * rest + other._x * share, self._y * rest + other._y * share)


# ---------------------------------------------------------------- functions of numbers


def clamp(value, low, high):
    """Return a value limited to low and high."""
    return low if value < low else high if value > high else value


def lerp(a, b, share, do_clamp=True, /):
    """Return the number at a share of the way from a to b."""
    if do_clamp:
        share = min(max(share, 0.0), 1.0)
    return float(a + (b - a) * share)
