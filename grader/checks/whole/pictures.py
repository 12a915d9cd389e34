"""Look at the window at a few moments: every disc where it is, its spoke, and nothing else.

A program may draw in any style and colours. So each pixel is compared with the same pixel at
another moment, when no disc covers it. The picture may be a frame late, or between two steps.
"""

import math
import zlib
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise

from grader.checks.whole.lab_scene import HOOK
from grader.checks.whole.movers import Mover
from grader.judge.decode import Pair
from grader.judge.lab import Lab
from grader.protocol import Photo, Played

SIZE = (900, 600)  # px
LATE = 8  # steps: maximum age of the state in a picture
APART = 16  # of 255: colours that differ by more in a channel are different
MARGIN = 6.0  # px around a disc or a rod
TEXT, FLOOR = 58, 558  # px: above and below there may be text
SHOWN = 0.25  # share of the points of a disc that differ from the background
CLEARED = 0.9  # share of the points where discs have been
TURNED = 0.4  # rad
PLAIN = 0.85  # share of a ring in one colour, where it lies on a disc and not beside it
SAMPLES = 48  # of a ring


@dataclass
class Disc:
    """A disc at one moment."""

    place: Pair
    radius: float
    angle: float
    is_bob: bool

    def ring(self, share: float, count: int) -> list[Pair]:
        """Return points around its centre at a share of its radius."""
        x, y = self.place
        turns = (2 * math.pi * number / count for number in range(count))
        reach = share * self.radius
        return [(x + reach * math.cos(turn), y + reach * math.sin(turn)) for turn in turns]

    def circles(self) -> Iterator[tuple[float, float, float]]:
        """Yield circles (x, y, radius) that the disc or its rod may have coloured."""
        yield *self.place, self.radius + MARGIN
        if self.is_bob:
            (x, y), (along_x, along_y) = HOOK, self.place
            count = int(min(math.dist(HOOK, self.place), 2 * SIZE[0]) / MARGIN) + 1
            for share in (number / count for number in range(count)):
                yield x + share * (along_x - x), y + share * (along_y - y), 1.5 * MARGIN


class Picture:
    """The colours of a photo of the window, and the discs in the steps that it may show."""

    def __init__(self, colours: bytes, moments: list[list[Disc]]) -> None:
        self.colours = colours
        self.moments = moments
        self.discs = moments[-1]  # until the step that it shows is found
        self.covered = mark_covered(disc for discs in moments for disc in discs)

    def __getitem__(self, point: Pair) -> tuple[int, ...]:
        """Return the colour at a point."""
        start = 3 * pixel(point)
        return tuple(self.colours[start : start + 3])

    def is_free(self, point: Pair) -> bool:
        """Return whether nothing that moves is near a point."""
        return not self.covered[pixel(point)]


def pixel(point: Pair) -> int:
    """Return the number of the pixel at a point, row by row."""
    return SIZE[0] * round(point[1]) + round(point[0])


def mark_covered(discs: Iterable[Disc]) -> bytearray:
    """Return for each pixel of the window whether one of the discs may have coloured it."""
    width, height = SIZE
    pixels = bytearray(width * height)
    for x, y, radius in dict.fromkeys(circle for disc in discs for circle in disc.circles()):
        for row in range(max(math.ceil(y - radius), 0), min(math.floor(y + radius) + 1, height)):
            half = math.sqrt(radius**2 - (row - y) ** 2)
            begin, end = max(math.floor(x - half), 0), min(math.ceil(x + half) + 1, width)
            if begin < end:
                pixels[width * row + begin : width * row + end] = b"\1" * (end - begin)
    return pixels


def want_pictures(lab: Lab, played: Played, movers: Sequence[Mover], frames: Sequence[int]) -> None:
    """Insist that at the end of these frames the window shows the simulated state."""
    photos = [(each.frame, seen) for each in played.photos if (seen := decompress(each))]
    lab.want(
        [frame for frame, _ in photos] == list(frames),
        "a window of 900 x 600 px that shows a new picture in each frame",
        f"{len(photos)} such pictures in {len(frames)} frames",
    )
    shown = [Picture(seen, moments_of(played, movers, frame)) for frame, seen in photos]
    for picture in shown:
        want_discs_where_they_are(lab, picture, [each for each in shown if each is not picture])
    want_a_cleared_window(lab, movers, shown[0], shown[-1])
    want_turning_spokes(lab, shown)


def decompress(photo: Photo) -> bytes:
    """Return the colours of a photo; empty unless it covers the whole window."""
    length = 3 * SIZE[0] * SIZE[1]
    if (photo.width, photo.height) != SIZE:
        return b""
    try:
        colours = zlib.decompressobj().decompress(photo.colours, length)
    except zlib.error:
        return b""
    return colours if len(colours) == length else b""


