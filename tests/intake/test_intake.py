"""Test the intake of a class: exports of learning systems, class lists, and zips of every kind."""

import io
import os
import random
import stat
import subprocess
import sys
import unicodedata
import zipfile
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path

import pytest
from counting import count_calls
from packed import Files, as_zip, put

from grader.errors import Stop
from grader.intake import archives
from grader.intake.found import CannotTake, Work
from grader.intake.listing import open_class
from grader.intake.names import make_portable
from grader.intake.packing import open_submission, pack, read_package
from grader.intake.roster import ClassList
from grader.intake.systems import read_roster
from grader.judge import submission
from grader.judge.submission import MAX_FILES, CannotGrade
from grader.judge.task import KIT
from grader.protocol import MAX_UPLOAD

PROGRAM = {"mini_engine/__init__.py": "", "integrators.py": "x = 1\n"}


def under(folder: str, files: Files = PROGRAM) -> Files:
    return {f"{folder}/{name}": content for name, content in files.items()}


def names_in(found: Work) -> list[str]:
    return [name for name, _ in read_package(found).files]


@pytest.fixture
def classroom(tmp_path: Path) -> Path:
    (tmp_path / "class").mkdir()
    return tmp_path / "class"


def handed_in(classroom: Path, content: bytes) -> Work:
    (classroom / "ann.zip").write_bytes(content)
    return Work("ann", (classroom / "ann.zip",))


def refuse(classroom: Path, content: bytes) -> str:
    with pytest.raises(CannotTake) as caught:
        read_package(handed_in(classroom, content))
    assert {path.name for path in classroom.parent.iterdir()} == {"class"}, "written outside"
    return str(caught.value)


# ---------------------------------------------------------------- exports


def test_canvas_names_late_marks_and_loose_files(classroom):
    put(
        classroom,
        {
            "doejane_LATE_1234_5678_hand-in.zip": as_zip(PROGRAM),
            "roebo_77_10_integrators-2.py": "x = 2\n",
            "roebo_77_11_pymunk_scene.py": "",
            "anon_k3Xyz_99_work.zip": as_zip(under("work")),
            "texter_5_text.html": "<p>it does not run</p>",
        },
    )
    with open_class(classroom) as taken:
        found = {each.name: each for each in taken.found}
        assert list(found) == ["anon_k3Xyz", "doejane_1234", "roebo_77"]
        assert found["doejane_1234"].late and not found["roebo_77"].late
        assert names_in(found["roebo_77"]) == ["integrators.py", "pymunk_scene.py"]
        assert names_in(found["anon_k3Xyz"]) == sorted(PROGRAM)
        assert taken.troubles.keys() == {"texter_5"} and "no file" in taken.troubles["texter_5"]


def test_moodle_with_folders_of_both_kinds_and_without(classroom):
    put(
        classroom,
        {
            **under("Ann Lee_101_assignsubmission_file_"),
            **under("Ben Öz_102_assignsubmission_file/deep"),
            "Cem O_Neil_103_assignsubmission_file_work.zip": as_zip(PROGRAM),
            "Ann Lee_101_assignsubmission_onlinetext_/onlinetext.html": "hello",
            "Dora_104_assignsubmission_onlinetext/onlinetext.html": "see my page",
        },
    )
    with open_class(classroom) as taken:
        assert [each.name for each in taken.found] == [
            "Ann Lee_101",
            "Ben Öz_102",
            "Cem O_Neil_103",
        ]
        assert all(names_in(each) == sorted(PROGRAM) for each in taken.found)
        assert taken.troubles.keys() == {"Dora_104"}


GRADESCOPE = """\
submission_1:
  :submitters:
  - :name: Ann Lee
    :sid: '100'
    :email: ann@school.edu
  :created_at: 2026-05-04 21:59:01.500000000 Z
  :score: 3.0
  :results: !ruby/hash:ActiveSupport::HashWithIndifferentAccess
    score: 3
submission_2:
  :submitters:
  - :name: Ben
    :sid: '200'
    :email: ben@school.edu
  - :name: Cem
    :sid:
    :email:
  :created_at: 2026-05-05 01:00:00 +02:00
submission_3:
  :submitters:
  - :name:
    :email: dora@school.edu
"""


