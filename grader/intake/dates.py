"""Read times as learning systems write them for people, in the language of the reader.

`Monday, 4 May 2026, 11:59 PM`, `Montag, 4. Mai 2026, 23:59`, `May 4, 2026 1159 PM`: Moodle's
worksheet has them, and the folders of Brightspace's download.
"""

import re
from datetime import datetime

MONTHS = (  # as each begins in English, German, French, Spanish, Italian, Dutch and Portuguese
    ("jan", "jän", "ene", "gen"),
    ("feb", "fév", "fev"),
    ("mar", "mär", "mrz", "maa"),
    ("apr", "avr", "abr"),
    ("may", "mai", "mei", "mag", "maj"),
    ("jun", "juin", "giu"),
    ("jul", "juil", "lug"),
    ("aug", "aoû", "ago"),
    ("sep", "set"),
    ("oct", "okt", "ott", "out"),
    ("nov",),
    ("dec", "dez", "déc", "dic", "des"),
)
LINKS = r"(?:\s+del?)?"  # 4 de mayo de 2026
YEAR = r"(?P<year>\d{4})"
WORD = r"(?P<month>[^\W\d_]{3,})\.?"
DAY = r"(?P<day>\d{1,2})(?!\d)"
DATES = (
    re.compile(rf"(?<!\d){DAY}\.?{LINKS}\s+{WORD},?{LINKS}\s+{YEAR}"),
    re.compile(rf"{WORD}\s+{DAY},?\s+{YEAR}"),
    re.compile(rf"{YEAR}\s+{WORD}\s+{DAY}"),
    re.compile(rf"{YEAR}-(?P<month>\d\d)-{DAY}"),
)
CLOCK = re.compile(
    r"(?<!\d)(?P<hour>\d{1,2})[:._h ]?(?P<minute>\d\d)(?::\d\d)?(?!\d)"
    r"\s*(?P<half>[AP])?\.?(?:M\b)?",
    re.I,
)


def read_moment(words: str) -> datetime | None:
    """Return the time in a text; None if there is none, or only a day."""
    for form in DATES:
        if date := form.search(words):
            clock = CLOCK.search(words, date.end())
            month = read_month(date["month"])
            if clock and month:
                try:
                    day = datetime(int(date["year"]), month, int(date["day"]))
                    return day.replace(hour=read_hour(clock), minute=int(clock["minute"]))
                except ValueError:  # no such day, or no such hour
                    return None
    return None


def read_month(word: str) -> int | None:
    if word.isdecimal():
        return int(word)
    starts = {start: number for number, each in enumerate(MONTHS, 1) for start in each}
    hits = [start for start in starts if word.lower().startswith(start)]
    return starts[max(hits, key=len)] if hits else None


def read_hour(clock: re.Match[str]) -> int:
    hour = int(clock["hour"])
    if not clock["half"]:
        return hour
    if not 1 <= hour <= 12:
        raise ValueError(f"no hour of half a day: {hour}")
    return hour % 12 + 12 * (clock["half"].upper() == "P")
