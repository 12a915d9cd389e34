"""Test the command line as people and scripts use it."""

import json
import os
import shutil
import subprocess
import sys
import sysconfig
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import typer
from command_line import run_grader, start_grader

from grader.cli import dev, grade, main
from grader.cli import shared as commands
from grader.judge.rubric import load_rubric
from grader.judge.task import KIT


def unwrapped(words: str) -> str:
    return " ".join(words.split())


@pytest.mark.parametrize("todos", [["8a"], pytest.param([], marks=pytest.mark.soak)])
def test_full_marks_end_with_status_0(todos: list[str]):
    points = sum(t.max_points for t in load_rubric().main_todos if not todos or t.id in todos)
    done = start_grader("grade", "solution", *(f"--todo={todo}" for todo in todos))
    assert done.returncode == 0 and f"solution: {points} / {points}" in done.stdout


def test_less_than_full_marks_end_with_status_1(tmp_path: Path):
    target = tmp_path / "marks.json"
    words = ["--todo", "8a", "--jobs", "2", "--json", target]
    assert run_grader("grade", KIT / "starter", *words).exit_code == 1
    assert json.loads(target.read_text(encoding="utf-8"))["points"] == 0


def list_loaded(*arguments: str) -> set[str]:
    """Return the modules that a command loads."""
    code = (
        "import sys; sys.argv[0] = 'grader'; import grader.cli.main as cli\n"
        "try: cli.main()\n"
        "finally: print(*sys.modules, file=sys.stderr)"
    )
    command = [sys.executable, "-c", code, *arguments]
    return set(subprocess.run(command, cwd=KIT, capture_output=True, text=True).stderr.split())


def test_the_command_line_starts_without_what_only_some_commands_need():
    loaded = list_loaded("--help")
    assert "grader.cli.classroom" in loaded
    heavy = {"grader.intake", "grader.classroom.grading", "grader.classroom.nbgrader"}
    assert not loaded & {*heavy, "grader.report.html", "grader.report.ci", "grader.cli.watch"}


def test_a_check_that_passes_loads_nothing_for_failures_and_other_commands(hand_in):
    loaded = list_loaded("check", "--todo", "8a", str(hand_in("solution")))
    assert "grader.judge.loop" in loaded
    needless = {"jinja2", "grader.judge.explain.meaning", "grader.cli.grade", "grader.cli.classes"}
    assert not loaded & needless


def test_files_in_the_current_folder_shadow_nothing(hand_in):
    trap = "raise SystemExit('the judge imported a file of the submission')\n"
    names = ("json_py", "random_py", "pytest_py", "hypothesis_py", "conftest_py", "typer_py")
    tree = hand_in("solution", **dict.fromkeys(names, trap))
    done = start_grader("check", "--todo", "8a", cwd=tree)
    assert done.returncode == 0, done.stdout + done.stderr


def test_there_are_three_hints_for_every_todo():
    for todo in load_rubric().todos:
        assert len(todo.hints) == (3 if todo.function else 0), todo.id


# ---------------------------------------------------------------- options that would be ignored


@pytest.mark.parametrize(
    "arguments, words",
    [
        ("--jobs 2", "--jobs would be ignored without a submission"),
        ("--class", "--class needs the submissions"),
        ("--json marks.json --out marks", "--out, --json would be ignored without a submission"),
        ("--class tests/bank --json marks.json", "--json would be ignored with --class"),
        ("--class tests/bank --at-least 3", "--at-least would be ignored with --class"),
    ],
)
def test_an_option_that_would_be_ignored_is_refused(arguments: str, words: str):
    done = run_grader("grade", *arguments.split())
    assert done.exit_code == 2 and words in unwrapped(done.stderr)


# ---------------------------------------------------------------- a class without --class


@pytest.mark.parametrize("form", ["folders", "zips", "a zip", "a wrapper each"])
def test_a_folder_of_submissions_is_no_submission(tmp_path: Path, form: str):
    path = tmp_path / "class"
    for name in ("ann", "ben"):
        folder = path / name / "deeper" if form == "a wrapper each" else path / name
        folder.mkdir(parents=True)
        (folder / "integrators.py").write_text("def step():\n    return 1\n", encoding="utf-8")
        if form == "zips":
            shutil.make_archive(str(folder), "zip", folder)
            shutil.rmtree(folder)
    if form == "a zip":
        path = Path(shutil.make_archive(str(path), "zip", path))
    done = run_grader("grade", path)
    assert done.exit_code == 2 and "grade each of them with --class" in unwrapped(done.stderr)


