"""Test that the handouts are true and give no solution away."""

import ast
import html
import importlib.util
import json
import math
import re
import sys
import tomllib
import xml.etree.ElementTree as ElementTree
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import integrators
import mini_engine
from grader.cli.grade import grade_command
from grader.release.formulas import typeset
from grader.release.pages import MEASURED, make_page
from grader.source.regions import python_files, regions_in

KIT = Path(__file__).parents[2]
HANDOUTS, SOLUTION, STARTER = KIT / "handouts", KIT / "solution", KIT / "starter"
STUDENTS = sorted(HANDOUTS.glob("*.md"))
PAGES = sorted(HANDOUTS.rglob("*.md"))
GUIDES = [KIT / "README.md", KIT / "CONTRIBUTING.md"]
ON_GITHUB = {f"../../actions/workflows/ci.yml{end}" for end in ("", "/badge.svg")}  # no files
CHECKS = KIT / "grader" / "checks"
RUBRIC = tomllib.loads((CHECKS / "rubric.toml").read_text(encoding="utf-8"))
FUNCTIONS = {todo["id"]: todo for todo in RUBRIC["todos"] if todo["function"]}
TODOS = {name: todo for name, todo in FUNCTIONS.items() if not name.startswith("B")}
BONUS = {name: todo for name, todo in FUNCTIONS.items() if name.startswith("B")}

# The course's plan, in minutes: the engine, pymunk, the integrators.
MINUTES = {"1": 10, "2": 4, "3": 6, "4": 3, "5": 3, "6": 5}
PYMUNK_MINUTES = 20


def name_of(page: Path) -> str:
    return page.relative_to(HANDOUTS).as_posix()


def place_of(page: Path) -> str:
    return page.relative_to(KIT).as_posix()


def text_of(name: str) -> str:
    return (HANDOUTS / name).read_text(encoding="utf-8")


def without_code(text: str) -> str:
    return re.sub(r"`[^`\n]*`", "", re.sub(r"^ *```.*?^ *```", "", text, flags=re.M | re.S))


def script(name: str) -> ModuleType:
    """Load one of the programs that make parts of the handouts."""
    spec = importlib.util.spec_from_file_location(name, HANDOUTS / f"{name}.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    before = list(sys.path)
    spec.loader.exec_module(module)
    sys.path[:] = before
    return module


def table_below(text: str, heading: str) -> list[list[str]]:
    """Return the cells of the first table after a heading, without its two head rows."""
    rows = []
    for line in text.partition(heading)[2].splitlines():
        if line.startswith("|"):
            rows.append([cell.strip() for cell in line.strip("|").split("|")])
        elif rows:
            break
    return rows[2:]


# ---------------------------------------------------------------- links and pictures


def anchors(page: Path) -> set[str]:
    """Return the headings of a page, as links name them."""
    found = set()
    for heading in re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), re.M):
        words = re.sub(r"[^\w\s-]", "", heading.replace("`", "")).strip().lower()
        found.add(re.sub(r"[\s-]+", "-", words))
    return found


def links(text: str) -> list[str]:
    return re.findall(r"\]\(([^)\s]+)\)", without_code(text))


def trouble_with(page: Path, link: str) -> str:
    """Return the fault in a link, or an empty text."""
    target, _, anchor = link.partition("#")
    place = (page.parent / target).resolve() if target else page
    if not place.is_file():
        return f"{link}: there is no such file"
    if anchor and anchor not in anchors(place):
        return f"{link}: no such heading in {place.name}"
    return ""


@pytest.mark.parametrize("page", [*PAGES, *GUIDES], ids=place_of)
def test_every_link_and_picture_is_there(page: Path) -> None:
    found = [link for link in links(page.read_text(encoding="utf-8")) if link not in ON_GITHUB]
    assert not list(filter(None, (trouble_with(page, link) for link in found)))


@pytest.mark.parametrize("page", [*PAGES, *GUIDES], ids=place_of)
def test_every_path_of_the_kit_that_is_named_is_there(page: Path) -> None:
    assert not [path for path in paths_in(page) if not (KIT / path).exists()]


def paths_in(page: Path) -> list[str]:
    folders = "grader|handouts|solution|starter|tests"
    return re.findall(rf"`((?:{folders})/[^`\s]*)`", page.read_text(encoding="utf-8"))


@pytest.mark.parametrize("page", STUDENTS, ids=name_of)
def test_students_are_not_sent_to_the_instructors_pages(page: Path) -> None:
    assert not [link for link in links(page.read_text(encoding="utf-8")) if "instructor" in link]