def test_gradescope_names_times_and_people_who_work_together(classroom):
    files = {
        "submission_metadata.yml": GRADESCOPE,
        **under("submission_1"),
        **under("submission_2"),
    }
    put(classroom / "assignment_9_export", files)
    with open_class(classroom) as taken:
        found = {each.name: each for each in taken.found}
        assert list(found) == ["Cem", "ann@school.edu", "ben@school.edu"]
        assert found["Cem"].sources == found["ben@school.edu"].sources
        assert found["Cem"].group == ("ben@school.edu",)
        assert found["ben@school.edu"].group == ("Cem",)
        assert found["Cem"].handed_in_by == "ben@school.edu"
        at = datetime(2026, 5, 4, 21, 59, 1, 500000, UTC)
        assert found["ann@school.edu"].handed_in == at
        assert found["Cem"].handed_in == datetime(2026, 5, 4, 23, tzinfo=UTC)
        assert taken.troubles.keys() == {"dora@school.edu"}


def test_a_list_that_is_not_gradescopes_is_refused(classroom):
    for text in ("- 1\n", "submission_1: {}\n", "a: [\n", "submission_1: {':submitters': 7}\n"):
        put(classroom, {"submission_metadata.yml": text})
        with pytest.raises(Stop, match="not as Gradescope"), open_class(classroom):
            pass


STUDENTS = [f"{name}_1_assignsubmission_file_" for name in ("Ann", "Ben")]
ONE_EACH = {f"{student}/integrators.py": "x = 1" for student in STUDENTS}
TWO = under("ann") | under("ben")
DOWNLOADS = {
    "Canvas": {
        "ann_1_2_a.zip": as_zip(PROGRAM),
        "ben_LATE_3_4_b.zip": as_zip(PROGRAM),
    },
    "a folder around": {f"all/{name}": text for name, text in TWO.items()},
    "what a Mac leaves": TWO | {"__MACOSX/._x": ""},
    "strange names": TWO | {"ben/aux.py": "", "../../up.py": "", "/root.py": ""},
    "names that become one": ONE_EACH | {f"{STUDENTS[0]}/{n}": n for n in ("x*", "x_/y")},
    "a device": ONE_EACH | {f"{STUDENTS[0]}/{n}": n for n in ("con/x", "_con")},
    "a long path": ONE_EACH | {f"{STUDENTS[1]}/{f'{chr(0x3B1) * 80}/' * 50}a.py": "y"},
}


@pytest.mark.parametrize("kind", DOWNLOADS)
def test_a_download_of_a_class_is_read_whatever_is_in_it(classroom, kind):
    (classroom / "all.zip").write_bytes(as_zip(DOWNLOADS[kind]))
    with open_class(classroom / "all.zip") as intake:
        first, second = intake.found
        assert first.name.lower().startswith("ann") and second.name.lower().startswith("ben")
        assert {"integrators.py"} <= set(names_in(first))
        if kind in ("names that become one", "a device"):
            assert len([each for each in first.sources[0].rglob("*") if each.is_file()]) == 3
        if kind == "a long path":
            with pytest.raises(CannotTake, match="folders in each other"):
                pack(second)
    assert {path.name for path in classroom.parent.iterdir()} == {"class"}


# ---------------------------------------------------------------- folders of people


def test_folders_checkouts_and_system_files(classroom):
    put(classroom, under("ann") | under("ben/x/y") | {"cem.zip": as_zip(under("cem's work"))})
    left = ("ann/.git/config", "ben/x/._mini_engine", ".DS_Store", "Thumbs.db")
    put(classroom, dict.fromkeys(left, ""))
    put(classroom, {"roster.csv": "", "adjustments.toml": ""})
    (classroom / "empty").mkdir()
    with open_class(classroom) as taken:
        assert [each.name for each in taken.found] == ["ann", "ben", "cem", "empty"]
        assert all(names_in(each) == sorted(PROGRAM) for each in taken.found[:3])
        with pytest.raises(CannotTake, match=r"nothing of the lab .* it holds no file"):
            read_package(taken.found[3])
        assert not taken.troubles and not taken.notes


