"""Test each form of a result: it has the same marks, and no word of a submission changes it."""

import base64
import csv
import io
import json
from pathlib import Path
from typing import Any

import ci_readers
import msgspec
import pytest
from command_line import run_grader

from grader.errors import Stop
from grader.judge.result import CheckResult, Result, State, TodoResult, Where
from grader.report.files import write_json
from grader.report.sinks.classroom50 import write_classroom50
from grader.report.sinks.github import SHOWN, stop_commands, write_annotations, write_outputs
from grader.report.sinks.gradescope import write_gradescope
from grader.report.sinks.junit import write_junit
from grader.report.sinks.markdown import write_markdown
from grader.report.sinks.reporter import write_reporter
from grader.report.sinks.tables import write_csv, write_json_lines
from grader.text import clean

RUNNER = {
    "CLASSROOM": "physics",
    "ASSIGNMENT": "engine",
    "ASSIGNMENT_TYPE": "individual",
    "OWNER": "anna",
    "SUBMISSION_TAG": "submit/2026-10-01T10-00-00Z-0a1b2c3",
    "COMMIT_URL": "https://git.example/commit/0a1b2c3",
    "RELEASE_URL": "https://git.example/releases/1",
    "REVIEW_URL": "https://git.example/compare/1...2",
}
HOSTILE = [
    "::error title=Well done::100 of 100 points",
    "\n::set-output name=points::100",
    "words\r\n::add-mask::1\r\n::stop-commands::mine",
    "words ##[error]100 of 100 points",
    "##[set-output name=points]100",
    "%0A::error::100%0D%25",
    "points=100\nresult<<END\nforged\nEND",
    "]]></failure></testcase><testcase name='all' classname='passed'/>",
    "<!-- --> <script>alert(1)</script> <img src=x onerror=alert(1)>",
    "```\n## 100 of 100 points\n```",
    "~~~\n| 1 | all | passed | 100 / 100 |",
    "**bold** _line_ `code` [link](javascript:alert(1)) ![](https://track.example/a.png)",
    "@everyone see #1 and https://track.example www.track.example",
    "&lt;b&gt; &#60;b&#62; \\<b\\>",
    "\x1b[2J\x1b]0;title\x07 \u202e \u2028 \x00 \ufffe \ud800",
    "a,line=1,title=b::c",
    "long " * 100_000,
    *("=1+1", "+1", "-1*2", "@SUM(A1)", "\uff1d1", "a\r\nb,c"),
]


def check(state: State, words: str = "words", number: int = 1, file: str = "world.py") -> Any:
    return CheckResult(
        id=f"check_{number}",
        title="Loses as much, whatever the step",
        kind="unit",
        state=state,
        points=3 if state == "passed" else 0,
        max_points=3,
        ran=words,
        expected=words,
        got=words,
        meaning=words,
        where=Where(file, 71),
    )


def result(
    words: str = "words", states: tuple[State, ...] = ("passed", "not yet", "error"), todos: int = 1
) -> Result:
    checks = [check(each, words, number, words) for number, each in enumerate(states)]
    points = sum(each.points for each in checks)
    state: State = "passed" if set(states) == {"passed"} else "not yet"
    made = [
        TodoResult(str(n), "Damping per second", state, points, 3 * len(states), None, checks)
        for n in range(todos)
    ]
    most = 3 * len(states) * todos
    return Result(1, words, points * todos, most, 0, ["rlimits", "landlock-files"], made)


EVERY: tuple[State, ...] = ("passed", "not yet", "not started", "waiting", "error")


# ---------------------------------------------------------------- words of a submission


