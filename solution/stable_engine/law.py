"""Newton's law of restitution, at the moment of an impact."""

from math import sqrt

from .contact import Contact
from .flight import Flight
from .frame import Frame
from .hit import Hit, resolve_at_once
from .order import balls_of
from .row import Row
from .time_of_impact import speed_at_touch


def resolve(group: list[Contact], frames: list[Frame], flight: Flight) -> None:
    """Make contacts separate at the speeds of the law, or faster, with the rods of frames."""
    c = group[0]
    if len(group) == 1 and not (frames or c.mu):
        closing = c.closing_speed()
        parting, _ = law_of(c, closing, flight)
        c.push_apart(max((parting + closing) * c.mn, 0.0))
    else:
        solve_together(group, frames, flight)
    for body in balls_of(group) if flight.rests else []:
        if body in flight.rests and body not in flight.frame_of:
            flight.release(body)


def solve_together(group: list[Contact], frames: list[Frame], flight: Flight) -> None:
    """Solve contacts and rods together, as each changes the speeds at the others."""
    for frame in frames:
        frame.hold()
    hits = [Hit(c, law_of(c, c.closing_speed(), flight)) for c in group]
    rods = [Row(rod.end_a, rod.end_b, rod.nx, rod.ny) for frame in frames for rod in frame.rods]
    resolve_at_once(hits, rods)


def law_of(c: Contact, closing: float, flight: Flight) -> tuple[float, float]:
    """Return the speed (px/s) at which a pair separates that closes in at the other.

    At any step size a ball leaves a wall exactly: e is applied to its speed at the surface. If
    it was not moved back there, conservation of energy gives that speed, and the present one.

    Also return the share of the impulse without the speed gained below the surface.
    """
    e = c.e
    g, lag = flight.closing_acceleration(c)
    lag += flight.stiff_lag(c) if flight.stiff else 0.0
    if g == lag == 0:
        return e * closing, 1.0
    crossing = max(speed_at_touch(c, closing, g, lag), 0.0)
    gap = c.gap if abs(c.gap) > flight.contacts.touching_gap else 0.0
    most = (closing + lag) * (closing + lag)
    parting = sqrt(max(min(e * e * crossing * crossing - 2 * g * gap, most), 0.0)) + lag
    whole = parting + closing
    return parting, min((1 + e) * crossing / whole, 1.0) if whole > 0 else 1.0
