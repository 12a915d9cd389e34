"""Vector2 in Python, equal to that of pygame-ce to the last bit, and a few functions of numbers.

A vector is made and read thousands of times in each frame, so the methods of the lab take the short
way first: both are Vector2, or the factor is a float. Everything else is sorted out in `read_pair`.
"""

from math import acos, atan2, copysign, cos, degrees, fabs, floor, fmod, pi, radians, sin, sqrt, tau

from .naming import Named, explain, full_name, refuse

NOT_GIVEN = object()
EPSILON = 1e-6
QUARTER = pi / 2
NEEDS_A_PAIR = (
    "Vector2 must be set with 2 real numbers, a sequence of 2 real numbers, "
    "or another Vector2 instance"
)
NO_ORDER = "This operation is not supported by vectors"
ZERO_LENGTH = "Can't normalize Vector of length zero"
ABSENT = {  # attributes of Vector2
    *("angle", "angle_rad", "elementwise", "epsilon", "is_normalized", "move_towards"),
    *("move_towards_ip", "slerp", "smoothstep"),
}
INFINITY, NAN = float("inf"), float("nan")


def is_number(value):
    """Return whether pygame takes a value for a real number."""
    return isinstance(value, (int, float)) or (
        hasattr(value, "__float__") or hasattr(value, "__index__")
    )


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


def need_pair(value, error, message):
    """Return a sequence of two real numbers as two floats, or raise the error."""
    pair = read_pair(value)
    if pair is None:
        raise error(message)
    return pair


def need_sequence(value):
    """Return two floats; raise the errors of pygame's distances."""
    if not hasattr(value, "__getitem__") or not hasattr(value, "__len__"):
        raise TypeError("A sequence was expected")
    if len(value) != 2:
        raise ValueError("Vector and sequence must be the same size")
    return to_float(value[0]), to_float(value[1])


def to_float(value):
    """Return a real number as a float; raise TypeError for anything else."""
    if not is_number(value):
        raise TypeError(f"must be real number, not {full_name(value)}")
    return float(value)


def read_number(value):
    """Return a number as a float, or None for anything else."""
    if not is_number(value):
        return None
    try:
        return float(value)
    except OverflowError:
        return None


def turn(x, y, angle):
    """Return (x, y) turned by an angle in rad; multiples of 90° are exact."""
    angle = fmod(angle, tau) if fabs(angle) != INFINITY else NAN
    if angle < 0:
        angle += tau
    if fmod(angle + EPSILON, QUARTER) < 2 * EPSILON:
        match int((angle + EPSILON) / QUARTER):
            case 1:
                return -y, x
            case 2:
                return -x, -y
            case 3:
                return y, -x
        return x, y
    s, c = sin(angle), cos(angle)
    return c * x - s * y, s * x + c * y


