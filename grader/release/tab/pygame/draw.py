"""Shapes, as commands for a canvas.

A place is cut to whole pixels, as pygame does. Lines and polygons run through the middles of
pixels, so half a pixel is added; rectangles and circles have their edges between pixels.
"""

from .math import is_number, read_pair
from .naming import full_name, refuse
from .rect import Rect, read_rect, to_int
from .surface import Surface


def check(surface, color):
    """Return the colour as a text; raise TypeError without a surface."""
    if not isinstance(surface, Surface):
        raise TypeError(f"argument 1 must be pygame.surface.Surface, not {full_name(surface)}")
    return surface.css(color)


def read_point(point, message):
    """Return a place in whole pixels."""
    pair = read_pair(point)
    if pair is None:
        raise TypeError(message)
    return to_int(pair[0]), to_int(pair[1])


def read_points(points, least, message):
    """Return at least this many places in whole pixels."""
    if not hasattr(points, "__getitem__") or not hasattr(points, "__len__"):
        raise TypeError("points argument must be a sequence of number pairs")
    if len(points) < least:
        raise ValueError(message)
    return [read_point(each, "points must be number pairs") for each in points]


def find_bounds(surface, points, more=0):
    """Return the part of the rectangle around some pixels that is on the surface."""
    xs, ys = [x for x, _ in points], [y for _, y in points]
    left, top = min(xs) - more, min(ys) - more
    box = (left, top, max(xs) + more + 1 - left, max(ys) + more + 1 - top)
    return clip_box(surface, box, points[0])


def clip_box(surface, box, start):
    """Return the visible part of a rectangle, or an empty one at `start`."""
    left = surface.get_clip().clip(box)
    return left if left else Rect(*start, 0, 0)


def circle(surface, color, center, radius, width=0):
    """Draw a circle, filled without a width."""
    css = check(surface, color)
    x, y = read_point(center, "center argument must be a pair of numbers")
    radius, width = read_radius(radius), int(width)
    if radius < 1 or width < 0:
        return Rect(x, y, 0, 0)
    surface._into.append(("circle", x, y, radius, css, 0 if width >= radius else width))
    return clip_box(surface, (x - radius, y - radius, 2 * radius, 2 * radius), (x, y))


def aacircle(surface, color, center, radius, width=0):
    """Draw a circle with smooth edges; its middle is the middle of a pixel."""
    css = check(surface, color)
    x, y = read_point(center, "center argument must be a pair of numbers")
    radius, width = read_radius(radius), int(width)
    if radius < 1 or width < 0:
        return Rect(x, y, 0, 0)
    width = 0 if width >= radius else width
    surface._into.append(("circle", x + 0.5, y + 0.5, radius, css, width))
    return clip_box(surface, (x - radius, y - radius, 2 * radius + 1, 2 * radius + 1), (x, y))


def read_radius(radius):
    """Return a radius in whole pixels."""
    if not is_number(radius):
        raise TypeError("radius argument must be a number")
    return to_int(radius)


def line(surface, color, start_pos, end_pos, width=1):
    """Draw a line."""
    css = check(surface, color)
    x, y = read_point(start_pos, "invalid start_pos argument")
    to_x, to_y = read_point(end_pos, "invalid end_pos argument")
    if width < 1:
        return Rect(x, y, 0, 0)
    shift = 0.5 if width % 2 else 0.0
    add_line(surface, x + shift, y + shift, to_x + shift, to_y + shift, css, int(width))
    return find_bounds(surface, [(x, y), (to_x, to_y)], int(width) // 2)


def add_line(surface, x, y, to_x, to_y, css, width):
    """Add the command of a line, unless it is too long for a canvas."""
    if max(map(abs, (x, y, to_x, to_y))) < 1e6:
        surface._into.append(("line", x, y, to_x, to_y, css, width))


def aaline(surface, color, start_pos, end_pos, width=1):
    """Draw a line with smooth edges."""
    css = check(surface, color)
    start = read_pair(start_pos)
    end = read_pair(end_pos)
    if start is None or end is None:
        raise TypeError(f"invalid {'end' if start else 'start'}_pos argument")
    if width < 1:
        return Rect(to_int(start[0]), to_int(start[1]), 0, 0)
    add_line(surface, *(each + 0.5 for each in (*start, *end)), css, int(width))
    return find_bounds(
        surface, [tuple(map(to_int, start)), tuple(map(to_int, end))], int(width) // 2
    )


def lines(surface, color, closed, points, width=1):
    """Draw lines from each point to the next."""
    check(surface, color)
    points = read_points(points, 2, "points argument must contain 2 or more points")
    if width < 1:
        return Rect(*points[0], 0, 0)
    ends = points[1:] + points[:1] if closed else points[1:]
    for start, end in zip(points, ends, strict=False):
        line(surface, color, start, end, width)
    return find_bounds(surface, points, int(width) // 2)


def aalines(surface, color, closed, points, blend=1):
    """Draw lines with smooth edges from each point to the next."""
    return lines(surface, color, closed, points)


def polygon(surface, color, points, width=0):
    """Draw a polygon, filled without a width."""
    css = check(surface, color)
    places = read_points(points, 3, "points argument must contain more than 2 points")
    if width:
        return lines(surface, color, True, points, width)
    numbers = [number + 0.5 for place in places for number in place]
    if max(map(abs, numbers)) < 1e6:
        surface._into.append(("poly", numbers, css, 0))
    return find_bounds(surface, places)


def rect(surface, color, rect, width=0, border_radius=-1, *_, **__):
    """Draw a rectangle, filled without a width; a border lies inside."""
    css = check(surface, color)
    x, y, w, h = need_rect(rect)
    width = int(width)
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
    return clip_box(surface, (x, y, w, h), (x, y))


def need_rect(value):
    """Return (x, y, w, h); raises the TypeError of this module."""
    try:
        return read_rect(value)
    except TypeError:
        raise TypeError("rect argument is invalid") from None


def ellipse(surface, color, rect, width=0):
    """Draw the ellipse in a rectangle, filled without a width."""
    css = check(surface, color)
    x, y, w, h = need_rect(rect)
    if width < 0 or w < 1 or h < 1:
        return Rect(x, y, 0, 0)
    width = 0 if 2 * width >= min(w, h) else int(width)
    surface._into.append(("ellipse", x, y, w, h, css, width))
    return clip_box(surface, (x, y, w, h), (x, y))


def arc(surface, color, rect, start_angle, stop_angle, width=1):
    """Draw a part of the ellipse in a rectangle, between two angles in rad, anticlockwise."""
    from math import tau

    css = check(surface, color)
    x, y, w, h = need_rect(rect)
    if width < 1 or w < 1 or h < 1:
        return Rect(x, y, 0, 0)
    while stop_angle < start_angle:
        stop_angle += tau
    surface._into.append(("arc", x, y, w, h, start_angle, stop_angle, css, int(width)))
    return clip_box(surface, (x, y, w, h), (x, y))
