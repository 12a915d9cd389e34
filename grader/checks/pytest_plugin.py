"""Run checks as ordinary tests: `pytest grader/checks --submission PATH -k friction`.

For authors of checks: a failure has pytest's traceback into the check, and `--pdb` stops in it.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from grader.judge.drawing import kept_examples
from grader.judge.failures import Broke, NotYet
from grader.judge.grade import Grading, grading
from grader.judge.jobs import load_checks
from grader.judge.rubric import CHECKS, Check, Todo, load_rubric
from grader.judge.task import Options, shipped_reference

GRADING = pytest.StashKey[Grading]()


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("physics-grader")
    group.addoption("--submission", type=Path, help="Run the grader's checks on this submission.")


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.File | None:
    """Collect a file of checks as tests, once a submission is named."""
    wanted = file_path.name == "checks.py" and CHECKS in file_path.parents
    if not wanted or parent.config.getoption("--submission") is None:
        return None
    file: pytest.File = CheckFile.from_parent(parent, path=file_path)
    return file


@pytest.hookimpl(wrapper=True)
def pytest_runtestloop(session: pytest.Session) -> Iterator[None]:
    """Keep one worker and one copy of the submission for all checks of a session."""
    path = session.config.getoption("--submission")
    if path is None:
        return (yield)
    with grading(path, Options(shipped_reference(), trusted=True)) as run:
        session.stash[GRADING] = run
        return (yield)


class CheckFile(pytest.File):
    """The checks of one folder, in the order of the rubric."""

    def collect(self) -> Iterator[pytest.Item]:
        for todo in load_rubric().todos:
            for check in todo.checks if todo.folder == self.path.parent.name else ():
                item = CheckItem.from_parent(self, name=f"{check.id}[{todo.id}]")
                item.todo, item.check = todo, check
                yield item


class CheckItem(pytest.Item):
    """One check, run on the submission with the reference's code in the other TODOs."""

    todo: Todo
    check: Check

    def runtest(self) -> None:
        function: Any = getattr(load_checks(self.todo), self.check.id)
        lab = self.session.stash[GRADING].new_lab(self.todo, self.check)
        with lab.opened(), kept_examples(function, None):
            with lab.settled():
                function(lab=lab)
            if lab.overstepped is not None:
                raise lab.overstepped

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], *args: Any) -> Any:
        """Return the traceback, and above it what ran, what was expected and what came out."""
        failure, words = excinfo.value, [f"TODO {self.todo.id}: {self.check.id}"]
        if isinstance(failure, NotYet | Broke):
            words.append(f"We ran    {failure.ran}")
        if isinstance(failure, NotYet):
            words += [f"Expected  {failure.expected}", f"Got       {failure.got}"]
        return "\n".join([*words, "", str(super().repr_failure(excinfo))])
