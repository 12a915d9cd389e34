"""Grade one submission, from a path to a Result."""

import logging
import os
import tempfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cache, cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

import msgspec

from grader.judge import misconceptions
from grader.judge.blame import Blame, Blamed, Key
from grader.judge.budget import Budget
from grader.judge.children import Child, Worker, start_worker
from grader.judge.course import FULL, Course
from grader.judge.failures import (
    ALIAS,
    IDLE,
    LOOP,
    REBOUND,
    RETURNS,
    SWAPPED,
    TRESPASS,
    UNREAD,
    Broke,
    Failing,
    NotYet,
)
from grader.judge.isolation import Isolation, load_everything
from grader.judge.lab import Lab, Observation
from grader.judge.meaning import (
    NOTHING_SHOWN,
    Evidence,
    Left,
    RegionWords,
    explain,
    is_unexplained,
)
from grader.judge.mending import Mend, find_mend
from grader.judge.names import Names
from grader.judge.passed import PassedPrograms
from grader.judge.reference import Reference
from grader.judge.result import MAX_FILE, CheckResult, Result, TodoResult, Where, state_of
from grader.judge.rubric import Check, Rubric, Todo, load_rubric
from grader.judge.sandbox import Sandbox
from grader.judge.submission import CannotGrade, Submission, handed_out, load_given, take_in
from grader.judge.workplace import work_folder
from grader.protocol import cut
from grader.source.given import Changed, change_of_file, changes, restored
from grader.source.leftovers import (
    find_alias,
    find_dead_end,
    find_idle,
    find_leftover,
    find_loop,
    find_rebound,
    find_return_in_loop,
    find_swapped_sign,
    find_unread,
)
from grader.source.regions import python_files, read_source, shape_of
from grader.text import harmless, listed

if TYPE_CHECKING:
    from grader.judge.loop import CheckLoop

KIT = Path(__file__).parents[2]
T = TypeVar("T")
log = logging.getLogger(__name__)
MEND_SECONDS = 2.5  # of a processor, for one TODO


@dataclass(frozen=True)
class Options:
    """Options of a grade; without any, those of a student's copy, which has no reference.

    `reference`: a complete tree, whose functions stand in for a submission's unfinished ones;
    `shipped_reference()` is the one that `make grade` takes. With None, checks that need an
    unfinished TODO wait for it.
    `course`: what is asked, and for how many points; without one, all that there is.
    `isolation`: "auto" confines as well as this machine can and refuses to grade where files would
    be open, "strict" also where some may be read or the network is open, "none" confines nothing.
    `trusted`: it is one's own work, and graded with what confinement there is.
    `mends`: name the line in which one change makes a failed check pass, which takes seconds; for
    `trusted` work alone.
    `only`: the ids of the TODOs to grade, such as "4" or "7a"; empty for all.
    `seed`: an instructor's secret, for other examples in the property checks than the fixed ones.
    `spawn`: start each child anew, as on platforms without fork. Slower, and the same marks.
    `progress`: told of each check as it ends. What it raises ends the grade.
    `jobs`: how many checks run at a time. It changes no mark.
    `passed`: the programs that have passed and need not run again; for `trusted` work alone.
    """

    reference: Path | None = None
    isolation: Isolation = "auto"
    only: frozenset[str] = frozenset()
    seed: int | None = None
    spawn: bool = False
    progress: Callable[[CheckResult], None] | None = None
    trusted: bool = False
    mends: bool = False
    course: Course = FULL
    passed: PassedPrograms | None = None
    jobs: int = 1

    def wants(self, todo: Todo) -> bool:
        return not self.only or todo.id in self.only


DEFAULT_OPTIONS = Options()


def shipped_reference() -> Path | None:
    """Return the solution beside the grader, where the whole kit is checked out."""
    folder = KIT / "solution"
    return folder if (folder / "mini_engine").is_dir() else None


def grade(
    path: Path | str, options: Options = DEFAULT_OPTIONS, worker: Worker | None = None
) -> Result:
    """Grade the submission at `path`, a folder or a Python file.

    A full grade takes seconds; the same submission and options always give the same marks. What
    cannot be imported or does not end is graded, with the reason. Raises CannotGrade, with a
    sentence that says what to do, when there is nothing to grade or not as the options ask.

    A `worker` that is handed in, from `start_worker`, serves more than one grade and stays open.
    """
    with grading(Path(path), options, worker) as ours:
        return ours.run()


