"""Groups of the class list: what one of a group handed in is the work of all of it."""

from collections.abc import Callable, Iterable
from dataclasses import replace

from grader.intake.found import Found, Intake
from grader.intake.names import folded, names_of, portable
from grader.intake.roster import ClassList


def share(intake: Intake, people: ClassList, files_of: Callable[[Found], str]) -> None:
    """Give who handed in nothing a place of their own in the class, with the work of their group.

    Where the group handed in different work, by `files_of`, a person must say which is theirs.
    """
    for group in people.groups:
        names = called(group, [*(each.name for each in intake.found), *intake.troubles])
        of_group = set(names.values())
        here = [each for each in intake.found if each.name in of_group]
        refused = [name for name in names.values() if name in intake.troubles]
        absent = [portable(name) for name in group if name not in names]
        everybody = [*names.values(), *absent]
        members = {each.name: with_group(each, everybody) for each in here}
        intake.found = [members.get(each.name, each) for each in intake.found]
        if not absent:
            continue
        if len(here) == 1 or len({files_of(each) for each in here}) == 1:
            first = members[here[0].name]
            mates = (replace(first, name=mate, handed_in_by=first.name) for mate in absent)
            intake.found += [with_group(mate, everybody) for mate in mates]
        elif here:
            who = " and ".join(members)
            words = f"{who}, of the same group, handed in different work: set points by hand"
            intake.troubles |= dict.fromkeys(absent, words)
        elif refused:
            words = f"{refused[0]}, of the same group: {intake.troubles[refused[0]]}"
            intake.troubles |= dict.fromkeys(absent, words)


def called(group: list[str], taken: Iterable[str]) -> dict[str, str]:
    """Those of a group who are in the class already, and what they are called there."""
    there: dict[str, str] = {}
    for name in taken:
        there.setdefault(folded(name), name)
    found = {each: [there[name] for name in names_of(each) if name in there] for each in group}
    return {each: names[0] for each, names in found.items() if names}


def with_group(found: Found, everybody: list[str]) -> Found:
    return replace(found, group=tuple(each for each in everybody if each != found.name))
