"""Names of students: how they are compared, and how they become names of files."""

import unicodedata

PORTS = {f"{port}{number}" for port in ("com", "lpt") for number in range(10)}
DEVICES = PORTS | {"con", "prn", "aux", "nul"}  # what Windows takes for no file
UNPRINTED = frozenset('<>:"/\\|?*')  # what Windows has in no name
LONGEST = 180  # bytes of a file's name, so that there is room for what is put behind it
MENTIONED = 20  # names in one note


def folded(words: str) -> str:
    """What two spellings of one identifier have in common."""
    return unicodedata.normalize("NFC", words).strip().casefold()


def without_zeros(words: str) -> str:
    """A number as a spreadsheet leaves it, without the zeros before it; anything else folded."""
    plain = folded(words)
    return plain.lstrip("0") or "0" if plain.isdecimal() else plain


def names_of(cell: str) -> list[str]:
    """What a student may be called in the gradebook: the cell, or the first half of an address."""
    return [name for name in dict.fromkeys([folded(cell), folded(cell).partition("@")[0]]) if name]


def portable(words: str) -> str:
    """A name that every file system takes, and as near to the given one as can be."""
    text = unicodedata.normalize("NFC", words)
    text = "".join(c if c.isprintable() and c not in UNPRINTED else "_" for c in text).strip(" .")
    text = text.encode()[:LONGEST].decode("utf-8", "ignore")
    return f"_{text}" if not text or text.partition(".")[0].lower() in DEVICES else text


def in_short(names: list[str]) -> str:
    """Names for one note."""
    more = f" and {len(names) - MENTIONED} more" if len(names) > MENTIONED else ""
    return ", ".join(names[:MENTIONED]) + more