def test_the_students_grader_says_that_it_grades_no_class(tmp_path: Path, monkeypatch):
    monkeypatch.setattr(grade, "find_spec", lambda name: None)
    done = run_grader("grade", "--class", tmp_path)
    assert done.exit_code == 2 and "--class needs the whole kit" in unwrapped(done.stderr)


# ---------------------------------------------------------------- without the kit around it

ELSEWHERE = {
    "gradescope": "",
    "verify": "",
    "release": "",
    "sync": "",
    "mutants": "",
    "bench": "",
    "tab": "",
    "nbgrader course": "course",
    "nbgrader collect": "class",
    "nbgrader release": "",
    "grade": "",
}


@pytest.mark.parametrize("command", ELSEWHERE)
def test_a_command_of_the_kit_says_so_where_the_grader_is_installed_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str
):
    monkeypatch.setattr(commands, "KIT", tmp_path)
    done = run_grader(*command.split(), *ELSEWHERE[command].split())
    assert done.exit_code == 2 and done.stdout == ""
    words = unwrapped(done.stderr)
    assert f"`grader {command}` works on the whole kit" in words and "holds no solution/" in words
    assert f"run python -m grader {command} in a checkout" in words


def test_every_command_of_maintainers_is_one_of_the_kit():
    names = {str(each.name) for each in dev.app.registered_commands}
    assert names <= set(ELSEWHERE)


@pytest.mark.soak
@pytest.mark.skipif(os.name == "nt", reason="an environment is laid out differently there")
def test_an_installed_grader_grades_and_needs_a_checkout_for_the_rest(tmp_path: Path):
    """Install a wheel into an environment with the same packages but without the kit."""
    pip = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]
    source = tmp_path / "kit"
    shutil.copytree(KIT / "grader", source / "grader")
    for name in ("pyproject.toml", "LICENSE"):
        shutil.copy(KIT / name, source)
    build = ["wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", tmp_path, source]
    subprocess.run([*pip, *build], check=True)
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", tmp_path / "venv"], check=True)
    python = tmp_path / "venv" / "bin" / "python"
    (wheel,) = tmp_path.glob("*.whl")
    install = ["--python", python, "install", "--no-deps", "--no-index", wheel]
    subprocess.run([*pip, *install], check=True)
    (packages,) = (tmp_path / "venv").glob("lib/python*/site-packages")
    (packages / "others.pth").write_text(sysconfig.get_path("purelib"), encoding="utf-8")

    def installed(*arguments: object) -> subprocess.CompletedProcess[str]:
        command = [tmp_path / "venv" / "bin" / "grader", *map(str, arguments)]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)

    for command, rest in ELSEWHERE.items():
        done = installed(*command.split(), *rest.split())
        assert done.returncode == 2 and "in a checkout" in unwrapped(done.stderr), command
    done = installed("grade", KIT / "solution", "--todo", "8a")
    assert done.returncode == 0 and "solution: 2 / 2" in done.stdout, done.stderr
    assert installed("hint", "--todo", "4").returncode == 0


def list_commands(group: Any, hidden: bool, before: str = "") -> Iterator[tuple[str, Any]]:
    """Yield each command that `--help` leads to, or every one with those that are `hidden`."""
    for name, command in group.commands.items():
        if command.hidden and not hidden:
            continue
        if hasattr(command, "commands"):
            yield from list_commands(command, hidden, f"{before}{name} ")
        else:
            yield before + name, command


def test_help_leads_an_instructor_to_few_commands_and_options():
    whole = typer.main.get_command(main.make_app())
    shown = dict(list_commands(whole, hidden=False))
    assert {"class grade", "grade", "release"} <= set(shown)
    assert len(shown) <= 12, list(shown)
    params = [each for command in shown.values() for each in command.params]
    options = [each for each in params if each.param_type_name == "option" and not each.hidden]
    assert 12 < len(options) <= 50, [each.opts for each in options]


def test_course_means_one_thing_in_every_command():
    whole = typer.main.get_command(main.make_app())
    every = [command for _, command in list_commands(whole, hidden=True)]
    named = [each for command in every for each in command.params if "--course" in each.opts]
    assert len(named) > 12 and {each.help for each in named} == {commands.COURSE_HELP}


def test_help_lists_no_command_of_maintainers_and_each_works_both_ways():
    listed = run_grader("--help").output
    for name in ("sync", "course-check", "export"):
        assert f" {name} " not in listed and f" {name} " in run_grader("dev", "--help").output
        ways = [run_grader(name, "--help"), run_grader("dev", name, "--help")]
        assert [done.exit_code for done in ways] == [0, 0]
