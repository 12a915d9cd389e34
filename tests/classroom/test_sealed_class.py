"""Test a class in which some submissions attack the judge: the others' results do not change."""

import json
import shutil
import sys
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from rich.console import Console

from grader.bank.members import list_attacks
from grader.classroom import dashboard, similarity
from grader.classroom.dashboard import read_class, write_dashboard
from grader.classroom.grading import ClassOptions, run_class
from grader.classroom.similarity import Prints, find_pairs
from grader.errors import Stop
from grader.intake import archives, listing
from grader.judge.task import KIT, Options, shipped_reference
from grader.judge.wall.outer import Allowance, Exceeded

pytestmark = pytest.mark.skipif(
    sys.platform != "linux", reason="forks are watched where the system tells of all processes"
)
QUIET = Console(quiet=True)
SEED = 1 << 127  # as long as the sheets that a class draws
ONLY_8A = Options(shipped_reference(), only=frozenset({"8a"}), seed=SEED)
LITTLE = Allowance("reading it", cpu=0.3)
GREEK = "\u0390" * 80  # each is three letters in NFKD: an honest name's worst case
SAME = "".join(f"a = {'+'.join('x' * (n % 97 + 2))}\n" for n in range(1200))


def loop() -> int:
    while True:
        pass


# ---------------------------------------------------------------- a class of twelve


def define_without_end(folder: Path) -> None:
    """Write a class that is its own base in two ways, in a branch that never runs."""
    lines = ["def step():", "    pass", "if False:"]
    lines += [f"    class A{n}(A{n - 1}.a, A{n - 1}.b): pass" for n in range(1, 4000)]
    write(folder, "\n".join([*lines, "    class A0(A3999.a, A3999.b): pass", ""]))


def nest_deeply(folder: Path) -> None:
    write(folder, "x = " + "(" * 60_000 + ")" * 60_000 + "\n")


def pack_many_entries(folder: Path) -> None:
    folder.mkdir()
    with zipfile.ZipFile(folder / "work.zip", "w") as archive:
        for number in range(60_000):
            archive.writestr(f"f{number}", b"")


def write_long_tokens(folder: Path) -> None:
    write(folder, f"{' ' * 8000}$ ? {'x' * 8000}\n" * 7)


