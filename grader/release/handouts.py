"""Make the handouts of a course: the pages in `handouts/`, without the tasks it omits.

Sections and table rows that begin with a TODO's id are removed with it, and points are the
course's. Other course-specific text is between Jinja marks in HTML comments, so the file stays
readable: `<!--% if asked("5") %-->`, `<!--= hand_in =-->`.
"""

import re
from collections.abc import Iterable, Mapping
from itertools import takewhile
from pathlib import Path
from typing import Any

from jinja2 import Environment, StrictUndefined

from grader.judge.course import Course
from grader.judge.rubric import Todo, load_rubric
from grader.report.screen import Tasks
from grader.source.regions import TODO_ID
from grader.text import format_time, join_words, spell_number

EXAMPLE, BONUS_EXAMPLE = "4", "B1"  # TODOs for examples of commands
SHEETS = ("lab-sheet.md", "bonus.md")  # the pages with a section for each TODO
SECTION = re.compile(rf"^(##+) (?:TODO )?({TODO_ID}): ")
ROW = re.compile(rf"^\| \[?({TODO_ID})(?:\]\([^)]*\))? \|")
LINK = re.compile(r"(?<!!)\[([^\]]+)\]\(([\w./-]+\.md)(?:#[\w-]*)?\)")
WHAT = ("**What.** ", "**How.** ")  # paragraphs of a section that say what to do
NOT_YET = "**Watch out.**"  # later parts follow
PARTS = re.compile(r"(?m)^(?=- |\||python |```|\n)|(?<=\n\n)")  # items, rows, paragraphs

pages = Environment(
    block_start_string="<!--%",
    block_end_string="%-->",
    variable_start_string="<!--=",
    variable_end_string="=-->",
    comment_start_string="<!--#",
    comment_end_string="#-->",
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
    undefined=StrictUndefined,
    autoescape=False,  # Markdown of our own
)


def cut_page(text: str, course: Course) -> str:
    """Remove the sections and rows of tables that a course leaves out."""
    todos = {todo.id: todo for todo in course.rubric.todos}
    known = {todo.id for todo in load_rubric().todos}
    text = "\n".join(drop_lines(text.split("\n"), todos, known - todos.keys()))
    text = re.sub(r"\n{3,}", "\n\n", text).rstrip() + "\n"
    return choose_examples(text, course)


def cut_readme(text: str, course: Course) -> str:
    """Remove the parts of the student's README that name something the course omits.

    The file is plain Markdown without conditions: parts name the TODO or program they depend on.
    """
    given = {todo.id for todo in course.given_todos}
    every = set(load_rubric().modules) - set(course.modules)
    names = [*(f"TODO {id}" for id in given), *map(name_command, every), *map(name_program, every)]
    if not names:
        return text
    about = re.compile(rf"(?<![\w./])({'|'.join(map(re.escape, names))})(?![\w/])")
    parts = PARTS.split(cut_page(text, course))
    kept = "".join(part for part in parts if not about.search(part))
    return re.sub(r"\n{3,}", "\n\n", kept)


def make_handouts(folder: Path, course: Course) -> dict[str, str]:
    """Return the students' pages in this folder, by name; dead links are plain words."""
    bonus = any(todo.bonus for todo in course.rubric.todos)
    paths = [path for path in sorted(folder.glob("*.md")) if bonus or path.name != "bonus.md"]
    words, texts = list_words(course), {}
    for path in paths:
        text = pages.from_string(path.read_text(encoding="utf-8")).render(words)
        texts[path.name] = cut_page(text, course)
    return {name: drop_dead_links(text, texts.keys()) for name, text in texts.items()}


def make_tasks(texts: Mapping[str, str]) -> Tasks:
    """Return the task of each TODO as paragraphs without markup."""
    return {todo: list(find_paragraphs(body)) for todo, body in find_sections(texts).items()}


def find_sections(texts: Mapping[str, str]) -> dict[str, str]:
    """Return the text of each TODO on the lab sheet and among the bonus tasks, without heading."""
    found = {}
    for name in SHEETS:
        _, *sections = re.split(r"^(?=##? )", texts.get(name, ""), flags=re.M)
        for section in sections:
            heading, _, body = section.partition("\n")
            if todo := SECTION.match(heading):
                found[todo[2]] = body
    return found


