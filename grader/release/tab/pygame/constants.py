"""The numbers of keys, events and flags in pygame-ce."""

NOEVENT, QUIT, KEYDOWN, KEYUP, TEXTEDITING, TEXTINPUT = 0, 256, 768, 769, 770, 771
MOUSEMOTION, MOUSEBUTTONDOWN, MOUSEBUTTONUP, MOUSEWHEEL = 1024, 1025, 1026, 1027
ACTIVEEVENT, VIDEORESIZE, VIDEOEXPOSE = 32768, 32769, 32770
WINDOWSHOWN, WINDOWRESIZED, WINDOWENTER, WINDOWLEAVE = 32773, 32777, 32782, 32783
WINDOWFOCUSGAINED, WINDOWFOCUSLOST, WINDOWCLOSE = 32784, 32785, 32786
USEREVENT, NUMEVENTS = 32865, 65535

KMOD_NONE, KMOD_LSHIFT, KMOD_RSHIFT, KMOD_SHIFT = 0, 1, 2, 3
KMOD_LCTRL, KMOD_RCTRL, KMOD_CTRL = 64, 128, 192
KMOD_LALT, KMOD_RALT, KMOD_ALT = 256, 512, 768
KMOD_LGUI = KMOD_LMETA = 1024
KMOD_RGUI = KMOD_RMETA = 2048
KMOD_GUI = KMOD_META = 3072
KMOD_NUM, KMOD_CAPS, KMOD_MODE = 4096, 8192, 16384

BUTTON_LEFT, BUTTON_MIDDLE, BUTTON_RIGHT, BUTTON_WHEELUP, BUTTON_WHEELDOWN = 1, 2, 3, 4, 5
SWSURFACE, HWSURFACE, OPENGL, RESIZABLE, NOFRAME, SHOWN, HIDDEN = 0, 1, 2, 16, 32, 64, 128
SCALED, SRCALPHA, DOUBLEBUF, FULLSCREEN = 512, 65536, 1 << 30, -(1 << 31)

SIGNS = {
    "BACKQUOTE": "`", "BACKSLASH": "\\", "COMMA": ",", "EQUALS": "=", "LEFTBRACKET": "[",
    "MINUS": "-", "PERIOD": ".", "QUOTE": "'", "RIGHTBRACKET": "]", "SEMICOLON": ";",
    "SLASH": "/", "AMPERSAND": "&", "ASTERISK": "*", "AT": "@", "CARET": "^", "COLON": ":",
    "DOLLAR": "$", "EXCLAIM": "!", "GREATER": ">", "HASH": "#", "LEFTPAREN": "(", "LESS": "<",
    "PERCENT": "%", "PLUS": "+", "QUESTION": "?", "QUOTEDBL": '"', "RIGHTPAREN": ")",
    "UNDERSCORE": "_",
}  # fmt: skip
CONTROLS = {  # name: (code, name in messages)
    "BACKSPACE": (8, "backspace"), "TAB": (9, "tab"), "RETURN": (13, "return"),
    "ESCAPE": (27, "escape"), "SPACE": (32, "space"), "DELETE": (127, "delete"),
}  # fmt: skip
OTHERS = {  # the same for keys without a character; their codes are 1 << 30 and more
    "CAPSLOCK": (57, "caps lock"), "PRINT": (70, "print screen"), "SCROLLLOCK": (71, "scroll lock"),
    "PAUSE": (72, "break"), "INSERT": (73, "insert"), "HOME": (74, "home"), "PAGEUP": (75, "page up"),
    "END": (77, "end"), "PAGEDOWN": (78, "page down"), "RIGHT": (79, "right"), "LEFT": (80, "left"),
    "DOWN": (81, "down"), "UP": (82, "up"), "NUMLOCK": (83, "numlock"), "KP_DIVIDE": (84, "[/]"),
    "KP_MULTIPLY": (85, "[*]"), "KP_MINUS": (86, "[-]"), "KP_PLUS": (87, "[+]"),
    "KP_ENTER": (88, "enter"), "KP_PERIOD": (99, "[.]"), "MENU": (118, "menu"),
    "LCTRL": (224, "left ctrl"), "LSHIFT": (225, "left shift"), "LALT": (226, "left alt"),
    "LGUI": (227, "left meta"), "RCTRL": (228, "right ctrl"), "RSHIFT": (229, "right shift"),
    "RALT": (230, "right alt"), "RGUI": (231, "right meta"),
}  # fmt: skip
OTHERS |= {f"F{number}": (57 + number, f"f{number}") for number in range(1, 13)}
OTHERS |= {f"KP{number}": (88 + (number or 10), f"[{number}]") for number in range(10)}
OTHERS |= {name.replace("KP", "KP_"): OTHERS[name] for name in map("KP{}".format, range(10))}

key_names = {ord(sign): sign for sign in "abcdefghijklmnopqrstuvwxyz0123456789"}  # by code
key_names |= {ord(sign): sign for sign in SIGNS.values()} | dict(CONTROLS.values())
key_names |= {1 << 30 | number: name for number, name in OTHERS.values()}
KEYS = {f"K_{sign}": ord(sign) for sign in "abcdefghijklmnopqrstuvwxyz0123456789"}
KEYS |= {f"K_{name}": ord(sign) for name, sign in SIGNS.items()}
KEYS |= {f"K_{name}": code for name, (code, _) in CONTROLS.items()}
KEYS |= {f"K_{name}": 1 << 30 | number for name, (number, _) in OTHERS.items()}
globals().update(KEYS)
K_UNKNOWN = 0

__all__ = [name for name in dir() if name.isupper() and name[0] != "_"] + list(KEYS)
__all__ = sorted({*__all__} - {"SIGNS", "CONTROLS", "OTHERS", "KEYS"})
