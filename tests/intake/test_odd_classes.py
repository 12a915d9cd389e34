"""Test unusual classes: no student is lost or silently 0, and every refusal has a reason."""

import base64
import errno
import os
import shutil
import struct
import sys
import unicodedata
import zlib
from datetime import datetime
from pathlib import Path

import classes
import gradebooks
import packed
import pytest
from packed import put

from grader.classroom.book import list_broken
from grader.classroom.course_check import find_problems
from grader.classroom.folder import ClassFolder, Settings
from grader.classroom.marks import Marking, Marks, Part, Parts, Scores, make_marks
from grader.errors import Stop
from grader.intake.dates import read_moment
from grader.intake.found import CannotTake, Intake, Work
from grader.intake.learning_systems.moodle import Moodle
from grader.intake.listing import open_class
from grader.intake.lms import Page
from grader.intake.packing import read_package
from grader.intake.roster import ClassList, Roster
from grader.intake.systems import find_system, read_roster
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.submission import MAX_FILES, CannotGrade, take_in

SOURCE = "points = 7\n"
WORK: packed.Files = {"integrators.py": SOURCE}
MARKING = Marking("Physics engine", {"engine": 1}, 20)


def list_intake(folder: Path, people: ClassList | None = None) -> Intake:
    with open_class(folder, people) as intake:
        return intake


def make_work(folder: Path, files: packed.Files) -> Work:
    put(folder / "ann", files)
    return Work("ann", (folder / "ann",))


def people_of(path: Path, text: str | bytes) -> ClassList:
    classes.put(path, text)
    return ClassList(read_roster(path))


# ---------------------------------------------------------------- files of a submission

CHANGED = (
    *("integrators (1).py", "integrators-2.py", "integrators - Copie (2).py", "INTEGRATORS.PY"),
    *("integrators(2).py", "integrators-12.py", "integrators - Copy.py", "integrators copy 2.py"),
    *("integrators 2.py", "Copy of integrators.py", "integrators%20(1).py", "Integrators.py"),
    *("Kopie von integrators.py", "integrators \u2013 Kopie.py", "integrators - コピー.py"),
    *("integrators - 副本.py", "integrators — копия.py", "integrators - Cópia.py"),
    *("integrators final.py", "integrators (final).py", "my integrators.py", "ann-integrators.py"),
    *("integrators .py", "integrators%281%29.py", "integrators.py.txt", "integrators.txt"),
)


@pytest.mark.parametrize("name", CHANGED)
def test_a_name_that_python_cannot_import_is_taken_as_what_it_was(tmp_path: Path, name: str):
    package = read_package(make_work(tmp_path, {name: SOURCE}))
    assert dict(package.files)["integrators.py"] == SOURCE.encode()
    assert package.notes == [f"{name} is taken as integrators.py"]


@pytest.mark.parametrize("what", ["ann/mini_engine", "ann/mini_engine/world.py"])
def test_what_may_not_be_read_is_for_a_person_and_not_nothing(tmp_path: Path, monkeypatch, what):
    """A locked folder, or one of another user, may contain work."""
    found = make_work(tmp_path, WORK | {"mini_engine/__init__.py": "", "mini_engine/world.py": ""})
    shut(monkeypatch, tmp_path / what)
    with pytest.raises(CannotTake, match=f"{what[4:]} cannot be read: Permission denied"):
        read_package(found)
    with pytest.raises(CannotGrade, match=f"{what[4:]} cannot be read: Permission denied"):
        take_in(found.sources[0], tmp_path / "copy")


def shut(monkeypatch, path: Path) -> None:
    """Make a file or folder unreadable, also for the superuser."""

    def refusing(usual):
        def ask(asked, *args, **options):
            here = (path, Path(path.name))  # the name alone, in an open folder
            if not isinstance(asked, int) and Path(asked) in here:
                raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(asked))
            return usual(asked, *args, **options)

        return ask

    monkeypatch.setattr(os, "scandir", refusing(os.scandir))
    monkeypatch.setattr(os, "open", refusing(os.open))


