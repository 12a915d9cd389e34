"""Define the commands for a class: a course with nbgrader, and marks for an LMS.

Each imports what it needs itself: all of it together would add a tenth of a second to every start
of the grader, `check` included.
"""

from collections.abc import Collection, Iterator
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import msgspec
import typer

from grader.cli.shared import (
    Confinement,
    CourseFile,
    Jobs,
    ResultsFolder,
    SecretSeed,
    console,
    course_option,
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
from grader.judge.grade import KIT, Options, shipped_reference
from grader.text import clean, listed

if TYPE_CHECKING:
    from grader.classroom.dashboard import Entry
    from grader.classroom.marks import Scores
    from grader.intake import roster as lists

app = typer.Typer()
course_app = typer.Typer(
    help="A course with nbgrader.",
    epilog="Once: course, roster. After a deadline: collect, nbgrader autograde, bridge. "
    "handouts/instructor/nbgrader.md describes each.",
    no_args_is_help=True,
)
app.add_typer(course_app, name="nbgrader", hidden=True)

# Before, --course was nbgrader's folder, and this the course file.
CourseFileToo = Annotated[Path | None, course_option("--course", "--course-file")]
CourseFolder = Annotated[Path, typer.Option("--folder", help="The course folder of nbgrader.")]
ClassList = Annotated[
    Path | None, typer.Option("--roster", help="The class list, if it was graded with one.")
]
Key = Annotated[str, typer.Option(help="Its column that names students as their folders do.")]
Gradebook = Annotated[
    Path, typer.Argument(help="The class list: the gradebook as the LMS exports it.")
]
COURSE = "course.toml"  # in the course folder of nbgrader: what it was made of
OTHER_RECIPIENTS = ("email", "nbgrader")  # beside the learning systems


@course_app.command("course")
def course_command(
    course: Annotated[Path, typer.Argument(help="The course folder to make.")],
    renew: Annotated[bool, typer.Option(help="Replace the assignment's source.")] = False,
    release: Annotated[
        Path | None,
        typer.Option(help="What students get, an archive; the newest in build/release."),
    ] = None,
    without_checks: Annotated[
        bool, typer.Option(help="Make it of the kit as it is: students get nothing to check with.")
    ] = False,
    taken: CourseFileToo = None,
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
    console.print(f"{len(files)} files are in {course / 'source' / ASSIGNMENT}")
    console.print(f"Next, in {course}: nbgrader generate_assignment {ASSIGNMENT}")


def find_course(folder: Path, named: Path | None) -> Path | None:
    """Return the course that is named, or of which the folder was made; None for the kit's own."""
    own = folder / COURSE
    return named or (own if own.is_file() else None)


def refuse_folder(course: Path | None) -> None:
    """Stop where --course names the folder of nbgrader, as it did in earlier versions."""
    if course is not None and course.is_dir():
        raise Stop(f"--course {course} is a folder, and names a course file: say --folder {course}")


@course_app.command("collect")
def collect_command(
    folder: Annotated[Path, typer.Argument(help="A folder of submissions, a folder each.")],
    course: CourseFolder = Path("."),
) -> None:
    """Take submissions into the course folder. Exit status 1: a name could not be used."""
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
    taken: CourseFileToo = None,
) -> None:
    """Write the grader's marks into the gradebook. Exit status 1: not for everyone."""
    refuse_folder(taken)
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
    """Renew the notebooks that the starter holds, by nbgrader itself."""
    require_checkout("nbgrader release")
    from grader.release import nbgrader_notebooks as notebooks

    console.print(f"renewed {', '.join(notebooks.renew_notebooks(KIT)) or 'nothing'}")


@course_app.command("roster")
def roster_command(roster: Gradebook, course: CourseFolder = Path("."), key: Key = "") -> None:
    """Write the names of a class list into the gradebook."""
    from grader.classroom.nbgrader.gradebook import write_names
    from grader.intake.systems import read_roster

    listed = read_roster(roster)
    column = listed.choose_key(key)
    write_names(course, listed, column)
    console.print(f"{len(listed.rows)} students are in the gradebook, by {column}")


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
    """Make the autograder for Gradescope. It holds the solution: it is for you alone."""
    require_checkout("gradescope")
    require_file_target(out, "--out")
    from grader.classroom.gradescope import write_autograder
    from grader.classroom.gradescope.autograder import Settings

    write_autograder(out, Settings(isolation, seed, read_course(course)), wheels)
    print_note(f"made {out}")


@app.command("dashboard")
def dashboard_command(
    context: typer.Context,
    results: ResultsFolder,
    submissions: Annotated[
        Path | None, typer.Option(help="The class itself: one student's replay per known mistake.")
    ] = None,
    roster: ClassList = None,
    seed: Annotated[int | None, typer.Option(help="The seed it was graded with.")] = None,
    course: CourseFile = None,
) -> None:
    """Make a page of a class, and beside it a report for each student."""
    if submissions is None:
        refuse_ignored(context, ("roster", "seed"), "without --submissions")
    from grader.classroom.dashboard import add_replays, read_class, write_dashboard
    from grader.intake.listing import open_class
    from grader.intake.systems import read_class_list

    taken = read_course(course)
    entries = read_class(results)
    if submissions is not None:
        options = Options(shipped_reference(), seed=seed, course=taken)
        with open_class(submissions, read_class_list(submissions, roster)) as intake:
            require_same_class(entries, intake.names, results, submissions)
            entries = list(add_replays(entries, intake, options, results))
    print_note(f"made {write_dashboard(results, entries, taken)}")


@app.command("course-check")
def course_check_command(
    submissions: Annotated[
        Path | None, typer.Argument(help="Submissions, all or some: read, and not graded.")
    ] = None,
    roster: Annotated[Path | None, typer.Option(help="The class list.")] = None,
    key: Key = "",
    adjust: Annotated[Path | None, typer.Option(help="The adjustments.")] = None,
    settings: Annotated[
        Path | None, typer.Option(help="marks.toml: what the parts are worth, and the title.")
    ] = None,
    course: CourseFile = None,
) -> None:
    """Find problems before grading. Exit status 1: there are some."""
    from grader.classroom.course_check import Files, find_problems
    from grader.intake.systems import find_file

    if submissions is not None:
        roster = roster or find_file(submissions, "roster.csv")
        adjust = adjust or find_file(submissions, "adjustments.toml")
    if key and roster is None:
        raise Stop(f"--key {key} would be ignored without a class list: name it with --roster")
    problems = list(find_problems(Files(roster, key, adjust, settings, submissions), course))
    problems = problems or list(find_release_problems(course))
    print_notes(problems or ["No problems found."])
    raise typer.Exit(1 if problems else 0)


def find_release_problems(path: Path | None) -> Iterator[str]:
    """Yield why a release of the course would be refused; nothing of a course that is invalid."""
    if list_missing():
        return
    from grader.release.build import prove_cut
    from grader.release.leaks import find_given_answers

    with suppress(WrongCourse):
        course = read_course(path)
        yield from find_given_answers(KIT, course)
        try:
            with console.status("trying the students' copy (ten seconds or so)"):
                prove_cut(course)
        except Stop as error:
            yield f"this course cannot be released: {error}"


def require_same_class(
    entries: "list[Entry]", names: Collection[str], results: Path, submissions: Path
) -> None:
    """Stop where results and submissions are of two classes."""
    known = {entry.outcome.name for entry in entries}
    if others := sorted(name for name in names if name not in known):
        raise Stop(
            f"{results} has no result of {listed(others)} in {submissions}: name the class as it "
            "was graded, or grade it again"
        )


@app.command("alike")
def alike_command(
    results: ResultsFolder,
    submissions: Annotated[Path, typer.Option(help="The class as it was graded.")],
    also: Annotated[
        list[Path] | None, typer.Option(help="Another class, as last year's; may be repeated.")
    ] = None,
    roster: ClassList = None,
    least: Annotated[
        float, typer.Option(min=0, max=1, help="The share above which a pair is shown.")
    ] = 0.5,
    course: CourseFile = None,
) -> None:
    """Show similar submissions, also those of earlier years, on the page of the class."""
    from grader.classroom.dashboard import read_class, write_dashboard
    from grader.classroom.similarity import find_pairs, read_prints, write_pairs
    from grader.intake.systems import read_class_list

    taken = read_course(course)
    entries = read_class(results)
    with ExitStack() as stack:
        people = read_class_list(submissions, roster)
        found, prints = read_prints(stack, submissions, people)
        here = {each.name for each in prints}
        require_same_class(entries, here, results, submissions)
        for folder in also or []:
            people = read_class_list(folder, None)
            others, more = read_prints(stack, folder, people, folder.name)
            found |= others
            prints += more
        pairs = find_pairs(prints, least, here)
        page = write_pairs(results, pairs, found, least)
    write_dashboard(results, entries, taken)
    print_note(f"{len(pairs)} pairs are on {page}")


@app.command("feedback")
def feedback_command(
    results: ResultsFolder,
    for_: Annotated[
        str, typer.Option("--for", help="Who takes it: the LMS by its name, email, or nbgrader.")
    ],
    submissions: Annotated[
        Path | None, typer.Option(help="The class as it was graded; for an LMS.")
    ] = None,
    roster: Annotated[Path | None, typer.Option(help="The class list; needed for email.")] = None,
    key: Key = "",
    out: Annotated[
        Path | None, typer.Option(help="The zip, or for email and nbgrader the folder, to write.")
    ] = None,
    course: CourseFile = None,
) -> None:
    """Write everybody's page for the way back. Exit status 1: somebody was left out."""
    from grader.intake.systems import find_file

    listed = roster or (find_file(submissions, "roster.csv") if submissions else None)
    return_feedback(for_, results, Sources(submissions, listed, key, read_course(course)), out)


@dataclass(frozen=True)
class Sources:
    """Hold what pages are made of besides the results."""

    submissions: Path | None
    roster: Path | None
    key: str
    course: Course
    people: "lists.ClassList | None" = None


def return_feedback(recipient: str, results: Path, sources: Sources, out: Path | None) -> NoReturn:
    """Write everybody's page for whoever takes it, and end with the status of the command."""
    from grader.classroom import feedback
    from grader.classroom.dashboard import read_class, write_dashboard
    from grader.intake.listing import open_class
    from grader.intake.systems import BY_NAME, read_class_list, read_roster
    from grader.report.files import write_whole

    systems = [name for name, system in BY_NAME.items() if system.takes_feedback]
    if recipient not in (*systems, *OTHER_RECIPIENTS):
        known = ", ".join((*systems, *OTHER_RECIPIENTS))
        raise typer.BadParameter(f"{recipient!r} is not one of {known}", param_hint="--for")
    check_target = require_folder_target if recipient in OTHER_RECIPIENTS else require_file_target
    check_target(out, "--out")
    submissions, roster = sources.submissions, sources.roster
    entries = read_class(results)
    write_dashboard(results, entries, sources.course)
    results = results.resolve()
    graded = feedback.GradedClass(entries, results, sources.course)
    if recipient == "nbgrader":
        made, target = feedback.place_for_nbgrader(graded), Path("feedback")
    elif recipient == "email":
        if roster is None:
            raise Stop("addresses are in the class list: name it with --roster")
        book = read_roster(roster)
        made = feedback.address_pages(book, book.choose_key(sources.key), graded)
        target = results.with_name(f"{results.name}-mail")
    else:
        if submissions is None:
            raise Stop(f"{recipient} knows files by the names it gave: name --submissions")
        people = sources.people or read_class_list(submissions, roster)
        with open_class(submissions, people) as intake:
            require_same_class(entries, intake.names, results, submissions)
            made = feedback.answer_export(BY_NAME[recipient], intake, graded, people)
        target = results.with_name(f"{results.name}-{recipient}.zip")
    target = out or target
    if recipient in OTHER_RECIPIENTS:
        for file, content in made.files.items():
            write_whole(content, target / file)
    else:
        write_whole(feedback.zip_files(made.files), target)
    print_notes([*made.notes, f"{len(made.files)} files are in {target}"])
    raise typer.Exit(1 if made.notes else 0)


@app.command("marks")
def marks_command(
    roster: Gradebook,
    course: Annotated[
        Path | None, typer.Option("--folder", help="The course folder of nbgrader.")
    ] = None,
    results: Annotated[
        Path | None, typer.Option(help="Instead: a folder of result files; the engine alone.")
    ] = None,
    out: Annotated[Path, typer.Option(help="The file for the LMS.")] = Path("marks.csv"),
    key: Key = "",
    settings: Annotated[
        Path | None, typer.Option(help="What the parts are worth; marks.toml of the course.")
    ] = None,
    so_far: Annotated[bool, typer.Option(help="Count what waits for a person as 0.")] = False,
    others_known: Annotated[
        bool, typer.Option(help="Who handed in and is not in the class list is nobody in it.")
    ] = False,
    taken: CourseFileToo = None,
) -> None:
    """Make one mark per student, in the gradebook's own form.

    Exit status 0: everybody in the class list has a mark, 1: not everybody, 2: no file was made.
    """
    require_file_target(out, "--out")
    refuse_folder(taken)
    if results is None and not (course or Path(".")).joinpath("gradebook.db").is_file():
        raise Stop("name --results, the folder of a graded class, or --folder, one of nbgrader")
    if settings is None and course is None:
        require_checkout("marks", ", or name marks.toml with --settings")
    from grader.intake.systems import read_roster
    from grader.release.nbgrader_course import INSTRUCTOR

    listed = read_roster(roster)
    column = listed.choose_key(key)
    path = settings or (course if course else INSTRUCTOR) / "marks.toml"
    assessed = Assessed(read_course(taken), path, results, course or Path("."))
    scores, notes = read_scores(assessed, so_far, others_known)
    write_marks(listed, column, scores, out, notes)


@dataclass(frozen=True)
class Assessed:
    """Name what marks are made of: a class's results, or the gradebook in nbgrader's folder."""

    course: Course
    settings: Path | None  # marks.toml
    results: Path | None = None
    folder: Path = Path(".")


def read_scores(assessed: Assessed, so_far: bool, others_known: bool) -> "tuple[Scores, list[str]]":
    """Return everybody's parts and how to make marks of them, and what to say of the results.

    Results hold the engine alone, so the shares of notebooks do not count there.
    """
    from grader.classroom.dashboard import read_outcomes
    from grader.classroom.marks import ENGINE, Scores, compare_totals, load_marking, make_parts

    marking = load_marking(assessed.settings, assessed.course)
    if assessed.results is None:
        from grader.classroom.nbgrader.gradebook import read_parts

        parts = read_parts(assessed.folder, marking)
        return Scores(parts, marking, so_far, others_known), []
    marking = msgspec.structs.replace(marking, shares={ENGINE: 1})
    outcomes = read_outcomes(assessed.results)
    notes = [f"{each.name}: {each.explain()}" for each in outcomes if each.explain()]
    notes += compare_totals(marking, assessed.course)
    return Scores(make_parts(outcomes), marking, so_far, others_known), notes


def write_marks(
    listed: "lists.Roster", column: str, scores: "Scores", out: Path, notes: list[str]
) -> NoReturn:
    """Write the file for the LMS, and end with the status of the command."""
    from grader.classroom.marks import make_marks

    made = make_marks(listed, column, scores)
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_bytes(made.text.encode(made.encoding))
    print_notes([*notes, *made.notes])
    console.print(f"{made.given} of {len(listed.rows)} marks are in {out}", soft_wrap=True)
    raise typer.Exit(0 if made.given == len(listed.rows) else 1)
