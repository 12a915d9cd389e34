"""Write Gradescope's results.json."""

import msgspec

from grader.judge.course import FULL, Course
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.wording import add_task, format_reasons, points_in_words
from grader.text import clean

SHOWN = {"output_format": "text", "visibility": "visible"}  # to the student


def write_gradescope(result: Result, course: Course = FULL) -> bytes:
    """Return a visible test per check; one hidden test would hide the student's total.

    The score includes the bonus only if the course adds it; the output names the bonus.
    """
    score: float = result.points + course.count_bonus(result.bonus, result.points)
    output = points_in_words(result)
    if course.out_of is not None and course.out_of != result.max_points:
        score = round(score * course.out_of / result.max_points, 2)
        output += f": {score:g} of {course.out_of:g}"
    results = {
        "score": score,
        "output": output,
        "test_output_format": "text",
        **SHOWN,
        "stdout_visibility": "hidden",
        "tests": [
            make_test(todo, check, number)
            for todo in result.todos_to_show
            for number, check in enumerate(todo.checks, 1)
        ],
        "extra_data": {
            "schema": result.schema,
            "submission": clean(result.submission),
            "bonus": result.bonus,
            "isolation": result.isolation,
        },
    }
    return msgspec.json.format(msgspec.json.encode(results))


def make_test(todo: TodoResult, check: CheckResult, number: int) -> dict[str, object]:
    """Return a test; a bonus has points in its name, so that sums are right."""
    name = add_task(todo, check.title)
    points: dict[str, object] = {"score": check.points, "max_score": check.max_points}
    if todo.bonus:
        name, points = f"{name} (bonus: {check.points} of {check.max_points})", {}
    return {
        "name": name,
        **points,
        "status": "passed" if check.state == "passed" else "failed",
        "number": f"{todo.id}.{number}",
        "output": "\n".join(format_reasons(check)) if check.state != "passed" else "",
        "tags": [f"todo-{todo.id}", check.kind, check.state.replace(" ", "-")],
        **SHOWN,
    }