def test_the_labs_own_files_come_first_however_many_others_there_are(tmp_path: Path):
    many: packed.Files = {f"aaa/m{n}.py": "x = 1\n" for n in range(MAX_FILES + 100)}
    lab: packed.Files = {"mini_engine/__init__.py": "x = 1\n", **WORK}
    deep = {f"deep/{name}": content for name, content in (many | lab).items()}
    for found in (make_work(tmp_path / "folder", many | lab), zipped(tmp_path, deep)):
        package = read_package(found)
        assert lab.keys() <= {name for name, _ in package.files}
        assert any("files: size limit reached" in note for note in package.notes)
    inner = many | {"zzz/work.zip": packed.as_zip(WORK)}
    assert dict(read_package(zipped(tmp_path, inner)).files)["integrators.py"] == SOURCE.encode()
    submission = take_in(put(tmp_path / "plain", many | lab), tmp_path / "copy")
    assert (tmp_path / "copy" / "integrators.py").is_file() and submission.left_out


def zipped(folder: Path, files: packed.Files) -> Work:
    classes.put(folder / "work.zip", packed.as_zip(files))
    return Work("ann", (folder / "work.zip",))


# ---------------------------------------------------------------- archives


def raw_zip(name: bytes) -> bytes:
    """Return a zip with a name in an old encoding that it does not declare."""
    content = SOURCE.encode()
    crc, size = zlib.crc32(content), len(content)
    head = struct.pack("<HHHHHIIIHH", 20, 0, 0, 0, 0, crc, size, size, len(name), 0)
    body = b"PK\3\4" + head + name + content
    listed = b"PK\1\2" + struct.pack("<H", 20) + head + struct.pack("<HHHII", 0, 0, 0, 0, 0) + name
    end = struct.pack("<4sHHHHIIH", b"PK\5\6", 0, 0, 1, 1, len(listed), len(body), 0)
    return body + listed + end


@pytest.mark.parametrize(
    ("name", "letters"),
    [
        ("課題/", "shift-jis"),
        ("ソ表/", "shift-jis"),
        ("作业/", "gbk"),
        ("Übung/", "cp437"),
        ("Übung/", "utf-8"),
    ],
)
def test_names_in_old_letters_hide_no_program(tmp_path: Path, name: str, letters: str):
    classes.put(tmp_path / "work.zip", raw_zip(name.encode(letters) + b"integrators.py"))
    package = read_package(Work("ann", (tmp_path / "work.zip",)))
    assert dict(package.files)["integrators.py"] == SOURCE.encode()


# ---------------------------------------------------------------- authors


def test_a_loose_file_of_who_is_listed_is_theirs_and_so_is_what_cannot_be_read(tmp_path: Path):
    people = people_of(
        tmp_path / "list.csv", "ID number,Email address\nann,ann@x.edu\nbo,b@x.edu\n"
    )
    folder = put(tmp_path / "class", {"ann@x.edu.docx": "words", "bo/integrators.py": SOURCE})
    put(folder, {"notes.docx": "mine", "ben.tar.zst": b"(\xb5/\xfd"})
    (folder / "cem").symlink_to(folder / "bo")
    intake = list_intake(folder, people)
    assert intake.troubles.keys() == {"ann@x.edu", "ben.tar", "cem"}
    assert intake.notes == ["notes.docx is no submission: skipped"]
    assert "links are not followed" in intake.troubles["cem"]
    assert "not read" in intake.troubles["ben.tar"]


def test_names_that_look_the_same_are_told_apart(tmp_path: Path):
    put(tmp_path, {"Ann/integrators.py": SOURCE, "ann/integrators.py": "other = 1\n"})
    troubles = list_intake(tmp_path).troubles
    assert "rename one where they are two students'" in troubles["Ann"]


