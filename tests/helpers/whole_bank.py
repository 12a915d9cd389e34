"""Read the bank once in each process that runs tests."""

from dataclasses import replace
from functools import cache

from msgspec.structs import replace as replace_in

from grader.bank.members import Member, list_members
from grader.bank.verify import Verdict, grade_member
from grader.judge.result import is_bonus


@cache
def bank() -> tuple[Member, ...]:
    return (*list_members(),)


def member_named(name: str) -> Member:
    """Return the member of this name that is a package."""
    (found,) = (each for each in bank() if each.name == name and each.form == "package")
    return found


def grade_briefly(member: Member) -> Verdict:
    """Grade it on its TODOs, without a time limit: `make verify` has limits."""
    patient = replace(member, entry=replace_in(member.entry, seconds=10**9))
    return grade_member(patient, find_graded(patient))


def find_graded(member: Member) -> frozenset[str]:
    """Return the TODOs to grade it on; empty for all."""
    spoils_more = member.entry.base != "solution" or any(map(is_bonus, member.todos))
    return member.judged_by if member.kind == "hostile" and spoils_more else member.todos