def find_paragraphs(body: str) -> Iterable[str]:
    """Yield the paragraphs marked as the task, or else those up to the first warning."""
    parts = [" ".join(part.split()) for part in re.split(r"\n\n|\n(?=- )", body.strip())]
    marked = [part for part in parts if part.startswith(WHAT)]
    for part in marked or takewhile(lambda part: not part.startswith(NOT_YET), parts):
        yield re.sub(
            r"\*\*(?:What\.\*\* |How\.\*\* )?|(?<!\w)\*(?=\w)|(?<=\w)\*|`",
            "",
            LINK.sub(r"\1", part),
        )


def drop_dead_links(text: str, names: Iterable[str]) -> str:
    """Turn links to missing pages into words, and drop rows of tables about them."""
    dead = {link[2] for link in LINK.finditer(text) if "/" not in link[2]} - set(names)
    for name in dead:
        text = re.sub(rf"^\| \[[^\]]+\]\({re.escape(name)}\) .*\n", "", text, flags=re.M)
    return LINK.sub(lambda link: link[1] if link[2] in dead else link[0], text)


def list_words(course: Course) -> dict[str, Any]:
    todos = {todo.id: todo for todo in course.rubric.todos}
    tasks = [todo for todo in course.rubric.main_todos if todo.function]
    bonus = [todo for todo in course.rubric.todos if todo.bonus]
    ids = [todo.id for todo in tasks]
    return {
        "asked": lambda *names: any(name in todos for name in names),
        "every": course.rubric == load_rubric(),
        "title": course.title,
        "due": format_time(course.due),
        "tasks": spell_number(len(tasks)),
        "bonus_tasks": spell_number(len(bonus)),
        "bonus_points": sum(todo.max_points for todo in bonus),
        "points": {id: todo.max_points for id, todo in todos.items()},
        "span": f"TODO {ids[0]} to {ids[-1]}" if len(ids) > 1 else f"TODO {ids[0]}",
        "programs": "\n".join(
            ["```", *(f"python {name_command(each)}" for each in course.modules), "```"]
        ),
        "hand_in": join_words([f"`{name_program(each)}`" for each in course.modules]),
    }


def name_command(module: str) -> str:
    return "-m mini_engine" if module == "mini_engine" else f"{module}.py"


def name_program(module: str) -> str:
    """Return a program's name in the student's folder: a package, or a file."""
    return module if module == "mini_engine" else f"{module}.py"


def drop_lines(lines: list[str], todos: dict[str, Todo], left_out: set[str]) -> Iterable[str]:
    """Drop sections and rows of omitted tasks; fill in the course's points."""
    skipping, column, of_todos = 0, 0, False
    for line in lines:
        heading = re.match(r"^(#+) ", line)
        if heading and len(heading[1]) <= (skipping or 9):
            section = SECTION.match(line)
            skipping = len(section[1]) if section and section[2] in left_out else 0
        if skipping:
            continue
        if line.startswith("| TODO |") or line.startswith("| task |"):
            names = [cell.strip() for cell in line.split("|")]
            column, of_todos = names.index("points") if "points" in names else 0, True
        row = ROW.match(line) if of_todos else None
        if row and row[1] in left_out:
            continue
        if row and column and row[1] in todos:
            cells = line.split("|")
            cells[column] = f" {todos[row[1]].max_points} "
            line = "|".join(cells)
        elif not line.startswith("|"):
            column, of_todos = 0, False
        yield line


def choose_examples(text: str, course: Course) -> str:
    """Change the TODO of examples to one that the course has."""
    for example, bonus in ((EXAMPLE, False), (BONUS_EXAMPLE, True)):
        ids = [todo.id for todo in course.rubric.todos if todo.function and todo.bonus == bonus]
        if ids and example not in ids:
            text = re.sub(
                rf"(TODO[= ]|--todo |grader (?:check|hint) ){example}\b", rf"\g<1>{ids[0]}", text
            )
    return text
