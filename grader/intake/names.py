"""Compare names of students, and make names of files of them."""

import re
import unicodedata

PORTS = {f"{port}{number}" for port in ("com", "lpt") for number in range(10)}
DEVICES = PORTS | {"con", "prn", "aux", "nul"}  # names that Windows reserves
UNPRINTED = frozenset('<>:"/\\|?*')  # signs that Windows refuses in names
LONGEST = 180  # bytes of a file's name, with room for a suffix
MENTIONED = 20  # names in one note


def fold(words: str) -> str:
    """Return the form that all spellings of an identifier share."""
    return unicodedata.normalize("NFC", words).strip().casefold()


def strip_zeros(words: str) -> str:
    """Return a number without leading zeros, as spreadsheets write it; fold other words."""
    plain = fold(words)
    return plain.lstrip("0") or "0" if plain.isdecimal() else plain


def sort_key(words: str) -> list[tuple[int, int, str]]:
    """Return a key that sorts names without accents, and 2 before 10."""
    plain = unicodedata.normalize("NFKD", words.casefold())
    parts = re.findall(r"\d+|\D+", "".join(c for c in plain if not unicodedata.combining(c)))
    return [(0, int(part), "") if part.isdecimal() else (1, 0, part) for part in parts]


def split_login(cell: str) -> list[str]:
    """Return an identifier, and the part before any @."""
    return [name for name in dict.fromkeys([fold(cell), fold(cell).partition("@")[0]]) if name]


def make_portable(words: str) -> str:
    """Return the nearest name that every file system takes."""
    text = unicodedata.normalize("NFC", words)
    text = "".join(c if c.isprintable() and c not in UNPRINTED else "_" for c in text).strip(" .")
    text = text.encode()[:LONGEST].decode("utf-8", "ignore")
    return f"_{text}" if not text or text.partition(".")[0].lower() in DEVICES else text


def shorten_list(names: list[str]) -> str:
    more = f" and {len(names) - MENTIONED} more" if len(names) > MENTIONED else ""
    return ", ".join(names[:MENTIONED]) + more
