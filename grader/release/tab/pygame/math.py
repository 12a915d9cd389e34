"""Vector2 in Python, equal to that of pygame-ce to the last bit, and a few functions of numbers.

A vector is made and read thousands of times in each frame, so the methods of the lab take the short
way first: both are Vector2, or the factor is a float. Everything else is sorted out in `read_pair`.
"""

from math import acos, atan2, copysign, cos, degrees, fabs, floor, fmod, pi, radians, sin, sqrt, tau

from .naming import Named, full_name, refuse

NOT_GIVEN = object()
EPSILON = 1e-6
QUARTER = pi / 2
NEEDS_A_PAIR = (
    "Vector2 must be set with 2 real numbers, a sequence of 2 real numbers, "
    "or another Vector2 instance"
)
NO_ORDER = "This operation is not supported by vectors"
ZERO_LENGTH = "Can't normalize Vector of length zero"
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
    """Return a sequence of two real numbers as two floats; raise the error for anything else."""
    pair = read_pair(value)
    if pair is None:
        raise error(message)
    return pair


def need_sequence(value):
    """Return two floats; raise as pygame does where distances are measured to something else."""
    if not hasattr(value, "__getitem__") or not hasattr(value, "__len__"):
        raise TypeError("A sequence was expected")
    if len(value) != 2:
        raise ValueError("Vector and sequence must be the same size")
    return to_float(value[0]), to_float(value[1])


def to_float(value):
    """Return a real number as a float; raise TypeError for anything else, texts included."""
    if not is_number(value):
        raise TypeError(f"must be real number, not {full_name(value)}")
    return float(value)


def read_number(value):
    """Return a number as a float, or None where a vector cannot be multiplied by it."""
    if not is_number(value):
        return None
    try:
        return float(value)
    except OverflowError:
        return None


