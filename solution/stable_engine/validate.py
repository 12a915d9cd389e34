"""Check what a caller passes in: bad input raises an error that names the value."""

import math
import operator
from collections.abc import Callable, Iterable
from typing import NoReturn, TypeVar

Function = TypeVar("Function", bound=Callable[..., object])


class WrongType(TypeError, ValueError):
    """Raised for a value of the wrong type. `except ValueError` catches it as well."""


def refuse(field: str, value: object, rule: str) -> NoReturn:
    """Raise WrongType naming the field, its value and the rule."""
    raise WrongType(f"{field} is {value!r}, but it must be {rule}.")


def require(ok: bool, field: str, value: object, rule: str) -> None:
    """Raise ValueError naming the field, its value and the rule, unless ok is true."""
    if not ok:
        raise ValueError(f"{field} is {value}, but it must be {rule}.")


def number(field: str, value: float, low: float, high: float, rule: str) -> float:
    """Return value as a float. Raises ValueError when it is NaN or not from low to high."""
    try:
        ok = math.isfinite(value) and low <= value <= high
    except TypeError:
        refuse(field, value, rule)
    require(ok, field, value, rule)
    return float(value)


def finite(field: str, value: float) -> float:
    """Return value as a float. Raises ValueError when it is NaN or infinite."""
    return number(field, value, -math.inf, math.inf, "a finite number")


def not_negative(field: str, value: float) -> float:
    """Return value as a float. Raises ValueError when it is below 0, NaN or infinite."""
    return number(field, value, 0, math.inf, "a finite number, 0 or more")


def positive(field: str, value: float) -> float:
    """Return value as a float. Raises ValueError when it is 0 or below, NaN or infinite."""
    return number(field, value, math.ulp(0), math.inf, "a finite number above 0")


def whole(field: str, value: int) -> int:
    """Return value as an int. Raises ValueError when it is no whole number above 0."""
    rule = "a whole number above 0"
    try:
        count = operator.index(value)
    except TypeError:
        refuse(field, value, rule)
    require(count > 0, field, value, rule)
    return count


def pair(field: str, value: Iterable[float]) -> tuple[float, float]:
    """Return value as two floats. Raises ValueError when it is not a pair of finite numbers."""
    rule = "a pair of finite numbers"
    try:
        numbers = tuple(value)
        ok = len(numbers) == 2 and all(map(math.isfinite, numbers))
    except TypeError:
        refuse(field, value, rule)
    require(ok, field, value, rule)
    return float(numbers[0]), float(numbers[1])


def function(field: str, value: Function | None, arguments: str) -> Function | None:
    """Return value. Raises ValueError when it is neither a function, of these, nor None."""
    if value is not None and not callable(value):
        refuse(field, value, f"a function of {arguments}, or None")
    return value
