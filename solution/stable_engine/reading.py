"""Return readings of a body: a Vector2 that cannot be changed in place."""

from typing import Any

from pygame import Vector2

IN_PLACE = (
    *("__setitem__", "update", "scale_to_length", "normalize_ip", "rotate_ip", "rotate_rad_ip"),
    *("reflect_ip", "move_towards_ip", "clamp_magnitude_ip"),
)


class Reading(Vector2):
    """A body's position or velocity. Setting a part raises an error instead of changing nothing.

    It is a copy, so body.vel.x += 5 would be lost; body.vel += (5, 0) is not. Copies and results
    of arithmetic are ordinary vectors.
    """

    __slots__ = ("field",)  # copies have no field

    def __setattr__(self, name: str, value: Any) -> None:
        if name != "field":
            refuse_change(self)
        super().__setattr__(name, value)


def read(field: str, x: float, y: float) -> Vector2:
    """Return a Reading for the field of that name."""
    reading = Reading(x, y)
    reading.field = field
    return reading


def refuse_change(vector: Vector2) -> None:
    """Raise AttributeError if the vector is a body's."""
    field = getattr(vector, "field", "")
    if field:
        name = field.rpartition(".")[2]
        raise AttributeError(
            f"{field} cannot be changed in part: what you read is a copy. "
            f"Set it whole, as in body.{name} += (5, 0)."
        )


def guarded(name: str) -> Any:
    """Return a method of Vector2 made to raise an error if it would change a Reading."""
    change = getattr(Vector2, name)

    def method(self: Vector2, *arguments: Any) -> Any:
        refuse_change(self)
        return change(self, *arguments)

    return method


for _name in IN_PLACE:
    setattr(Reading, _name, guarded(_name))
