"""Make shared fixtures: student files, changed copies of a tree, and results."""

import gc
import os
import pickle
import shutil
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

import msgspec
import pytest
from hypothesis import HealthCheck, settings
from page_readers import chromium

from grader.bank.sync import list_students_files
from grader.bank.verify import shared_worker
from grader.judge.course import FULL
from grader.judge.grade import grade, open_tree
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.rubric import Rubric, load_rubric
from grader.judge.task import Options, shipped_reference
from grader.player import replay
from grader.questions.program import open_program
from grader.release import practice
from grader.release.leaks import Secret, find_secrets
from grader.release.pages import write_pages
from grader.report.files import write_json

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
for name in ("MAKELEVEL", "MAKEFLAGS", "MFLAGS"):
    os.environ.pop(name, None)  # students do not run below `make test`
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)  # otherwise each command compiles the kit again
sys.dont_write_bytecode = False

settings.register_profile(  # enough for a busy machine
    "any machine", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("any machine")

KIT = Path(__file__).parents[1]
os.environ["COURSE_FILE"] = str(KIT / "tests" / "full.toml")

HandIn = Callable[..., Path]
Once = Callable[[str, Callable[[Path], object]], Path]
Part = TypeVar("Part", TodoResult, CheckResult)
RECORDED = {"1", "5", "8b"}  # TODOs whose right runs are recorded
FEW_CASES = 3  # of each question for practice
LONGEST = 1800  # s that a process waits for another one's result


def pytest_configure() -> None:
    """Switch off garbage collection: test collection makes no garbage, and it takes a third of the
    time."""
    gc.disable()


def pytest_collection_finish() -> None:
    gc.freeze()
    gc.enable()


@pytest.fixture(scope="session")
def handed_out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Make a student's folder with no work: the starter and the added files."""
    folder = tmp_path_factory.mktemp("handed-out")
    for name, path in list_students_files(KIT).items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, folder / name)
    return folder


@pytest.fixture
def hand_in(tmp_path: Path) -> HandIn:
    """Make a submission: a tree (or nothing), with files added or, given None, removed."""

    def make(base: str | None = None, **files: str | None) -> Path:
        folder = tmp_path / "handed-in"
        if base:
            shutil.copytree(
                KIT / base, folder, ignore=shutil.ignore_patterns("__pycache__", "build")
            )
        else:
            folder.mkdir()
        for name, text in files.items():
            path = folder / name.replace("__", "/").replace("_py", ".py")
            if text is None:
                path.unlink()
            else:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
        return folder

    return make


@pytest.fixture(scope="session")
def once(tmp_path_factory: pytest.TempPathFactory) -> Once:
    """Fill a folder once, by one of the test processes, for all of them."""
    top = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        top = top.parent

    def filled(name: str, fill: Callable[[Path], object]) -> Path:
        folder, ended = top / name, top / f"{name}-ended"
        try:
            folder.mkdir()
        except FileExistsError:
            wait_for(ended)
        else:
            try:
                fill(folder)
            except BaseException as error:
                ended.with_suffix(".part").write_text(f"{type(error).__name__}: {error}")
                raise
            else:
                ended.with_suffix(".part").touch()
            finally:
                ended.with_suffix(".part").replace(ended)
        assert ended.read_text() == "", f"another process could not make {name}"
        return folder

    return filled


def wait_for(path: Path) -> None:
    for _ in range(LONGEST * 10):
        if path.exists():
            return
        time.sleep(0.1)
    pytest.fail(f"{path} does not come")


@pytest.fixture(scope="session")
def handout_pages(once: Once) -> Path:
    """Write the pages of the handouts as students get them, including those about engines."""

    def fill(folder: Path) -> None:
        write_pages(KIT / "handouts", folder, FULL)
        write_pages(KIT / "handouts", folder, FULL, measured=True)

    return once("pages", fill)


@pytest.fixture(scope="session")
def secrets(once: Once) -> list[Secret]:
    """Find the statements that no release may contain."""

    def fill(folder: Path) -> None:
        (folder / "secrets").write_bytes(pickle.dumps(find_secrets(KIT)))

    found: list[Secret] = pickle.loads((once("secrets", fill) / "secrets").read_bytes())
    return found


@pytest.fixture(scope="session")
def solution(starter: Result) -> Result:
    """Return the solution's expected result, made from the starter's without grading.

    `make verify` and `solution_graded` check that the solution really gets it.
    """

    def with_full_marks(part: Part) -> Part:
        return msgspec.structs.replace(part, state="passed", points=part.max_points)

    todos = [
        msgspec.structs.replace(with_full_marks(todo), checks=[*map(with_full_marks, todo.checks)])
        for todo in starter.todos
    ]
    return msgspec.structs.replace(starter.with_todos(todos), submission="solution")


@pytest.fixture(scope="session")
def solution_graded(once: Once) -> Callable[[tuple[str, ...]], Result]:
    """Grade the solution with the reference, on some TODOs or, given none, on all."""
    return lambda todos: result_of("solution", once, todos)


@pytest.fixture(scope="session")
def starter(once: Once) -> Result:
    return result_of("starter", once)


@pytest.fixture(scope="session")
def expected_runs(once: Once) -> bytes:
    """Record the solution's runs of some TODOs, for students' copies of the grader.

    They are those of a contact, the damping and an integrator, which tests use.
    """

    def fill(folder: Path) -> None:
        with open_tree(KIT / "solution") as open_child:
            runs = replay.record_expected(open_child, only_some(load_rubric()))
        (folder / "expected_runs.json").write_bytes(runs)

    return (once("expected-runs", fill) / "expected_runs.json").read_bytes()


@pytest.fixture(scope="session")
def practice_file(once: Once, solution: Result) -> bytes:
    """Make a release's practice file, with fewer cases."""

    def fill(folder: Path) -> None:
        with pytest.MonkeyPatch.context() as patch:
            opened_with = partial(open_program, worker=shared_worker(), result=solution)
            patch.setattr(practice, "open_program", opened_with)
            patch.setattr(practice, "EACH", FEW_CASES)
            (folder / "practice.json").write_bytes(practice.make_practice(FULL))

    return (once("practice", fill) / "practice.json").read_bytes()


def only_some(rubric: Rubric) -> Rubric:
    """Return the rubric with the TODOs whose expected runs are recorded."""
    return Rubric([todo for todo in rubric.todos if todo.id in RECORDED])


def result_of(tree: str, once: Once, todos: tuple[str, ...] = ()) -> Result:
    def fill(folder: Path) -> None:
        options = Options(shipped_reference(), only=frozenset(todos))
        write_json(grade(KIT / tree, options, shared_worker()), folder / "result.json")

    folder = once("-".join(("graded", tree, *todos)), fill)
    return msgspec.json.decode((folder / "result.json").read_bytes(), type=Result)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Open a browser, if this machine has one."""
    with chromium() as browser:
        yield browser