@pytest.mark.parametrize("name", ["núñezana", "कुमारराज", "สมชาย", "שרהכהן", "李伟"])
def test_canvas_names_in_every_script_have_their_owner(tmp_path: Path, name: str):
    for at, form in enumerate(("NFC", "NFD")):
        file = f"{unicodedata.normalize(form, name)}_{at + 1}_50{at}_work.zip"
        classes.put(tmp_path / "class" / file, packed.as_zip({"integrators.py": f"x = {at}\n"}))
    rows = 'Student,ID,SIS Login ID,Section\n"A, B",1,ann,x\n"C, D",2,ben,x\n'
    people = people_of(tmp_path / "list.csv", rows)
    assert [each.name for each in list_intake(tmp_path / "class", people).found] == ["ann", "ben"]


def test_the_same_upload_twice_is_one(tmp_path: Path):
    content = packed.as_zip(WORK)
    put(tmp_path, {"leeann_1_10_work.zip": content, "leeann_1_11_work-1.zip": content})
    (found,) = list_intake(tmp_path).found
    assert dict(read_package(found).files)["integrators.py"] == SOURCE.encode()


def test_of_attempts_at_unread_times_none_is_the_last(tmp_path: Path):
    start = "1001-77 - Jane Doe - "
    put(tmp_path / "a", {f"{start}4 mai 2026 0930/integrators.py": "x = 1\n"})
    put(tmp_path / "a", {f"{start}15 mai 2026 0930/integrators.py": SOURCE})
    (found,) = list_intake(tmp_path / "a").found
    assert dict(read_package(found).files)["integrators.py"] == SOURCE.encode()
    put(tmp_path / "b", {f"{start}4 kvetna 2026 0930/integrators.py": "x = 1\n"})
    put(tmp_path / "b", {f"{start}15 kvetna 2026 0930/integrators.py": SOURCE})
    intake = list_intake(tmp_path / "b")
    assert not intake.found and "at unknown times" in intake.troubles["Jane Doe_1001-77"]


def test_a_groups_folder_is_its_members(tmp_path: Path):
    people = people_of(
        tmp_path / "list.csv",
        "Username,Last Name,First Name,Group\nu1,Lee,Ann,Group 3\nu2,Poe,Ben,Group 3\n",
    )
    name = "1006-77 - Group 3 - May 4, 2026 1159 PM/integrators.py"
    found = list_intake(put(tmp_path / "class", {name: SOURCE}), people).found
    assert [each.name for each in found] == ["u1", "u2"]


MOMENTS = {
    "Monday, 4 May 2026, 11:59 PM": (23, 59),
    "Monday, May 4, 2026, 11:59 PM": (23, 59),
    "Montag, 4. Mai 2026, 23:59": (23, 59),
    "lundi 4 mai 2026, 23:59": (23, 59),
    "lunes, 4 de mayo de 2026, 23:59": (23, 59),
    "lunedì, 4 maggio 2026, 23:59": (23, 59),
    "maandag, 4 mei 2026, 23:59": (23, 59),
    "segunda-feira, 4 de maio de 2026 às 23:59": (23, 59),
    "May 4, 2026 1159 PM": (23, 59),
    "4 May, 2026 1205 AM": (0, 5),
    "May 4, 2026 905 AM": (9, 5),
    "2026 May 4 2359": (23, 59),
    "2026-05-04 23:59": (23, 59),
}


@pytest.mark.parametrize("words", MOMENTS)
def test_times_are_read_in_the_language_of_the_reader(words: str):
    assert read_moment(words) == datetime(2026, 5, 4, *MOMENTS[words])


def test_no_time_is_guessed():
    for words in ("", "-", "4/5/2026 23:59", "30 February 2026, 11:59 PM", "May 4, 2026"):
        assert read_moment(words) is None
    assert read_moment("4 May 2026, 13:59 PM") is None and read_moment("4 foo 2026, 13:59") is None
    told = [read_moment(f"3 {month} 2026, 10:00") for month in ("juin", "juillet", "mars", "août")]
    assert [each.month for each in told if each] == [6, 7, 3, 8]


