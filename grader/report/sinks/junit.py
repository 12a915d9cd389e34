"""Write JUnit XML, which GitLab, Jenkins and others show as a list of tests."""

from xml.etree import ElementTree as ET

from grader.judge.result import CheckResult, Result, State, TodoResult
from grader.judge.wording import add_task, format_reasons
from grader.text import clean, plural

TAGS: dict[State, str] = {
    "not yet": "failure",
    "error": "error",
    "not started": "skipped",
    "waiting": "skipped",
}


def write_junit(result: Result) -> bytes:
    """Return a suite per TODO and a case per check, in the form of the schema junit-10."""
    root = ET.Element("testsuites", name=clean(result.submission))
    add_counts(root, result.todos_to_show)
    for todo in result.todos_to_show:
        suite = ET.SubElement(root, "testsuite", name=add_task(todo, todo.title))
        add_counts(suite, [todo])
        suite.set("skipped", str(count([todo], "skipped")))
        for check in todo.checks:
            add_case(suite, check)
    ET.indent(root)
    text = ET.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'.encode()


def add_counts(element: ET.Element, todos: list[TodoResult]) -> None:
    element.set("tests", str(sum(len(todo.checks) for todo in todos)))
    element.set("failures", str(count(todos, "failure")))
    element.set("errors", str(count(todos, "error")))


def count(todos: list[TodoResult], tag: str) -> int:
    return sum(TAGS.get(check.state) == tag for todo in todos for check in todo.checks)


def add_case(suite: ET.Element, check: CheckResult) -> None:
    """Add a check, with the same name in every run; GitLab shows the class name."""
    case = ET.SubElement(suite, "testcase", classname=suite.attrib["name"])
    case.set("name", f"{check.title} ({plural(check.max_points, 'point')})")
    if tag := TAGS.get(check.state):
        element = ET.SubElement(case, tag, message=clean(check.got) or check.state)
        if tag != "skipped":
            element.text = "\n".join(format_reasons(check))
