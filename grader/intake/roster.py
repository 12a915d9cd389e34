"""Class lists: the gradebook files of learning systems, and who is meant by what one says."""

import csv
import io
import re
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import Literal

from grader.intake.dates import moment
from grader.intake.names import folded, names_of, without_zeros
from grader.judge.submission import CannotGrade

CANVAS = (
    *("Student", "LastName", "FirstName", "ID", "SIS User ID", "SIS Login ID"),
    *("Integration ID", "Root Account", "Section"),
)
MOODLE = ("First name", "Last name", "Surname", "ID number", "Email address")
LAST = ("Last name", "Last Name", "LastName", "Surname")
FIRST = ("First name", "First Name", "FirstName")
WORKSHEET = ("Identifier", "Full name", "ID number", "Email address")  # Moodle's, of one assignment
BLACKBOARD = ("Last Name", "First Name", "Username", "Student ID")
BRIGHTSPACE = ("OrgDefinedId", "Username", "Last Name", "First Name", "Email")
END_OF_LINE = "End-of-Line Indicator"  # Brightspace's last column, a # in each row
SUBMITTED = "Last modified (submission)"  # in Moodle's worksheet, the school's own time
TOTAL = "Maximum Grade"  # there, and the column before it is the grade's
CALLED = "Called"  # a column of one's own: what an export calls somebody whom it does not identify
KEYS = (
    "SIS Login ID",
    "Email address",
    "ID number",
    "SIS User ID",
    "Username",
    "OrgDefinedId",
    "Student ID",
    "Email",
    "Identifier",
)
GROUPS = ("Group", "Groups", "Group name", "Group Name")
Kind = Literal["canvas", "worksheet", "blackboard", "brightspace", "plain"]
POINTS_POSSIBLE = "Points Possible"  # the first cell of Canvas's second row
TEST_STUDENT = "Student, Test"  # Canvas's own, who never hands in
MANGLED = re.compile(r"\d([.,]\d+)?E\+\d+")  # what a spreadsheet makes of a long number
# Moodle's titles in the languages of its users; each stands for itself in another case, too.
TITLES = {
    "Identifier": ("ID", "Identifiant", "Identificador", "Identificativo", "Identificatie"),
    "Full name": (
        *("Vollständiger Name", "Nom complet", "Nombre completo", "Nome completo"),
        *("Volledige naam",),
    ),
    "First name": ("Vorname", "Prénom", "Nombre", "Nome", "Voornaam", "Nom"),
    "Last name": (
        *("Nachname", "Nom de famille", "Apellido(s)", "Cognome", "Achternaam", "Apelido"),
        *("Cognoms",),
    ),
    "Email address": (
        *("E-Mail-Adresse", "Adresse de courriel", "Dirección de correo", "Indirizzo email"),
        *("E-mailadres", "E-mail", "Adreça electrònica"),
    ),
    "ID number": (
        *("ID-Nummer", "Numéro d'identification", "Número de ID", "Codice identificativo"),
        *("Nummer (ID)", "Número de identificação (ID)", "Número ID"),
    ),
    "Username": (
        *("Anmeldename", "Nom d'utilisateur", "Nombre de usuario", "Gebruikersnaam"),
        *("Nome de utilizador", "Nom d'usuari"),
    ),
    "Group": ("Gruppe", "Groupe", "Grupo", "Gruppo", "Groep", "Grup"),
    "Groups": ("Gruppen", "Groupes", "Grupos", "Gruppi", "Groepen", "Grups"),
    TOTAL: (
        *("Bestwertung", "Note maximale", "Calificación máxima", "Valutazione massima"),
        *("Maximaal cijfer", "Nota máxima", "Qualificació màxima"),
    ),
    "Feedback comments": (
        *("Feedback als Kommentar", "Feedback par commentaires", "Commenti"),
        *("Comentarios de retroalimentación", "Feedback tekstvak", "Comentários de feedback"),
        *("Comentaris de retroacció.", "Comentaris de retroacció"),
    ),
    SUBMITTED: (
        *("Zuletzt geändert (Abgabe)", "Dernière modification (travail remis)"),
        *("Última modificación (entrega)", "Ultima modifica (consegna)"),
        *("Laatst gewijzigd (inzending)", "Última atualização (submissão)"),
        *("Darrera modificació (tramesa)",),
    ),
}


