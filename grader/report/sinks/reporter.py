"""The JSON that the action classroom-resources/autograding-grading-reporter takes from a step."""

import msgspec

from grader.judge.result import CheckResult, Result, State, TodoResult
from grader.judge.wording import named
from grader.text import clean

STATUS: dict[State, str] = {"passed": "pass", "error": "error"}  # everything else: fail


def reporter(result: Result) -> bytes:
    """One test per check; the points of the tests add up to those of the result.

    Those of bonus tasks are left out: it adds up whatever it gets.
    """
    tests = [test(todo, check) for todo in result.counted for check in todo.checks]
    statuses = {each["status"] for each in tests}
    status = next((each for each in ("fail", "error") if each in statuses), "pass")
    return msgspec.json.encode(
        {"version": 1, "status": status, "max_score": result.max_points, "tests": tests}
    )


def test(todo: TodoResult, check: CheckResult) -> dict[str, object]:
    """It prints names and messages into the log of the job, where they must not be commands."""
    name = named(todo, check.title)
    why = no_command(f"{name}: {check.got or check.state}")
    return {
        "name": name,
        "status": STATUS.get(check.state, "fail"),
        "score": check.points,
        "message": "" if check.state == "passed" else why,
        "test_code": "",
        "filename": no_command(check.where.file) if check.where else "",
        "line_no": check.where.line if check.where else 0,
        "duration": 0,
    }


def no_command(words: str) -> str:
    """One line without the marks of a workflow command, `::` at its start or `##[` anywhere."""
    return clean(words).replace("##[", "## [").replace("::", ": :")
