"""Read single keys of a terminal, without Enter."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import import_module

MOST = 64  # bytes of one key, such as an arrow
ESCAPE = "\x1b"  # begins keys that are not letters


@contextmanager
def open_keys() -> Iterator[Callable[[], str]]:
    """Yield a function that returns the letter typed since the last call, or an empty text."""
    if os.name == "nt":
        yield read_windows_key
        return
    termios, tty = import_module("termios"), import_module("tty")
    terminal = sys.stdin.fileno()
    usual = termios.tcgetattr(terminal)
    tty.setcbreak(terminal)  # Ctrl-C still interrupts
    try:
        yield lambda: read_key(terminal)
    finally:
        termios.tcsetattr(terminal, termios.TCSADRAIN, usual)


def read_key(terminal: int) -> str:
    """Return the letter typed on a terminal, or an empty text."""
    ready, _, _ = import_module("select").select([terminal], [], [], 0)
    typed = os.read(terminal, MOST).decode(errors="ignore") if ready else ""
    return "" if typed.startswith(ESCAPE) else typed[:1].lower()


def read_windows_key() -> str:
    """Return the letter typed on a Windows terminal, where other keys come in two parts."""
    console = import_module("msvcrt")
    if not console.kbhit():
        return ""
    typed: str = console.getwch()
    if typed in "\x00\xe0":
        console.getwch()
        return ""
    return typed.lower()