class CannotRead(Exception):
    """A file that is not what it should be; the message names it and says what to do."""


# ---------------------------------------------------------------- reading


@dataclass
class Roster:
    """A class list as an LMS wrote it."""

    path: Path
    columns: list[str]
    rows: list[dict[str, str]]  # of students
    kind: Kind
    possible: bool  # there is a row of points possible
    delimiter: str
    mark: str  # the byte order mark, where there is one
    encoding: str = "utf-8"
    titles: dict[str, str] = field(
        default_factory=dict
    )  # of columns, where it calls them otherwise
    doubt: str = ""  # what a person should look at

    def key(self, wanted: str = "") -> str:
        """The column that identifies students."""
        if wanted and wanted not in self.columns:
            columns = ", ".join(self.columns)
            raise CannotRead(f"{self.path} has no column {wanted!r}; it has {columns}")
        for enough in (all, any):  # one that everybody has, before one that some have
            for name in [wanted] if wanted else KEYS:
                if name in self.columns and enough(row[name].strip() for row in self.rows):
                    return name
        for name in [] if wanted else self.columns:  # in a language that is not known here
            addresses = {row[name].strip() for row in self.rows}
            if len(addresses) == len(self.rows) and all("@" in each for each in addresses):
                return name
        raise CannotRead(
            f"{self.path} has none of {', '.join(KEYS)}: call the column that identifies students "
            "by one of these names, export it again in English, or, where a command has it, name "
            "your column with --key"
        )


WORKBOOKS = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")  # .xlsx and .ods, .xls: how they begin


def read_roster(path: Path) -> Roster:
    """Read the gradebook of a learning system, or any CSV with a row of titles."""
    try:
        content = path.read_bytes()
    except OSError as error:
        raise CannotRead(f"there is no class list at {path}") from error
    if content.startswith(WORKBOOKS):
        raise CannotRead(f"{path} is a spreadsheet's own file: export the class list as CSV")
    text, encoding, doubt = text_of(content, path)
    mark = "\ufeff" if text.startswith("\ufeff") else ""
    text = text.removeprefix(mark)
    told = re.match(r"sep=([,;\t])\r?\n", text)  # which a spreadsheet takes and nobody else
    text = text[told.end() :] if told else text
    first = text.partition("\n")[0]
    delimiter = max(",;\t", key=lambda each: len(next(csv.reader([first], delimiter=each), [])))
    lines = [row for row in csv.reader(io.StringIO(text, newline=""), delimiter=delimiter) if row]
    if len(lines) < 2:
        raise CannotRead(f"{path} is empty: it needs a row of titles and a row per student")
    written = [title.strip() for title in lines[0]]
    columns = in_english(written)
    if len(set(columns)) < len(columns):
        raise CannotRead(f"{path} has two columns of one name: {', '.join(columns)}")
    rows = [dict(zip(columns, [*row, *[""] * len(columns)], strict=False)) for row in lines[1:]]
    kind = kind_of(columns)
    canvas = kind == "canvas"
    possible = canvas and any(first_cell(row) == POINTS_POSSIBLE for row in rows)
    students = [row for row in rows if not canvas or is_student(row)]
    for row in students:
        for column in (*KEYS, "ID"):
            if MANGLED.fullmatch(row.get(column, "").strip()):
                raise CannotRead(
                    f"{path} has {row[column].strip()} under {column!r}, which a spreadsheet made "
                    "of a number: export it again, and do not save it from a spreadsheet"
                )
    titles = {name: title for name, title in zip(columns, written, strict=True) if name != title}
    return Roster(path, columns, students, kind, possible, delimiter, mark, encoding, titles, doubt)


