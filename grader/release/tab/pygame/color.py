"""Color, and the conversion of pygame's colours to those of a canvas."""

from functools import lru_cache

from .naming import Named, full_name

INVALID = (
    "invalid color (color sequence must have size 3 or 4, "
    "and each element must be an integer in the range [0, 255])"
)
COLORS = """
aliceblue f0f8ff antiquewhite faebd7 aqua 00ffff aquamarine 7fffd4 azure f0ffff beige f5f5dc
bisque ffe4c4 black 000000 blanchedalmond ffebcd blue 0000ff blueviolet 8a2be2 brown a52a2a
burlywood deb887 cadetblue 5f9ea0 chartreuse 7fff00 chocolate d2691e coral ff7f50 cornflowerblue
6495ed cornsilk fff8dc crimson dc143c cyan 00ffff darkblue 00008b darkcyan 008b8b darkgoldenrod
b8860b darkgray a9a9a9 darkgreen 006400 darkgrey a9a9a9 darkkhaki bdb76b darkmagenta 8b008b
darkolivegreen 556b2f darkorange ff8c00 darkorchid 9932cc darkred 8b0000 darksalmon e9967a
darkseagreen 8fbc8f darkslateblue 483d8b darkslategray 2f4f4f darkslategrey 2f4f4f darkturquoise
00ced1 darkviolet 9400d3 deeppink ff1493 deepskyblue 00bfff dimgray 696969 dimgrey 696969
dodgerblue 1e90ff firebrick b22222 floralwhite fffaf0 forestgreen 228b22 fuchsia ff00ff gainsboro
dcdcdc ghostwhite f8f8ff gold ffd700 goldenrod daa520 gray bebebe green 00ff00 greenyellow adff2f
grey bebebe honeydew f0fff0 hotpink ff69b4 indianred cd5c5c indigo 4b0082 ivory fffff0 khaki
f0e68c lavender e6e6fa lavenderblush fff0f5 lawngreen 7cfc00 lemonchiffon fffacd lightblue add8e6
lightcoral f08080 lightcyan e0ffff lightgoldenrod eedd82 lightgoldenrodyellow fafad2 lightgray
d3d3d3 lightgreen 90ee90 lightgrey d3d3d3 lightpink ffb6c1 lightsalmon ffa07a lightseagreen 20b2aa
lightskyblue 87cefa lightslateblue 8470ff lightslategray 778899 lightslategrey 778899
lightsteelblue b0c4de lightyellow ffffe0 lime 00ff00 limegreen 32cd32 linen faf0e6 magenta ff00ff
maroon b03060 mediumaquamarine 66cdaa mediumblue 0000cd mediumorchid ba55d3 mediumpurple 9370db
mediumseagreen 3cb371 mediumslateblue 7b68ee mediumspringgreen 00fa9a mediumturquoise 48d1cc
mediumvioletred c71585 midnightblue 191970 mintcream f5fffa mistyrose ffe4e1 moccasin ffe4b5
navajowhite ffdead navy 000080 navyblue 000080 oldlace fdf5e6 olive 808000 olivedrab 6b8e23 orange
ffa500 orangered ff4500 orchid da70d6 palegoldenrod eee8aa palegreen 98fb98 paleturquoise afeeee
palevioletred db7093 papayawhip ffefd5 peachpuff ffdab9 peru cd853f pink ffc0cb plum dda0dd
powderblue b0e0e6 purple a020f0 red ff0000 rosybrown bc8f8f royalblue 4169e1 saddlebrown 8b4513
salmon fa8072 sandybrown f4a460 seagreen 2e8b57 seashell fff5ee sienna a0522d silver c0c0c0
skyblue 87ceeb slateblue 6a5acd slategray 708090 slategrey 708090 snow fffafa springgreen 00ff7f
steelblue 4682b4 tan d2b48c teal 008080 thistle d8bfd8 tomato ff6347 turquoise 40e0d0 violet
ee82ee violetred d02090 wheat f5deb3 white ffffff whitesmoke f5f5f5 yellow ffff00 yellowgreen
9acd32
"""
NAMES = COLORS.split()
THECOLORS = dict(zip(NAMES[::2], NAMES[1::2], strict=True))  # name: RRGGBB


class Color(metaclass=Named):
    """A colour; r, g, b and a are whole numbers from 0 to 255."""

    __slots__ = ("a", "b", "g", "r")
    __hash__ = None

    def __init__(self, *values):
        self.r, self.g, self.b, self.a = read_color(*values)

    def __iter__(self):
        return iter((self.r, self.g, self.b, self.a))

    def __len__(self):
        return 4

    def __getitem__(self, index):
        return (self.r, self.g, self.b, self.a)[index]

    def __eq__(self, other):
        try:
            return tuple(self) == read_color(other)
        except (TypeError, ValueError):
            return False

    def __repr__(self):
        return f"Color({self.r}, {self.g}, {self.b}, {self.a})"


def read_color(*values):
    """Return (r, g, b, a) of any colour that pygame accepts; raise ValueError or TypeError."""
    if len(values) > 1:
        return check_channels(values)
    (value,) = values or ((0, 0, 0, 255),)
    if isinstance(value, str):
        return read_text(value)
    if isinstance(value, Color):
        return value.r, value.g, value.b, value.a
    if isinstance(value, int):
        if not 0 <= value <= 0xFFFFFFFF:
            raise ValueError("invalid color argument")
        return tuple(value.to_bytes(4, "big"))
    if not hasattr(value, "__getitem__") or not hasattr(value, "__len__"):
        raise TypeError(f"unable to interpret object of type '{full_name(value)}' as a color")
    return check_channels(value)


def check_channels(values):
    """Return three or four numbers as whole (r, g, b, a), or one as a whole number."""
    try:
        numbers = tuple(map(int, values))
    except (TypeError, ValueError, OverflowError):
        raise ValueError(INVALID) from None
    if len(numbers) not in (1, 3, 4) or not all(0 <= each <= 255 for each in numbers):
        raise ValueError(INVALID)
    return (*numbers, 255) if len(numbers) == 3 else numbers


def read_text(text):
    """Return (r, g, b, a) of a name, or of digits as in #RRGGBB and 0xRRGGBBAA."""
    name = text.replace(" ", "").lower()
    digits = THECOLORS.get(name, name.removeprefix("#").removeprefix("0x"))
    if name[:4] in ("gray", "grey") and name[4:].isdecimal() and int(name[4:]) <= 100:
        digits = f"{int(int(name[4:]) * 2.55 + 0.5):02x}" * 3
    if len(digits) not in (6, 8) or (digits == name and name not in THECOLORS):
        raise ValueError("invalid color name")
    try:
        return (*bytes.fromhex(digits), 255)[:4]
    except ValueError:
        raise ValueError("invalid color name") from None


def css(color, opaque):
    """Return a colour as #RRGGBB or, for a surface with transparency, also as #RRGGBBAA."""
    try:
        return make_css(color, opaque)
    except TypeError:  # a list or a Color cannot be cached
        return make_css.__wrapped__(color, opaque)


@lru_cache(4096)
def make_css(color, opaque):
    text = "#%02x%02x%02x%02x" % read_color(color)
    return text[:7] if opaque or text[7:] == "ff" else text
