"""Test that names of any kind are read fast, and names of any script are matched."""

from pathlib import Path

import pytest

from grader.intake.learning_systems import SYSTEMS
from grader.intake.learning_systems.blackboard import WHO
from grader.intake.names import LONGEST, make_portable
from grader.intake.pieces import is_backup, is_renamed, match_name, strip_additions
from grader.intake.places import list_modules
from grader.intake.roster import ClassList

MOST = 255  # bytes of a file's name on any disk

# If the time of a name doubled with each part, this file would take years.
PARTS = [
    *("\u03b1", "\u4e2d", "\N{GRINNING FACE}", "e\u0301", "a", "_", "1", "-", "-1", " ", "  ", "."),
    *(
        "copy",
        " copy",
        " copy 1",
        " - copy",
        " (1)",
        "copy of ",
        "_LATE_",
        "LATE_",
        "anon_",
        "_text",
    ),
    *(
        " - ",
        " - a 2026",
        "2026",
        "_attempt_",
        "_a_attempt_2026-01-01-01-01-01",
        "%20",
        ".py",
        ".txt",
    ),
    *("_1", "_1_1_", "_assignsubmission_", "_assignsubmission_file_", "1-2 - ", "integrators"),
]


def read_name(name: str) -> None:
    """Read a file's name in all the ways in which the intake does."""
    name = name.encode()[:MOST].decode("utf-8", "ignore").replace("/", "_").replace("\0", "_")
    for system in SYSTEMS:
        system.read_upload(Path("nowhere", name), ClassList())
        system.read_own_name(Path("nowhere", name))
    assert len(make_portable(name).encode()) <= LONGEST + 1
    assert strip_additions(name) == strip_additions(name)
    assert is_backup(name) in (True, False)
    for module in list_modules():
        assert is_renamed(f"{name}.py", module) in (True, False)
        assert match_name(name, [module]) in (None, module)


@pytest.mark.parametrize("part", PARTS)
def test_a_name_of_one_part_again_and_again_is_read(part: str):
    for end in ("", "!", "!.py", "_1_2_a.py"):
        read_name(part * MOST + end)
        read_name((part * MOST)[: MOST - len(end)] + end)


def test_a_receipt_is_read_whatever_stands_in_it():
    (match,) = WHO.finditer("Name: Anna (Ann) Becker  (abecker)  \nAssignment: Lab")
    assert (match["name"].strip(), match["user"]) == ("Anna (Ann) Becker", "abecker")
    for part in (" ", "(", "(a", "Name:", "Name: ", ")"):
        assert WHO.search(f"Name:{part * 600}!") is None