@contextmanager
def grading(
    path: Path, options: Options, worker: Worker | None = None, rubric: Rubric | None = None
) -> Iterator["Grading"]:
    """Set up what it takes to grade the submission at `path`, by another rubric if given."""
    rubric = rubric or options.course.rubric
    reference = Reference(options.reference, load_rubric())
    with work_folder() as work:
        submission = take_in(path, work / "submission", load_rubric(), load_stubs())
        ours = worker or start_worker(options.spawn)
        if options.jobs > 1:
            ours.helpers(options.jobs - 1)  # to load meanwhile
        try:
            sandbox = sandbox_for(submission, work, ours, options)
            yield Grading(options, rubric, reference, submission, sandbox)
        finally:
            if worker is None:
                ours.close()


@contextmanager
def opened(tree: Path) -> Iterator[Callable[[int], Child]]:
    """Yield a way to open children of a tree as it is, without grading it."""
    with work_folder() as work:
        worker = start_worker()
        try:
            taken_in = take_in(tree, work / "tree", load_rubric(), {})
            yield sandbox_for(taken_in, work, worker, Options(trusted=True)).open_child
        finally:
            worker.close()


def sandbox_for(tree: Submission, work: Path, worker: Worker, options: Options) -> Sandbox:
    """Return the sandbox of a tree, out of whose reach the grader and the reference are."""
    hidden = [str(KIT / "grader"), str(options.reference or KIT / "solution")]
    return Sandbox(
        tree.folder,
        work,
        worker,
        options.isolation,
        hidden,
        loads=["numpy"] if tree.uses_numpy else [],
        trusted=options.trusted,
        shown=as_in_reference(tree.folder, options.reference),
    )


def as_in_reference(tree: Path, reference: Path | None) -> list[str]:
    """Return the folders of a tree that hold no program and are just as the reference has them.

    They were handed out to be used. A folder of the student's own, which a program may write to, is
    never among them.
    """
    if reference is None or os.name != "posix":  # Windows may not allow a link
        return []
    programs = {todo.module for todo in load_rubric().todos}
    folders = [each.name for each in sorted(tree.iterdir()) if each.is_dir()]
    return [
        name
        for name in folders
        if name not in programs and has_same_files(tree / name, reference / name)
    ]


def has_same_files(folder: Path, other: Path) -> bool:
    """Return whether a folder holds the same Python files as another, and nothing else."""
    ours = {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file()}
    return ours == {p.relative_to(other): p.read_bytes() for p in python_files(other)}


@cache
def load_stubs() -> dict[str, str]:
    """Return the shapes of the starter's stubs: of each region, and of the function around it."""
    return {name: shape_of(source) for name, source in handed_out().stubs.items()}


