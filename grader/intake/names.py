"""Compare names of students, and make names of files of them."""

import re
import unicodedata

PORTS = {f"{port}{number}" for port in ("com", "lpt") for number in range(10)}
DEVICES = PORTS | {"con", "prn", "aux", "nul"}  # what Windows takes for no file
UNPRINTED = frozenset('<>:"/\\|?*')  # what Windows has in no name
LONGEST = 180  # bytes of a file's name, so that there is room for what is put behind it
MENTIONED = 20  # names in one note


def fold(words: str) -> str:
    """Return what two spellings of one identifier have in common."""
    return unicodedata.normalize("NFC", words).strip().casefold()


def strip_zeros(words: str) -> str:
    """Return a number without the zeros before it, as spreadsheets write it; fold other words."""
    plain = fold(words)
    return plain.lstrip("0") or "0" if plain.isdecimal() else plain


def sort_key(words: str) -> list[tuple[int, int, str]]:
    """Return a key that sorts names as people do: without accents, and 2 before 10."""
    plain = unicodedata.normalize("NFKD", words.casefold())
    parts = re.findall(r"\d+|\D+", "".join(c for c in plain if not unicodedata.combining(c)))
    return [(0, int(part), "") if part.isdecimal() else (1, 0, part) for part in parts]


def split_login(cell: str) -> list[str]:
    """Return a student's names in the gradebook: the cell, and the first half of an address."""
    return [name for name in dict.fromkeys([fold(cell), fold(cell).partition("@")[0]]) if name]


def make_portable(words: str) -> str:
    """Return a name that every file system takes, as near to the given one as can be."""
    text = unicodedata.normalize("NFC", words)
    text = "".join(c if c.isprintable() and c not in UNPRINTED else "_" for c in text).strip(" .")
    text = text.encode()[:LONGEST].decode("utf-8", "ignore")
    return f"_{text}" if not text or text.partition(".")[0].lower() in DEVICES else text


def list_names(names: list[str]) -> str:
    """Return all names as one text: what is left out of a warning is never done."""
    return ", ".join(names)


def shorten_list(names: list[str]) -> str:
    more = f" and {len(names) - MENTIONED} more" if len(names) > MENTIONED else ""
    return ", ".join(names[:MENTIONED]) + more