@pytest.fixture(params=HOSTILE, ids=range(len(HOSTILE)))
def words(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def test_github_obeys_no_words(words: str, capfd: Any):
    found = ci_readers.commands_in(write_annotations(result(words, todos=2)))
    assert [(name, set(held)) for name, held, _ in found] == [
        ("error", {"file", "line", "title"})
    ] * 2
    for _, held, message in found:
        assert held["line"] == "71" and held["title"].endswith(": Damping per second")
        assert held["file"] == clean(words)
        assert clean(words) in message
    outputs = ci_readers.outputs_in(write_outputs(result(words)))
    encoded = json.loads(base64.b64decode(outputs.pop("result")))
    assert outputs == {"points": "3", "max-points": "9"}
    assert encoded == json.loads(write_reporter(result(words)))
    with stop_commands({"GITHUB_ACTIONS": "true"}):
        print(words.encode("utf-8", "replace").decode())
    print("::notice::afterwards")
    assert ci_readers.commands_in(capfd.readouterr().out) == [("notice", {}, "afterwards")]
    log = ci_readers.reporter_log(json.loads(write_reporter(result(words, EVERY))))
    assert ci_readers.commands_in(log) == [] and len(log.splitlines()) == len(EVERY)


def test_words_change_no_markdown(words: str):
    plain, forged = (
        ci_readers.markdown_tokens(write_markdown(result(each, EVERY))) for each in ("words", words)
    )
    assert [token.type for token in plain if token.type != "text_special"] == [
        token.type for token in forged if token.type not in ("text_special", "softbreak")
    ]
    fences = [token.content for token in forged if token.type == "fence"]
    assert len(fences) == 2 and all(clean(words) in each for each in fences)
    heading = next(token for token in forged if token.type == "inline")
    assert "".join(each.content for each in heading.children).startswith(clean(words).strip())


def test_words_change_no_other_form(words: str):
    plain, forged = (
        ci_readers.junit_cases(write_junit(result(w, EVERY))) for w in ("words", words)
    )
    assert [[each.tag for each in case.iter()] for case in forged] == [
        [each.tag for each in case.iter()] for case in plain
    ]
    error = forged[-1].find("error")
    assert error is not None and error.attrib["message"] == (clean(words) or "error")
    assert error.text is not None and clean(words) in error.text
    tests = ci_readers.gradescope_tests(json.loads(write_gradescope(result(words, EVERY))))
    assert [test["status"] for test in tests] == ["passed", *["failed"] * 4]
    assert clean(words) in tests[1]["output"] and len(tests[1]["output"]) < 2500
    marks = json.loads(write_classroom50(result(words, EVERY, todos=2), RUNNER))
    assert ci_readers.classroom50_marks(marks) == 6
    assert [test["passed"] for test in marks["tests"]] == [False, False]
    assert words.strip() == "" or clean(words) not in json.dumps(marks)
    rows = read_csv(write_csv([result(words)]))
    assert len(rows) == 3 and all(None not in row for row in rows)
    assert rows[1]["got"].removeprefix("'").replace("'", "") == clean(words).replace("'", "")
    assert not any(cell.startswith(("=", "+", "-", "@")) for row in rows for cell in row.values())
    assert json.loads(write_json_lines([result(words)]).splitlines()[1])["got"] == clean(words)


# ---------------------------------------------------------------- GitHub


def test_an_annotation_says_where_the_line_is_in_the_repository():
    (found,) = ci_readers.commands_in(write_annotations(result("world.py"), inside="week 3/engine"))
    assert found[1]["file"] == "week 3/engine/world.py"


def test_a_todo_is_annotated_once_and_only_if_a_check_failed():
    (found,) = ci_readers.commands_in(
        write_annotations(result(states=("not yet", "error", "waiting")))
    )
    assert "failed as well: 1" in found[2]
    assert write_annotations(result(states=("passed", "not started", "waiting"))) == ""


def test_more_errors_than_github_shows_go_on_as_warnings():
    names = [name for name, _, _ in ci_readers.commands_in(write_annotations(result(todos=14)))]
    assert names == ["error"] * SHOWN + ["warning"] * 4


def test_the_word_that_lets_commands_through_again_cannot_be_known(capfd: Any):
    for _ in range(2):
        with stop_commands({"GITHUB_ACTIONS": "true"}):
            pass
    tokens = [line[2:-2] for line in capfd.readouterr().out.splitlines()[1::2]]
    assert len(set(tokens)) == 2 and all(len(token) >= 32 for token in tokens)


# ---------------------------------------------------------------- the reporter


def test_the_reporter_adds_up_to_the_points():
    encoded = ci_readers.outputs_in(write_outputs(result(states=EVERY, todos=2)))["result"]
    results = ci_readers.read_report(encoded)
    assert sum(test["score"] for test in results["tests"]) == 6
    assert results["max_score"] == 30 and results["status"] == "fail"
    statuses = [test["status"] for test in results["tests"][:5]]
    assert statuses == ["pass", "fail", "fail", "fail", "error"]


@pytest.mark.parametrize(
    ("states", "status"),
    [(("passed",), "pass"), (("passed", "error"), "error"), (("error", "waiting"), "fail")],
)
def test_the_reporter_is_told_how_it_went(states: tuple[State, ...], status: str):
    assert json.loads(write_reporter(result(states=states)))["status"] == status


# ---------------------------------------------------------------- Markdown


def test_the_summary_has_every_todo_with_its_points():
    text = write_markdown(result(states=EVERY, todos=3))
    rows = [line for line in text.splitlines() if line.endswith("| not yet | 3 / 15 |")]
    assert len(rows) == 3 and "9 of 45 points" in text
    assert "Not confined here: network, other processes" in text


def test_the_longest_summary_is_short_enough_for_github():
    longest = write_markdown(result("\U0001f600" * 1000, ("error",) * 8, todos=14))
    assert len(longest.encode("utf-8")) < 1024 * 1024  # a job's summary
    assert len(longest) < 125_000  # a release's text
    told = sum(token.type == "fence" for token in ci_readers.markdown_tokens(longest))
    assert told > 40 and f"Further failed checks: {8 * 14 - told}." in longest


# ---------------------------------------------------------------- the others


def test_junit_names_what_passed_failed_and_did_not_run():
    cases = ci_readers.junit_cases(write_junit(result(states=EVERY)))
    assert [[each.tag for each in case] for case in cases] == [
        *([], ["failure"], ["skipped"], ["skipped"], ["error"])
    ]
    assert cases[0].attrib["classname"] == "TODO 0: Damping per second"


def test_classroom50_needs_its_runner():
    with pytest.raises(Stop, match="SUBMISSION_TAG, COMMIT_URL, RELEASE_URL not set"):
        write_classroom50(result(), {"CLASSROOM": "physics", "ASSIGNMENT": "engine"})


# ---------------------------------------------------------------- tables


def read_csv(content: bytes) -> list[dict[str, str]]:
    text = content.decode("utf-8-sig")
    return list(csv.DictReader(io.StringIO(text, newline="")))


def test_both_tables_have_a_line_per_check():
    made = [result(), result("Zoë")]
    rows = [json.loads(line) for line in write_json_lines(made).splitlines()]
    assert [tuple(row) for row in rows] == [tuple(rows[0])] * 6
    content = write_csv(made)
    assert [{name: str(value) for name, value in row.items()} for row in rows] == read_csv(content)
    assert content.startswith(b"\xef\xbb\xbf")  # as Excel reads it
    assert content.count(b"\r\n") == content.count(b"\n") == 7
    assert rows[1] == {
        "submission": "words",
        "todo": "0",
        "check": "check_1",
        "kind": "unit",
        "state": "not yet",
        "points": 0,
        "max_points": 3,
        "misconception": "",
        "expected": "words",
        "got": "words",
        "where": "words:71",
    }


# ---------------------------------------------------------------- the command


def test_export_makes_tables_of_a_whole_folder(tmp_path: Path):
    for name in ("ann", "ben"):
        write_json(result(name), tmp_path / f"{name}.json")
    out = tmp_path / "all.csv"
    done = run_grader("export", "csv", tmp_path, "--out", out)
    assert done.exit_code == 0, done.output
    assert {row["submission"] for row in read_csv(out.read_bytes())} == {"ann", "ben"}


def test_export_writes_what_it_prints(tmp_path: Path):
    write_json(result(states=EVERY), tmp_path / "ann.json")
    printed = run_grader("export", "junit", tmp_path / "ann.json")
    assert printed.exit_code == 0, printed.stderr
    assert len(ci_readers.junit_cases(printed.stdout.encode())) == len(EVERY)
    done = run_grader("export", "junit", tmp_path / "ann.json", "--out", tmp_path / "new/junit.xml")
    assert done.exit_code == 0 and done.stdout == ""
    assert (tmp_path / "new" / "junit.xml").read_text(encoding="utf-8") == printed.stdout


def test_export_of_what_is_no_result_ends_with_a_sentence(tmp_path: Path):
    (tmp_path / "ann.json").write_bytes(msgspec.json.encode({"points": 100}))
    done = run_grader("export", "markdown", tmp_path / "ann.json")
    assert done.exit_code == 2
    assert "is no result of the grader" in " ".join(done.stderr.split())


def test_a_file_is_written_in_the_place_of_a_link_and_not_through_it(tmp_path: Path):
    (tmp_path / "precious").write_text("as it was")
    (tmp_path / "marks.json").symlink_to(tmp_path / "precious")
    write_json(result(), tmp_path / "marks.json")
    assert (tmp_path / "precious").read_text() == "as it was"
    assert not (tmp_path / "marks.json").is_symlink()
    assert {path.name for path in tmp_path.iterdir()} == {"precious", "marks.json"}


def test_a_folder_is_many_results_and_only_tables_take_many(tmp_path: Path):
    done = run_grader("export", "junit", tmp_path)
    assert done.exit_code == 2 and done.stdout == ""
    said = " ".join(done.stderr.split())
    assert f"{tmp_path} is a folder, and junit takes one result; csv and jsonl take many" in said
