"""Grade the same six checks by this kit and by four other graders, in turns in one run.

    .venv/bin/python tests/benchmarks/other_graders/compare.py VENV

VENV holds the others, from the requirements.txt beside this file. Every grader takes the class
as its documentation says for one machine, one submission after the other, on one core.
"""

import contextlib
import ctypes
import json
import os
import resource
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, NamedTuple

import attacks
import typer
from rich.console import Console
from rich.table import Table

from grader.judge.task import KIT

HERE = Path(__file__).parent
CHECKS = (HERE / "checks.py").read_text(encoding="utf-8")
ASKED = [
    'want_steps("semi_implicit_euler", semi_implicit_euler)',
    "want_spring(semi_implicit_euler, 1, 1.878, -2.38)",
    'want_steps("velocity_verlet", velocity_verlet)',
    "want_spring(velocity_verlet, 2, 0.665, -0.01)",
    'want_steps("rk4", rk4)',
    "want_spring(rk4, 4, 0.018, -0.03)",
]
POINTS = len(ASKED)
PR_SET_CHILD_SUBREAPER = 36  # of Linux, see prctl(2)
LIMIT = 60.0  # s for a submission; a grader that takes longer is stopped

Class = dict[str, str]  # submission of each student
Points = dict[str, float]  # points of each student; missing ones could not be graded


class Grader(NamedTuple):
    """A grader: functions to lay out a class and read the points, and the command to run."""

    name: str
    prepare: Callable[[Path, Class], list[str]]
    points: Callable[[Path], Points]


class Run(NamedTuple):
    """One class graded."""

    seconds: float
    cpu: float  # s of processor time
    points: Points
    stopped: bool  # by us, after LIMIT


class Cost(NamedTuple):
    """The processor time of a class of one, which shows the start's cost, and of a larger one."""

    alone: list[float]
    whole: list[float]

    def one_more(self, more: int) -> list[float]:
        """Return the cost of one submission more in each round."""
        return [(whole - one) / more for one, whole in zip(self.alone, self.whole, strict=True)]


# ---------------------------------------------------------------- this kit


def prepare_kit(folder: Path, handed_in: Class) -> list[str]:
    for student, program in handed_in.items():
        (folder / "class" / student).mkdir(parents=True)
        (folder / "class" / student / "integrators.py").write_text(program, encoding="utf-8")
    todos = [word for todo in ("8a", "8b", "8c") for word in ("--todo", todo)]
    grade = [sys.executable, "-m", "grader", "grade", "--class", str(folder / "class")]
    return [*grade, "--out", str(folder / "out"), "--jobs", "1", *todos]


def points_of_kit(folder: Path) -> Points:
    results = [json.loads(path.read_bytes()) for path in (folder / "out").glob("*.json")]
    return {each["submission"]: each["points"] for each in results}


# ---------------------------------------------------------------- notebooks


def code_cell(number: int, text: str, **metadata: Any) -> dict[str, Any]:
    cell = {"cell_type": "code", "id": f"cell-{number}", "metadata": metadata, "source": text}
    return cell | {"outputs": [], "execution_count": None}