def turn(x, y, angle, epsilon):
    """Return (x, y) turned by an angle in rad; multiples of 90° move the numbers, unrounded."""
    angle = fmod(angle, tau) if fabs(angle) != INFINITY else NAN
    if angle < 0:
        angle += tau
    if fmod(angle + epsilon, QUARTER) < 2 * epsilon:
        match int((angle + epsilon) / QUARTER):
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

    __slots__ = ("_epsilon", "_x", "_y")
    __hash__ = None

    def __init__(self, x=0.0, y=NOT_GIVEN):
        if type(x) is float and type(y) is float:
            self._x = x
            self._y = y
        else:
            self._x, self._y = read_coordinates(x, y)

    def __init_subclass__(cls):
        """Let what returns vectors return those of the subclass, without its __init__."""
        for name in RETURN_VECTORS:
            if name not in vars(cls):
                setattr(cls, name, returning(cls, getattr(Vector2, name)))

    # ------------------------------------------------------------ the two numbers

    @property
    def x(self):
        """The first number."""
        return self._x

    @x.setter
    def x(self, value):
        self._x = value if type(value) is float else to_float(value)

    @x.deleter
    def x(self):
        raise TypeError("Cannot delete the x attribute")

    @property
    def y(self):
        """The second number."""
        return self._y

    @y.setter
    def y(self, value):
        self._y = value if type(value) is float else to_float(value)

    @y.deleter
    def y(self):
        raise TypeError("Cannot delete the y attribute")

    @property
    def epsilon(self):
        """Return how far numbers may be apart that count as equal."""
        try:
            return self._epsilon
        except AttributeError:
            return EPSILON

    @epsilon.setter
    def epsilon(self, value):
        self._epsilon = to_float(value)

    @property
    def xy(self):
        """Return a copy."""
        return type(self)._of(self._x, self._y)

    @xy.setter
    def xy(self, values):
        self._x, self._y = read_swizzle(values)

    @property
    def yx(self):
        """Return a copy with the numbers exchanged."""
        return type(self)._of(self._y, self._x)

    @yx.setter
    def yx(self, values):
        self._y, self._x = read_swizzle(values)

    @classmethod
    def _of(cls, x, y):
        """Return a vector of two floats, of this class and without its __init__."""
        made = object.__new__(cls)
        made._x, made._y = x, y
        return made

    def __getattr__(self, name):
        if len(name) < 2 or set(name) - {"x", "y"}:
            raise AttributeError(f"{full_name(self)!r} object has no attribute {name!r}")
        if len(name) == 3:
            refuse("pygame", "Vector3")
        numbers = tuple(self._x if letter == "x" else self._y for letter in name)
        return type(self)._of(*numbers) if len(name) == 2 else numbers

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
        if isinstance(index, slice):
            numbers = [self._x, self._y]
            count = len(numbers[index])
            if not hasattr(value, "__getitem__") or len(value) != count:
                raise ValueError("Sequence has the wrong length.")
            numbers[index] = map(to_float, value)
            self._x, self._y = numbers
        elif not hasattr(index, "__index__"):
            raise TypeError(f"list indices must be integers, not {type(index).__name__}")
        elif index in (0, -2):
            self.x = value
        elif index in (1, -1):
            self.y = value
        else:
            raise IndexError("subscript out of range.")

    def __delitem__(self, index):
        raise TypeError("item deletion is not supported")

    def __len__(self):
        return 2

    def __iter__(self):
        return iter((self._x, self._y))

    def __contains__(self, value):
        value = to_float(value)
        return fabs(self._x - value) < self.epsilon or fabs(self._y - value) < self.epsilon

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
        return type(self), (self._x, self._y)

    def __getstate__(self):
        return None

    def update(self, x=0.0, y=NOT_GIVEN):
        """Set both numbers, from what a Vector2 can be made of."""
        self._x, self._y = read_coordinates(x, y)

    # ------------------------------------------------------------ comparisons

    def __eq__(self, other):
        pair = read_pair(other)
        if pair is None:
            return False
        epsilon = self.epsilon
        return fabs(self._x - pair[0]) < epsilon and fabs(self._y - pair[1]) < epsilon

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
            return self._x * pair[0] + self._y * pair[1]
        number = read_number(other)
        if number is None:
            return NotImplemented
        return Vector2(self._x * number, self._y * number)

    __rmul__ = __mul__

    def __imul__(self, other):
        if type(other) is not float:
            other = read_number(other)
            if other is None:
                return NotImplemented
        self._x *= other
        self._y *= other
        return self

    def __truediv__(self, other):
        number = read_number(other)
        if number is None:
            return NotImplemented
        if not number:
            raise ZeroDivisionError("division by zero")
        number = 1.0 / number  # as pygame: its last bit differs from that of a division
        return Vector2(self._x * number, self._y * number)

    def __itruediv__(self, other):
        number = read_number(other)
        if number is None:
            return NotImplemented
        if not number:
            raise ZeroDivisionError("division by zero")
        number = 1.0 / number
        self._x *= number
        self._y *= number
        return self

    def __floordiv__(self, other):
        number = read_number(other)
        if number is None:
            return NotImplemented
        return Vector2(floor_division(self._x, number), floor_division(self._y, number))

    def __ifloordiv__(self, other):
        number = read_number(other)
        if number is None:
            return NotImplemented
        self._x = floor_division(self._x, number)
        self._y = floor_division(self._y, number)
        return self

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
            return self._x * other._x + self._y * other._y
        x, y = need_pair(other, TypeError, "Cannot perform dot product with this type.")
        return self._x * x + self._y * y

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

    def normalize_ip(self):
        """Set the length to 1."""
        self._x, self._y = self.normalize()

    def is_normalized(self):
        """Return whether the length is 1."""
        return fabs(self.length_squared() - 1) < self.epsilon

    def scale_to_length(self, length):
        """Set the length."""
        length, old = to_float(length), self.length()
        if old < self.epsilon:
            raise ValueError("Cannot scale a vector with zero length")
        self._x *= length / old
        self._y *= length / old

    def clamp_magnitude(self, *limits):
        """Return a vector no longer than the last of one or two limits, nor shorter than the first."""
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

    def clamp_magnitude_ip(self, *limits):
        """Bring the length between the limits."""
        self._x, self._y = self.clamp_magnitude(*limits)

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
        return Vector2(*turn(self._x, self._y, radians(to_float(angle)), self.epsilon))

    def rotate_rad(self, angle):
        """Return the vector turned by an angle in rad."""
        return Vector2(*turn(self._x, self._y, to_float(angle), self.epsilon))

    def rotate_ip(self, angle):
        """Turn by an angle in degrees."""
        self._x, self._y = turn(self._x, self._y, radians(to_float(angle)), self.epsilon)

    def rotate_rad_ip(self, angle):
        """Turn by an angle in rad."""
        self._x, self._y = turn(self._x, self._y, to_float(angle), self.epsilon)

    rotate_ip_rad = rotate_rad_ip

    @property
    def angle(self):
        """Return the direction in degrees."""
        return degrees(atan2(self._y, self._x))

    @property
    def angle_rad(self):
        """Return the direction in rad."""
        return atan2(self._y, self._x)

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
        if length < self.epsilon:
            raise ValueError("Normal must not be of length zero.")
        if length != 1:
            length = sqrt(length)
            x, y = x / length, y / length
        along = self._x * x + self._y * y
        return Vector2(self._x - 2 * x * along, self._y - 2 * y * along)

    def reflect_ip(self, normal):
        """Bounce from a surface with this normal."""
        self._x, self._y = self.reflect(normal)

    def project(self, other):
        """Return the part of the vector along another one."""
        x, y = need_pair(other, TypeError, "Expected Vector as argument 1")
        length = x * x + y * y
        if length < self.epsilon:
            raise ValueError("Cannot project onto a vector with zero length")
        share = (self._x * x + self._y * y) / length
        return Vector2(x * share, y * share)

    # ------------------------------------------------------------ on the way to another vector

    def lerp(self, other, share):
        """Return the point at a share, from 0 to 1, of the way to another one."""
        x, y = need_pair(other, TypeError, "Expected Vector as argument 1")
        share = to_float(share)
        if not 0 <= share <= 1:
            raise ValueError("Argument 2 must be in range [0, 1]")
        rest = 1 - share
        return Vector2(self._x * rest + x * share, self._y * rest + y * share)

    def smoothstep(self, other, share):
        """Return a point on the way to another one, with a soft start and end."""
        x, y = need_pair(other, TypeError, "Expected Vector as argument 1")
        share = min(max(to_float(share), 0.0), 1.0)
        share = share * share * (3 - 2 * share)
        return Vector2(self._x * (1 - share) + x * share, self._y * (1 - share) + y * share)

    def slerp(self, other, share):
        """Return the vector at a share, from -1 to 1, of the turn to another one."""
        x, y = need_pair(other, TypeError, "Expected Vector as argument 1")
        share = to_float(share)
        if not -1 <= share <= 1:
            raise ValueError("Argument 2 must be in range [-1, 1].")
        mine, its = self.length(), sqrt(x * x + y * y)
        if mine < self.epsilon or its < self.epsilon:
            raise ValueError("can't use slerp with Zero-Vector")
        angle = acos(min(max((self._x * x + self._y * y) / (mine * its), -1.0), 1.0))
        if share < 0:
            angle, share = angle - tau, -share
        if self._x * y < self._y * x:
            angle = -angle
        if fabs(angle) < self.epsilon or fabs(fabs(angle) - tau) < self.epsilon:
            return Vector2(self._x * (1 - share) + x * share, self._y * (1 - share) + y * share)
        if fabs(fabs(angle) - pi) < self.epsilon:
            raise ValueError("SLERP with 180 degrees is undefined.")
        factor = ((its - mine) * share + mine) / sin(angle)
        one, other = sin(angle * (1 - share)) / mine, sin(angle * share) / its
        return Vector2((self._x * one + x * other) * factor, (self._y * one + y * other) * factor)

    def move_towards(self, other, most):
        """Return the point at a distance, at most, on the straight way to another one."""
        x, y = need_pair(other, TypeError, "Expected Vector as argument 1")
        most = to_float(most)
        over, down = x - self._x, y - self._y
        length = sqrt(over * over + down * down)
        if not length:
            return Vector2(self._x, self._y)
        if length <= most:
            return Vector2(x, y)
        return Vector2(self._x + over * (most / length), self._y + down * (most / length))

    def move_towards_ip(self, other, most):
        """Move by a distance, at most, straight towards a point."""
        self._x, self._y = self.move_towards(other, most)

    def elementwise(self):
        """Return what treats each number by itself: `v.elementwise() * (2, 3)`."""
        return VectorElementwiseProxy(self)


