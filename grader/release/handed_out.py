"""Make the student's tree of a course: the starter, with the TODOs of other courses done."""

import textwrap
from pathlib import Path

from grader.bank.sync import list_students_files
from grader.judge.course import Course
from grader.release.handouts import choose_examples, cut_readme
from grader.source.regions import RegionError, read_source, regions_in

FOR_CI = {".gitlab-ci.yml", ".github/workflows/grade.yml"}
GIVEN = "# Given in this course: what TODO {} asks for elsewhere is done here."


def make_students_tree(kit: Path, course: Course) -> dict[str, bytes]:
    """Return the content of each file that students get, by its name, without notebooks."""
    paths = list_students_files(kit)
    return {name: fill_given(path, kit / "solution" / name, course) for name, path in paths.items()}


def fill_given(path: Path, solution: Path, course: Course) -> bytes:
    """Return a file's content, with the solution's code and a note in given TODOs."""
    if path.suffix == ".md":
        return cut_readme(path.read_text(encoding="utf-8"), course).encode()
    if path.name == "Makefile":
        return choose_examples(path.read_text(encoding="utf-8"), course).encode()
    if path.suffix != ".py":
        return path.read_bytes()
    given = {todo.id for todo in course.given_todos}
    text = read_source(path)
    regions = [region for region in regions_in(text) if region.id in given]
    if not regions:
        return path.read_bytes()
    right = {region.id: region.lines for region in regions_in(read_source(solution))}
    lines = text.splitlines()
    for region in reversed(regions):
        if region.id not in right:
            raise RegionError(f"{solution} has no TODO {region.id}, which {path} has")
        indent = lines[region.start][: -len(lines[region.start].lstrip())]
        said = textwrap.indent(GIVEN.format(region.id), indent)
        lines[region.start : region.stop + 1] = [said, *right[region.id]]
    return ("\n".join(lines) + "\n").encode()


def write_tree(files: dict[str, bytes], folder: Path) -> None:
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