def test_every_page_is_in_the_menu() -> None:
    menu = (HANDOUTS / "site" / "mkdocs.yml").read_text(encoding="utf-8").partition("\nnav:")[2]
    assert set(re.findall(r": (\S+\.md)$", menu, re.M)) == {name_of(page) for page in PAGES}


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_no_page_names_a_place_on_a_machine(page: Path) -> None:
    assert not re.findall(r"(?:/work|/tmp|/home|/root)/\S*", page.read_text(encoding="utf-8"))


def test_pictures_are_small() -> None:
    for picture in (HANDOUTS / "figures").iterdir():
        assert picture.stat().st_size < 60 * 1024, f"{picture.name} is too large for a page"


def shown_words(page: Path) -> int:
    """Count the words of a page, without the menus around it."""
    text = page.read_text(encoding="utf-8")
    text = re.sub(r"<(script|style|head|header|footer)\b.*?</\1>", "", text, flags=re.S)
    return len(re.findall(r"\w[\w'.-]*", html.unescape(re.sub(r"<[^>]+>", " ", text))))


def test_pages_of_the_lab_are_short(handout_pages: Path) -> None:
    measured = {Path(name).stem for name in MEASURED}
    pages = [page for page in handout_pages.glob("*.html") if page.stem not in measured]
    readme = (STARTER / "README.md").read_text(encoding="utf-8").split()
    assert len(pages) == len(STUDENTS) - len(measured)
    assert sum(map(shown_words, pages)) + len(readme) <= 12_000


# ---------------------------------------------------------------- generated parts


def test_the_page_of_hints_says_what_the_command_says() -> None:
    made = script("make_hints").page()
    assert text_of("hints.md") == made, "run: python handouts/make_hints.py"
    told = html.unescape(re.sub(r"</?code>", "`", made))
    for todo in RUBRIC["todos"]:
        assert all(words in told for words in todo.get("hints", []))


def test_the_figures_are_those_of_the_solution(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    figures = script("make_figures")
    monkeypatch.setattr(figures, "FIGURES", tmp_path)
    for draw in figures.ALL:
        draw()
    made = sorted(tmp_path.iterdir())
    assert len(made) == len(figures.ALL)
    for figure in made:
        ElementTree.parse(figure)
        there = text_of(f"figures/{figure.name}")
        assert figure.read_text(encoding="utf-8") == there, "run: python handouts/make_figures.py"


def test_every_task_with_a_picture_has_two() -> None:
    sheet = text_of("lab-sheet.md")
    for todo in script("make_pictures").SHOTS:
        for when in ("before", "after"):
            assert f"(figures/todo-{todo}-{when}.png)" in sheet


# ---------------------------------------------------------------- the lab sheet


def function_around(path: Path, line: int) -> str:
    """Return the last function, with its class, that begins above a line of a file."""
    names = {}
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef):
            names[node.lineno] = node.name
        elif isinstance(node, ast.ClassDef):
            inner = [each for each in node.body if isinstance(each, ast.FunctionDef)]
            names |= {each.lineno: f"{node.name}.{each.name}" for each in inner}
    return names[max(number for number in names if number <= line)]


def places(tree: Path) -> dict[str, tuple[str, str]]:
    """Return the file and function of each TODO of a tree."""
    return {
        region.id: (path.relative_to(tree).as_posix(), function_around(path, region.start + 1))
        for path in python_files(tree)
        for region in regions_in(path.read_text(encoding="utf-8"))
    }


@pytest.fixture(scope="module")
def plan() -> dict[str, dict[str, Any]]:
    """Read the lab sheet's table of tasks."""
    return {
        re.sub(r"\[(.+)\].*", r"\1", todo): {
            "minutes": int(minutes),
            "points": int(points),
            "place": (file.strip("`"), function.strip("`")),
        }
        for todo, minutes, points, file, function, _ in table_below(
            text_of("lab-sheet.md"), "## The plan"
        )
    }


def test_the_plan_has_every_todo_with_its_points_and_minutes(plan: dict[str, Any]) -> None:
    points = {
        name: sum(check["points"] for check in todo["checks"]) for name, todo in TODOS.items()
    }
    assert list(plan) == list(TODOS) and {t: row["points"] for t, row in plan.items()} == points
    assert 100 - sum(points.values()) == 10
    assert "Ten more points are for the program as a whole." in text_of("lab-sheet.md")
    assert {todo: plan[todo]["minutes"] for todo in MINUTES} == MINUTES
    in_pymunk = [row["minutes"] for todo, row in plan.items() if todo.startswith("7")]
    assert sum(in_pymunk) == PYMUNK_MINUTES