@dataclass
class Grading:
    """One run of the checks against one submission."""

    options: Options
    rubric: Rubric
    reference: Reference
    submission: Submission
    sandbox: Sandbox
    observations: dict[str, list[Observation]] = field(default_factory=dict)  # answers, by TODO
    blamed: dict[Key, Blamed] = field(default_factory=dict)  # what fails for changed given code
    surveys_all: bool = False  # ask each check to its end, to have all that it may ask
    failing: dict[Key, Failing] = field(default_factory=dict)  # what a replay shows once more
    left: dict[str, Left] = field(default_factory=dict)  # what TODOs should be without

    def run(self) -> Result:
        if self.options.isolation == "none":
            load_everything()
        # Here for the time it takes, 0.2 s: pytest and hypothesis load while the worker loads.
        from grader.judge.loop import CheckLoop

        budget = Budget()
        loop = CheckLoop(
            self.submission,
            self.rubric,
            self.reference,
            self.sandbox.open_child,
            self.find_unusable(budget),
            self.options.wants,
            self.options.seed,
            self.options.progress,
            observations=self.observations,
            shows_output=self.options.trusted,
            surveys_all=self.surveys_all,
            budget=budget,
            open_right=self.open_right if self.options.reference else None,
            helpers=[each.open_child for each in self.sandbox.beside(self.options.jobs - 1)],
            passed=self.options.passed if self.options.trusted and not self.surveys_all else None,
        )
        loop.run()
        self.failing = loop.failing
        self.put_given_code_back(loop)
        self.left = self.find_what_was_left(loop)
        return self.result(loop)

    def new_lab(self, todo: Todo, check: Check) -> Lab:
        """Return a lab for one check, with the reference in the other TODOs' places."""
        module = check.module or todo.module
        pieces = self.reference.for_the_others(todo, module, self.rubric, self.submission)
        return Lab(module, lambda: self.sandbox.open_child(check.cpu_seconds), pieces)

    def put_given_code_back(self, loop: "CheckLoop") -> None:
        """Ask failed checks with changed given code undone; a TODO's own that pass have passed."""
        failed = {key: loop.results[key] for key in loop.failed}
        if not failed or not (changed := self.changed_given(loop.unusable.values())):
            return
        blame = Blame(changed, self.open_with, loop.again, lambda: bool(loop.budget.cut))
        blame.look_into(failed)
        self.blamed = blame.found
        loop.seen |= blame.seen
        for id in {id for id, _ in blame.seen}:
            answers = [each for key, each in loop.seen.items() if key[0] == id]
            self.observations[id] = [each for some in answers for each in some]
        kept = []
        for key, blamed in blame.found.items():
            check, job = loop.results[key], loop.failed[key]
            if blamed.mended and self.keeps_points(job.todo):
                kept.append(blamed)
                hint = "" if blamed.is_all else self.names.hint(job.todo, job.module, check)
                loop.failing.pop(key, None)
                passed = as_passed(check, f"{blamed.in_words} {hint}".rstrip())
                loop.results[key] = msgspec.structs.replace(passed, where=blamed.place(check))
        costly = [each for each in kept if not each.is_experiment]
        if costly:
            self.charge_whole(loop, costly[0])

    def charge_whole(self, loop: "CheckLoop", blamed: Blamed) -> None:
        """Take a point of the whole for given code that a TODO needs, unless it lost one."""
        whole = {key: check for key, check in loop.results.items() if key[0] == "whole"}
        passed = [key for key, check in whole.items() if check.state == "passed"]
        if not passed or len(passed) < len(whole):
            return
        check = whole[passed[0]]
        loop.results[passed[0]] = msgspec.structs.replace(
            check,
            state="not yet",
            points=0,
            ran="the checks of the TODOs with your own code around them",
            expected="the code around the TODOs as it was handed out",
            got="; ".join(each.how for each in blamed.changes),
            meaning=blamed.in_words,
            where=blamed.place(check),
        )

    def find_what_was_left(self, loop: "CheckLoop") -> dict[str, Left]:
        """Return the TODOs with lines of the stub, or with a return above their own code."""
        keys: dict[str, Key] = {}
        for key, job in loop.failed.items():
            if job.todo.function and key not in self.blamed:
                keys.setdefault(job.todo.id, key)
        found = (
            (id, tried(partial(self.look_at_region, key, loop), None)) for id, key in keys.items()
        )
        return {id: left for id, left in found if left}

    def look_at_region(self, key: Key, loop: "CheckLoop") -> Left | None:
        """Return what a failed check is the better without, which a run without it shows."""
        todo, where = loop.failed[key].todo, self.submission.where.get(key[0])
        if where is None or loop.budget.cut:
            return None
        text = read_source(self.submission.folder / where.file)
        leftover = find_leftover(text, todo.id, handed_out().stubs[todo.id])
        if leftover is not None:
            open_child = self.sandbox.changed({where.file: leftover.without}).open_child
            if loop.again(key, open_child).failure is None:
                return Left(leftover.words, Where(where.file, leftover.line), True)
            if leftover.answers:
                words = leftover.words_of_the_return
                return Left(words, Where(where.file, leftover.last), False, answers=True)
        if idle := find_idle(text, todo.id):
            return Left(IDLE.format(line=idle[0], text=idle[1]), Where(where.file, idle[0]), True)
        dead_end = find_dead_end(text, todo.id, todo.function.partition(":")[2])
        if dead_end is None:
            return None
        return Left(dead_end.words, Where(where.file, dead_end.line), dead_end.is_first)

    @cached_property
    def outside_of_region(self) -> dict[str, str]:
        """Return by TODO which line of its function was changed outside its region, in words."""
        return {each.todo: each.outside for each in self.changed_given(()) if each.outside}

    def read_region(self, todo: Todo) -> RegionWords:
        """Return what the text of a failed TODO shows."""
        where, path = self.submission.where.get(todo.id), todo.function.partition(":")[2]
        if where is None or not path:
            return NOTHING_SHOWN
        text = read_source(self.submission.folder / where.file)
        rebound, loop = find_rebound(text, todo.id, path), find_loop(text, todo.id)
        returns = find_return_in_loop(text, todo.id)
        unread, swapped = find_unread(text, todo.id, path), find_swapped_sign(text, todo.id)
        alias = find_alias(text, todo.id)
        return RegionWords(
            self.outside_of_region.get(todo.id, ""),
            REBOUND.format(line=rebound[0], name=rebound[1]) if rebound else "",
            LOOP.format(line=loop[0], text=loop[1]) if loop else "",
            UNREAD.format(line=unread[0], name=unread[1]) if unread else "",
            SWAPPED.format(line=swapped[0], got=swapped[1], meant=swapped[2]) if swapped else "",
            RETURNS.format(line=returns) if returns else "",
            ALIAS.format(line=alias[0], name=alias[1], value=alias[2]) if alias else "",
        )

    def keeps_points(self, todo: Todo) -> bool:
        """Return whether a TODO is its function's code alone: called as it was handed out."""
        path = todo.function.partition(":")[2]
        return bool(path) and path not in self.names.changed(todo.module)

    def open_right(self, cpu_seconds: int) -> Child:
        """Return a child of the reference itself, to see what should happen."""
        return self.right_sandbox.open_child(cpu_seconds)

    @cached_property
    def right_sandbox(self) -> Sandbox:
        """Return the sandbox of the reference, taken in when it is first needed."""
        folder = self.right_submission.folder
        return sandbox_for(self.right_submission, folder.parent, self.sandbox.worker, self.options)

    @cached_property
    def right_submission(self) -> Submission:
        """Return the reference, taken in like a submission."""
        assert self.options.reference is not None
        work = Path(tempfile.mkdtemp(dir=self.sandbox.work))  # a name that nobody can guess
        return take_in(self.options.reference, work / "tree", self.rubric, {})

    def changed_given(self, unusable: Iterable[Broke | NotYet]) -> list[Changed]:
        """Return what this submission has otherwise than it was handed out.

        A file in which an import fails counts as a whole: code that was added may be the reason.
        Nothing has changed that cannot be compared, such as code nested beyond all measure.
        """
        return tried(partial(self.compare_given, unusable), [])

    def compare_given(self, unusable: Iterable[Broke | NotYet]) -> list[Changed]:
        folder, given = self.submission.folder, load_given()
        own = {n: read_source(folder / n) for n in given if (folder / n).is_file()}
        raised = [each.raised for each in unusable if isinstance(each, Broke) and each.raised]
        fails = {each.frames[-1].file for each in raised if each.frames} & own.keys()
        whole = [c for name in sorted(fails) for c in change_of_file(name, own[name], given[name])]
        kept = {name: text for name, text in own.items() if name not in fails}
        return [*whole, *changes(kept, given)]

    def open_with(self, undone: Sequence[Changed]) -> Callable[[int], Child]:
        """Return a way to open children of the submission with some given code put back."""
        folder, files = self.submission.folder, {each.file for each in undone}
        mine = {name: [each for each in undone if each.file == name] for name in files}
        texts = {name: restored(read_source(folder / name), mine[name]) for name in files}
        return self.sandbox.changed(texts).open_child

    def find_unusable(self, budget: Budget) -> dict[str, Broke | NotYet]:
        """Return the modules that cannot be imported, each tried once instead of in every check."""
        modules = dict.fromkeys(
            check.module or todo.module
            for todo in filter(self.options.wants, self.rubric.todos)
            for check in todo.checks
        )
        unusable: dict[str, Broke | NotYet] = {}
        for module in modules:
            lab = Lab(module, lambda: self.sandbox.open_child(10), [])
            lab.ran(f"import {module}")
            with lab.opened():
                try:
                    lab.probe()
                except (Broke, NotYet) as failure:
                    unusable[module] = failure
            budget.charge(f"import {module}", lab.connection)
        return unusable

    def result(self, loop: "CheckLoop") -> Result:
        """Return the marks, and the reasons of the checks that failed."""
        checks = {
            todo.id: count_guards(todo, self.without_others_mistakes(todo, loop))
            for todo in filter(self.options.wants, self.rubric.todos)
        }
        unfinished = {id for id, some in checks.items() if state_of(some) != "passed"}
        todos = [
            self.todo_result(todo, checks[todo.id], loop, unfinished)
            for todo in self.rubric.todos
            if todo.id in checks
        ]
        nothing = Result(
            schema=1,
            submission=cut(harmless(self.submission.name), MAX_FILE),
            points=0,
            max_points=0,
            bonus=0,
            isolation=self.sandbox.layers,
            todos=[],
        )
        return nothing.with_todos(todos).in_bounds()

    def without_others_mistakes(self, todo: Todo, loop: "CheckLoop") -> list[CheckResult]:
        """Return the results of a TODO; a scene that another TODO spoils counts as the rest does.

        That is where no right version could stand in, as in a program that has another function for
        it or none. Of the whole, checks of a program without such TODOs are the rest.
        """
        results = [loop.results[todo.id, each.id] for each in todo.checks]
        wrong = {id for (id, _) in loop.failed if not self.was_replaced(id)}
        spoilt = [
            sorted(wrong & {*check.runs, *(() if todo.function else check.needs)})
            for check in todo.checks
        ]
        rest = [r for r, ids in zip(results, spoilt, strict=True) if not ids]
        guards = {check.id for check in todo.checks if check.guard}
        if {each.id for each in rest} <= guards or any(r.state != "passed" for r in rest):
            return results  # nothing of its own is right
        return [pass_for_others(*pair) for pair in zip(spoilt, results, strict=True)]

    def todo_result(
        self, todo: Todo, checks: list[CheckResult], loop: "CheckLoop", unfinished: set[str]
    ) -> TodoResult:
        """Return what came of a TODO, when it is known which ones are `unfinished`.

        Its marks are fixed: where no words can be found, it has none.
        """
        points = sum(check.points for check in checks)
        nothing: tuple[list[CheckResult], misconceptions.Mistake | None] = (checks, None)
        told, mistake = tried(partial(self.put_into_words, todo, checks, loop, unfinished), nothing)
        named = mistake.id if mistake is not None else None
        return TodoResult(todo.id, todo.title, state_of(told), points, todo.max_points, named, told)

    def put_into_words(
        self, todo: Todo, checks: list[CheckResult], loop: "CheckLoop", unfinished: set[str]
    ) -> tuple[list[CheckResult], misconceptions.Mistake | None]:
        """Return the checks with what their failures mean, and the mistake that is named."""
        ran = {id for todo_id, id in loop.failed if todo_id == todo.id}
        mistake = None
        if any(check.failed and check.id in ran for check in checks):
            mistake = misconceptions.name_mistake(todo.id, self.observations.get(todo.id, []))
        earlier = self.find_earlier(todo, loop, unfinished)
        checks = [wait_for(earlier[c.id], c) if c.id in earlier else c for c in checks]
        modules = {each.id: each.module or todo.module for each in todo.checks}
        starts = self.submission.starts
        evidence = Evidence(
            todo,
            mistake,
            {c.id: loop.seen.get((todo.id, c.id), []) for c in checks if c.id not in earlier},
            {id: self.own_names(todo, loop.remembered.get((todo.id, id), [])) for id in ran},
            {id: loop.trespasses.get((todo.id, id), "") for id in ran},
            {id: self.blamed[todo.id, id] for id in ran if (todo.id, id) in self.blamed},
            earlier,
            lambda check: self.names.hint(todo, modules[check.id], check),
            {id: starts[module] for id, module in modules.items() if module in starts},
            self.left.get(todo.id),
            self.read_region(todo) if ran else NOTHING_SHOWN,
            self.submission.remarks.get(todo.id, ""),
        )
        rule = TRESPASS.removeprefix("{name}")
        oversteps = any(rule in c.meaning for c in checks)  # then a line that mends is not why
        if self.options.trusted and self.options.mends and not oversteps:
            unexplained = [c.id for c in checks if c.id in ran and is_unexplained(evidence, c)]
            mend = self.find_mend(todo, loop, unexplained) if unexplained else None
            if mend is not None:
                evidence = replace(evidence, mends=dict.fromkeys(unexplained, mend))
        return explain(evidence, checks, ran), mistake

    def find_mend(self, todo: Todo, loop: "CheckLoop", failed: Sequence[str]) -> Mend | None:
        """Return the line of a TODO in which one change makes these checks pass."""
        where, path = self.submission.where.get(todo.id), todo.function.partition(":")[2]
        if where is None or not path:
            return None
        until = loop.budget.words_cpu + MEND_SECONDS
        copy = self.sandbox.changed({})

        def passes(changed: str) -> bool:
            copy.write(where.file, changed)
            return loop.are_mended(todo, failed, copy.open_child)

        return find_mend(
            read_source(self.submission.folder / where.file),
            (where.file, todo.id, path),
            passes,
            lambda: loop.budget.has_more and loop.budget.words_cpu < until,
        )

    def find_earlier(
        self, todo: Todo, loop: "CheckLoop", unfinished: set[str]
    ) -> dict[str, list[str]]:
        """Return, by failed check, the other TODOs whose mistakes show before its own can.

        A check of the whole also waits for what it needs and no right version could stand in for.
        """
        found = {}
        stood_in = {each.id for each in self.rubric.todos if self.was_replaced(each.id)}
        if not todo.function:
            stood_in &= loop.replaceable()
        for check in todo.checks:
            module, key = check.module or todo.module, (todo.id, check.id)
            if key not in loop.failed:
                continue
            others = [
                each.id
                for each in self.rubric.todos
                if each.id in unfinished - {todo.id} and each.module == module and each.function
            ]
            named = loop.elsewhere.get(key)
            if named is not None:
                ids = [id for id in others if id == named] or others
            else:
                ids = [id for id in others if id in check.needs and id not in stood_in]
            if ids:
                found[check.id] = ids
        return found

    def was_replaced(self, todo: str) -> bool:
        """Return whether a right version of a TODO stood in for it."""
        return bool(self.reference.pieces) and todo in self.submission.functions

    def own_names(self, todo: Todo, names: list[str]) -> list[str]:
        """Return which of the names that held something are used by the code of a TODO."""
        if not names or not todo.function:
            return []
        used = self.submission.program.names_used(*todo.function.split(":"))
        return [name for name in names if name.rpartition(".")[2] in used]

    @cached_property
    def names(self) -> Names:
        return Names(self.submission)


