"""Gradescope: a folder for each submission, and a list of students, files and times."""

import re
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec
import yaml
from msgspec import Struct, field

from grader.errors import Stop
from grader.intake.found import Intake, Work
from grader.intake.lms import Lms
from grader.intake.names import make_portable
from grader.intake.roster import ClassList

if TYPE_CHECKING or not yaml.__with_libyaml__:  # both loaders have the same types
    from yaml import SafeLoader
else:
    from yaml import CSafeLoader as SafeLoader

METADATA = "submission_metadata.yml"


class MetadataLoader(SafeLoader):
    """A loader of YAML that skips values with the tags of Ruby's classes."""


MetadataLoader.add_constructor(None, lambda loader, node: None)


class Submitter(Struct):
    """A person in Gradescope's data; each field may be anything."""

    name: Any = field(default=None, name=":name")
    sid: Any = field(default=None, name=":sid")
    email: Any = field(default=None, name=":email")

    def find_name(self, people: ClassList) -> str:
        addresses = self.email, str(self.email or "").partition("@")[0]
        known = people.find(["Email address", "SIS Login ID"], *addresses)
        known = known or people.find(["SIS User ID", "ID number"], self.sid)
        return make_portable(str(known or self.email or self.sid or self.name))


class ListedWork(Struct):
    """One submission in Gradescope's list."""

    submitters: list[Submitter] = field(name=":submitters")
    created_at: Any = field(default=None, name=":created_at")


class Gradescope(Lms):
    name = "gradescope"
    title = "Gradescope"
    class_list = "a list of your own, or *Roster, Download*: any CSV with addresses"
    download = (
        "`submission_123456789` and `submission_metadata.yml`: the address in that list, and "
        "the time; one for each of those who worked together"
    )
    marks_file = "the columns of names, then `Grade` and `Feedback`"
    side_files = frozenset({METADATA})

    def is_export(self, folder: Path) -> bool:
        return (folder / METADATA).is_file()

    def is_whole_export(self, folder: Path) -> bool:
        """Return whether it is an export; a submission with a list is named otherwise."""
        return self.is_export(folder) and bool(re.fullmatch(r"assignment_\d+_export", folder.name))

    def read_export(self, folder: Path, people: ClassList, intake: Intake) -> Iterator[Work]:
        """Return the submissions of an export; each group member gets one."""
        for place, entry in read_metadata(folder).items():
            path = folder / make_portable(place)
            names = [person.find_name(people) for person in entry.submitters]
            for name in names:
                if path.is_dir() and not path.is_symlink():
                    yield Work(
                        name,
                        (path,),
                        handed_in=add_zone(entry.created_at),
                        group=tuple(each for each in names if each != name),
                        handed_in_by=names[0] if name != names[0] else "",
                    )
                else:
                    words = f"{path.name} is in {METADATA}, and no such folder is here"
                    intake.troubles[name] = words


def read_metadata(folder: Path) -> dict[str, ListedWork]:
    try:
        with open(folder / METADATA, "rb") as file:
            return msgspec.convert(yaml.load(file, MetadataLoader), dict[str, ListedWork])
    except (yaml.YAMLError, UnicodeError, ValueError, msgspec.ValidationError) as error:
        words = f"{folder / METADATA} is not as Gradescope writes it ({error!s:.200})"
        raise Stop(f"{words}: export the submissions again") from error


def add_zone(when: Any) -> datetime | None:
    """Return a moment with its zone; Gradescope writes UTC without one."""
    if not isinstance(when, datetime):
        return None
    return when if when.tzinfo else when.replace(tzinfo=UTC)
