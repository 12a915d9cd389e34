"""Renew the table of learning systems in instructor/class.md from grader/intake/learning_systems.

python handouts/make_systems.py
"""

import re
from pathlib import Path

from grader.intake.learning_systems import SYSTEMS

PAGE = Path(__file__).resolve().parent / "instructor" / "class.md"
HEAD = "| system | export of the class list | download of submissions | what `marks.csv` holds |"
TABLE = re.compile(rf"^{re.escape(HEAD)}\n(?:\|.*\n)*", re.M)


def renew(text):
    """Return the page with a table of the present systems."""
    rows = [
        f"| {each.title} | {each.class_list} | {each.download} | {each.marks_file} |"
        for each in sorted(SYSTEMS, key=lambda each: each.title)
    ]
    table = "\n".join([HEAD, "|---|---|---|---|", *rows, ""])
    return TABLE.sub(lambda found: table, text)


if __name__ == "__main__":
    PAGE.write_text(renew(PAGE.read_text(encoding="utf-8")), encoding="utf-8", newline="\n")
