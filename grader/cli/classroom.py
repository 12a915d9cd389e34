"""Define the commands for a course with nbgrader, for Gradescope, and for views of a class.

Each command imports its own modules: together they would add a tenth of a second to the start of
others.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import typer

from grader.cli.shared import (
    Confinement,
    CourseFile,
    Jobs,
    ResultsFolder,
    SecretSeed,
    console,
    list_missing,
    print_note,
    print_notes,
    refuse_ignored,
    require_checkout,
    require_file_target,
    require_folder_target,
)
from grader.errors import Stop
from grader.judge.course import Course, WrongCourse, read_course
from grader.judge.task import KIT, Options, shipped_reference
from grader.text import clean, plural

app = typer.Typer()
course_app = typer.Typer(
    help="A course with nbgrader.",
    epilog="Once: course, roster. After a deadline: collect, nbgrader autograde, bridge. "
    "handouts/instructor/nbgrader.md describes each.",
    no_args_is_help=True,
)
app.add_typer(course_app, name="nbgrader", hidden=True)

CourseFolder = Annotated[Path, typer.Option("--folder", help="The course folder of nbgrader.")]
Key = Annotated[str, typer.Option(help="Its column that names students as their folders do.")]
Gradebook = Annotated[
    Path, typer.Argument(help="The class list: the gradebook as the LMS exports it.")
]
COURSE = "course.toml"  # in the course folder of nbgrader: the source of the folder


@course_app.command("course")
def course_command(
    course: Annotated[Path, typer.Argument(help="The course folder to make.")],
    renew: Annotated[bool, typer.Option(help="Replace the assignment's source.")] = False,
    release: Annotated[
        Path | None,
        typer.Option(help="The release for students; the newest in build/release if left out."),
    ] = None,
    without_checks: Annotated[
        bool, typer.Option(help="Make it without a release: students cannot run checks.")
    ] = False,
    taken: CourseFile = None,
) -> None:
    """Make a course folder: the notebooks, the students' files, and nbgrader's settings."""
    require_checkout("nbgrader course")
    require_folder_target(course, "the course folder")
    from grader.classroom.nbgrader.submissions import ASSIGNMENT
    from grader.release.nbgrader_course import find_newest_release, make_course

    release = None if without_checks else release or find_newest_release(KIT / "build" / "release")
    if release is None and not without_checks:
        raise Stop("there is no release in build/release, which has the checks: make release")
    asked = find_course(course, taken)
    files = make_course(course, renew, release, read_course(asked))
    if asked is not None and asked != course / COURSE:
        (course / COURSE).write_bytes(asked.read_bytes())
    console.print(f"wrote {plural(len(files), 'file')} to {course / 'source' / ASSIGNMENT}")
    console.print(f"Next, in {course}: nbgrader generate_assignment {ASSIGNMENT}")


def find_course(folder: Path, named: Path | None) -> Path | None:
    """Return the named course or the folder's; None for the kit's own."""
    own = folder / COURSE
    return named or (own if own.is_file() else None)


@course_app.command("collect")
def collect_command(
    folder: Annotated[Path, typer.Argument(help="A folder of submissions, a folder each.")],
    course: CourseFolder = Path("."),
) -> None:
    """Copy submissions into the course folder. Exit status 1: a name could not be used."""
    require_checkout("nbgrader collect")
    from grader.classroom.nbgrader.submissions import ASSIGNMENT, collect_submissions

    taken = list(collect_submissions(folder, course))
    for each in taken:
        console.print(f"{clean(each.student)}: {each.words}")
    console.print(f"Next, in {course}: nbgrader autograde {ASSIGNMENT}")
    raise typer.Exit(0 if all(each.taken for each in taken) else 1)


@course_app.command("bridge")
def bridge_command(
    context: typer.Context,
    results: Annotated[
        list[Path] | None, typer.Argument(help="Result files, or folders of them; or grade now.")
    ] = None,
    course: CourseFolder = Path("."),
    jobs: Jobs = 0,
    isolation: Confinement = "auto",
    seed: SecretSeed = None,
    taken: CourseFile = None,
) -> None:
    """Write the grader's marks into the gradebook. Exit status 1: some are missing."""
    if results:
        given = ("jobs", "isolation", "seed")
        refuse_ignored(context, given, "with results, which are graded already")
    from grader.classroom.nbgrader.gradebook import fill_gradebook, read_results
    from grader.classroom.nbgrader.submissions import grade_submitted

    troubles: list[str] = []
    if not results:
        asked = read_course(find_course(course, taken))
        options = Options(shipped_reference(), isolation, seed=seed, course=asked)
        troubles = grade_submitted(course, options, jobs, console)
    for each in list(fill_gradebook(course, read_results(results or [course / "results"]))):
        if isinstance(each, str):
            troubles.append(each)
            continue
        console.print(f"{clean(each.student)}: {each.points:g} / {each.max_points:g}")
        for note in each.notes:
            console.print(f"  {clean(note)}")
    for trouble in troubles:
        console.print(clean(trouble))
    raise typer.Exit(1 if troubles else 0)


