"""Write the JSON that the action classroom-resources/autograding-grading-reporter takes."""

import msgspec

from grader.judge.result import CheckResult, Result, State, TodoResult
from grader.judge.wording import add_task
from grader.text import clean

STATUS: dict[State, str] = {"passed": "pass", "error": "error"}  # everything else: fail


def write_reporter(result: Result) -> bytes:
    """Return one test per check, without bonus tasks: the action adds up all points."""
    tests = [make_test(todo, check) for todo in result.main_todos for check in todo.checks]
    statuses = {each["status"] for each in tests}
    status = next((each for each in ("fail", "error") if each in statuses), "pass")
    return msgspec.json.encode(
        {"version": 1, "status": status, "max_score": result.max_points, "tests": tests}
    )


def make_test(todo: TodoResult, check: CheckResult) -> dict[str, object]:
    """Return a test whose name and message cannot act as commands in a job's log."""
    name = add_task(todo, check.title)
    why = escape_commands(f"{name}: {check.got or check.state}")
    return {
        "name": name,
        "status": STATUS.get(check.state, "fail"),
        "score": check.points,
        "message": "" if check.state == "passed" else why,
        "test_code": "",
        "filename": escape_commands(check.where.file) if check.where else "",
        "line_no": check.where.line if check.where else 0,
        "duration": 0,
    }


def escape_commands(words: str) -> str:
    """Return one line without the marks of a workflow command, `::` and `##[`."""
    return clean(words).replace("##[", "## [").replace("::", ": :")