class Vector2(metaclass=Named):
    """Vector2() -> Vector2(0, 0)
    Vector2(int) -> Vector2
    Vector2(float) -> Vector2
    Vector2(Vector2) -> Vector2
    Vector2(x, y) -> Vector2
    Vector2((x, y)) -> Vector2
    a 2-Dimensional Vector"""

    __slots__ = ("_x", "_y")
    __hash__ = None

    def __init_subclass__(cls):
        raise TypeError(explain("a subclass of pygame.Vector2"))

    def __init__(self, x=0.0, y=NOT_GIVEN):
        if type(x) is float and type(y) is float:
            self._x = x
            self._y = y
        else:
            self._x, self._y = read_coordinates(x, y)

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

    def __getattr__(self, name):
        if name in ABSENT:
            refuse("pygame.Vector2", name)
        if len(name) < 2 or set(name) - {"x", "y"}:
            raise AttributeError(f"{full_name(self)!r} object has no attribute {name!r}")
        if len(name) == 3:
            refuse("pygame", "Vector3")
        numbers = tuple(self._x if letter == "x" else self._y for letter in name)
        return Vector2(*numbers) if len(name) == 2 else numbers

    def __getitem__(self, index):
        if isinstance(index, slice):
            return [self._x, self._y][index]
        if not hasattr(index, "__index__"):
            raise TypeError(f"vector indices must be integers, not {type(index).__name__}")
        try:
            return (self._x, self._y)[index]
        except IndexError:
            raise IndexError("subscript out of range.") from None

    def __setitem__(self, index, value):
        if not hasattr(index, "__index__"):
            raise TypeError(f"list indices must be integers, not {type(index).__name__}")
        elif index in (0, -2):
            self.x = value
        elif index in (1, -1):
            self.y = value
        else:
            raise IndexError("subscript out of range.")

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

    def __copy__(self):
        return Vector2(self._x, self._y)

    copy = __copy__

    def __deepcopy__(self, memo):
        return self.__copy__()

    def __reduce__(self):
        return Vector2, (self._x, self._y)

    def update(self, x=0.0, y=NOT_GIVEN):
        """Set both numbers from the arguments of Vector2()."""
        self._x, self._y = read_coordinates(x, y)

    xy = property(__copy__, update)

    # ------------------------------------------------------------ comparisons

    def __eq__(self, other):
        pair = read_pair(other)
        if pair is None:
            return False
        return fabs(self._x - pair[0]) < EPSILON and fabs(self._y - pair[1]) < EPSILON

    def __lt__(self, other):
        if read_pair(other) is None:
            return NotImplemented
        raise TypeError(NO_ORDER)

    __le__ = __gt__ = __ge__ = __lt__

    # ------------------------------------------------------------ operators

    def __add__(self, other):
        if type(other) is Vector2:
            return Vector2(self._x + other._x, self._y + other._y)
        pair = read_pair(other)
        if pair is None:
            return NotImplemented
        return Vector2(self._x + pair[0], self._y + pair[1])

    __radd__ = __add__

    def __iadd__(self, other):
        if type(other) is Vector2:
            self._x += other._x
            self._y += other._y
            return self
        pair = read_pair(other)
        if pair is None:
            return NotImplemented
        self._x += pair[0]
        self._y += pair[1]
        return self

    def __sub__(self, other):
        if type(other) is Vector2:
            return Vector2(self._x - other._x, self._y - other._y)
        pair = read_pair(other)
        if pair is None:
            return NotImplemented
        return Vector2(self._x - pair[0], self._y - pair[1])

    def __rsub__(self, other):
        pair = read_pair(other)
        if pair is None:
            return NotImplemented
        return Vector2(pair[0] - self._x, pair[1] - self._y)

    def __isub__(self, other):
        if type(other) is Vector2:
            self._x -= other._x
            self._y -= other._y
            return self
        pair = read_pair(other)
        if pair is None:
            return NotImplemented
        self._x -= pair[0]
        self._y -= pair[1]
        return self

    def __mul__(self, other):
        if type(other) is float:
            return Vector2(self._x * other, self._y * other)
        pair = read_pair(other)
        if pair is not None:
            return 0.0 + self._x * pair[0] + self._y * pair[1]
        number = read_number(other)
        if number is None:
            return NotImplemented
        return Vector2(self._x * number, self._y * number)

    __rmul__ = __mul__

    def __truediv__(self, other):
        number = read_number(other)
        if number is None:
            return NotImplemented
        if not number:
            raise ZeroDivisionError("division by zero")
        number = 1.0 / number  # as pygame: its last bit differs from that of a division
        return Vector2(self._x * number, self._y * number)

    def __floordiv__(self, other):
        number = read_number(other)
        if number is None:
            return NotImplemented
        return Vector2(floor_division(self._x, number), floor_division(self._y, number))

    def __neg__(self):
        return Vector2(-self._x, -self._y)

    def __pos__(self):
        return Vector2(self._x, self._y)

    def __round__(self, digits=None):
        if digits is None:
            return Vector2(round_half_up(self._x), round_half_up(self._y))
        power = (
            10.0 ** int(digits.__index__()) if hasattr(digits, "__index__") else round(0.0, digits)
        )
        return Vector2(
            round_half_up(self._x * power) / power, round_half_up(self._y * power) / power
        )

    # ------------------------------------------------------------ products and lengths

    def dot(self, other):
        """Return the dot product."""
        if type(other) is Vector2:
            return 0.0 + self._x * other._x + self._y * other._y
        x, y = need_pair(other, TypeError, "Cannot perform dot product with this type.")
        return 0.0 + self._x * x + self._y * y

    def cross(self, other):
        """Return the cross product, a number."""
        message = "Incompatible vector argument: cannot calculate cross product"
        x, y = need_pair(other, TypeError, message)
        return self._x * y - self._y * x

    def length(self):
        """Return the length."""
        return sqrt(self._x * self._x + self._y * self._y)

    magnitude = length

    def length_squared(self):
        """Return the square of the length."""
        return self._x * self._x + self._y * self._y

    magnitude_squared = length_squared

    def normalize(self):
        """Return a vector of length 1 in the same direction."""
        length = sqrt(self._x * self._x + self._y * self._y)
        if not length:
            raise ValueError(ZERO_LENGTH)
        return Vector2(self._x / length, self._y / length)

    def scale_to_length(self, length):
        """Set the length."""
        length, old = to_float(length), self.length()
        if old < EPSILON:
            raise ValueError("Cannot scale a vector with zero length")
        self._x *= length / old
        self._y *= length / old

    def clamp_magnitude(self, *limits):
        """Return a vector whose length is within one or two limits."""
        if not 1 <= len(limits) <= 2:
            raise TypeError("Vector clamp function must take one or two floats")
        *low, high = map(to_float, limits)
        low = low[0] if low else 0.0
        if low > high:
            raise ValueError("Argument min_length cannot exceed max_length")
        if low < 0 or high < 0:
            raise ValueError("Arguments to Vector clamp must be non-negative")
        length = self.length()
        if not length:
            if low > 0:
                raise ValueError(
                    "Cannot clamp a vector with zero length with a min_length greater than 0"
                )
            return Vector2(self._x, self._y)
        share = high / length if length > high else low / length if length < low else 1.0
        return Vector2(self._x * share, self._y * share)

    def distance_to(self, other):
        """Return the distance to a point."""
        x, y = need_sequence(other)
        x, y = x - self._x, y - self._y
        return sqrt(x * x + y * y)

    def distance_squared_to(self, other):
        """Return the square of the distance to a point."""
        x, y = need_sequence(other)
        x, y = x - self._x, y - self._y
        return x * x + y * y

    # ------------------------------------------------------------ directions

    def rotate(self, angle):
        """Return the vector turned by an angle in degrees."""
        return Vector2(*turn(self._x, self._y, radians(to_float(angle))))

    def rotate_rad(self, angle):
        """Return the vector turned by an angle in rad."""
        return Vector2(*turn(self._x, self._y, to_float(angle)))

    def angle_to(self, other):
        """Return the angle to another vector in degrees."""
        message = "Incompatible vector argument: cannot calculate angle to"
        x, y = need_pair(other, TypeError, message)
        return degrees(atan2(y, x) - atan2(self._y, self._x))

    def as_polar(self):
        """Return (length, direction in degrees)."""
        return self.length(), degrees(atan2(self._y, self._x))

    def from_polar(self, polar):
        """Set both numbers, from (length, direction in degrees)."""
        length, angle = need_pair(polar, TypeError, "Expected a sequence of two numbers")
        angle = radians(angle)
        self._x, self._y = length * cos(angle), length * sin(angle)

    def reflect(self, normal):
        """Return the vector after a bounce from a surface with this normal."""
        x, y = need_pair(normal, ValueError, "Sequence has the wrong length.")
        length = x * x + y * y
        if length < EPSILON:
            raise ValueError("Normal must not be of length zero.")
        if length != 1:
            length = sqrt(length)
            x, y = x / length, y / length
        along = 0.0 + self._x * x + self._y * y
        return Vector2(self._x - 2 * x * along, self._y - 2 * y * along)

    def project(self, other):
        """Return the part of the vector along another one."""
        x, y = need_pair(other, TypeError, "Expected Vector as argument 1")
        length = x * x + y * y
        if length < EPSILON:
            raise ValueError("Cannot project onto a vector with zero length")
        share = (0.0 + self._x * x + self._y * y) / length
        return Vector2(x * share, y * share)

    # ------------------------------------------------------------ on the way to another vector

    def lerp(self, other, share):
        """Return the point at a share, from 0 to 1, of the way to another."""
        x, y = need_pair(other, TypeError, "Expected Vector as argument 1")
        share = to_float(share)
        if not 0 <= share <= 1:
            raise ValueError("Argument 2 must be in range [0, 1]")
        rest = 1 - share
        return Vector2(self._x * rest + x * share, self._y * rest + y * share)


