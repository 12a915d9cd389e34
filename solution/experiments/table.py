"""Tables for the terminal and for handouts, and a progress line."""

import json
import sys
import time

BEGIN, END = "<!-- tables: begin -->", "<!-- tables: end -->"


class Table:
    """A title, heads and rows of cells, all of them text."""

    def __init__(self, title, heads, rows, note=""):
        self.title, self.heads, self.note = title, heads, note
        self.rows = [[str(cell) for cell in row] for row in rows]

    def text(self):
        """Return the table for a terminal, in columns of equal width."""
        rows = [self.heads, *self.rows]
        widths = [max(len(row[i]) for row in rows) for i in range(len(self.heads))]
        lines = [
            "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
            for row in rows
        ]
        lines.insert(1, "  ".join("-" * width for width in widths))
        parts = [self.title, "=" * len(self.title), *lines, self.note]
        return "\n".join(filter(None, parts)) + "\n"

    def markdown(self):
        """Return the table for a handout."""
        rows = [self.heads, ["---"] * len(self.heads), *self.rows]
        lines = ["| " + " | ".join(row) + " |" for row in rows]
        parts = [f"**{self.title}**", "\n".join(lines), self.note]
        return "\n\n".join(filter(None, parts)) + "\n"


def write_markdown(path, tables, lines, **more):
    """Put the tables between the two markers of a file, or into a file of their own.

    `lines` and `more` go into results.json beside it; `lines` support the text near tables.
    """
    block = "\n".join(table.markdown() for table in tables)
    text = path.read_text(encoding="utf-8") if path.exists() else f"{BEGIN}\n{END}\n"
    before, _, rest = text.partition(BEGIN)
    _, found, after = rest.partition(END)
    if not found:
        raise ValueError(f"{path} lacks the lines {BEGIN} and {END}: put them where the tables go.")
    path.write_text(f"{before}{BEGIN}\n{block}{END}{after}", encoding="utf-8")
    results = path.with_name("results.json")
    kept = json.loads(results.read_text(encoding="utf-8")) if results.exists() else {}
    kept |= {path.name: lines, **more}
    text = json.dumps(kept, indent=1, sort_keys=True, ensure_ascii=False)
    results.write_text(text + "\n", encoding="utf-8")


def number(value):
    """Return a number in three digits; a word stays as it is."""
    if value is None:
        return "-"
    if isinstance(value, str):
        return value
    if value == 0:
        return "0"
    if 0.001 <= abs(value) < 10_000:
        digits = f"{value:.3g}"
        return digits if "e" not in digits else f"{value:.0f}"
    mantissa, exponent = f"{value:.1e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def span(values, unit=""):
    """Return the least and the largest number in two digits, or one if they are equal."""
    if not values:
        return "-"
    ends = [number(one if isinstance(one, str) else float(f"{one:.2g}")) for one in values]
    low, high = ends[0], ends[-1]
    return f"{low}{unit}" if low == high else f"{low} to {high}{unit}"


def as_range(name, values):
    """Return the two lines of a range, if there is one."""
    return {f"{name}, least": min(values), f"{name}, most": max(values)} if values else {}


class Progress:
    """A line on a terminal that shows how much is done and how long the rest will take."""

    def __init__(self, total, stream=None):
        self.total, self.done, self.start = total, 0.0, time.monotonic()
        self.stream = stream or sys.stderr
        self.shown = self.stream.isatty()

    def step(self, weight, what):
        """Name the next item, and count the one before as done."""
        if self.shown:
            share = min(self.done / self.total, 1)
            spent = time.monotonic() - self.start
            left = f"{spent * (1 - share) / share:.0f} s left" if share > 0.02 else ""
            bar = "#" * round(30 * share)
            self.stream.write(f"\r\033[K[{bar:<30}] {100 * share:3.0f} %  {left:<10} {what}")
            self.stream.flush()
        self.done += weight

    def end(self):
        if self.shown:
            self.stream.write("\r\033[K")
            self.stream.flush()