# ---------------------------------------------------------------- class lists and marks

GERMAN = (
    "ID,Vollständiger Name,E-Mail-Adresse,Status,Bewertung,Bestwertung,"
    "Bewertung kann geändert werden,Zuletzt geändert (Abgabe),Zuletzt geändert (Bewertung),"
    "Feedback als Kommentar\n"
    'Teilnehmer/in401,Jörg Müller,j@x.de,,,"20,00",Ja,"Montag, 4. Mai 2026, 23:59",-,\n'
    'Teilnehmer/in402,Hans_Peter Groß,h@x.de,,,"20,00",Ja,-,-,\n'
)


def marks_of(roster: Roster, parts: dict[str, Parts], **options: object) -> Marks:
    return make_marks(roster, roster.choose_key(), Scores(parts, MARKING, **options))


def scores(**points: int) -> dict[str, Parts]:
    return {name.replace("__", "@"): {"engine": Part(each, 20)} for name, each in points.items()}


@pytest.mark.parametrize("letters", ["utf-8", "utf-8-sig", "cp1252", "utf-16"])
def test_a_worksheet_in_another_language_goes_back_in_it(tmp_path: Path, letters: str):
    classes.put(tmp_path / "list.csv", GERMAN.encode(letters))
    roster = read_roster(tmp_path / "list.csv")
    people = ClassList(roster)
    put(tmp_path / "class", {"Jörg Müller_401_assignsubmission_file_/integrators.py": SOURCE})
    (found,) = list_intake(tmp_path / "class", people).found
    assert (found.name, found.handed_in) == ("j@x.de", datetime(2026, 5, 4, 23, 59))
    made = marks_of(roster, {"j@x.de": {"engine": Part(12, 20)}})
    content = made.text.encode(made.encoding)
    assert content.decode("utf-8-sig").splitlines()[0] == GERMAN.splitlines()[0]
    first, second = gradebooks.rows_of(content)
    assert (first["ID"], first["Bewertung"], second["Bewertung"]) == (
        "Teilnehmer/in401",
        "12.0",
        "0",
    )
    assert first["Zuletzt geändert (Bewertung)"] == "-"


def test_windows_letters_are_asked_about(tmp_path: Path):
    classes.put(tmp_path / "list.csv", GERMAN.encode("cp1252"))
    fault, *_ = find_problems(ClassFolder(tmp_path, Settings(roster="list.csv")))
    assert "is not UTF-8" in fault and "Vollständiger" in fault


def test_semicolons_and_the_line_that_names_them(tmp_path: Path):
    text = 'sep=;\r\n"Lab, all";Username;Last Name;First Name\r\n;;;\r\n;ann;Lee;Ann\r\n'
    classes.put(tmp_path / "list.csv", text)
    roster = read_roster(tmp_path / "list.csv")
    assert roster.columns[1:] == ["Username", "Last Name", "First Name"] and len(roster.rows) == 1


@pytest.mark.parametrize(
    "content, words",
    [
        (b'Email address,ID number\na@x.edu,"1.23E+05"\n', "a spreadsheet made of a number"),
        (b'Email address,ID number\na@x.edu,"1,23457E+11"\n', "a spreadsheet made of a number"),
        (b"PK\x03\x04" + bytes(50), "is a spreadsheet's own file: export"),
        (b"\xd0\xcf\x11\xe0" + bytes(50), "is a spreadsheet's own file: export"),
    ],
)
def test_what_a_spreadsheet_did_to_a_class_list_is_refused(tmp_path: Path, content, words):
    classes.put(tmp_path / "list.csv", content)
    with pytest.raises(Stop, match=words):
        read_roster(tmp_path / "list.csv")