@pytest.mark.parametrize("tree", [SOLUTION, STARTER], ids=lambda tree: tree.name)
def test_the_plan_says_where_each_todo_stands(plan: dict[str, Any], tree: Path) -> None:
    found = places(tree)
    assert {todo: row["place"] for todo, row in plan.items()} == {t: found[t] for t in TODOS}
    bonus = {row["todo"]: row["place"] for row in bonus_rows()}
    assert bonus == {todo: found[todo] for todo in BONUS}
    assert set(found) == {*TODOS, *BONUS}


def bonus_rows() -> list[dict[str, Any]]:
    """Read the table of the bonus tasks."""
    return [
        {
            "todo": re.sub(r"\[(.+)\].*", r"\1", todo),
            "points": int(points),
            "place": (file.strip("`"), function.strip("`")),
        }
        for todo, points, file, function, _ in table_below(text_of("bonus.md"), "# Going further")
    ]


def test_the_bonus_tasks_have_the_points_of_the_rubric() -> None:
    points = {
        todo: sum(check["points"] for check in known["checks"]) for todo, known in BONUS.items()
    }
    assert [row["todo"] for row in bonus_rows()] == [f"B{number}" for number in range(1, 7)]
    assert {row["todo"]: row["points"] for row in bonus_rows()} == points


def test_every_section_says_the_same_as_the_plan(plan: dict[str, Any]) -> None:
    sections = dict(re.findall(r"^## TODO (\w+): .*\n\n(.*)$", text_of("lab-sheet.md"), re.M))
    assert list(sections) == list(plan)
    for todo, line in sections.items():
        file, function = plan[todo]["place"]
        assert line == f"{plan[todo]['minutes']} minutes · `{file}` · `{function}`"


def test_every_section_says_how_to_check_and_where_hints_are() -> None:
    parts = re.split(r"^## ", text_of("lab-sheet.md"), flags=re.M)
    sections = [part for part in parts if part.startswith("TODO ")]
    assert len(sections) == len(TODOS)
    for section, (todo, known) in zip(sections, TODOS.items(), strict=True):
        assert section.lower().startswith(f"todo {todo}: {known['title'].lower()}\n")
        assert f"- [ ] `make check TODO={todo}` says `PASSED`." in section
        assert f"`make hint TODO={todo}`" in section
        assert f"(hints.md#todo-{todo}-" in section


# ---------------------------------------------------------------- numbers


def test_the_table_of_integrators_is_what_the_program_prints(
    capsys: pytest.CaptureFixture[str],
) -> None:
    integrators.main()
    printed = [line.split() for line in capsys.readouterr().out.splitlines()[1:]]
    assert table_below(text_of("lesson.md"), "<!-- integrators: begin -->") == printed
    for todo, row in zip(("8a", "8b", "8c"), printed[1:], strict=True):
        section = text_of("lab-sheet.md").partition(f"## TODO {todo}:")[2].partition("\n## ")[0]
        assert f"prints {row[1]} in this row" in section


def test_shares_that_are_left_after_many_steps_are_right() -> None:
    found = re.findall(r"0\.99\^(\d+) ≈ ([\d.]+) %", text_of("lesson.md"))
    assert [int(steps) for steps, _ in found] == [60, 120, 600]
    for steps, share in found:
        digits = len(share.partition(".")[2])
        assert round(100 * 0.99 ** int(steps), digits) == float(share)


def test_the_damping_of_the_lab_scene_is_right() -> None:
    world = mini_engine.World()
    text = " ".join(text_of("lesson.md").split())
    rates = f"velocity at {world.linear_damping} per second and the spin at {world.angular_damping}"
    assert rates in text
    kept = round(100 * math.exp(-world.linear_damping))
    assert f"At {world.linear_damping} about {kept} % of a speed is left after a second" in text


@pytest.mark.parametrize(
    "words",
    [
        f"only above {mini_engine.RESTING_SPEED} px/s",
        f"takes out 1/{round(1 / mini_engine.STEP)} s",
        f"add {mini_engine.MAX_STEPS} steps at most",
        f"where this engine has {mini_engine.ITERATIONS} passes",
        {0.2: "a fifth"}[mini_engine.BETA] + " of the overlap per step (`BETA`)",
        {0.5: "half a pixel"}[mini_engine.SLOP] + " that is left alone (`SLOP`)",
        f"gravity is (0, {mini_engine.World().gravity.y:g}) px/s²",
    ],
)
def test_the_lesson_names_the_constants_of_the_engine(words: str) -> None:
    assert words in " ".join(text_of("lesson.md").split())


def test_the_long_frame_of_the_drawing_is_described_right() -> None:
    frames = script("make_figures").FRAMES
    longest = frames.index(max(frames))
    waiting = sum(frames[:longest]) % (1000 * mini_engine.STEP)
    owed = int((waiting + frames[longest]) / (1000 * mini_engine.STEP))
    words = f"could pay for {owed} steps. The cap allows {mini_engine.MAX_STEPS}."
    assert words in text_of("lesson.md")