def text_of(content: bytes, path: Path) -> tuple[str, str, str]:
    """A table's text, the encoding to write it in again, and what a person should look at."""
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        return content.decode("utf-16", "replace"), "utf-16", ""  # Blackboard's .xls is such a one
    with suppress(UnicodeDecodeError):
        return content.decode("utf-8"), "utf-8", ""
    text = content.decode("cp1252", "replace")
    letters = next((word for word in re.findall(r"\w+", text) if not word.isascii()), "\ufffd")
    doubt = f"{path} is not UTF-8 and was read as Windows writes it: is {letters!r} right?"
    return text, "utf-8", doubt


def in_english(written: list[str]) -> list[str]:
    """The titles of columns as Moodle has them in English; others stay as they are."""
    plain = {folded(TOTAL): TOTAL}  # newer ones write it in small letters
    for name, others in TITLES.items():
        for other in others:
            if other != "ID" or "Bestwertung" in written:  # many lists have an ID that is none
                plain.setdefault(folded(other), name)
    columns = [plain.get(folded(title).replace("\u2019", "'"), title) for title in written]
    if "Full name" not in columns and "Last name" not in columns:  # Italian has one word for both
        columns = ["Full name" if name == "First name" else name for name in columns]
    if TOTAL in columns and "Identifier" in columns and "Grade" not in columns:
        columns[columns.index(TOTAL) - 1] = "Grade"
    return columns if len(set(columns)) == len(columns) else written


def kind_of(columns: list[str]) -> Kind:
    """Whose gradebook has these columns."""
    here = set(columns)
    if "ID" in here and ("Student" in here or {"LastName", "FirstName"} <= here):
        return "canvas"
    if {"Identifier", "Grade"} <= here:
        return "worksheet"
    if END_OF_LINE in here or "OrgDefinedId" in here:
        return "brightspace"
    return "blackboard" if set(BLACKBOARD[:3]) <= here else "plain"


def first_cell(row: dict[str, str]) -> str:
    """Canvas's first: a name in one column or in two."""
    names = [row[name].strip() for name in ("Student", "LastName", "FirstName") if name in row]
    return ", ".join(filter(None, names))


def is_student(row: dict[str, str]) -> bool:
    return first_cell(row) not in ("", POINTS_POSSIBLE, TEST_STUDENT)


def people(roster: Roster, key: str) -> Iterator[dict[str, str]]:
    """Students for nbgrader: id, names and address, as far as the class list has them."""
    for row in roster.rows:
        if not row[key].strip():
            continue
        last, comma, first = row.get("Student", "").partition(", ")
        yield {
            "id": row[key].strip(),
            "first_name": either(row, FIRST, first if comma else ""),
            "last_name": either(row, LAST, last),
            "email": row.get("Email address", row.get("Email", "")),
        }


# ---------------------------------------------------------------- who is meant


