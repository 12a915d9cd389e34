"""Checks of what a caller passes in: bad input is an error that names the value."""

import math
from collections.abc import Iterable


def require(ok: bool, field: str, value: object, rule: str) -> None:
    """Raise ValueError naming the field, its value and the rule, unless ok is true."""
    if not ok:
        raise ValueError(f"{field} is {value}, but it must be {rule}.")


def finite(field: str, value: float) -> float:
    """value as a float. Raises ValueError when it is NaN or infinite."""
    require(math.isfinite(value), field, value, "a finite number")
    return float(value)


def not_negative(field: str, value: float) -> float:
    """value as a float. Raises ValueError when it is below 0, NaN or infinite."""
    require(0 <= value < math.inf, field, value, "a finite number, 0 or more")
    return float(value)


def pair(field: str, value: Iterable[float]) -> tuple[float, float]:
    """value as two floats. Raises ValueError when it is not a pair of finite numbers."""
    numbers = tuple(value)
    ok = len(numbers) == 2 and all(map(math.isfinite, numbers))
    require(ok, field, value, "a pair of finite numbers")
    return float(numbers[0]), float(numbers[1])