def test_nothing_is_dropped_in_silence(classroom):
    put(classroom, under("ann") | {"ben.rar": "Rar!", "cem.py": "x", "read me.txt": ""})
    (classroom / "link").symlink_to(classroom / "ann")
    with open_class(classroom) as taken:
        assert taken.troubles.keys() == {"cem", "link"}
        assert "link is a link" in taken.troubles["link"]
        assert [each.name for each in taken.found] == ["ann", "ben"]
        with pytest.raises(CannotTake, match="broken"):
            read_package(taken.found[1])
        assert taken.notes == ["read me.txt is no submission: skipped"]


def test_one_submission_is_laid_out_as_one_of_a_class_is(tmp_path):
    path, said = tmp_path / "ann.zip", []
    path.write_bytes(as_zip(under("work") | {"work/old/integrators.py": "x = 0\n"}))
    with open_submission(path, said.append) as folder:
        assert folder.name == "ann"
        assert {name for name in PROGRAM if (folder / name).is_file()} == set(PROGRAM)
    assert not folder.exists() and "old/integrators.py was skipped" in said[0]
    for files, words in (({"../up.py": ""}, "reaches outside"), ({"a.txt": ""}, "nothing of the")):
        path.write_bytes(as_zip(files))
        for each in (path, tmp_path):
            with pytest.raises(CannotGrade, match=words), open_submission(each):
                pass


def test_one_submission_is_not_taken_for_a_class(classroom):
    with pytest.raises(Stop, match="leave out --class"):
        open_class(put(classroom, PROGRAM)).__enter__()


def test_who_handed_in_twice_must_choose_unless_it_is_the_same(classroom):
    put(classroom, under("ann") | {"ann.zip": as_zip(PROGRAM)})
    put(classroom, under("Ben") | {"ben.zip": as_zip({"integrators.py": "other"})})
    put(classroom, under("cem") | {"cem.rar": "Rar!"})
    with open_class(classroom) as taken:
        assert [each.name for each in taken.found] == ["ann"]
        assert "Ben and ben.zip" in taken.troubles["Ben"]
        assert "as cem and cem.rar" in taken.troubles["cem"]
        assert "ann and ann.zip are the same" in taken.notes[0]


def test_the_same_files_are_one_package_whoever_and_however(classroom, tmp_path):
    folder = Work("ann", (put(classroom / "ann", PROGRAM),))
    (classroom / "b.zip").write_bytes(as_zip(under("x/y", dict(reversed(PROGRAM.items())))))
    package = read_package(folder)
    assert package.digest == read_package(Work("ben", (classroom / "b.zip",))).digest
    unpacked = package.unpack(tmp_path)
    assert unpacked.name == "ann"
    assert {name: (unpacked / name).read_text() for name in PROGRAM} == PROGRAM
    put(classroom / "ann", {"integrators.py": "x = 2\n"})
    assert read_package(folder).digest != package.digest


# ---------------------------------------------------------------- the class list


CANVAS_LIST = """\
Student,ID,SIS User ID,SIS Login ID,Section
"Doe, Jane",1234,S1,jane,A
"Roe, Bo",77,S2,bo,A
"Poe, Al",78,S3,al,A
"""
MOODLE_LIST = """\
First name,Last name,ID number,Email address
Ann,Lee,7,ann@school.edu
Bo,Roe,8,bo@school.edu
"""


def people(tmp_path: Path, text: str) -> ClassList:
    (tmp_path / "list.csv").write_text(text, encoding="utf-8")
    return ClassList(read_roster(tmp_path / "list.csv"))