class ClassList:
    """Who is in the class, by everything that an LMS may call them; empty without a roster."""

    def __init__(self, roster: Roster | None = None, key: str = "") -> None:
        self.names: list[str] = []
        self._known: dict[tuple[str, str], set[str]] = {}
        self._columns: set[str] = set()
        self._handed_in: dict[str, datetime] = {}
        self._participants: dict[str, str] = {}
        self.groups: list[list[str]] = []
        self._grouped: list[tuple[str, list[str]]] = []
        if roster is None:
            return
        key = roster.key(key)
        self._columns = set(roster.columns)
        for row in roster.rows:
            if not row[key].strip():
                continue
            self.names.append(row[key].strip())
            number = number_in(row)
            self._known.setdefault(("Identifier", number), set()).add(row[key].strip())
            if row.get("Full name", "").strip() and number:
                self._participants[row[key].strip()] = f"{row['Full name'].strip()}_{number}"
            if when := moment(row.get(SUBMITTED, "")):
                self._handed_in[row[key].strip()] = when
            for column, label in [*row.items(), *(("name", name) for name in names_in(row))]:
                for spelled in {folded(label), without_zeros(label)}:
                    self._known.setdefault((column, spelled), set()).add(row[key].strip())
        for name, rows in groups_of(roster).items():
            self.groups.append([row[key].strip() for row in rows if row[key].strip()])
            self._grouped.append((folded(name), self.groups[-1]))

    def name_of(self, columns: Iterable[str], *labels: object) -> str | None:
        """The one student whom one of the labels means."""
        for spelled in (folded, without_zeros):
            for column in columns:
                for label in filter(None, labels):
                    names = self._known.get((column, spelled(str(label))), set())
                    if len(names) == 1:
                        return next(iter(names))
        return None

    def anybody(self, label: str) -> str | None:
        """Who is called so in any way."""
        return self.name_of([*KEYS, "ID", CALLED, "name"], label)

    def one_of_group(self, group: str) -> str:
        """The first of a group, by what an export calls it; the others have the work from there."""
        return next((each[0] for name, each in self._grouped if name == folded(group)), "")

    def knows(self, column: str) -> bool:
        """Whether the list has such identifiers: then no name need be guessed from."""
        return column in self._columns

    def handed_in(self, name: str) -> datetime | None:
        """When somebody handed in, where the list says so: the school's own time, no zone."""
        return self._handed_in.get(name)

    def participant(self, name: str) -> str:
        """What Moodle calls a student in the names of files; empty where the list does not say."""
        return self._participants.get(name, "")

    def absent(self, handed_in: Iterable[str]) -> list[str]:
        """Those who handed in nothing, given the names of the others."""
        here = {folded(name) for name in handed_in}
        return [name for name in self.names if not here & set(names_of(name))]

    def unlisted(self, handed_in: Iterable[str]) -> list[str]:
        """Those who handed in and are not in the class list."""
        known = {each for name in self.names for each in names_of(name)}
        return [name for name in handed_in if self.names and folded(name) not in known]


def groups_of(roster: Roster) -> dict[str, list[dict[str, str]]]:
    """The rows of each group that the list names, in the order in which they come."""
    column = next((name for name in GROUPS if name in roster.columns), None)
    groups: dict[str, list[dict[str, str]]] = {}
    for row in roster.rows if column else []:
        if row[column or ""].strip():
            groups.setdefault(row[column or ""].strip(), []).append(row)
    return groups


def names_in(row: dict[str, str]) -> Iterator[str]:
    """Someone's full name, first name first and last name first."""
    last, _, first = row.get("Student", "").partition(", ")
    last, first = either(row, LAST, last), either(row, FIRST, first)
    if first and last:
        yield from (f"{first} {last}", f"{last} {first}")
    if full := row.get("Full name", ""):
        yield full


def number_in(row: dict[str, str]) -> str:
    """The number of Moodle's Identifier, which has a word before it in the reader's language."""
    match = re.search(r"\d+$", row.get("Identifier", "").strip())
    return match[0] if match else ""


def either(row: dict[str, str], titles: tuple[str, ...], otherwise: str) -> str:
    return next((row[title] for title in titles if title in row), otherwise)


def people_of(path: Path, roster: Path | None) -> ClassList:
    """Return the list of the class at `path`, empty where there is none. Raises CannotGrade."""
    roster = roster or beside(path, "roster.csv")
    try:
        return ClassList(read_roster(roster) if roster else None)
    except CannotRead as error:
        raise CannotGrade(str(error)) from error


def beside(path: Path, name: str) -> Path | None:
    """Return the file of this name in the folder of a class, or None."""
    return path / name if (path / name).is_file() else None
