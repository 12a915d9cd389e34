"""Measure what grading costs: a student's wait, a full grade, the layers around it, a class.

All figures are measured in turns, those of another commit too, so that a slow minute of the machine
slows all of them.
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory, mkdtemp
from time import perf_counter, sleep
from typing import Any, NamedTuple

import msgspec
from rich.console import Console
from rich.table import Table

from grader.bank.members import members
from grader.errors import Stop
from grader.judge.grade import KIT

KEPT = KIT / "build" / "bench"  # other commits, unpacked


class Sizes(NamedTuple):
    """Say how much is measured."""

    rounds: int
    graded: int  # submissions in the class that is graded
    shown: int  # results in the class whose pages are made
    proven: bool  # also verify and release


class Used(NamedTuple):
    """Hold what a command took: s on the clock, processor s, and MB of its largest process."""

    seconds: float
    cpu: float
    memory: float


class Tested(NamedTuple):
    """A kit that is measured, and the folder for what it writes."""

    kit: Path
    work: Path

    def start(self, *words: str, cwd: Path | None = None, **how: Any) -> "subprocess.Popen[str]":
        """Start `python -m` with these words, in which `grader` is this kit's."""
        environment = os.environ | {"PYTHONPATH": str(self.kit)}
        usual: dict[str, Any] = {"stdout": subprocess.DEVNULL, "cwd": cwd or self.kit, "text": True}
        return subprocess.Popen([sys.executable, "-m", *words], env=environment, **usual | how)

    def run(self, *words: str, **how: Any) -> Used:
        """Run a command of the grader, which must end well; only Unix tells what it used."""
        start, process = perf_counter(), self.start("grader", *words, **how)
        cpu = memory = 0.0
        if hasattr(os, "wait4"):
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            cpu = used.ru_utime + used.ru_stime
            memory = used.ru_maxrss / (1e6 if sys.platform == "darwin" else 1e3)
        assert process.wait() == 0, words
        return Used(perf_counter() - start, cpu, memory)


def bench(sizes: Sizes, console: Console, against: str = "") -> None:
    """Print the figures of some rounds; those of the commit `against` beside them."""
    kits = {"this kit": KIT} | ({against: unpack_commit(against)} if against else {})
    found: dict[str, dict[str, list[float]]] = {name: {} for name in kits}
    with TemporaryDirectory(prefix="bench-") as temporary, ExitStack() as stack:
        turns: list[tuple[str, Tested, subprocess.Popen[str]]] = []
        for name, kit in kits.items():
            tested = Tested(kit, Path(temporary, str(len(turns))))
            prepare(tested, sizes)
            turns.append((name, tested, stack.enter_context(watch_todo_4(tested))))
        for _ in range(sizes.rounds):
            measured = [measure(each, watch, sizes) for _, each, watch in turns]
            for figures in zip(*measured, strict=True):
                for (name, _, _), (figure, value) in zip(turns, figures, strict=True):
                    found[name].setdefault(figure, []).append(value)
            turns.reverse()
    console.print(tabulate(found, sizes))


def unpack_commit(commit: str) -> Path:
    """Return the folder of a commit's files; it is kept, with what was proven there."""
    try:
        named = run_git("rev-parse", "--verify", "--end-of-options", f"{commit}^{{commit}}")
    except (OSError, subprocess.CalledProcessError) as error:
        raise Stop(f"--against {commit}: there is no such commit in {KIT}") from error
    KEPT.mkdir(parents=True, exist_ok=True)
    if not (KEPT / named).exists():
        with TemporaryDirectory(dir=KEPT) as part:
            run_git("archive", "--output", f"{part}/kit.zip", named)
            shutil.unpack_archive(f"{part}/kit.zip", f"{part}/kit")
            Path(part, "kit").rename(KEPT / named)
    return KEPT / named


def run_git(*words: str) -> str:
    command = ["git", "-C", str(KIT), *words]
    return subprocess.run(command, capture_output=True, check=True, text=True).stdout.strip()