def test_a_class_list_names_students_as_the_gradebook_does(classroom, tmp_path):
    known = people(tmp_path, CANVAS_LIST)
    put(
        classroom,
        {f"{who}_1_a.zip": as_zip(PROGRAM) for who in ("doejane_1234", "roebo_77")},
    )
    put(classroom, under("stranger"))
    with open_class(classroom, known) as taken:
        names = [each.name for each in taken.found]
        assert names == ["bo", "jane", "stranger"]
        assert known.list_absent(names) == ["al"]
        assert known.list_unlisted(names) == ["stranger"]
    known = people(tmp_path, MOODLE_LIST)
    put(classroom / "moodle", under("Ann Lee_5_assignsubmission_file") | under("bo"))
    with open_class(classroom / "moodle", known) as taken:
        names = [each.name for each in taken.found]
        assert names == ["ann@school.edu", "bo"]
        assert known.list_absent(names) == [] and known.list_unlisted(names) == []
    twins = people(tmp_path, MOODLE_LIST + "Ann,Lee,9,other@school.edu\n")
    assert twins.find(["name"], "Ann Lee") is None


@pytest.mark.parametrize(
    "words, name",
    [
        ("Zoë Müller", "Zoë Müller"),
        (unicodedata.normalize("NFD", "Zoë"), "Zoë"),
        ("../../etc/passwd", "_.._etc_passwd"),
        ("CON", "_CON"),
        ("aux.json", "_aux.json"),
        ("a\x1b[2J\u202eb", "a_[2J_b"),
        ("...", "_"),
        ("", "_"),
        ("ö" * 300, "ö" * 90),
    ],
)
def test_names_become_file_names_of_every_system(words, name):
    assert make_portable(words) == name


# ---------------------------------------------------------------- zips that must be refused


OUTSIDE = ["../up.py", "a/../../up.py", "/etc/up.py", "C:/up.py", "..\\up.py", "\\\\host\\up.py"]
UNPORTABLE = ["aux.py", "what?.txt", "lab: last/more.py", 'the "floor".png', f"{'x' * 200}.py"]


def test_names_that_not_every_system_takes_are_changed_or_refused(classroom):
    for name in OUTSIDE:
        assert "outside" in refuse(classroom, as_zip(PROGRAM | {name: "x"})), name
    assert "case alone" in refuse(classroom, as_zip(PROGRAM | {"Integrators.py": "x"}))
    for name in UNPORTABLE:
        package = read_package(handed_in(classroom, as_zip(PROGRAM | {name: "x"})))
        (other,) = {file for file, _ in package.files} - set(PROGRAM)
        assert other == "/".join(map(make_portable, name.split("/"))) and not package.notes


def test_broken_encrypted_and_unusual_zips_are_refused(classroom):
    good = as_zip(PROGRAM)
    assert "broken" in refuse(classroom, b"")
    assert "broken" in refuse(classroom, b"Rar!" + bytes(100))
    assert "broken" in refuse(classroom, good[:-30])
    stored = as_zip(PROGRAM, zipfile.ZIP_STORED)
    assert "broken" in refuse(classroom, stored.replace(b"x = 1", b"x = 2"))
    central = good.rindex(b"PK\x01\x02")
    locked = bytearray(good)
    locked[central + 8] |= 1
    assert "encrypted" in refuse(classroom, bytes(locked))
    assert "unusual" in refuse(classroom, as_zip(PROGRAM, zipfile.ZIP_BZIP2))
    assert "unusual" in refuse(classroom, as_zip(PROGRAM, zipfile.ZIP_LZMA))


@pytest.mark.parametrize("hidden", [b"", b"PK\x05\x06", b"PK\x06\x07"])
def test_a_zip_that_lists_too_many_files_is_not_even_listed(classroom, monkeypatch, hidden):
    """Nor if a second end record, in the comment of the first, claims that the list is short."""
    monkeypatch.setattr(archives, "MAX_DIRECTORY", 1000)
    content = bytearray(as_zip({f"{n}.py": "" for n in range(40)}))
    if hidden:
        content[-2:] = (40).to_bytes(2, "little")
        hidden += bytes(36)
    assert "too many" in refuse(classroom, bytes(content + hidden))


