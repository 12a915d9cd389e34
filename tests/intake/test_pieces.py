"""Test finding the lab's files in a submission: in archives, in any folder, under any name."""

import bz2
import gzip
import re
import subprocess
import sys
import tarfile
from pathlib import Path

import packed
import pytest
from samples import sample
from whole_bank import bank

from grader.errors import Stop
from grader.intake import archives, repack
from grader.intake.found import CannotTake, Package, Work
from grader.intake.listing import open_class
from grader.intake.packing import read_package
from grader.judge.submission import plain_files
from grader.judge.task import KIT
from grader.protocol import MAX_UPLOAD

PROGRAM: packed.Files = {
    "mini_engine/__init__.py": "from mini_engine.solver import *\n",
    "mini_engine/solver.py": "# mine\n",
    "integrators.py": "x = 1\n",
    "pymunk_scene.py": "y = 1\n",
}
ALL = sorted(PROGRAM)


def write(folder: Path, files: packed.Files | bytes) -> Work:
    """Write a submission: a folder of files, or a zip."""
    if isinstance(files, bytes):
        return make_work(folder.parent, "work.zip", files)
    return Work("ann", (packed.put(folder, files),))


def make_work(tmp_path: Path, name: str, content: bytes) -> Work:
    (tmp_path / name).write_bytes(content)
    return Work("ann", (tmp_path / name,))


def names(package: Package) -> list[str]:
    return [name for name, _ in package.files]


def under(folder: str, files: packed.Files = PROGRAM) -> packed.Files:
    return {f"{folder}/{name}": content for name, content in files.items()}


# ---------------------------------------------------------------- archives

KINDS = {
    "zip": packed.as_zip,
    "tar": lambda files: packed.as_tar(files, ""),
    "tar.gz": packed.as_tar,
    "tgz": packed.as_tar,
    "tar.bz2": lambda files: packed.as_tar(files, "bz2"),
    "tar.xz": lambda files: packed.as_tar(files, "xz"),
    "7z": packed.as_7z,
    "rar": packed.as_rar,
}


@pytest.mark.parametrize("kind", KINDS)
def test_archives_of_all_kinds_are_read(tmp_path, kind):
    for name in (f"ann.{kind}", "other.rar" if kind == "tar" else "other.zip"):
        package = read_package(make_work(tmp_path, name, KINDS[kind](under("work"))))
        assert {name: content.decode() for name, content in package.files} == PROGRAM
    with open_class(tmp_path) as taken:
        assert [each.name for each in taken.found] == ["ann", "other"]


@pytest.mark.parametrize("kind", sample(["tar.gz", "7z", "rar"], 3))
def test_no_archive_reaches_outside(tmp_path, kind):
    for name in ("../up.py", "a/../../up.py"):
        found = make_work(tmp_path, f"ann.{kind}", KINDS[kind](PROGRAM | {name: "x"}))
        with pytest.raises(CannotTake, match=r"outside|broken"):
            read_package(found)
    assert [path.name for path in tmp_path.iterdir()] == [f"ann.{kind}"]


