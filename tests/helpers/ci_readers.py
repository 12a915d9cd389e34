"""Read the grader's output as other systems do, each by its own rules."""

import base64
import json
import re
from typing import Any
from xml.etree import ElementTree as ET

from markdown_it import MarkdownIt

COMMANDS = {
    *("add-mask", "add-matcher", "add-path", "debug", "echo", "endgroup", "error", "group"),
    *("notice", "remove-matcher", "save-state", "set-env", "set-output", "stop-commands"),
    "warning",
}

Command = tuple[str, dict[str, str], str]  # its name, its properties, its message


def commands_in(log: str) -> list[Command]:
    """List the commands of a log for GitHub's runner: `::name p=v::message`, and `##[name]`
    anywhere."""
    known, token, found = set(COMMANDS), "", []
    for line in re.split(r"\r\n|\r|\n", log):
        modern = re.match(r"\s*::(?P<info>.*?)::(?P<data>.*)", line)
        old = re.search(r"##\[(?P<info>[^\]]*)\](?P<data>.*)", line)
        for match in filter(None, (modern, old)):
            name, _, properties = match["info"].partition(" ")
            if name.lower() not in known:
                continue
            if token:
                token, known = ("", known - {token}) if name == token else (token, known)
            elif name.lower() == "stop-commands":
                token = match["data"]
                known.add(token)
            else:
                pairs = (each.partition("=") for each in properties.split(",") if "=" in each)
                held = {key.strip(): unescaped(value) for key, _, value in pairs}
                found.append((name, held, unescaped(match["data"])))
            break
    assert not token, "commands were stopped and never went on"
    return found


def unescaped(words: str) -> str:
    for code, character in (("%0D", "\r"), ("%0A", "\n"), ("%3A", ":"), ("%2C", ",")):
        words = words.replace(code, character)
    return words.replace("%25", "%")


def outputs_in(text: str) -> dict[str, str]:
    """Return the outputs of a step: `name=value` lines, or `name<<END` with lines up to END."""
    found, lines = {}, iter(text.splitlines())
    for line in lines:
        if "=" in line.partition("<<")[0]:
            name, _, found[name] = line.partition("=")
        else:
            name, mark, end = line.partition("<<")
            assert mark, f"the runner stops at {line!r}"
            found[name] = "\n".join(iter(lambda: next(lines), end))
    return found


def read_report(encoded: str) -> dict[str, Any]:
    """Return the reporter's input from an output, in the form that it requires."""
    results = json.loads(base64.b64decode(encoded, validate=True))
    assert results["version"] == 1 and results["status"] in ("pass", "fail", "error")
    assert type(results["max_score"]) is int and results["tests"]
    for test in results["tests"]:
        assert test["status"] in ("pass", "fail", "error")
        assert type(test["score"]) is int and type(test["line_no"]) is int
    return dict(results)


def reporter_log(results: dict[str, Any]) -> str:
    """Return the reporter's text in the log of its job."""
    lines = []
    for test in results["tests"]:
        line = f" - line {test['line_no']}" if test["line_no"] else ""
        if test["status"] == "error":
            lines.append(f"Error: {test['message'] or test['name']}")
        else:
            lines.append(f"\x1b[32m{test['status']} {test['name']}{line}\x1b[0m")
        if test["test_code"]:
            lines.append(f"Test code:\n{test['test_code']}")
    return "\n".join(lines)


def junit_cases(content: bytes) -> list[ET.Element]:
    """Return the test cases of a file in the schema junit-10 of Jenkins' xunit plugin."""
    root = ET.fromstring(content)
    allowed = {
        "testsuites": ({"name", "time", "tests", "failures", "errors"}, {"testsuite"}),
        "testsuite": (
            {"name", "tests", "failures", "errors", "skipped", "time", "timestamp", "hostname"},
            {"testcase", "properties", "system-out", "system-err"},
        ),
        "testcase": (
            {"name", "time", "classname", "group"},
            {"skipped", "error", "failure", "system-out", "system-err"},
        ),
        **dict.fromkeys(("skipped", "error", "failure"), ({"type", "message"}, set())),
    }
    assert root.tag == "testsuites"
    for element in root.iter():
        attributes, children = allowed[element.tag]
        assert set(element.attrib) <= attributes and {each.tag for each in element} <= children
    for group in (root, *root.iter("testsuite")):
        cases = list(group.iter("testcase"))
        assert int(group.attrib["tests"]) == len(cases)
        assert int(group.attrib["failures"]) == len(list(group.iter("failure")))
        assert int(group.attrib["errors"]) == len(list(group.iter("error")))
    return list(root.iter("testcase"))


def markdown_tokens(text: str) -> list[Any]:
    """Parse a text as GitHub's Markdown."""
    blocks = MarkdownIt("commonmark", {"html": True}).enable(["table", "strikethrough"]).parse(text)
    return [token for block in blocks for token in (block, *(block.children or ()))]


def classroom50_marks(marks: dict[str, Any]) -> int:
    """Return the score of a result.json that keeps the rules of classroom50/result/v1."""
    needed = {
        *("schema", "classroom", "assignment", "assignment_type", "owner", "submission"),
        *("commit", "release", "review", "datetime", "score", "max-score", "tests"),
    }
    assert set(marks) - {"graded_at", "submitted_by"} == needed
    assert marks["schema"] == "classroom50/result/v1"
    assert marks["assignment_type"] in ("individual", "group", "team")
    assert marks["submission"].startswith("submit/")
    for name in ("classroom", "assignment", "owner", "commit", "release", "review"):
        assert isinstance(marks[name], str) and marks[name]
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", marks["datetime"])
    for each in (marks, *marks["tests"]):
        assert type(each["score"]) is int and type(each["max-score"]) is int
        assert 0 <= each["score"] <= each["max-score"]
    for test in marks["tests"]:
        assert isinstance(test["test-name"], str) and test["test-name"]
        assert type(test["passed"]) is bool
    assert sum(test["score"] for test in marks["tests"]) == marks["score"]
    assert sum(test["max-score"] for test in marks["tests"]) == marks["max-score"]
    return int(marks["score"])


def gradescope_tests(results: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the tests of a results.json that keeps Gradescope's rules and shows a total."""
    formats = ("text", "html", "simple_format", "md", "ansi")
    assert results["output_format"] in formats and results["test_output_format"] in formats
    assert results["visibility"] == "visible"
    for test in results["tests"]:
        assert test["visibility"] == "visible", "one hidden test hides the total"
        assert test["status"] in ("passed", "failed") and test["output_format"] in formats
        bonus = test["number"].startswith("B")  # in words, so that the others add up
        assert bonus or (type(test["score"]) is int and type(test["max_score"]) is int)
        assert all(isinstance(each, str) for each in (test["name"], test["number"], *test["tags"]))
    assert results["score"] == sum(test.get("score", 0) for test in results["tests"])
    return list(results["tests"])