def test_a_short_list_is_read_where_another_end_is_hidden_in_it(classroom):
    name = "PK\x05\x06" + "\xff" * 16
    assert len(names_in(handed_in(classroom, as_zip(PROGRAM | {name: "x"})))) == 3


def test_many_archives_have_the_bounds_of_one(classroom, monkeypatch):
    """Each costs a process or a list, so their number, sizes, lists and seconds are counted."""
    monkeypatch.setattr(archives, "MAX_ARCHIVES", 3)
    monkeypatch.setattr(archives, "MAX_DIRECTORY", 10_000)
    opened = []
    real = archives.open_archive
    monkeypatch.setattr(archives, "open_archive", lambda *args: opened.append(1) or real(*args))
    with pytest.raises(CannotTake, match="more than 3 archives in one submission"):
        many = as_zip({f"{n}.zip": as_zip({"a.txt": ""}) for n in range(40)})
        read_package(handed_in(classroom, many))
    assert len(opened) == 3
    monkeypatch.setattr(archives, "MAX_ARCHIVES", 40)
    many = as_zip({f"{n}.zip": as_zip({f"{m}.txt": "" for m in range(20)}) for n in range(30)})
    with pytest.raises(CannotTake, match="too many files"):
        read_package(handed_in(classroom, many))