RETURN_VECTORS = [
    "__add__",
    "__radd__",
    "__sub__",
    "__rsub__",
    "__mul__",
    "__rmul__",
    "__truediv__",
    "__floordiv__",
    "__neg__",
    "__pos__",
    "__round__",
    "__copy__",
    "copy",
    "normalize",
    "clamp_magnitude",
    "rotate",
    "rotate_rad",
    "reflect",
    "project",
    "lerp",
    "smoothstep",
    "slerp",
    "move_towards",
]


def returning(cls, method):
    """Return a method that makes the vectors it returns members of a subclass."""

    def call(self, *args):
        result = method(self, *args)
        return cls._of(result._x, result._y) if type(result) is Vector2 else result

    return call


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


def read_swizzle(values):
    """Return the first two numbers of a sequence as floats."""
    if not hasattr(values, "__getitem__") or not hasattr(values, "__len__"):
        raise TypeError("a sequence is expected")
    if len(values) < 2:
        raise TypeError("a sequence of 2 numbers is expected")
    return to_float(values[0]), to_float(values[1])


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


class VectorElementwiseProxy(metaclass=Named):
    """A vector whose operators treat each number by itself."""

    __slots__ = ("vector",)
    __hash__ = None

    def __init__(self, vector):
        self.vector = vector

    def _with(self, other, operate):
        """Return what an operation gives for each number, or NotImplemented."""
        if isinstance(other, VectorElementwiseProxy):
            other = other.vector
        pair = read_pair(other)
        if pair is None:
            number = read_number(other)
            if number is None:
                return NotImplemented
            pair = number, number
        return operate(self.vector._x, pair[0]), operate(self.vector._y, pair[1])

    def _vector_with(self, other, operate):
        pair = self._with(other, operate)
        return pair if pair is NotImplemented else Vector2(*pair)

    def _all_with(self, other, operate):
        pair = self._with(other, operate)
        return pair if pair is NotImplemented else all(pair)

    def __add__(self, other):
        return self._vector_with(other, lambda a, b: a + b)

    __radd__ = __add__

    def __sub__(self, other):
        return self._vector_with(other, lambda a, b: a - b)

    def __rsub__(self, other):
        return self._vector_with(other, lambda a, b: b - a)

    def __mul__(self, other):
        return self._vector_with(other, lambda a, b: a * b)

    __rmul__ = __mul__

    def __truediv__(self, other):
        return self._vector_with(other, divide)

    def __rtruediv__(self, other):
        return self._vector_with(other, lambda a, b: divide(b, a))

    def __floordiv__(self, other):
        return self._vector_with(other, floor_division)

    def __rfloordiv__(self, other):
        return self._vector_with(other, lambda a, b: floor_division(b, a))

    def __mod__(self, other):
        return self._vector_with(other, remainder)

    def __rmod__(self, other):
        return self._vector_with(other, lambda a, b: remainder(b, a))

    def __pow__(self, other):
        return self._vector_with(other, power)

    def __rpow__(self, other):
        return self._vector_with(other, lambda a, b: power(b, a))

    def __abs__(self):
        return Vector2(fabs(self.vector._x), fabs(self.vector._y))

    def __neg__(self):
        return -self.vector

    def __pos__(self):
        return +self.vector

    def __bool__(self):
        return bool(self.vector)

    def __eq__(self, other):
        return self._all_with(other, lambda a, b: fabs(a - b) < EPSILON)

    def __ne__(self, other):
        return self._all_with(other, lambda a, b: not fabs(a - b) < EPSILON)

    def __lt__(self, other):
        return self._all_with(other, lambda a, b: a < b)

    def __le__(self, other):
        return self._all_with(other, lambda a, b: a <= b)

    def __gt__(self, other):
        return self._all_with(other, lambda a, b: a > b)

    def __ge__(self, other):
        return self._all_with(other, lambda a, b: a >= b)