def prepare(tested: Tested, sizes: Sizes) -> None:
    """Lay out a kit's own solution, and a class of this kit's bank, spread over all of it."""
    without = shutil.ignore_patterns("__pycache__")
    shutil.copytree(tested.kit / "solution", tested.work / "tree", ignore=without)
    chosen = [each for each in members(KIT) if each.kind in ("wrong", "right")]
    for number in range(sizes.graded):
        member = chosen[number * len(chosen) // sizes.graded]
        member.build(KIT, tested.work / "class" / f"{number:04}-{member.name}")
    if sizes.proven:
        list(measure_proofs(tested))


def measure(
    tested: Tested, watch: "subprocess.Popen[str]", sizes: Sizes
) -> Iterator[tuple[str, float]]:
    """Measure each figure once."""
    tree = tested.work / "tree"
    yield "check --todo 4, s", tested.run("check", "--todo", "4", cwd=tree).seconds
    yield "check --watch, after a save, s", measure_save(tree, watch)
    full = tested.run("grade", str(tree))
    yield "full grade, s", full.seconds
    yield "full grade, processor s", full.cpu
    yield "full grade on one core, s", tested.run("grade", str(tree), **on_one_core()).seconds
    used, used_inside = grade_solution(tested), grade_solution(tested, "--inside")
    yield "isolation: processor time, divided by that in one process", used / used_inside
    one, _ = grade_class(tested, 1)
    two, first = grade_class(tested, 2)
    yield "a class on one core, s per submission", one / sizes.graded
    yield "a class, two jobs: times as fast as one", one / two
    yield "a class, s until the first result", first
    results = multiply_results(tested, sizes.shown)
    page = tested.run("dashboard", str(results))
    roster = str(results.with_name("roster.csv"))
    marks = tested.run("marks", roster, "--results", str(results), "--out", f"{results}.csv")
    shutil.rmtree(results.parent)
    yield f"{sizes.shown} results: pages and marks, processor s", page.cpu + marks.cpu
    yield f"{sizes.shown} results: pages and marks, MB", max(page.memory, marks.memory)
    yield from measure_proofs(tested) if sizes.proven else ()


def measure_proofs(tested: Tested) -> Iterator[tuple[str, float]]:
    yield "verify, nothing changed, s", tested.run("verify").seconds
    out = str(tested.work / "release")
    yield "release, nothing changed, s", tested.run("release", "--out", out).seconds


def on_one_core() -> dict[str, Any]:
    """Return how to start a command on one core, where the system can be told so."""
    if not hasattr(os, "sched_setaffinity"):
        return {}
    return {"preexec_fn": partial(os.sched_setaffinity, 0, {min(os.sched_getaffinity(0))})}


def grade_class(tested: Tested, jobs: int) -> tuple[float, float]:
    """Grade a class on as many cores; return the seconds in all and until the first result."""
    out = Path(mkdtemp(dir=tested.work), "results")  # in a new folder all are graded again
    words = ["--class", str(tested.work / "class"), "--jobs", str(jobs), "--out", str(out)]
    start = perf_counter()
    process = tested.start("grader", "grade", *words, **(on_one_core() if jobs == 1 else {}))
    while process.poll() is None and not any(out.glob("[!.]*.json")):
        sleep(0.01)
    first = perf_counter() - start
    assert process.wait() == 0, words
    return perf_counter() - start, first


def multiply_results(tested: Tested, count: int) -> Path:
    """Make a class of many results out of those of the class; return their folder."""
    (book, *_) = tested.work.glob("*/results.class.jsonl")
    lines = [msgspec.json.decode(line) for line in book.read_bytes().splitlines()]
    results = Path(mkdtemp(dir=tested.work), "many")
    results.mkdir()
    names = {f"student-{number:05}": lines[number % len(lines)] for number in range(count)}
    for name, line in names.items():
        shutil.copyfile(
            book.with_name("results") / f"{line['name']}.json", results / f"{name}.json"
        )
    rows = b"\n".join(msgspec.json.encode(line | {"name": name}) for name, line in names.items())
    results.with_name("many.class.jsonl").write_bytes(rows)
    results.with_name("roster.csv").write_text("\n".join(["Email address", *names]), "utf-8")
    return results


@contextmanager
def watch_todo_4(tested: Tested) -> Iterator["subprocess.Popen[str]"]:
    """Start a `check --watch` that has shown its first result."""
    words = ["grader", "check", "--todo", "4", "--watch"]
    with tested.start(*words, cwd=tested.work / "tree", stdout=subprocess.PIPE) as process:
        try:
            read_until(process, "Watching")
            yield process
        finally:
            process.terminate()


def read_until(process: "subprocess.Popen[str]", start: str) -> None:
    assert process.stdout is not None
    if not any(line.startswith(start) for line in process.stdout):
        raise RuntimeError(f"check --watch ended before it said: {start}")


def measure_save(tree: Path, watch: "subprocess.Popen[str]") -> float:
    """Save a new comment inside TODO 4; return the seconds until its points are shown."""
    path = tree / "mini_engine" / "solver.py"
    text = path.read_text(encoding="utf-8").replace("    # END TODO 4", "    #\n    # END TODO 4")
    start = perf_counter()
    path.write_text(text, encoding="utf-8")
    read_until(watch, "TODO 4:")
    return perf_counter() - start


def grade_solution(tested: Tested, *options: str) -> float:
    """Grade the solution once; return the processor seconds that took."""
    process = tested.start("grader.bench.one_process", *options, stdout=subprocess.PIPE)
    return float(process.communicate()[0].split()[-1])  # pygame writes a line first


def tabulate(found: dict[str, dict[str, list[float]]], sizes: Sizes) -> Table:
    """Return a row for each figure, with the ratios of the rounds where there are two kits."""
    ours, *others = found
    title = f"{sizes.rounds} rounds, {sizes.graded} in the class: minimum, median, maximum"
    table = Table("figure", *found, *(f"{ours} / {name}" for name in others), title=title)
    for figure, values in found[ours].items():
        pairs = (zip(values, found[name][figure], strict=True) for name in others)
        ratios = [[one / other for one, other in each] for each in pairs]
        table.add_row(figure, *map(write_range, [*(found[n][figure] for n in found), *ratios]))
    return table


def write_range(values: list[float]) -> str:
    return "  ".join(f"{each:.2f}" for each in (min(values), median(values), max(values)))