def moments_of(played: Played, movers: Sequence[Mover], frame: int) -> list[list[Disc]]:
    """Return the discs in each step that a picture at the end of a frame may show."""
    last = sum(played.steps[: frame + 1])
    return [
        [
            Disc((m.trail[step].x, m.trail[step].y), m.radius, m.trail[step].angle, m.is_bob)
            for m in movers
        ]
        for step in range(max(last - 1 - LATE, 0), last)
    ]


def want_discs_where_they_are(lab: Lab, picture: Picture, others: list[Picture]) -> None:
    """Insist that the picture shows all discs as in one of its possible steps."""
    shares = [[seen_share(disc, picture, others) for disc in discs] for discs in picture.moments]
    best = max(shares, key=sum)
    picture.discs = picture.moments[shares.index(best)]
    least = [disc for disc, share in zip(picture.discs, best, strict=True) if share < SHOWN]
    lab.want(
        not least,
        "a picture with every ball where it is",
        f"{len(least)} that cannot be seen, one of them at "
        f"({least[0].place[0]:.0f}, {least[0].place[1]:.0f})"
        if least
        else "",
    )


def seen_share(disc: Disc, picture: Picture, others: list[Picture]) -> float:
    """Return the visible share of a disc; 1 where it cannot be separated from its neighbours."""
    points = [each for each in (*disc.ring(0.55, 12), *disc.ring(0.9, 12)) if is_clear(each)]
    known = [
        differ(picture[point], other[point])
        for point in points
        for other in islice((each for each in others if each.is_free(point)), 1)
    ]
    return sum(known) / len(known) if known else 1.0


def want_a_cleared_window(lab: Lab, movers: Sequence[Mover], first: Picture, last: Picture) -> None:
    """Insist that the discs' old positions are cleared."""
    points = [
        (moment.x, moment.y)
        for mover in movers
        for moment in mover.trail[::6]
        if is_clear((moment.x, moment.y))
    ]
    known = [each for each in points if first.is_free(each) and last.is_free(each)]
    left = [each for each in known if differ(first[each], last[each])]
    lab.want(
        len(left) <= (1 - CLEARED) * len(known),
        "a window that is cleared in each frame",
        f"traces of the balls, for instance at ({left[0][0]:.0f}, {left[0][1]:.0f})"
        if left
        else "",
    )


def want_turning_spokes(lab: Lab, shown: list[Picture]) -> None:
    """Insist that most discs look different once they have turned."""
    both = [pair for one, other in pairwise(shown) for pair in find_turned(one, other)]
    lab.want(bool(both), "balls that turn", "none that has turned")
    seen = [pair for pair in both if all(map(is_plain, pair))]
    changed = sum(count_changes(*pair) > 0 for pair in seen)
    lab.want(
        not seen or 2 * changed > len(seen),
        "a spoke on each ball that shows how it turns",
        "balls that look the same however they turn",
    )


def find_turned(one: Picture, other: Picture) -> Iterator[tuple[list[tuple[int, ...]], ...]]:
    """Return the rings of each ball that has turned from one picture to the other."""
    for before, after in zip(one.discs, other.discs, strict=True):
        if before.is_bob:  # its rod turns about it
            continue
        angle = (after.angle - before.angle) % (2 * math.pi)
        rings = before.ring(0.6, SAMPLES), after.ring(0.6, SAMPLES)
        if TURNED < angle < 2 * math.pi - TURNED and all(map(is_clear, (*rings[0], *rings[1]))):
            yield [one[point] for point in rings[0]], [other[point] for point in rings[1]]


def is_plain(ring: list[tuple[int, ...]]) -> bool:
    """Return whether nearly all of a ring has one colour, that of its disc."""
    counts = Counter(ring)
    most = max(
        sum(count for other, count in counts.items() if not differ(one, other)) for one in counts
    )
    return most >= PLAIN * len(ring)


def count_changes(before: list[tuple[int, ...]], after: list[tuple[int, ...]]) -> int:
    """Count samples unlike the old ones at their place and beside it: rounding may shift by one."""
    near = zip(before[-1:] + before[:-1], before, before[1:] + before[:1], strict=True)
    return sum(
        all(differ(now, each) for each in some) for now, some in zip(after, near, strict=True)
    )


def is_clear(point: Pair) -> bool:
    """Return whether a point is in the window, and text is not expected there."""
    return 1 < point[0] < SIZE[0] - 2 and TEXT < point[1] < FLOOR


def differ(one: Sequence[int], other: Sequence[int]) -> bool:
    (red, green, blue), (red_too, green_too, blue_too) = one, other
    return (
        abs(red - red_too) > APART or abs(green - green_too) > APART or abs(blue - blue_too) > APART
    )
