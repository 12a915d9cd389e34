"""Blackboard: a file for each upload, with assignment, user and attempt in its name, and a receipt.

The receipt is the `.txt` of an attempt. It says who the user is, also where the user's name or the
assignment's has an underscore in it.
"""

import re
from contextlib import suppress
from datetime import datetime
from pathlib import Path

from grader.intake.found import Upload
from grader.intake.names import portable
from grader.intake.roster import ClassList

NAME = re.compile(
    r"(?P<attempt>(?P<assignment>.+)_(?P<user>[^_]+)_attempt_"
    r"(?P<when>\d{4}-\d\d-\d\d-\d\d-\d\d-\d\d))(?:_(?P<file>.+)|\.txt)"
)
WHO = re.compile(r"Name:\s*(?P<name>.*?)\s*\((?P<user>[^()\n]+)\)\s*$", re.M)
HEAD = 600  # characters of a receipt that Blackboard writes itself, before the student's words


def upload(path: Path, people: ClassList) -> Upload | None:
    """Whose upload this is; None for what Blackboard does not write. The time is the school's."""
    match = matched(path)
    if match is None:
        return None
    user, full = receipt(path.with_name(f"{match['attempt']}.txt"))
    user = user or listed_user(match, people) or match["user"]
    name = people.name_of(["Username"], user)
    name = name or people.name_of(["SIS Login ID", "Email address", "ID number"], user)
    name = name or (people.name_of(["name"], full) if full and not people.knows("Username") else "")
    name = name or people.one_of_group(user)
    when = None
    with suppress(ValueError):
        when = datetime.strptime(match["when"], "%Y-%m-%d-%H-%M-%S")
    return Upload(
        path,
        portable(name or user),
        from_lms=True,
        empty=not match["file"],
        handed_in=when,
        attempt=match["when"],
        owner=user,
    )


def listed_user(match: re.Match[str], people: ClassList) -> str:
    """The user of the class list whose name is the longest end of what stands there.

    `Lab_1_kl_6` is user `kl_6` of `Lab_1`, or `6` of `Lab_1_kl`: the list knows.
    """
    parts = f"{match['assignment']}_{match['user']}".split("_")
    ends = ("_".join(parts[at:]) for at in range(1, len(parts)))
    return next((end for end in ends if people.name_of(["Username"], end)), "")


def own_name(path: Path) -> str | None:
    """The file's name as the student gave it; None for what Blackboard does not write."""
    match = matched(path)
    return match["file"] if match else None


def matched(path: Path) -> re.Match[str] | None:
    return None if path.is_dir() else NAME.fullmatch(path.name)


def receipt(path: Path) -> tuple[str, str]:
    """The user's and the full name on a receipt; empty where there is none."""
    with suppress(OSError), open(path, "rb") as file:
        match = WHO.search(file.read(HEAD).decode("utf-8-sig", "replace").partition("\n\n")[0])
        if match:
            return match["user"], match["name"]
    return "", ""
