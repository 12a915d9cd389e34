"""What goes through where a machine lacks walls, as the table of the security page says.

The hostile bank is graded where namespaces are refused, where there is no Landlock and where there
is neither, by whoever runs this, root or an ordinary user.
"""

import json
import os
import re
import subprocess
import sys

import bare_container
import hostile_bank
import pytest
from test_security import expected_layers
from whole_bank import bank

from grader.judge.grade import KIT

pytestmark = [
    pytest.mark.soak,  # 10 minutes of processor time for each world
    pytest.mark.skipif(
        sys.platform != "linux"
        or not {"system-calls", "own-root", "landlock-scope"} <= expected_layers(),
        reason="the table is of a Linux that has all layers",
    ),
]

PAGE = KIT / "handouts" / "instructor" / "security.md"
WORLDS = {  # as the table calls them, and what is refused there
    "no namespaces": "namespaces",
    "no Landlock": "landlock",
    "neither": "namespaces,landlock",
}


def on_the_page(world: str) -> set[str]:
    """Return the members that go through there, as the page says."""
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    (row,) = (line for line in lines if line.startswith(f"| {world} |"))
    return set(re.findall(r"`([\w-]+)`", row.split("|")[2]))


@pytest.mark.parametrize("world", WORLDS)
def test_what_goes_through_is_what_the_page_says(world: str) -> None:
    """`make verify` grades the same members with all layers."""
    bare = [sys.executable, bare_container.__file__, WORLDS[world]]
    done = subprocess.run(
        [*bare, sys.executable, hostile_bank.__file__, world],
        cwd=KIT,
        env={**os.environ, "PYTHONPATH": str(KIT)},
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    complaints = json.loads(done.stdout.splitlines()[-1])
    assert set(complaints) == {member.name for member in bank() if member.kind == "hostile"}
    through = {name: complaint for name, complaint in complaints.items() if complaint}
    assert set(through) == on_the_page(world), through


def test_nothing_goes_through_all_layers() -> None:
    assert on_the_page("all layers") == set()