def write_formulas(folder: Path) -> None:
    formula = "$" + "\\frac{" * 2000 + "x" + "}{y}" * 2000 + "$\n"
    cells = [{"cell_type": "markdown", "metadata": {}, "source": formula * 20}] * 10
    notebook = {"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
    write(folder, json.dumps(notebook), "integrators.ipynb")


def link_out(folder: Path) -> None:
    folder.mkdir()
    (folder / "integrators.py").symlink_to("/etc/passwd")


def film_without_end(folder: Path) -> None:
    write(folder, "def __getattr__(name):\n    return lambda *_: [[0.0] * 10**5] * 10**4\n" + SAME)


def answer_by_the_megabyte(folder: Path) -> None:
    found = {each.name: each for each in list_attacks()}
    found["answers-by-the-megabyte"].build(folder)


def resemble_everything(folder: Path) -> None:
    write(folder, SAME)


def write(folder: Path, text: str, name: str = "integrators.py") -> None:
    folder.mkdir()
    (folder / name).write_text(text, encoding="utf-8")


NINE: dict[str, Callable[[Path], None]] = {
    "defines": define_without_end,
    "nests": nest_deeply,
    "packs": pack_many_entries,
    "spaces": write_long_tokens,
    "formulas": write_formulas,
    "links": link_out,
    "films": film_without_end,
    "answers": answer_by_the_megabyte,
    "resembles": resemble_everything,
}


def write_honest(folder: Path) -> None:
    for name, tree in (("anna", "solution"), ("ben", "starter"), (GREEK, "solution")):
        (folder / name).mkdir(parents=True)
        shutil.copy(KIT / tree / "integrators.py", folder / name)


@pytest.mark.soak
def test_nine_attacks_leave_the_others_as_they_are(tmp_path: Path):
    write_honest(tmp_path / "quiet")
    write_honest(tmp_path / "loud")
    for name, attack in NINE.items():
        attack(tmp_path / "loud" / name)
    runs = [
        run_class(tmp_path / name, ClassOptions(ONLY_8A, jobs=1), QUIET)
        for name in ("quiet", "loud")
    ]
    quiet, loud = (run.book for run in runs)
    honest = [each.name for each in runs[0].outcomes]
    assert len(honest) == 3 and len(runs[1].outcomes) == 12
    for name in honest:
        assert loud.locate_result(name).read_bytes() == quiet.locate_result(name).read_bytes()
        assert (loud.folder / f"{name}.html").is_file()
    earned = {each.name: each.points for each in runs[1].outcomes if each.name in NINE}
    assert not any(earned.values()), earned


# ---------------------------------------------------------------- each part by itself


def test_an_export_that_cannot_be_listed_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    write_honest(tmp_path / "class")
    monkeypatch.setattr(listing, "LISTING", LITTLE)
    monkeypatch.setattr(listing.ANY_OTHER, "read_export", lambda *_: iter([loop()]), raising=False)
    with pytest.raises(Stop, match="class: needs manual review: reading it takes more"):
        list(listing.open_class(tmp_path / "class").__enter__().found)


def test_an_odd_name_needs_review_and_the_others_are_listed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    write_honest(tmp_path / "class")
    (tmp_path / "class" / "odd").mkdir()
    monkeypatch.setattr(listing, "LISTING", LITTLE)
    monkeypatch.setattr(listing, "NAMING", replace(LITTLE, what="reading its name"))
    monkeypatch.setattr(
        listing.SYSTEMS[0], "match", lambda at: loop() if at.name == "odd" else None
    )
    with listing.open_class(tmp_path / "class") as intake:
        assert len(intake.found) == 3
    reason = "its name cannot be read: needs manual review: reading its name takes more"
    assert intake.troubles["odd"].startswith(reason)


def test_a_class_that_unpacks_without_end_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    with zipfile.ZipFile(tmp_path / "class.zip", "w") as archive:
        archive.writestr("anna/integrators.py", "x = 1\n")
    monkeypatch.setattr(listing, "UNPACKING", LITTLE)
    monkeypatch.setattr(archives, "write_member", lambda *_: loop())
    with (
        pytest.raises(Stop, match="zip: needs manual review: reading it takes more"),
        listing.open_class(tmp_path / "class.zip"),
    ):
        pass


@pytest.mark.soak
def test_a_page_that_cannot_be_made_says_so_and_the_others_are_made(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    write_honest(tmp_path / "class")
    book = run_class(tmp_path / "class", ClassOptions(ONLY_8A, jobs=1), QUIET).book
    write_entry = dashboard.write_entry

    def write_or_loop(entry: dashboard.Entry, course: object) -> None:
        write_entry(entry, dashboard.FULL)
        if entry.outcome.name == "ben":
            loop()

    before = (book.folder / "anna.html").read_bytes()
    monkeypatch.setattr(dashboard, "WRITING", replace(LITTLE, cpu=1.0, what="writing its page"))
    monkeypatch.setattr(dashboard, "write_entry", write_or_loop)
    write_dashboard(book.folder, read_class(book.folder))
    assert (book.folder / "anna.html").read_bytes() == before
    words = "needs manual review: writing its page takes more than 1 s of processor time"
    assert words in (book.folder / "ben.html").read_text(encoding="utf-8")


@pytest.mark.soak
def test_a_class_that_cannot_be_compared_is_graded_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    write_honest(tmp_path / "class")
    monkeypatch.setattr(similarity, "COMPARING", replace(LITTLE, what="comparing the class"))
    monkeypatch.setattr(similarity, "compare_all", lambda *_: loop())
    with pytest.raises(Exceeded, match="comparing the class takes more"):
        find_pairs([Prints("anna", frozenset())])
    run = run_class(tmp_path / "class", ClassOptions(ONLY_8A, jobs=1), QUIET)
    assert run.counts["graded"] == 3
    assert any(each.startswith("similar pairs: needs manual review") for each in run.notes)
