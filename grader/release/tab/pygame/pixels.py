"""Pixels of draw commands, where colours are needed: get_at, photos and checksums of a window.

The page draws on a canvas and hands no pixels back, so they are computed here, row by row. Shapes
cover the same pixels as in pygame-ce, except a few at slanted edges. Letters become bars.
"""

from math import floor, hypot, sqrt

BLANK = bytes(4)
LINE_HEIGHT = 0.7  # of a font's size: height of the bars


class Pixels:
    """A picture as bytes: red, green, blue and alpha of each pixel, row by row."""

    def __init__(self, width, height):
        self.width, self.height = width, height
        self.bytes = bytearray(4 * width * height)
        self.at = (0, 0)  # position of the commands' (0, 0)
        self.clip = (0, 0, width, height)  # left, top, right, bottom

    def paint(self, commands):
        """Carry out draw commands."""
        for command in commands:
            getattr(self, f"_{command[0]}")(*command[1:])

    def __getitem__(self, place):
        x, y = place
        start = 4 * (y * self.width + x)
        return tuple(self.bytes[start : start + 4])

    def _span(self, y, begin, end, color):
        """Colour the pixels from begin up to, but not including, end."""
        y += self.at[1]
        left, top, right, bottom = self.clip
        begin, end = max(begin + self.at[0], left), min(end + self.at[0], right)
        if begin >= end or not top <= y < bottom:
            return
        start, end = 4 * (y * self.width + begin), 4 * (y * self.width + end)
        if color[3] == 255:
            self.bytes[start:end] = color * ((end - start) // 4)
        else:
            self._blend(start, end, color)

    def _blend(self, start, end, color):
        share = color[3] / 255
        for at in range(start, end, 4):
            below = self.bytes[at : at + 4]
            rest = below[3] / 255 * (1 - share)
            whole = share + rest or 1.0
            mixed = [
                (new * share + old * rest) / whole for new, old in zip(color, below, strict=True)
            ]
            self.bytes[at : at + 4] = bytes([*map(round, mixed[:3]), round(255 * whole)])

    # ------------------------------------------------------------ the commands

    def _rect(self, x, y, w, h, css, width, radius=0):
        color = read_css(css)
        if not width:
            for row in range(y, y + h):
                self._span(row, x, x + w, color)
            return
        x, y, w, h = (round(each) for each in (x - width / 2, y - width / 2, w + width, h + width))
        self._rect(x, y, w, width, css, 0)
        self._rect(x, y + h - width, w, width, css, 0)
        self._rect(x, y + width, width, h - 2 * width, css, 0)
        self._rect(x + w - width, y + width, width, h - 2 * width, css, 0)

    def _circle(self, x, y, radius, css, width):
        color = read_css(css)
        for row in range(floor(y - radius), floor(y + radius) + 1):
            outer = half_chord(row + 0.5 - y, radius)
            inner = half_chord(row + 0.5 - y, radius - width) if width else 0.0
            if inner:
                self._span(row, round(x - outer), round(x - inner), color)
                self._span(row, round(x + inner), round(x + outer), color)
            elif outer:
                self._span(row, round(x - outer), round(x + outer), color)

    def _line(self, x, y, to_x, to_y, css, width):
        if width == 1:
            self._thin_line(floor(x), floor(y), floor(to_x), floor(to_y), read_css(css))
            return
        length = hypot(to_x - x, to_y - y) or 1.0
        over, down = (to_y - y) / length * width / 2, (x - to_x) / length * width / 2
        corners = x + over, y + down, to_x + over, to_y + down
        self._fill(corners + (to_x - over, to_y - down, x - over, y - down), read_css(css))

    def _thin_line(self, x, y, to_x, to_y, color):
        """Colour one pixel in each row or column, by Bresenham's method."""
        over, down = abs(to_x - x), -abs(to_y - y)
        step_x, step_y = (1 if x < to_x else -1), (1 if y < to_y else -1)
        error = over + down
        for _ in range(max(over, -down) + 1):
            self._span(y, x, x + 1, color)
            double = 2 * error
            if double >= down:
                error, x = error + down, x + step_x
            if double <= over:
                error, y = error + over, y + step_y

    def _poly(self, numbers, css, width):
        color = read_css(css)
        points = list(zip(numbers[::2], numbers[1::2], strict=True))
        if not width:
            self._fill(numbers, color)
        for (x, y), (to_x, to_y) in zip(points, points[1:] + points[:1], strict=True):
            self._line(x, y, to_x, to_y, css, max(width, 1))

    def _fill(self, numbers, color):
        """Colour the pixels whose middle is inside a polygon."""
        points = list(zip(numbers[::2], numbers[1::2], strict=True))
        edges = list(zip(points, points[1:] + points[:1], strict=True))
        low, high = min(numbers[1::2]), max(numbers[1::2])
        for row in range(floor(low), floor(high) + 1):
            middle = row + 0.5
            crossed = sorted(
                x + (middle - y) * (to_x - x) / (to_y - y)
                for (x, y), (to_x, to_y) in edges
                if (y <= middle) != (to_y <= middle)
            )
            for begin, end in zip(crossed[::2], crossed[1::2], strict=True):
                self._span(row, round(begin), round(end), color)

    def _text(self, x, y, text, css, size):
        """Draw a bar for each letter, with gaps that differ from letter to letter."""
        color, wide = read_css(css), max(int(size * 0.38), 2)
        for number, letter in enumerate(text):
            left = floor(x) + number * wide
            for row in range(floor(size * LINE_HEIGHT * 0.8)):
                if letter != " " and row % 8 != 7 and not ord(letter) >> row % 7 & 1:
                    self._span(floor(y) + row, left, left + wide - 1, color)

    def _at(self, x, y, commands):
        before = self.at
        self.at = before[0] + floor(x), before[1] + floor(y)
        self.paint(commands)
        self.at = before

    def _within(self, x, y, w, h, commands):
        before = self.clip
        left, top = max(before[0], self.at[0] + x), max(before[1], self.at[1] + y)
        self.clip = (
            left,
            top,
            min(before[2], self.at[0] + x + w),
            min(before[3], self.at[1] + y + h),
        )
        self.paint(commands)
        self.clip = before


def half_chord(above, radius):
    """Return half the width of a circle at a distance from its middle; 0 outside."""
    return radius * sqrt(1 - (above / radius) ** 2) if abs(above) < radius else 0.0


def read_css(css):
    """Return #RRGGBB or #RRGGBBAA as four bytes."""
    return (bytes.fromhex(css[1:]) + b"\xff")[:4]