def notebook(cells: list[dict[str, Any]]) -> str:
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    about = {"metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(about | {"cells": cells})


# ---------------------------------------------------------------- nbgrader


def make_metadata(name: str, **of: Any) -> dict[str, Any]:
    """Return the metadata by which nbgrader knows a cell."""
    usual = {"grade": False, "locked": False, "solution": False, "task": False}
    return {"nbgrader": usual | {"schema_version": 3, "grade_id": name} | of}


def prepare_nbgrader(folder: Path, handed_in: Class) -> list[str]:
    (folder / "nbgrader_config.py").write_text(
        f"c = get_config()\nc.CourseDirectory.root = {str(folder)!r}\n", encoding="utf-8"
    )
    cells = [
        code_cell(0, "### BEGIN SOLUTION\n### END SOLUTION", **make_metadata("work", solution=True))
    ]
    for number, asked in enumerate(ASKED, 1):
        text = asked if number > 1 else f"{CHECKS}\n{asked}"
        hidden = f"# A test\n### BEGIN HIDDEN TESTS\n{text}\n### END HIDDEN TESTS"
        about = make_metadata(f"test-{number}", grade=True, locked=True, points=1)
        cells.append(code_cell(number, hidden, **about))
    (folder / "source" / "ps1").mkdir(parents=True)
    (folder / "source" / "ps1" / "ps1.ipynb").write_text(notebook(cells), encoding="utf-8")
    generate = ["nbgrader", "generate_assignment", "ps1"]
    subprocess.run(generate, cwd=folder, check=True, capture_output=True)
    released = json.loads((folder / "release" / "ps1" / "ps1.ipynb").read_bytes())
    for student, program in handed_in.items():
        released["cells"][0]["source"] = program
        place = folder / "submitted" / student / "ps1"
        place.mkdir(parents=True)
        (place / "ps1.ipynb").write_text(json.dumps(released), encoding="utf-8")
    return ["nbgrader", "autograde", "ps1"]


def points_of_nbgrader(folder: Path) -> Points:
    """Return the points in its gradebook of the graded notebooks."""
    ask = (
        "import json; from nbgrader.api import Gradebook\n"
        "with Gradebook('sqlite:///gradebook.db') as book:\n"
        "    each = book.assignment_submissions('ps1')\n"
        "    print(json.dumps({one.student.id: one.score for one in each}))"
    )
    told = subprocess.run(["python", "-c", ask], cwd=folder, capture_output=True, check=True)
    graded = {path.parts[-3] for path in folder.glob("autograded/*/ps1/ps1.ipynb")}
    return {name: points for name, points in json.loads(told.stdout).items() if name in graded}


# ---------------------------------------------------------------- otter-grader

OTTER_TEST = """\
from otter.test_files import test_case

OK_FORMAT = False
name = "q{number}"
points = 1

{checks}

@test_case()
def asked(env):
    globals().update({{name: env[name] for name in env if name in {names}}})
    {asked}
"""
NAMES = ("semi_implicit_euler", "velocity_verlet", "rk4")

# In one process, so that it is loaded once, as in the other two.
OTTER_GRADES = """
import json, sys
from pathlib import Path
from otter.api import grade_submission
for path in sorted(Path("class").glob("*.ipynb")):
    try:
        points = grade_submission(str(path), "autograder.zip", quiet=True).total
    except Exception as error:
        print(path.stem, type(error).__name__, error, file=sys.stderr)
        continue
    with open("points.jsonl", "a") as file:
        file.write(json.dumps([path.stem, points]) + "\\n")
"""


def prepare_otter(folder: Path, handed_in: Class) -> list[str]:
    for name in ("tests", "class"):
        (folder / name).mkdir()
    for number, asked in enumerate(ASKED, 1):
        text = OTTER_TEST.format(number=number, checks=CHECKS, names=NAMES, asked=asked)
        (folder / "tests" / f"q{number}.py").write_text(text, encoding="utf-8")
    generate = ["otter", "generate", "--no-requirements", "--no-environment", "-t", "tests"]
    subprocess.run(generate, cwd=folder, check=True, capture_output=True)
    for student, program in handed_in.items():
        path = folder / "class" / f"{student}.ipynb"
        path.write_text(notebook([code_cell(0, program)]), encoding="utf-8")
    return ["python", "-c", OTTER_GRADES]


def points_of_otter(folder: Path) -> Points:
    path = folder / "points.jsonl"
    return dict(map(json.loads, path.read_text().splitlines())) if path.exists() else {}


# ---------------------------------------------------------------- gradescope-utils, check50


def lay_out_files(folder: Path, handed_in: Class) -> None:
    """Write a folder for each student, with a file in it."""
    for student, program in handed_in.items():
        place = folder / "class" / student
        place.mkdir(parents=True)
        (place / "integrators.py").write_text(program, encoding="utf-8")


# Both start a process for each submission, in its folder.
ONE_AFTER_THE_OTHER = """
import subprocess, sys
from pathlib import Path
for place in sorted(Path("class").iterdir()):
    subprocess.run(sys.argv[1:], cwd=place)
"""

UNITTEST = """\
import unittest
from gradescope_utils.autograder_utils.decorators import weight
from gradescope_utils.autograder_utils.json_test_runner import JSONTestRunner

{checks}

class TestIntegrators(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        import sys
        sys.path.insert(0, ".")
        import integrators
        globals().update({{name: getattr(integrators, name) for name in {names}}})
{tests}

with open("results.json", "w") as file:
    JSONTestRunner(visibility="visible", stream=file).run(
        unittest.defaultTestLoader.loadTestsFromTestCase(TestIntegrators)
    )
"""
TEST = """
    @weight(1)
    def test_{number}(self):
        {asked}
"""


def prepare_gradescope(folder: Path, handed_in: Class) -> list[str]:
    lay_out_files(folder, handed_in)
    tests = "".join(TEST.format(number=n, asked=asked) for n, asked in enumerate(ASKED, 1))
    program = UNITTEST.format(checks=CHECKS, names=NAMES, tests=tests)
    (folder / "run_tests.py").write_text(program, encoding="utf-8")
    return ["python", "-c", ONE_AFTER_THE_OTHER, "python", str(folder / "run_tests.py")]


def points_of_gradescope(folder: Path) -> Points:
    points = {}
    for path in folder.glob("class/*/results.json"):
        if text := path.read_text():  # empty, where the process ended early
            points[path.parent.name] = sum(each["score"] for each in json.loads(text)["tests"])
    return points


CHECK = '''
@check50.check()
def check_{number}():
    """Check {number}"""
    module = check50.py.import_("integrators.py")
    globals().update({{name: getattr(module, name) for name in {names}}})
    {asked}
'''


def prepare_check50(folder: Path, handed_in: Class) -> list[str]:
    lay_out_files(folder, handed_in)
    checks = "".join(
        CHECK.format(number=n, names=NAMES, asked=asked) for n, asked in enumerate(ASKED, 1)
    )
    (folder / "checks").mkdir()
    text = f"import check50\nimport check50.py\n\n{CHECKS}\n{checks}"
    (folder / "checks" / "__init__.py").write_text(text, encoding="utf-8")
    (folder / "checks" / ".cs50.yml").write_text("check50:\n  files: []\n", encoding="utf-8")
    check = ["check50", "--dev", "--output", "json", "--output-file", "results.json"]
    return ["python", "-c", ONE_AFTER_THE_OTHER, *check, str(folder / "checks")]


def points_of_check50(folder: Path) -> Points:
    points = {}
    for path in folder.glob("class/*/results.json"):
        results = json.loads(path.read_bytes()).get("results", [])
        points[path.parent.name] = float(sum(each["passed"] is True for each in results))
    return points


# ---------------------------------------------------------------- measuring


def run(grader: Grader, handed_in: Class) -> Run:
    with tempfile.TemporaryDirectory(prefix="compared-") as temporary:
        folder = Path(temporary)
        folder.chmod(0o755)
        command = grader.prepare(folder, handed_in)
        cwd = KIT if grader.name == "this kit" else folder
        before, start = read_processor_time(), time.monotonic()
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        process = subprocess.Popen(command, cwd=cwd, start_new_session=True, **quiet)
        try:
            process.wait(LIMIT * len(handed_in))
            stopped = False
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            stopped = True
        cpu = read_processor_time() - before
        return Run(time.monotonic() - start, cpu, grader.points(folder), stopped)


def adopt_orphans() -> None:
    """Count processes too whose parent ended first: they become children of this one."""
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def read_processor_time() -> float:
    """Return the processor time of all that was started and that has ended, s."""
    time.sleep(0.1)  # for processes that are being killed
    with contextlib.suppress(ChildProcessError):
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def right_program() -> str:
    """Return the solution's three functions; the rest of its file would not run in a notebook."""
    text = (KIT / "solution" / "integrators.py").read_text(encoding="utf-8")
    return text[text.index("def semi_implicit_euler") : text.index("def spring")]


def measure_costs(graders: list[Grader], size: int, rounds: int) -> dict[str, Cost]:
    """Run every grader once in each round, so that a slow minute slows all of them."""
    costs = {each.name: Cost([], []) for each in graders}
    for number in range(rounds):
        turn = number % len(graders)
        for grader in graders[turn:] + graders[:turn]:
            costs[grader.name].alone.append(grade_right(grader, 1).cpu)
            costs[grader.name].whole.append(grade_right(grader, size).cpu)
    return costs


def grade_right(grader: Grader, size: int) -> Run:
    """Grade a class of right submissions, no two the same."""
    handed_in = {f"student-{n:02}": f"# {n}\n{right_program()}" for n in range(size)}
    done = run(grader, handed_in)
    if done.points != dict.fromkeys(handed_in, POINTS):
        raise SystemExit(f"{grader.name} does not give right submissions their points: {done}")
    return done


def attack(grader: Grader, instructor: Path) -> dict[str, Run]:
    """Grade a class of two for each attack: the hostile one, and its neighbour."""
    answers = instructor / "answers.py"
    tried = {
        "ends the process": attacks.ENDS,
        "never ends": attacks.NEVER_ENDS,
        "takes the answers from memory": attacks.TAKES_ANSWERS,
        "forges its points": attacks.FORGES[grader.name],
        "reads and writes the instructor's files": attacks.READS_FILES.format(answers=str(answers)),
    }
    runs = {}
    for name, text in tried.items():
        answers.write_text(right_program(), encoding="utf-8")
        runs[name] = run(grader, {"hostile": text, "neighbour": right_program()})
    return runs


# ---------------------------------------------------------------- telling


def make_cost_table(costs: dict[str, Cost], size: int) -> Table:
    """Show the median of the rounds, and its ratio to this kit's in the same rounds."""
    title = f"{POINTS} checks on one core, one submission after the other: s of processor time"
    table = Table("", *costs, title=title)
    rows = {
        "one submission more": [cost.one_more(size - 1) for cost in costs.values()],
        "a class of one": [cost.alone for cost in costs.values()],
        f"a class of {size}": [cost.whole for cost in costs.values()],
    }
    for words, each in rows.items():
        table.add_row(words, *(compare(values, each[0]) for values in each))
    return table


def compare(values: list[float], ours: list[float]) -> str:
    """Return a median, with the median and the range of the rounds' ratios."""
    times = [one / other for one, other in zip(values, ours, strict=True)]
    spread = f"{statistics.median(times):.1f} times, {min(times):.1f} to {max(times):.1f}"
    return f"{statistics.median(values):.3g} ({spread})"


def make_outcome_table(runs: dict[str, dict[str, Run]]) -> Table:
    """Return the hostile submission's points and time, and whether the next one got its own
    points."""
    table = Table("a submission that", *runs, title=f"points of {POINTS}; it deserves 0")
    for name in next(iter(runs.values())):
        table.add_row(name, *[describe(each[name]) for each in runs.values()])
    return table


def describe(one: Run) -> str:
    points = one.points.get("hostile")
    words = [f"{points:g} points" if points is not None else "no points"]
    if one.points.get("neighbour") != POINTS:
        words.append("the next one not graded")
    ended = "stopped by us" if one.stopped else "ended"
    return ", ".join([*words, f"{ended} after {one.seconds:.0f} s"])


def main(
    venv: Annotated[Path, typer.Argument(help="Where the others are installed.")],
    size: Annotated[int, typer.Option(help="Submissions in the class.")] = 10,
    rounds: Annotated[int, typer.Option(help="How often each grader takes it.")] = 3,
) -> None:
    """Compare cost and safety of five graders on the same six checks."""
    os.environ["PATH"] = f"{venv.absolute() / 'bin'}{os.pathsep}{os.environ['PATH']}"
    graders = [
        Grader("this kit", prepare_kit, points_of_kit),
        Grader("nbgrader", prepare_nbgrader, points_of_nbgrader),
        Grader("otter-grader", prepare_otter, points_of_otter),
        Grader("check50", prepare_check50, points_of_check50),
        Grader("gradescope-utils", prepare_gradescope, points_of_gradescope),
    ]
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})  # also for started processes
    adopt_orphans()
    console = Console()
    console.print(make_cost_table(measure_costs(graders, size, rounds), size))
    with tempfile.TemporaryDirectory(prefix="instructor-") as temporary:
        Path(temporary).chmod(0o755)
        console.print(
            make_outcome_table({each.name: attack(each, Path(temporary)) for each in graders})
        )


if __name__ == "__main__":
    app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
    app.command()(main)
    app()