def test_zeros_that_a_spreadsheet_took_are_no_other_student(tmp_path: Path):
    classes.put(tmp_path / "list.csv", "ID number,Last name,First name\n123,Lee,Ann\n7,Poe,Bo\n")
    roster = read_roster(tmp_path / "list.csv")
    assert ClassList(roster).find(["ID number"], "00123") == "123"
    made = marks_of(roster, {"00123": {"engine": Part(12, 20)}})
    assert [line.split(",")[3] for line in made.text.splitlines()[1:]] == ["12.0", "0"]
    classes.put(tmp_path / "two.csv", "ID number,Last name,First name\n123,L,A\n0123,P,B\n")
    two = ClassList(read_roster(tmp_path / "two.csv"))
    assert two.find(["ID number"], "0123") == "0123" and not two.find(["ID number"], "00123")


def test_a_list_in_no_known_language_is_known_by_its_addresses(tmp_path: Path):
    classes.put(
        tmp_path / "list.csv", "Imię,Nazwisko,Adres e-mail\nAnna,Lis,a@x.pl\nJan,Kot,j@x.pl\n"
    )
    assert read_roster(tmp_path / "list.csv").choose_key() == "Adres e-mail"
    classes.put(tmp_path / "none.csv", "Imię,Nazwisko\nAnna,Lis\nJan,Kot\n")
    with pytest.raises(Stop, match="call the column that identifies students"):
        read_roster(tmp_path / "none.csv").choose_key()


def test_canvas_with_names_in_two_columns(tmp_path: Path):
    head = "LastName,FirstName,ID,SIS Login ID,Section,Physics engine (77)\n"
    rows = ",,,,,Manual Posting\n    Points Possible,,,,,20\nLee,Ann,1,ann,A,\n"
    classes.put(tmp_path / "list.csv", head + rows + "Student,Test,99,,A,\n")
    roster = read_roster(tmp_path / "list.csv")
    assert find_system(roster).name == "canvas"
    assert [row["SIS Login ID"] for row in roster.rows] == ["ann"]
    made = marks_of(roster, scores(ann=12))
    title, possible, ann = made.text.splitlines()
    assert (title, possible) == (head.strip(), "    Points Possible,,,,,20")
    assert ann == "Lee,Ann,1,ann,A,12.0"


@pytest.mark.parametrize("most", ["20,00", "20.00"])
def test_marks_that_moodle_would_leave_out_are_told(tmp_path: Path, most: str):
    """Its worksheet silently skips marks above the assignment's maximum."""
    head = "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Feedback comments\n"
    rows = (
        f'Participant 1,Ann Lee,ann@x.de,,,"{most}",\nParticipant 2,Ben Öz,ben@x.de,,,"{most}",\n'
    )
    classes.put(tmp_path / "list.csv", head + rows)
    roster = read_roster(tmp_path / "list.csv")
    given = {"ann@x.de": {"engine": Part(21, 20)}, "ben@x.de": {"engine": Part(20, 20)}}
    (note,) = marks_of(roster, given).notes
    assert note.startswith("ann@x.de: above 20, which Moodle's worksheet leaves out")
    more = Scores(given, Marking("Physics engine", {"engine": 1}, 30))
    notes = make_marks(roster, roster.choose_key(), more).notes
    assert any("counts to 20 there" in each for each in notes)


def test_nobody_has_handed_in_nothing_while_some_work_has_no_owner(tmp_path: Path):
    classes.put(tmp_path / "list.csv", "Username,Last Name,First Name\nann,L,A\nkl_6,S,K\n")
    roster = read_roster(tmp_path / "list.csv")
    stranger = scores(ann=12) | {"6": {"engine": Part(20, 20)}}
    made = marks_of(roster, stranger)
    assert made.given == 1 and made.unowned == ["kl_6"]
    assert any("may be theirs" in note for note in made.notes)
    assert [line.split(",")[3] for line in made.text.splitlines()[1:]] == ["12.0", ""]
    sure = marks_of(roster, stranger, others_known=True)
    assert sure.given == 2 and "kl_6: nothing handed in" in sure.notes