# ---------------------------------------------------------------- no solution


def squeezed(text: str) -> str:
    return "".join(text.split())


@cache
def solution_lines() -> list[tuple[str, str]]:
    """List each line of a TODO's solution, with its id, except those in given code."""
    texts = [path.read_text(encoding="utf-8") for path in python_files(STARTER)]
    given = {squeezed(line) for text in texts for line in text.splitlines()}
    found = [
        (region.id, squeezed(line))
        for path in python_files(SOLUTION)
        for region in regions_in(path.read_text(encoding="utf-8"))
        for line in region.lines
    ]
    lines = [each for each in found if len(each[1]) >= 12 and each[1][0] != "#"]
    lines = [each for each in lines if each[1] not in given]
    assert {todo for todo, _ in lines} == {*TODOS, *BONUS}, "a TODO without a line to search for"
    return lines


@pytest.mark.parametrize("page", STUDENTS, ids=name_of)
def test_no_line_of_a_solution_is_given_away(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    if page.name == "hints.md":  # its last level may be the code itself
        text = re.sub(r"<summary>Nearly the code</summary>\n<p>.*</p>", "", text)
    assert not [line for line in solution_lines() if line[1] in squeezed(text)]


def test_the_quiz_and_its_answers_belong_together() -> None:
    quiz = text_of("quiz.md")
    questions = re.findall(r"^\*\*(\d+)\. ", quiz, re.M)
    assert len(questions) >= 5
    found = re.findall(r"<summary>([A-D])\. .+</summary>\n<p>(Right)?.+</p>\n</details>", quiz)
    assert [letter for letter, _ in found] == [*"ABCD"] * len(questions)
    for number in range(len(questions)):
        assert sum(bool(right) for _, right in found[4 * number :][:4]) == 1, number + 1


def test_the_quiz_that_counts_asks_something_else_and_has_these_answers() -> None:
    notebook = json.loads((SOLUTION / "notebooks" / "quiz.ipynb").read_text(encoding="utf-8"))
    cells = {cell["id"]: "".join(cell["source"]) for cell in notebook["cells"]}
    answers = table_below(text_of("instructor/quiz-answers.md"), "## Quiz")
    assert [row[0] for row in answers] == [name[9:] for name in cells if name.startswith("questio")]
    for number, letter, _ in answers:
        assert f'answer_{number} = "{letter.lower()}"' in cells[f"answer-{number}"]
        asked = cells[f"question-{number}"].splitlines()[2]
        assert asked not in text_of("quiz.md") and len(asked) > 40


def test_the_journal_is_marked_as_in_its_notebook() -> None:
    notebook = (STARTER / "notebooks" / "journal.ipynb").read_text(encoding="utf-8")
    cells = ["".join(cell["source"]) for cell in json.loads(notebook)["cells"]]
    rows = re.findall(r"^\| \d .*$", "\n".join(cells), re.M)
    assert rows
    assert re.findall(r"^\| \d .*$", text_of("journal.md"), re.M) == rows


# ---------------------------------------------------------------- commands


def test_the_guides_options_of_grade_exist() -> None:
    guide = text_of("instructor/guide.md")
    table = guide.partition("## Grade")[2].partition("## Read a report")[0]
    told = {name.replace("-", "_") for name in re.findall(r"^\| `--([\w-]+)", table, re.M)}
    names = {name.rstrip("_") for name in grade_command.__annotations__}
    assert told == names - {"context", "path", "return", "class"}


def targets(makefile: Path) -> set[str]:
    return set(re.findall(r"^([a-z-]+):", makefile.read_text(encoding="utf-8"), re.M))


def test_every_make_target_that_is_named_exists() -> None:
    for pages, makefiles in ((STUDENTS, [STARTER]), (PAGES, [KIT, STARTER])):
        known = set().union(*(targets(folder / "Makefile") for folder in makefiles))
        for page in pages:
            named = set(re.findall(r"(?:`|^ *)make ([a-z-]+)", page.read_text("utf-8"), re.M))
            assert named <= known, f"{page.name}: {named - known}"


def test_formulas_are_set_without_a_script():
    text = (HANDOUTS / "lesson.md").read_text(encoding="utf-8")
    count = text.count("```math\n")
    made = typeset(text)
    assert count >= 5 and made.count('<div class="formula"') == made.count("<math ") == count
    assert "```math" not in made and "\\frac" not in made
    assert made.count("<mfrac>") >= 6  # fractions are fractions
    page = make_page("lesson.md", {"lesson.md": text})
    assert page.count("<math ") == count and "&lt;math" not in page