def make_in_place(method):
    """Return a method that sets its vector to the result of another method."""

    def change(self, *args):
        self._x, self._y = method(self, *args)

    return change


def make_operator(operate):
    """Return an operator such as *= from one such as *."""

    def change(self, other):
        if isinstance(result := operate(self, other), Vector2):
            self._x, self._y = result
            return self
        return NotImplemented

    return change


for each in ("normalize", "clamp_magnitude", "rotate", "rotate_rad", "reflect"):
    setattr(Vector2, f"{each}_ip", make_in_place(getattr(Vector2, each)))
Vector2.rotate_ip_rad = Vector2.rotate_rad_ip
for each in ("mul", "truediv", "floordiv"):
    setattr(Vector2, f"__i{each}__", make_operator(getattr(Vector2, f"__{each}__")))


def read_coordinates(x, y):
    """Return two floats from the arguments of Vector2()."""
    pair = None
    if y is NOT_GIVEN or not is_number(x):
        pair = (float(x), float(x)) if is_number(x) else read_pair(x)
    elif is_number(y):
        pair = float(x), float(y)
    if pair is None:
        raise ValueError(NEEDS_A_PAIR)
    return pair


def floor_division(x, number):
    """Return a whole quotient as a float, rounded down."""
    if not number:
        raise ZeroDivisionError("division by zero")
    quotient = x * (1.0 / number)
    return copysign(floor(quotient), quotient) if fabs(quotient) < INFINITY else quotient


def round_half_up(x):
    """Return a number rounded to a whole one; halves are rounded away from 0."""
    if not fabs(x) < 2.0**52:
        return x
    whole = float(floor(fabs(x) + 0.5))
    return -whole if x < 0 or str(x)[0] == "-" else whole


# ---------------------------------------------------------------- functions of numbers


def clamp(value, low, high):
    """Return a value limited to low and high."""
    if not all(map(is_number, (value, low, high))):
        raise TypeError("clamp requires 3 numeric arguments")
    return low if value < low else high if value > high else value


def lerp(a, b, share, do_clamp=True, /):
    """Return the number at a share of the way from a to b."""
    a, b, share = to_float(a), to_float(b), to_float(share)
    if do_clamp:
        share = min(max(share, 0.0), 1.0)
    return a + (b - a) * share