def test_moodle_reads_the_number_behind_a_name_with_an_underscore():
    source = Path("Hans_Peter Groß_402_assignsubmission_file_")
    page = Page("h", "feedback.html", b"page", "words")
    ((name, page),) = Moodle().name_pages(source, [page])
    parts = name.split("_", 4)  # as Moodle's own importer takes a name apart
    assert (parts[1:4], parts[4], page) == (
        ["402", "assignsubmission", "file"],
        "feedback.html",
        b"page",
    )


def test_a_program_that_cannot_be_imported_is_said_in_the_table():
    words = ("error", 0, 2, "import integrators", "an answer", "SyntaxError: y")
    check = CheckResult("a", "a", "unit", *words)
    todo = TodoResult("8a", "a", "error", 0, 4, None, [check, check])
    result = Result(1, "ann", 0, 4, 0, [], [todo])
    assert list_broken(result) == ["import integrators fails: SyntaxError: y"]


# ---------------------------------------------------------------- a .rar as its makers pack it

RAR = (  # integrators.py, 1,271 bytes in 156, packed by the makers' program
    "UmFyIRoHAQDz4YLrCwEFBwAGAQGAgIAALbmmaCQCAtMABvcJpIMCgA6Aab4xLEWABQEOaW50ZWdyYXRv"
    "cnMucHnEzlA1RDQvdQM5yimkSk5EUw0LkDQd8IbhL/FnFLdQGpbmbtVZDknl71P2q1IdNk1yzSOZI6zk"
    "nYQia09BMWfQLW7Fj/XglnuAOUN8fBVl36xWcB13VlEDBQQA"
)


def test_a_packed_rar_without_a_tool_names_what_is_missing(tmp_path: Path, monkeypatch):
    pythons = (Path(sys.executable), Path(sys.executable).resolve())
    monkeypatch.setenv("PATH", os.pathsep.join(str(each.parent) for each in pythons))
    classes.put(tmp_path / "work.rar", base64.b64decode(RAR))
    with pytest.raises(CannotTake, match="install one of unrar, unar and 7z"):
        read_package(Work("ann", (tmp_path / "work.rar",)))


@pytest.mark.skipif(
    not shutil.which("unrar") and not shutil.which("unar"),
    reason="needs unrar or unar on the PATH, to unpack a packed rar",
)
def test_a_packed_rar_is_read(tmp_path: Path):
    classes.put(tmp_path / "work.rar", base64.b64decode(RAR))
    package = read_package(Work("ann", (tmp_path / "work.rar",)))
    line = b"# the same line many times, so that there is something to pack\n"
    assert dict(package.files)["integrators.py"] == SOURCE.encode() + 20 * line


OWN_NAMES = {  # prefix of each system before a file's own name
    "blackboard": "Lab_{name}_attempt_2026-05-04-10-00-00_",
    "brightspace": "{number}-1 - {name} - May 4, 2026 1159 PM - ",
    "canvas": "{name}_{number}_9_",
    "moodle": "{name}_{number}_assignsubmission_file_",
}


@pytest.mark.parametrize("other", OWN_NAMES)
@pytest.mark.parametrize("system", OWN_NAMES)
def test_nobody_hands_in_for_another_by_the_name_of_a_file(tmp_path, system, other):
    names = [OWN_NAMES[system].format(name=name, number=n) for n, name in enumerate(("ann", "ben"))]
    claim = OWN_NAMES[other].format(name="ann", number=0).replace("2026", "2027")
    put(tmp_path, {f"{name}integrators.py": SOURCE for name in names})
    honest = list_intake(tmp_path)
    put(tmp_path, {f"{names[1]}x_{claim}a.py": SOURCE, f"{names[1]}{claim}b.py": SOURCE})
    attacked = list_intake(tmp_path)
    assert attacked.names == honest.names and not attacked.troubles
    assert [len(each.sources) for each in attacked.found] == [1, 3]
