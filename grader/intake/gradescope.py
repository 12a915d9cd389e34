"""Gradescope's export: a folder for each submission, and a list of who handed in what, and when."""

import re
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import msgspec
import yaml
from msgspec import Struct, field

from grader.intake.found import Found, Intake
from grader.intake.names import portable
from grader.intake.roster import ClassList
from grader.judge.submission import CannotGrade

try:
    from yaml import CSafeLoader as SafeLoader
except ImportError:  # a PyYAML without its C library
    from yaml import SafeLoader  # type: ignore[assignment]

METADATA = "submission_metadata.yml"


class MetadataLoader(SafeLoader):
    """YAML as Ruby writes it; what bears the tag of a class of its own is left out."""


MetadataLoader.add_constructor(None, lambda loader, node: None)


class Submitter(Struct):
    """What Gradescope says of one person: words, mostly."""

    name: Any = field(default=None, name=":name")
    sid: Any = field(default=None, name=":sid")
    email: Any = field(default=None, name=":email")

    def known_as(self, people: ClassList) -> str:
        addresses = self.email, str(self.email or "").partition("@")[0]
        known = people.name_of(["Email address", "SIS Login ID"], *addresses)
        known = known or people.name_of(["SIS User ID", "ID number"], self.sid)
        return portable(str(known or self.email or self.sid or self.name))


class Exported(Struct):
    """What Gradescope says of one submission, as far as it matters here."""

    submitters: list[Submitter] = field(name=":submitters")
    created_at: Any = field(default=None, name=":created_at")


def is_export(folder: Path) -> bool:
    return (folder / METADATA).is_file()


def is_whole_export(folder: Path) -> bool:
    """Whether a folder among others is an export, and not a submission with such a list in it.

    The list says whose the work is, and a folder that bears another name may be a student's.
    """
    return is_export(folder) and re.fullmatch(r"assignment_\d+_export", folder.name) is not None


def submissions(folder: Path, people: ClassList, intake: Intake) -> Iterator[Found]:
    """The submissions of an export: one for each of those who handed in together."""
    try:
        with open(folder / METADATA, "rb") as file:
            export = msgspec.convert(yaml.load(file, MetadataLoader), dict[str, Exported])
    except (yaml.YAMLError, UnicodeError, ValueError, msgspec.ValidationError) as error:
        words = f"{folder / METADATA} is not as Gradescope writes it ({error!s:.200})"
        raise CannotGrade(f"{words}: export the submissions again") from error
    for place, entry in export.items():
        path = folder / portable(place)
        names = [person.known_as(people) for person in entry.submitters]
        for name in names:
            if path.is_dir() and not path.is_symlink():
                yield Found(
                    name,
                    (path,),
                    handed_in=aware(entry.created_at),
                    group=tuple(each for each in names if each != name),
                    handed_in_by=names[0] if name != names[0] else "",
                )
            else:
                intake.troubles[name] = f"{path.name} is in {METADATA}, and no such folder is here"


def aware(when: Any) -> datetime | None:
    """A moment; Gradescope's own are in UTC where they do not say otherwise."""
    if not isinstance(when, datetime):
        return None
    return when if when.tzinfo else when.replace(tzinfo=UTC)
