"""Test the instructor's guide of a term: run each of its command lines, in order, on a tiny
class."""

import csv
import re
import runpy
from pathlib import Path

import classes
import packed
import pytest
import typer
from command_line import run_grader

from grader.cli.main import make_app
from grader.judge.task import KIT

PAGES = sorted((KIT / "handouts" / "instructor").rglob("*.md"))
PAGE = (KIT / "handouts" / "instructor" / "term.md").read_text(encoding="utf-8")
COURSE = 'title = "Lab 3"\ntodos = ["8a", "8b"]\nout_of = 10\n'
WAITS = ("review", "upload")  # serves a page until it is stopped, needs a Canvas
NAMES = ("ann", "ben")
START = re.compile(r"(?:\S*python -m )?grader (.*)")


def list_commands(page: str) -> list[list[str]]:
    """Return the words of each command line of the grader, without comments."""
    fenced = re.findall(r"^```\n(.*?)^```$", page, re.M | re.S)
    lines = [line.partition("#")[0] for block in fenced for line in block.splitlines()]
    found = [START.match(line) for line in lines]
    return [each[1].split() for each in found if each]


def test_the_guide_of_a_term_has_two_pages_and_names_every_command_of_a_class():
    assert len(PAGE.split()) <= 900
    whole = typer.main.get_command(make_app())
    named = {words[1] for words in list_commands(PAGE) if words[0] == "class"}
    assert set(whole.commands["class"].commands) <= named


def test_instructors_read_few_words():
    assert sum(len(path.read_text(encoding="utf-8").split()) for path in PAGES) <= 12_000


@pytest.mark.parametrize("page", [*PAGES, KIT / "README.md"], ids=lambda path: path.stem)
def test_every_command_line_of_a_page_has_commands_and_options_that_exist(page: Path):
    for words in list_commands(page.read_text(encoding="utf-8")):
        command = typer.main.get_command(make_app())
        while words and hasattr(command, "commands"):
            command, words = command.commands[words[0]], words[1:]
        options = {name for each in command.params for name in each.opts}
        assert {word for word in words if word.startswith("--")} <= options, words


def test_the_table_of_systems_is_as_they_have_it():
    page = (KIT / "handouts" / "instructor" / "class.md").read_text(encoding="utf-8")
    renew = runpy.run_path(str(KIT / "handouts" / "make_systems.py"))["renew"]
    assert renew(page) == page, "python handouts/make_systems.py renews the table"


def make_files() -> None:
    """Write the files that the guide names: a class list, a course, exports and answers on
    paper."""
    rows = [f"{name}@x.edu,{name.title()} Lee" for name in NAMES]
    Path("list.csv").write_text("\n".join(["Email address,Full name", *rows, ""]))
    Path("autumn.toml").write_text(COURSE)
    Path("answers.csv").write_text("student,question,answer\nann,1,3\n")
    program = (KIT / "solution" / "integrators.py").read_bytes()
    work = {f"{name}.zip": packed.as_zip({"integrators.py": program}) for name in NAMES}
    for name, content in work.items():
        classes.put(Path("first-week", name), content)
        classes.put(Path("2025", name), content)
    Path("submissions.zip").write_bytes(packed.as_zip(work))


def test_every_command_line_of_the_guide_of_a_term_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.chdir(tmp_path)
    make_files()
    for words in list_commands(PAGE):
        more = ["--help"] if words[1] in WAITS else []
        done = run_grader(*words, *more)
        assert done.exit_code in (0, 1), (words, done.output)
    with open("lab3/marks.csv", encoding="utf-8") as table:
        assert [row["Grade"] for row in csv.DictReader(table)] == ["10.0", "10.0"]