@course_app.command("release", hidden=True)
def release_command() -> None:
    """Renew the starter's notebooks with nbgrader."""
    require_checkout("nbgrader release")
    from grader.release import nbgrader_notebooks as notebooks

    console.print(f"renewed {', '.join(notebooks.renew_notebooks(KIT)) or 'nothing'}")


@course_app.command("roster")
def roster_command(roster: Gradebook, course: CourseFolder = Path("."), key: Key = "") -> None:
    """Write the names of a class list into the gradebook."""
    from grader.classroom.nbgrader.gradebook import write_names
    from grader.intake.systems import read_roster

    names = read_roster(roster)
    column = names.choose_key(key)
    write_names(course, names, column)
    console.print(f"the gradebook has {plural(len(names.rows), 'student')}, by {column}")


@app.command("gradescope")
def gradescope_command(
    out: Annotated[Path, typer.Option(help="The zip to write.")] = (
        KIT / "build" / "gradescope" / "autograder.zip"
    ),
    wheels: Annotated[
        str, typer.Option(help="Put all packages in, for this Python, such as 3.11.")
    ] = "",
    isolation: Confinement = "auto",
    seed: SecretSeed = None,
    course: CourseFile = None,
) -> None:
    """Make the autograder for Gradescope. It holds the solution: do not publish it."""
    require_checkout("gradescope")
    require_file_target(out, "--out")
    from grader.classroom.gradescope import write_autograder
    from grader.classroom.gradescope.autograder import Settings

    write_autograder(out, Settings(isolation, seed, read_course(course)), wheels)
    print_note(f"made {out}")


@app.command("dashboard")
def dashboard_command(results: ResultsFolder, course: CourseFile = None) -> None:
    """Make a page of a class, and a report for each student."""
    from grader.classroom.dashboard import read_class, write_dashboard

    print_note(f"made {write_dashboard(results, read_class(results), read_course(course))}")


@app.command("course-check")
def course_check_command(course: CourseFile = None) -> None:
    """Check the course file, and try its release. Exit status 1: there are problems."""
    try:
        problems = list(find_release_problems(read_course(course)))
    except WrongCourse as error:
        problems = [str(error)]
    print_notes(problems or ["No problems found."])
    raise typer.Exit(1 if problems else 0)


def find_release_problems(course: Course) -> Iterator[str]:
    """Yield the reasons to refuse a release of a course."""
    if list_missing():
        return
    from grader.release.build import prove_cut
    from grader.release.leaks import find_given_answers

    yield from find_given_answers(KIT, course)
    try:
        with console.status("trying the students' copy (ten seconds or so)"):
            prove_cut(course)
    except Stop as error:
        yield f"this course cannot be released: {error}"
