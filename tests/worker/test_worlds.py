"""What goes through where a machine lacks walls, as the table of the security page says.

The attacks of the hostile bank are graded where namespaces are refused, where there is no Landlock
and where there is neither, by whoever runs this: the table has a column for root, one for others.
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import bare_container
import pytest
from test_security import expected_layers
from test_walls import MEMBERS

from grader.judge.grade import KIT

pytestmark = [
    pytest.mark.soak,  # a minute for each world
    pytest.mark.skipif(
        sys.platform != "linux"
        or not {"system-calls", "own-root", "landlock-scope"} <= expected_layers(),
        reason="the table is of a Linux that has all layers",
    ),
]

PAGE = KIT / "handouts" / "instructor" / "security.md"
COLUMN = 1 if os.geteuid() == 0 else 2
WORLDS = {  # as the table calls them, and what is refused there
    "all layers": "",
    "no namespaces": "namespaces",
    "no Landlock": "landlock",
    "neither": "namespaces,landlock",
}
GRADE_ALL = """
import json
import sys

from grader.judge.grade import KIT
from grader.bank.members import members
from grader.bank.verify import grade_all

hostile = [each for each in members(KIT) if each.kind == "hostile" and each.name in sys.argv]
print(json.dumps({each.member.name: each.complaint for each in grade_all(hostile, 0)}))
"""


def on_the_page(world: str) -> set[str]:
    """The members of which the page says that they go through there."""
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    (row,) = (line for line in lines if line.startswith(f"| {world} |"))
    return set(re.findall(r"`([\w-]+)`", row.split("|")[COLUMN + 1]))


@pytest.mark.parametrize("world", WORLDS)
def test_what_goes_through_is_what_the_page_says(world: str, tmp_path: Path) -> None:
    bare = [sys.executable, bare_container.__file__, WORLDS[world]]
    command = [*bare, sys.executable, "-c", GRADE_ALL, *MEMBERS]
    done = subprocess.run(command, cwd=KIT, stdout=subprocess.PIPE, text=True, check=True)
    complaints = json.loads(done.stdout.splitlines()[-1])
    through = {name: complaint for name, complaint in complaints.items() if complaint}
    assert set(complaints) == set(MEMBERS)
    assert set(through) == on_the_page(world), through
