"""Tables of results, and marks of a graded class for an LMS."""

import csv
import io
import json
from pathlib import Path

import pytest
from command_line import run_grader, run_in_class
from page_readers import HOSTILE

from grader.classroom.book import Book, Outcome, make_outcome
from grader.judge.result import CheckResult, Result, TodoResult, Where
from grader.report.files import as_json, write_json
from grader.report.sinks.tables import write_csv, write_json_lines
from grader.text import clean


def result(name: str = "ann", words: str = 'w, "x"; y') -> Result:
    where = Where("world.py", 7)
    checks = [
        CheckResult("falls", "Falls", "unit", "passed", 3, 3),
        CheckResult("turns", "Turns", "scene", "not yet", 0, 4, words, words, words, where=where),
    ]
    todo = TodoResult("1", "Touch", "not yet", 3, 7, "half-for-full", checks)
    bonus = TodoResult("B1", "Sleep", "passed", 2, 2, None, checks[:1])
    return Result(1, name, 3, 7, 2, ["processes"], [todo, bonus])


def read_csv(content: bytes) -> list[dict[str, str]]:
    text = content.decode("utf-8-sig")
    return list(csv.DictReader(io.StringIO(text, newline="")))


# ---------------------------------------------------------------- tables


def test_both_tables_say_the_same_a_line_per_check():
    made = [result(), result("ben")]
    rows = [json.loads(line) for line in write_json_lines(made).splitlines()]
    assert [tuple(row) for row in rows] == [tuple(rows[0])] * 6
    assert [{name: str(value) for name, value in row.items()} for row in rows] == read_csv(
        write_csv(made)
    )
    assert rows[1] == {
        "submission": "ann",
        "todo": "1",
        "check": "turns",
        "kind": "scene",
        "state": "not yet",
        "points": 0,
        "max_points": 4,
        "misconception": "half-for-full",
        "expected": 'w, "x"; y',
        "got": 'w, "x"; y',
        "where": "world.py:7",
    }


def test_the_csv_is_as_excel_wants_it():
    content = write_csv([result("Zoë")])
    assert content.startswith(b"\xef\xbb\xbf")
    assert content.count(b"\r\n") == content.count(b"\n") == 4


@pytest.mark.parametrize("words", ["=1+1", "+1", "-1", "@SUM(A1)", "\uff1d1", HOSTILE, "a\r\nb,c"])
def test_no_word_breaks_a_table_or_is_a_formula(words: str):
    made = result(words, words)
    rows = read_csv(write_csv([made]))
    assert len(rows) == 3 and all(None not in row for row in rows)
    assert rows[1]["got"].removeprefix("'") == clean(words)
    assert not any(cell.startswith(("=", "+", "-", "@")) for row in rows for cell in row.values())
    assert json.loads(write_json_lines([made]).splitlines()[1])["got"] == clean(words)


def test_export_makes_tables_of_a_whole_folder(tmp_path: Path):
    for name in ("ann", "ben"):
        write_json(result(name), tmp_path / f"{name}.json")
    out = tmp_path / "all.csv"
    done = run_grader("export", "csv", tmp_path, "--out", out)
    assert done.exit_code == 0, done.output
    assert {row["submission"] for row in read_csv(out.read_bytes())} == {"ann", "ben"}
    assert run_grader("export", "junit", tmp_path).exit_code == 2


# ---------------------------------------------------------------- marks for an LMS

MOODLE = """\
First name,Last name,ID number,Email address
Zoë,Müller,s-17,zoe@school.example
Ben,O'Brien,s-18,ben@school.example
Eve,Roe,s-19,eve@school.example
"""


@pytest.fixture
def graded(tmp_path: Path) -> Path:
    """Zoe is late, Ben's could not be read, Eve handed in nothing."""
    with Book(tmp_path / "out") as book:
        content = as_json(result("zoe"))
        zoe = make_outcome("zoe", content, 1.0, "")
        book.write(zoe, content)
        reasons, final = ["1 day late: -1"], zoe.points - 1
        late = Outcome("zoe", "", 3, 7, zoe.todos, zoe.left, final, reasons, True)
        book.finish([late, Outcome("ben", "=no zip")])
    return tmp_path


def marks(graded: Path, roster: str, *options: str) -> tuple[list[dict[str, str]], str]:
    (graded / "class.csv").write_text(roster, encoding="utf-8")
    done = run_in_class(graded, "marks", *options, roster="class.csv", results="out")
    assert done.exit_code in (0, 1), done.output
    return read_csv((graded / "marks.csv").read_bytes()), done.output


def test_moodle_gets_the_reason_as_feedback(graded: Path):
    (zoe, ben, _), said = marks(graded, MOODLE)
    assert "eve@school.example: nothing handed in" in said and "2 of 3 marks" in said
    assert zoe["Feedback"] == "engine 2 / 7 (1 day late: -1)"
    assert (ben["Grade"], ben["Feedback"]) == ("", "engine not graded (=no zip)")
    assert marks(graded, MOODLE, "--so-far")[0][1]["Grade"] == "0.0"
