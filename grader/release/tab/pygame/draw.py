"""Shapes, as commands for a canvas.

A place is cut to whole pixels, as pygame does. Lines and polygons run through the middles of
pixels, so half a pixel is added; rectangles and circles have their edges between pixels.
"""

from math import cos, pi, sin, tau

from .math import is_number, read_pair
from .naming import full_name
from .rect import Rect, read_rect, to_int
from .surface import Surface

FARTHEST = 1e6  # px, for a canvas
CORNERS = 60  # of the polygon that stands for an ellipse


def check(surface, color):
    """Return the colour as a text; raise TypeError without a surface."""
    if not isinstance(surface, Surface):
        raise TypeError(f"argument 1 must be pygame.surface.Surface, not {full_name(surface)}")
    return surface.css(color)


def read_point(point):
    """Return a place in whole pixels."""
    pair = read_pair(point)
    if pair is None:
        raise TypeError("a point must be a pair of numbers")
    return to_int(pair[0]), to_int(pair[1])


def clip_box(surface, x, y, w, h):
    """Return the visible part of a rectangle, or an empty one in its corner."""
    return surface.get_clip().clip((x, y, w, h)) or Rect(x, y, 0, 0)


def find_bounds(surface, points, more=0):
    """Return the visible part of the rectangle around some pixels."""
    xs, ys = zip(*points, strict=True)
    left, top = min(xs) - more, min(ys) - more
    return clip_box(surface, left, top, max(xs) + more + 1 - left, max(ys) + more + 1 - top)


def circle(surface, color, center, radius, width=0):
    """Draw a circle; width 0 fills it."""
    return add_circle(surface, color, center, radius, width, 0.0)


def aacircle(surface, color, center, radius, width=0):
    """Draw a circle with smooth edges; its middle is the middle of a pixel."""
    return add_circle(surface, color, center, radius, width, 0.5)


def add_circle(surface, color, center, radius, width, shift):
    css, (x, y), width = check(surface, color), read_point(center), int(width)
    if not is_number(radius):
        raise TypeError("radius argument must be a number")
    radius = to_int(radius)
    if radius < 1 or width < 0:
        return Rect(x, y, 0, 0)
    width = 0 if width >= radius else width
    surface._into.append(("circle", x + shift, y + shift, radius, css, width))
    size = 2 * radius + int(2 * shift)
    return clip_box(surface, x - radius, y - radius, size, size)


def line(surface, color, start_pos, end_pos, width=1):
    """Draw a line."""
    return lines(surface, color, False, [start_pos, end_pos], width)


def lines(surface, color, closed, points, width=1):
    """Draw lines from each point to the next."""
    css, width = check(surface, color), int(width)
    points = [read_point(each) for each in points]
    if len(points) < 2:
        raise ValueError("points argument must contain 2 or more points")
    if width < 1:
        return Rect(*points[0], 0, 0)
    shift = 0.5 if width % 2 else 0.0
    ends = points[1:] + points[:1] if closed else points[1:]
    for start, end in zip(points, ends, strict=False):
        add_line(surface, [each + shift for each in (*start, *end)], css, width)
    return find_bounds(surface, points, width // 2)


def aaline(surface, color, start_pos, end_pos, width=1):
    """Draw a line with smooth edges."""
    css, ends = check(surface, color), [read_pair(start_pos), read_pair(end_pos)]
    if None in ends:
        raise TypeError("a point must be a pair of numbers")
    if width >= 1:
        add_line(surface, [each + 0.5 for end in ends for each in end], css, int(width))
    return find_bounds(surface, [tuple(map(to_int, end)) for end in ends], int(width) // 2)


def aalines(surface, color, closed, points, blend=1):
    """Draw lines with smooth edges from each point to the next."""
    return lines(surface, color, closed, points)


def add_line(surface, numbers, css, width):
    """Add the command of a line, unless it is too long for a canvas."""
    if max(map(abs, numbers)) < FARTHEST:
        surface._into.append(("line", *numbers, css, width))


def polygon(surface, color, points, width=0):
    """Draw a polygon; width 0 fills it."""
    css, points = check(surface, color), [read_point(each) for each in points]
    if len(points) < 3:
        raise ValueError("points argument must contain more than 2 points")
    if width:
        return lines(surface, color, True, points, width)
    numbers = [number + 0.5 for point in points for number in point]
    if max(map(abs, numbers)) < FARTHEST:
        surface._into.append(("poly", numbers, css, 0))
    return find_bounds(surface, points)


def rect(surface, color, rect, width=0, border_radius=-1, *_, **__):
    """Draw a rectangle; width 0 fills it, a border lies inside."""
    css, (x, y, w, h), width = check(surface, color), read_rect(rect), int(width)
    if width < 0 or w < 0 or h < 0:
        return Rect(x, y, 0, 0)
    if 2 * width >= min(w, h):
        width = 0
    inset = width / 2
    command = ("rect", x + inset, y + inset, w - width, h - width, css, width)
    if not width:
        command = ("rect", x, y, w, h, css, 0)
    if border_radius > 0:
        command = (*command, min(int(border_radius), w // 2, h // 2))
    surface._into.append(command)
    return clip_box(surface, x, y, w, h)


def ellipse(surface, color, rect, width=0):
    """Draw the ellipse in a rectangle; width 0 fills it."""
    points = list_arc(rect, 0, tau, width)
    return polygon(surface, color, points, width)


def arc(surface, color, rect, start_angle, stop_angle, width=1):
    """Draw a part of the ellipse in a rectangle, between two angles in rad, anticlockwise."""
    stop_angle += tau * (stop_angle < start_angle)
    return lines(surface, color, False, list_arc(rect, start_angle, stop_angle, width), width)


def list_arc(rect, start, stop, width):
    """Return points on the middle of the border of an ellipse, from one angle to another."""
    x, y, w, h = read_rect(rect)
    count = max(round(CORNERS * (stop - start) / (2 * pi)), 2)
    turns = [start + (stop - start) * number / count for number in range(count + 1)]
    wide, high = (w - width) / 2, (h - width) / 2
    return [(x + w / 2 + wide * cos(turn), y + h / 2 - high * sin(turn)) for turn in turns]