@pytest.mark.parametrize("kind", sample(["rar", "7z", "tar.gz"], 3))
def test_what_is_no_archive_is_a_sentence(tmp_path, kind):
    good = KINDS[kind](PROGRAM)
    for content in (b"", b"hello", good[: len(good) // 2], good[:20] + bytes(200)):
        with pytest.raises(CannotTake, match=r"broken|holds no file"):
            read_package(make_work(tmp_path, f"ann.{kind}", content))


def test_an_encrypted_archive_asks_for_one_without_a_password(tmp_path):
    with pytest.raises(CannotTake, match="password"):
        read_package(make_work(tmp_path, "ann.7z", packed.as_7z(PROGRAM, password="secret")))


def test_links_in_a_tar_are_left_out(tmp_path):
    links = []
    for name, kind, to in (
        ("passwords.txt", tarfile.SYMTYPE, "/etc/passwd"),
        ("shadow.txt", tarfile.LNKTYPE, "/etc/shadow"),
        ("pipe", tarfile.FIFOTYPE, ""),
    ):
        link = tarfile.TarInfo(name)
        link.type, link.linkname = kind, to
        links.append(link)
    assert (
        names(read_package(make_work(tmp_path, "a.tgz", packed.as_tar(PROGRAM, "gz", *links))))
        == ALL
    )


@pytest.mark.parametrize("kind", sample(["7z", "tar.xz"], 2))
def test_a_bomb_of_one_file_gives_the_program_alone(tmp_path, kind):
    bomb = bytes(MAX_UPLOAD + 1)
    found = make_work(tmp_path, f"ann.{kind}", KINDS[kind](PROGRAM | {"big.bin": bomb}))
    package = read_package(found)
    assert names(package) == ALL and package.notes == ["skipped big.bin: size limit reached"]


def test_a_class_in_an_archive_loses_nobody_for_being_large(tmp_path):
    large = {"ann.zip": packed.as_zip(PROGRAM), "ben.zip": bytes(MAX_UPLOAD + 1)}
    (tmp_path / "class.tgz").write_bytes(packed.as_tar(large))
    with pytest.raises(Stop, match=r"ben\.zip is too large: unpack it"):
        open_class(tmp_path / "class.tgz").__enter__()


@pytest.mark.parametrize("kind", ["tar.gz", "7z", "rar"])
def test_a_bomb_of_many_files_is_refused(tmp_path, kind, monkeypatch, capsys):
    path = tmp_path / "ann"
    path.write_bytes(KINDS[kind]({f"{number}.bin": bytes(300) for number in range(4)}))
    monkeypatch.setattr(repack, "set_limits", lambda seconds: None)
    for bound in ("MAX_UNPACKED", "MAX_MEMBERS"):
        with monkeypatch.context() as patch:
            patch.setattr(repack, bound, 1000 if bound == "MAX_UNPACKED" else 3)
            assert repack.main(str(path), str(tmp_path / "out")) == repack.REFUSED
        assert "too much" in capsys.readouterr().out


def test_all_archives_of_a_submission_share_the_seconds_of_one(tmp_path, monkeypatch):
    """A hundred bytes of bz2 hold ten megabytes; forty files must not cost forty times as much."""
    given, used = [], iter([0.0, 2.5, 2.5, 3.5, 3.5, 9.0])

    def run(script, **options):
        given.append((int(re.findall(r"'(\d+)'\]", script[-1])[0]), options["timeout"]))
        return subprocess.CompletedProcess(script, repack.REFUSED, "it is broken", "")

    monkeypatch.setattr(archives, "MAX_SECONDS", 5)
    monkeypatch.setattr(archives, "reaped_seconds", lambda: next(used))
    monkeypatch.setattr(archives.subprocess, "run", run)
    for number in range(9):
        (tmp_path / f"{number}.tar.bz2").write_bytes(bz2.compress(b""))
    with pytest.raises(CannotTake, match="archives of the submission take too long"):
        read_package(Work("ann", (tmp_path,)))
    assert given == [(5, 20), (3, 12), (2, 8)]


def test_a_library_that_is_not_here_is_named(monkeypatch):
    with pytest.raises(repack.CannotRepack, match=r"\.7z needs no_such_library.*pip install"):
        repack.load_library("no_such_library", ".7z")


# ---------------------------------------------------------------- at any depth, under any name

WORK: packed.Files = {"integrators.py": "x = 1\n"}
OTHERS = {name: text for name, text in PROGRAM.items() if name not in WORK}
LOOSE = {n.removeprefix("mini_engine/"): t for n, t in PROGRAM.items() if "__init__" not in n}
APART: packed.Files = {
    "1-6/mini_engine/__init__.py": "",
    "task 7/pymunk_scene.py": "",
    "task 7/helper.py": "",
    "task 8/integrators.zip": packed.as_zip(WORK),
}


def in_folder(name: str) -> packed.Files:
    return {file.replace("mini_engine", name): text for file, text in PROGRAM.items()}


def in_zips(*names: str) -> bytes:
    content = packed.as_zip(WORK)
    for name in names:
        content = packed.as_zip({f"{name}.zip": content})
    return content


READ: dict[str, tuple[packed.Files | bytes, list[str], str]] = {  # files, names read, a note
    "deep": (under("a/b/c/d/e/f"), ALL, ""),
    "around all": (under("mini_engine"), ALL, ""),
    "a folder each": (
        APART,
        ["helper.py", "integrators.py", "mini_engine/__init__.py", "pymunk_scene.py"],
        "task 7/pymunk_scene.py is taken as pymunk_scene.py",
    ),
    "beside a zip": (WORK | {"engine.zip": packed.as_zip(OTHERS)}, ALL, ""),
    "beside a 7z": (WORK | {"engine.7z": packed.as_7z(OTHERS)}, ALL, ""),
    "beside a rar": (WORK | {"engine.rar": packed.as_rar(OTHERS)}, ALL, ""),
    "zip not needed": (
        PROGRAM | {"old.zip": "no zip"},
        [*ALL, "old.zip"],
        "old.zip was not opened: all programs lie beside it",
    ),
    "zip in a zip": ({"work.zip": in_zips("inner")}, list(WORK), ""),
    "zip without a suffix": ({"work": packed.as_zip(WORK)}, list(WORK), ""),
    "nearer": (
        PROGRAM | {"old/integrators.py": "x = 0\n"},
        [*ALL, "old/integrators.py"],
        "old/integrators.py was skipped: integrators.py lies nearer to the top",
    ),
    "inside the package": (
        {n.replace("solver.py", "solver (1).py"): t for n, t in PROGRAM.items()},
        ALL,
        "mini_engine/solver (1).py is taken as mini_engine/solver.py",
    ),
    "twice the same": (
        PROGRAM | {"integrators (1).py": "x = 1\n", "mini_engine/solver-2.py": "# mine\n"},
        ALL,
        "integrators (1).py and integrators.py are the same",
    ),
    "loose": (LOOSE, [n for n in ALL if "__init__" not in n], "is taken as mini_engine"),
    "another package": (in_folder("my engine"), ALL, "my engine is taken as mini_engine"),
    "a second package": (in_folder("mini_engine (1)"), ALL, "mini_engine (1) is taken as"),
    "an empty one": (WORK | {"pymunk_scene.py": ""}, [*WORK, "pymunk_scene.py"], "is empty"),
    "a draft beside it": (WORK | {"integrators v1.py": "2"}, ["integrators v1.py", *WORK], ""),
}


@pytest.mark.parametrize("case", READ)
def test_the_programs_are_found(tmp_path, case):
    files, wanted, note = READ[case]
    package = read_package(write(tmp_path / "ann", files))
    read = {name: content.decode("utf-8", "replace") for name, content in package.files}
    assert set(wanted) <= set(read) and set(read) - set(wanted) <= {"integrators (1).py"}
    assert note in "; ".join(package.notes) and bool(note) == bool(package.notes)
    assert read.get("integrators.py", "x = 1\n") == "x = 1\n"


REFUSED: dict[str, tuple[packed.Files | bytes, str]] = {
    "broken archive": (WORK | {"engine.rar": "Rar!\x1a\x07\x01\x00"}, r"engine\.rar: the archive"),
    "two programs": (PROGRAM | {"integrators (1).py": "other\n"}, "more than one program"),
    "two inside": (PROGRAM | {"mini_engine/solver-2.py": "other\n"}, "more than one program"),
    "two drafts": ({"integrators v1.py": "1", "integrators v2.py": "2"}, "more than one program"),
    "two folders": (
        under("old") | under("new") | {"old/integrators.py": "x = 2"},
        "program integrators, in new, old: leave one",
    ),
    "a web page": ({"integrators.py": b"<!DOCTYPE html><html>"}, "integrators.py is a web page"),
    "rich text": ({"integrators.py": b"{\\rtf1\\ansi x}"}, "a text of a word processor"),
    "a zip": ({"integrators.py": packed.as_zip(WORK)}, "is a zip or an Office document"),
    "utf-16": ({"integrators.py": "x".encode("utf-16")}, "in UTF-16.* is needed in UTF-8"),
    "binary": ({"integrators.py": b"def x\0\0"}, "integrators.py is no text"),
    "a notebook": ({"integrators.py": b'{"cells": []}'}, "integrators.py is a notebook"),
    "empty": ({"integrators.py": b"", "mini_engine/__init__.py": b"\n"}, "programs are empty"),
    "an own name": ({"integrators_final.py": "x"}, "nothing of the lab was found"),
    "another name": ({"hello world.py": "x"}, "nothing of the lab was found"),
    "saved by a browser": ({"integrators.py.html": "x"}, "nothing of the lab was found"),
    "a link to a drive": ({"integrators.gdoc": "x"}, "nothing of the lab was found"),
    "too deep": (in_zips(*"abcd"), "archives are opened 3 deep"),
    "no bytes": (b"", "it has no bytes"),
    "cut off": (packed.as_zip(WORK)[:-30], "cut off"),
    "no tar": ({"integrators.py.gz": gzip.compress(b"x = 1\n")}, "of no kind that is read here"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_unclear_or_unreadable_is_for_a_person(tmp_path, case):
    files, words = REFUSED[case]
    with pytest.raises(CannotTake, match=words):
        read_package(write(tmp_path / "ann", files))


def test_a_reason_can_be_shown_to_the_student_too():
    for module in (KIT / "grader" / "intake").glob("*.py"):
        assert "ask for" not in module.read_text(encoding="utf-8"), module


def test_what_the_course_does_not_ask_for_decides_nothing(tmp_path):
    drafts = {"integrators.py": "a = 1\n", "integrators (1).py": "a = 2\n"}
    found = write(tmp_path, drafts | {"pymunk_scene.py": "x\n", "more.zip": b"PK broken"})
    package = read_package(found, ["pymunk_scene"])
    assert dict(package.files)["integrators.py"] == b"a = 1\n"
    words = "integrators.py is taken of several integrators; none of them is asked for"
    assert words in package.notes
    with pytest.raises(CannotTake, match="more than one program integrators"):
        read_package(found, ["integrators"])
    with pytest.raises(CannotTake, match=r"nothing of the lab was found \(mini_engine\): it holds"):
        read_package(write(tmp_path / "b", WORK), ["mini_engine"])


def test_canvas_loose_files_of_one_name_are_for_a_person(tmp_path):
    files = {"roebo_7_1_integrators.py": "a", "roebo_7_2_integrators.py": "b"}
    write(tmp_path / "class", files)
    with (
        open_class(tmp_path / "class") as taken,
        pytest.raises(CannotTake, match="more than one"),
    ):
        read_package(taken.found[0])


def test_a_second_of_an_lms_is_known_again(tmp_path):
    write(tmp_path / "class", {"roebo_7_1_integrators-3.py": "a", "roebo_7_2_helper-1.py": ""})
    with open_class(tmp_path / "class") as taken:
        package = read_package(taken.found[0])
    assert names(package) == ["helper.py", "integrators.py"]
    assert package.notes == ["integrators-3.py is taken as integrators.py"]


# ---------------------------------------------------------------- the bank


@pytest.mark.soak
def test_what_deserves_points_is_taken_in_whole(tmp_path):
    """The intake of a right submission of the bank loses no file and has no doubts."""
    for member in bank():
        if member.kind == "right" and member.name.startswith(("copies", "structure", "imports-m")):
            member.build(tmp_path / member.name)
            package = read_package(Work("ann", (tmp_path / member.name,)))
            there = {
                path.relative_to(tmp_path / member.name).as_posix()
                for path in plain_files(tmp_path / member.name)
            }
            assert {name for name, _ in package.files} >= there - backups(there), member.name


def backups(names: set[str]) -> set[str]:
    return {name for name in names if " copy" in name or "Copy" in name}


SHUT_IN = """
import os, socket, sys
sys.path.insert(0, sys.argv[1])
from grader.intake import repack
from grader.worker.confinement import shut_in_reader
source, folder, *programs = sys.argv[2:]
layers = shut_in_reader(source, folder, programs)
def refused(act, *args):
    try:
        act(*args)
    except OSError:
        return True
    return False
assert open(source).read() == "x"
open(os.path.join(folder, "out"), "w").close()
refusals = [refused(open, "/etc/passwd"), refused(open, folder + "-beside", "w")]
if "system-calls" in layers:
    refusals.append(refused(socket.socket))
    refusals.append(refused(os.fork))
print(",".join(layers), all(refusals))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the walls are Linux's")
@pytest.mark.parametrize("programs", [(), ("/usr/bin",)], ids=["alone", "with unpackers"])
def test_who_reads_an_archive_reaches_that_alone(tmp_path, programs):
    (tmp_path / "archive").write_text("x", encoding="utf-8")
    (tmp_path / "folder").mkdir()
    places = [str(KIT), str(tmp_path / "archive"), str(tmp_path / "folder"), *programs]
    done = subprocess.run([sys.executable, "-c", SHUT_IN, *places], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    layers, refused = done.stdout.split()
    if "landlock-files" in layers:
        assert refused == "True"
    assert not (programs and "system-calls" in layers)