def test_bombs_give_the_program_and_no_more_than_the_bounds(classroom, monkeypatch):
    bomb = {f"{n:02}.bin": bytes(MAX_UPLOAD // 4) for n in range(8)}
    inner = as_zip({f"{n}.bin": bytes(MAX_UPLOAD // 2) for n in range(4)})
    for files in (bomb, {f"{n}.zip": inner for n in range(50)}):
        package = read_package(handed_in(classroom, as_zip(files | PROGRAM)))
        assert {"integrators.py", "mini_engine/__init__.py"} <= {name for name, _ in package.files}
        assert sum(len(content) for _, content in package.files) <= MAX_UPLOAD
        assert package.notes
    monkeypatch.setattr(archives, "MAX_ZIP", 10)
    assert "MB" in refuse(classroom, as_zip(PROGRAM))


def test_a_size_that_lies_gives_no_more_than_it_says(classroom):
    content = bytearray(as_zip(PROGRAM | {"z.bin": bytes(100_000)}))
    at = content.rindex(b"PK\x01\x02") + 24
    assert int.from_bytes(content[at : at + 4], "little") == 100_000
    content[at : at + 4] = (10).to_bytes(4, "little")
    assert "broken" in refuse(classroom, bytes(content))


def test_links_environments_and_system_files_in_a_zip_are_left_out(classroom):
    content = io.BytesIO(as_zip(PROGRAM))
    with zipfile.ZipFile(content, "a") as archive:
        link = zipfile.ZipInfo("passwords.txt")
        link.external_attr = (stat.S_IFLNK | 0o777) << 16
        archive.writestr(link, "/etc/passwd")
        for name in ("env/pyvenv.cfg", "env/lib/site.py", ".git/config", "__MACOSX/._x.py"):
            archive.writestr(name, "")
        for name in ("mini_engine/._contacts.py", "._integrators.py", "lab/Icon\r"):
            archive.writestr(name, b"\0\5\26\7\0\2\0\0Mac OS X")
        for number in range(MAX_FILES + 1):
            archive.writestr(f"node_modules/{number}.py", "")
    package = read_package(handed_in(classroom, content.getvalue()))
    assert [name for name, _ in package.files] == sorted(PROGRAM) and not package.notes


def test_a_file_that_is_also_a_folder_is_refused(classroom):
    words = refuse(classroom, as_zip(PROGRAM | {"a.py": "", "a.py/b.py": ""}))
    assert "broken" in words and "/" not in words  # no path of this machine


def test_a_zip_with_any_bytes_changed_is_taken_or_refused_with_a_sentence(classroom):
    rng, content = random.Random(1), as_zip(PROGRAM | {"a/ö.txt": "hello" * 50})
    outcomes = set()
    for _ in range(60):
        changed = bytearray(content)
        for _ in range(rng.choice([1, 2, 20])):
            changed[rng.randrange(len(changed))] = rng.randrange(256)
        try:
            outcomes.add(bool(read_package(handed_in(classroom, bytes(changed))).files))
        except CannotTake as error:
            outcomes.add(str(error))
    assert True in outcomes and len(outcomes) > 3
    assert {path.name for path in classroom.parent.iterdir()} == {"class"}


# ---------------------------------------------------------------- delays


def test_what_has_no_end_is_for_a_person(classroom, monkeypatch):
    folder = put(classroom / "ann", PROGRAM)
    monkeypatch.setattr(submission, "MAX_SEEN", 30)
    put(folder, {f"many/{number}": "" for number in range(30)})
    with pytest.raises(CannotTake, match="more than 20000 files and folders"):
        read_package(Work("ann", (folder,)))


def test_folders_in_each_other_without_end_are_for_a_person(classroom):
    """They are deeper than Python's own functions can go."""
    folder = put(classroom / "ann", PROGRAM)
    here = os.getcwd()
    try:
        os.chdir(folder)
        for _ in range(1200):
            os.mkdir("d")
            os.chdir("d")
    finally:
        os.chdir(here)
    with pytest.raises(CannotTake, match="40 folders in each other"):
        read_package(Work("ann", (folder,)))
    deep = {"d/" * 1500 + "integrators.py": "x = 1\n"}
    assert "40 folders in each other" in refuse(classroom.parent / "class", as_zip(deep))
    subprocess.run(["rm", "-r", folder], check=True)  # pytest cannot


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pipes with names in folders")
@pytest.mark.parametrize("name", ["ann.zip", "ann.py", "ann.7z"])
def test_nobody_waits_at_a_pipe(classroom, name):
    os.mkfifo(classroom / name)
    with pytest.raises(CannotTake, match="no file to read"):
        read_package(Work("ann", (classroom / name,)))
    with pytest.raises(Stop, match="no file to read"), open_submission(classroom / name):
        pass
    folder = put(classroom / "ben", PROGRAM)
    os.mkfifo(folder / "data.py")
    assert "data.py" not in names_in(Work("ben", (folder,)))


@pytest.mark.parametrize("name", ["{}/integrators.py", "{}/mini_engine/__init__.py"])
def test_a_program_many_times_takes_no_more_calls_than_its_files(classroom, name):
    def take(count: int) -> None:
        folder = put(classroom / f"{count}", {name.format(n): "" for n in range(count)})
        with suppress(CannotTake):
            read_package(Work("ann", (folder,)))

    few, many = (count_calls(lambda count=count: take(count)) for count in (200, 400))
    assert many < 3 * few


def test_notes_of_one_submission_are_few(classroom):
    copies = {f"integrators ({number}).py": PROGRAM["integrators.py"] for number in range(200)}
    notes = read_package(Work("ann", (put(classroom / "ann", {**PROGRAM, **copies}),))).notes
    assert len(notes) == 21 and notes[-1] == "and 181 notes more"


def test_what_the_teacher_tried_in_canvas_is_nobodys(classroom):
    for name in ("studenttest_400001_9_lab.zip", "studenttest_LATE_400001_text.html"):
        (classroom / name).write_bytes(as_zip(PROGRAM))
    (classroom / "doejane_12_34_lab.zip").write_bytes(as_zip(PROGRAM))
    with open_class(classroom) as intake:
        assert intake.names == ["doejane_12"] and len(intake.notes) == 2
        assert intake.notes[0].endswith("was skipped: a test submission of the teacher")


def test_the_page_of_limits_has_those_of_an_upload():
    text = (KIT / "handouts" / "instructor" / "security.md").read_text(encoding="utf-8")
    assert f"{MAX_UPLOAD >> 20} MB, {MAX_FILES} files, {archives.MAX_ARCHIVES} archives" in text
