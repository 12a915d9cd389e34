"""Share the work of a group of the class list among its members."""

from collections.abc import Callable, Iterable
from dataclasses import replace

from grader.intake.found import Intake, Work
from grader.intake.names import fold, make_portable, split_login
from grader.intake.roster import ClassList


def share_work(intake: Intake, people: ClassList, hash_files: Callable[[Work], str]) -> None:
    """Enter the work of a group for its members who handed in nothing.

    If members' work differs by `hash_files`, members without work need manual review.
    """
    for group in people.groups.values():
        names = match_members(group, intake.names)
        here = [each for each in intake.found if each.name in names.values()]
        refused = [name for name in names.values() if name in intake.troubles]
        absent = [make_portable(name) for name in group if name not in names]
        everybody = [*names.values(), *absent]
        members = {each.name: set_group(each, everybody) for each in here}
        intake.found = [members.get(each.name, each) for each in intake.found]
        if not absent:
            continue
        if len(here) == 1 or len({hash_files(each) for each in here}) == 1:
            first = members[here[0].name]
            mates = (replace(first, name=mate, handed_in_by=first.name) for mate in absent)
            intake.found += [set_group(mate, everybody) for mate in mates]
        elif here:
            words = f"{' and '.join(members)}, of the same group, handed in different work: "
            intake.troubles |= dict.fromkeys(absent, words + "set points by hand")
        elif refused:
            words = f"{refused[0]}, of the same group: {intake.troubles[refused[0]]}"
            intake.troubles |= dict.fromkeys(absent, words)


def match_members(group: list[str], names: Iterable[str]) -> dict[str, str]:
    """Return the members who handed in, each with their name in the class."""
    there: dict[str, str] = {}
    for name in names:
        there.setdefault(fold(name), name)
    found = {each: [there[name] for name in split_login(each) if name in there] for each in group}
    return {each: names[0] for each, names in found.items() if names}


def set_group(found: Work, everybody: list[str]) -> Work:
    return replace(found, group=tuple(each for each in everybody if each != found.name))