def tried(make: Callable[[], T], otherwise: T) -> T:
    """Return what `make` finds in a submission's code, or `otherwise` where it trips over it.

    Only for words and what leads to them: what a submission is worth never hangs on them.
    """
    try:
        return make()
    except CannotGrade:
        raise
    except Exception as error:
        log.warning("no words were found for a failed check: %s", type(error).__name__)
        return otherwise


def count_guards(todo: Todo, checks: list[CheckResult]) -> list[CheckResult]:
    """Give no points for a check that a stub passes as well, unless another one passes too."""
    guards = {check.id for check in todo.checks if check.guard}
    if any(check.state == "passed" and check.id not in guards for check in checks):
        return checks
    return [
        msgspec.structs.replace(
            check, state="waiting", points=0, got="waiting for another check of this TODO to pass"
        )
        if check.state == "passed"
        else check
        for check in checks
    ]


def pass_for_others(wrong: list[str], check: CheckResult) -> CheckResult:
    """Return a check as passed that failed where other TODOs are wrong; as it is if none is."""
    if not wrong or not check.failed:
        return check
    meaning = (
        f"A scene that also runs TODO {', '.join(wrong)}, which is not right yet, cannot be "
        "judged. It counts as passed, because all else here passes."
    )
    return as_passed(check, meaning)


def as_passed(check: CheckResult, meaning: str) -> CheckResult:
    """Return a failed check that counts all the same, with the sentence that says why."""
    return msgspec.structs.replace(
        check, state="passed", points=check.max_points, expected="", got="", meaning=meaning
    )


def wait_for(todos: list[str], check: CheckResult) -> CheckResult:
    """Return a failed check without the words that are about other TODOs, which come first."""
    are = "is" if len(todos) == 1 else "are"
    got = f"your program fails before that: TODO {listed(todos)} {are} not right yet"
    return msgspec.structs.replace(check, expected="", got=got, meaning="")
