"""Find the reasons of the checks that failed: collect the evidence, and word it.

All points are final by then. A submission's code may be anything, so if the search fails, the
results have no reasons.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property, partial

from msgspec import structs

from grader.judge.explain import misconceptions
from grader.judge.explain.blame import GivenCause, find_changes
from grader.judge.explain.meaning import BadLine, Evidence, Failure, explain, is_unexplained
from grader.judge.explain.misconceptions import Mistake
from grader.judge.explain.one_change import Mend, find_mend
from grader.judge.failures import REMEMBERS, TRESPASS
from grader.judge.jobs import Key
from grader.judge.lab import Observation
from grader.judge.loop import CheckLoop
from grader.judge.result import CheckResult, Where
from grader.judge.rubric import Todo
from grader.judge.running import Outcome
from grader.judge.submission import attempt, handed_out
from grader.judge.task import Task
from grader.source.given import GivenChange
from grader.source.regions import read_source
from grader.source.suspects import (
    RegionCode,
    Suspect,
    find_dead_end,
    find_idle,
    find_leftover,
    find_suspects,
)
from grader.text import join_words

MEND_SECONDS = 2.5  # of processor time, for one TODO


class Reasons:
    """The reasons of all failed checks of one grade."""

    def __init__(self, grading: Task, loop: CheckLoop, causes: Mapping[Key, GivenCause]) -> None:
        self.grading, self.loop, self.causes = grading, loop, causes
        self.submission = grading.submission
        self.bad_lines = self._find_bad_lines()

    # ------------------------------------------------------------ the code of a TODO

    def _read_region(self, todo: Todo) -> RegionCode | None:
        where = self.submission.where.get(todo.id)
        if where is None or not todo.path:
            return None
        return RegionCode(read_source(self.submission.folder / where.file), todo.id, todo.path)

    def _find_bad_lines(self) -> dict[str, BadLine]:
        """Return by TODO a leftover line of the stub, or a line above code that never runs."""
        first: dict[str, Outcome] = {}
        for key, outcome in self.loop.failed.items():
            if outcome.job.todo.function and key not in self.causes:
                first.setdefault(outcome.job.todo.id, outcome)
        found = ((id, attempt(partial(self._look_at, each), None)) for id, each in first.items())
        return {id: line for id, line in found if line}

    def _look_at(self, outcome: Outcome) -> BadLine | None:
        """Return a line to remove; for a leftover, a run without it shows whether that helps."""
        todo = outcome.job.todo
        code = None if self.loop.budget.cut else self._read_region(todo)
        if code is None:
            return None
        file = self.submission.where[todo.id].file
        leftover = find_leftover(code, handed_out().stubs[todo.id])
        if leftover is not None:
            changed = self.grading.sandbox.changed({file: leftover.without})
            if self.loop.runner.run_again(outcome.job, changed.open_child).failure is None:
                return BadLine(leftover.words, Where(file, leftover.line), True)
            if leftover.is_only_return:
                return BadLine(leftover.last.words, Where(file, leftover.last.line), False, True)
        if idle := find_idle(code):
            return BadLine(idle.words, Where(file, idle.line), True)
        if dead_end := find_dead_end(code):
            is_first = dead_end.line == code.first_line
            return BadLine(dead_end.words, Where(file, dead_end.line), is_first)
        return None

    @cached_property
    def outside(self) -> dict[str, Suspect]:
        """Return by TODO the line of its function changed outside the region."""
        found = attempt(lambda: find_changes(self.submission), list[GivenChange]())
        return {each.todo: Suspect(each.line, each.outside) for each in found if each.outside}

    def _find_suspects(self, todo: Todo) -> Mapping[str, Suspect]:
        """Return the lines that look wrong in the text of a failed TODO."""
        code = self._read_region(todo)
        if code is None:
            return {}
        outside = {"outside": self.outside[todo.id]} if todo.id in self.outside else {}
        return {**outside, **find_suspects(code)}

    # ------------------------------------------------------------ words

    def word(
        self, todo: Todo, checks: list[CheckResult], unfinished: set[str]
    ) -> tuple[list[CheckResult], Mistake | None]:
        """Return the checks of a TODO with the meaning of each failure, and the mistake's name.

        `unfinished`: the TODOs that have not passed.
        """
        outcomes = {key[1]: each for key, each in self.loop.failed.items() if key[0] == todo.id}
        mistake = None
        if any(check.failed and check.id in outcomes for check in checks):
            mistake = misconceptions.name_mistake(todo.id, self.loop.list_observations(todo.id))
        earlier = self._find_earlier(todo, outcomes, unfinished)
        checks = [wait_for(earlier[c.id], c) if c.id in earlier else c for c in checks]
        answers = {} if any(check.meaning == REMEMBERS for check in checks) else self._answers(todo)
        evidence = Evidence(
            todo,
            mistake,
            [each for id, some in answers.items() if id not in earlier for each in some],
            self.bad_lines.get(todo.id),
            self._find_suspects(todo) if outcomes else {},
            self.submission.remarks.get(todo.id, ""),
        )
        failures = {
            check.id: self._make_failure(
                check, outcomes[check.id], evidence, earlier.get(check.id, []), answers
            )
            for check in checks
            if check.failed and check.id in outcomes
        }
        failures = self._add_mends(todo, failures, checks)
        return [explain(failures[c.id]) if c.id in failures else c for c in checks], mistake

    def _answers(self, todo: Todo) -> dict[str, Sequence[Observation]]:
        return {each.job.check.id: each.answers for each in self.loop.list_outcomes(todo.id)}

    def _make_failure(
        self,
        check: CheckResult,
        outcome: Outcome,
        evidence: Evidence,
        earlier: Sequence[str],
        answers: Mapping[str, Sequence[Observation]],
    ) -> Failure:
        job, lab = outcome.job, outcome.lab
        return Failure(
            check,
            evidence,
            [] if earlier else answers.get(check.id, []),
            self._own_names(job.todo, lab.remembers) if lab else [],
            lab.trespass if lab else "",
            self.causes.get(job.key),
            earlier,
            self.submission.starts.get(job.module),
            lambda: self.grading.names.hint(job.todo, job.module, check),
        )

    def _own_names(self, todo: Todo, names: list[str]) -> list[str]:
        """Return those of these `names` with kept values that a TODO's code uses."""
        if not names or not todo.function:
            return []
        used = self.submission.program.names_used(*todo.function.split(":"))
        return [name for name in names if name.rpartition(".")[2] in used]

    def _find_earlier(
        self, todo: Todo, outcomes: Mapping[str, Outcome], unfinished: set[str]
    ) -> dict[str, list[str]]:
        """Return, by failed check, the other TODOs whose mistakes make it fail first.

        A check of the whole also waits for TODOs that it needs and that no right version could
        replace.
        """
        found = {}
        todos = self.grading.rubric.todos
        replaced = {each.id for each in todos if self.grading.was_replaced(each.id)}
        if not todo.function:
            replaced &= self.loop.replaceable
        for id, outcome in outcomes.items():
            others = [
                each.id
                for each in todos
                if each.id in unfinished - {todo.id}
                and each.module == outcome.job.module
                and each.function
            ]
            if outcome.fails_in is not None:
                ids = [each for each in others if each == outcome.fails_in] or others
            else:
                needs = outcome.job.check.needs
                ids = [each for each in others if each in needs and each not in replaced]
            if ids and outcome.result.failed:
                found[id] = ids
        return found

    # ------------------------------------------------------------ the line that one change mends

    def _add_mends(
        self, todo: Todo, failures: dict[str, Failure], checks: Sequence[CheckResult]
    ) -> dict[str, Failure]:
        """Add the line in which one change makes the unexplained checks pass, if it is found."""
        options = self.grading.options
        rule = TRESPASS.removeprefix("{name}")
        # A forbidden change needs no other reason.
        oversteps = any(rule in check.meaning for check in checks)
        if not options.trusted or not options.mends or oversteps:
            return failures
        unexplained = [id for id, each in failures.items() if is_unexplained(each)]
        mend = self._find_mend(todo, unexplained) if unexplained else None
        return {
            id: replace(each, mend=mend) if id in unexplained else each
            for id, each in failures.items()
        }

    def _find_mend(self, todo: Todo, failed: Sequence[str]) -> Mend | None:
        """Return the line of a TODO in which one change makes these checks pass."""
        where = self.submission.where.get(todo.id)
        if where is None or not todo.path:
            return None
        budget = self.loop.budget
        until = budget.words_cpu + MEND_SECONDS
        copy = self.grading.sandbox.changed({})
        outcomes = self.loop.list_outcomes(todo.id)

        def passes(changed: str) -> bool:
            copy.write(where.file, changed)
            return self.loop.runner.do_pass(outcomes, failed, copy.open_child)

        return find_mend(
            read_source(self.submission.folder / where.file),
            (where.file, todo.id, todo.path),
            passes,
            lambda: budget.has_more and budget.words_cpu < until,
        )


def wait_for(todos: list[str], check: CheckResult) -> CheckResult:
    """Return a failed check that waits for other TODOs, whose mistakes come first."""
    are = "is" if len(todos) == 1 else "are"
    got = f"your program fails before that: TODO {join_words(todos)} {are} not right yet"
    return structs.replace(check, expected="", got=got, meaning="")
