"""The bank, read once by each process that runs tests: reading it takes half a second."""

from functools import cache

from grader.bank.members import Member, members
from grader.judge.grade import KIT


@cache
def bank() -> tuple[Member, ...]:
    return (*members(KIT),)


def member_named(name: str) -> Member:
    """Return the member of this name that is a package."""
    (found,) = (each for each in bank() if each.name == name and each.form == "package")
    return found