def divide(x, number):
    """Return a quotient; the message of pygame where the divisor is 0."""
    if not number:
        raise ZeroDivisionError("division by zero")
    return x / number


def remainder(x, number):
    """Return what a division leaves, with the sign of the divisor."""
    if not number:
        raise ZeroDivisionError("division by zero")
    return x % number


def power(x, exponent):
    """Return a power; a negative number cannot have one that is not whole."""
    if x < 0 and exponent != floor(exponent):
        raise ValueError("negative number cannot be raised to a fractional power")
    return x**exponent


# ---------------------------------------------------------------- functions of numbers


def clamp(value, low, high):
    """Return a value, or the limit that it is beyond."""
    if not all(map(is_number, (value, low, high))):
        raise TypeError("clamp requires 3 numeric arguments")
    return low if value < low else high if value > high else value


def lerp(a, b, share, do_clamp=True, /):
    """Return the number at a share of the way from a to b."""
    a, b, share = to_float(a), to_float(b), to_float(share)
    if do_clamp:
        share = min(max(share, 0.0), 1.0)
    return a + (b - a) * share


def invlerp(a, b, value, /):
    """Return the share of the way from a to b at which a number lies."""
    a, b, value = to_float(a), to_float(b), to_float(value)
    if b == a:
        raise ValueError("the result of b - a needs to be different from zero")
    return (value - a) / (b - a)


def remap(i_min, i_max, o_min, o_max, value, /):
    """Return the number that lies in one range as a value does in another."""
    i_min, i_max, o_min, o_max, value = map(to_float, (i_min, i_max, o_min, o_max, value))
    if i_max == i_min:
        raise ValueError("the result of i_max - i_min needs to be different from zero")
    share = (value - i_min) / (i_max - i_min)
    return o_min + (o_max - o_min) * share


def smoothstep(a, b, share, /):
    """Return a number on the way from a to b, with a soft start and end."""
    a, b, share = to_float(a), to_float(b), min(max(to_float(share), 0.0), 1.0)
    share = share * share * (3 - 2 * share)
    return a + (b - a) * share


def __getattr__(name):
    refuse(__name__, name)
