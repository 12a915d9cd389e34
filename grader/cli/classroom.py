"""The commands for a class: a course with nbgrader, and marks for an LMS.

Each imports what it needs itself: all of it together would add a tenth of a second to every start
of the grader, `check` included.
"""

from contextlib import ExitStack
from pathlib import Path
from typing import Annotated, Literal

import msgspec
import typer

from grader.cli.shared import (
    CourseFile,
    console,
    course_in,
    needs_checkout,
    refuse_ignored,
    stop,
)
from grader.judge.course import COURSE_FILE
from grader.judge.grade import KIT, Options, shipped_reference
from grader.judge.isolation import Isolation
from grader.judge.submission import CannotGrade
from grader.text import clean

app = typer.Typer()
course_app = typer.Typer(help="A course with nbgrader.", no_args_is_help=True)
app.add_typer(course_app, name="nbgrader")

Course = Annotated[Path, typer.Option(help="The course folder.")]
TakenFile = Annotated[  # where --course is nbgrader's folder
    Path | None,
    typer.Option(
        "--course-file",
        envvar=COURSE_FILE,
        show_envvar=False,
        help="What the course takes of the kit; its course.toml if left out.",
    ),
]
Feedbacks = Literal["moodle", "canvas", "brightspace", "email", "nbgrader"]


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
    taken: TakenFile = None,
) -> None:
    """Make a course folder: the notebooks, the students' files, and nbgrader's settings."""
    needs_checkout("nbgrader course")
    from grader.classroom.nbgrader.submissions import ASSIGNMENT, NoCourse
    from grader.release.nbgrader_course import make_course, newest_release

    release = None if without_checks else release or newest_release(KIT / "build" / "release")
    if release is None and not without_checks:
        stop("there is no release in build/release, which has the checks: make release", "go on")
    try:
        files = make_course(course, renew, release, course_in(taken))
    except NoCourse as error:
        stop(str(error), "go on")
    console.print(f"{len(files)} files are in {course / 'source' / ASSIGNMENT}")
    console.print(f"Next, in {course}: nbgrader generate_assignment {ASSIGNMENT}")


@course_app.command("collect")
def collect_command(
    folder: Annotated[Path, typer.Argument(help="A folder of submissions, a folder each.")],
    course: Course = Path("."),
) -> None:
    """Take submissions into the course folder. Exit status 1: a name could not be used."""
    needs_checkout("nbgrader collect")
    from grader.classroom.nbgrader.submissions import ASSIGNMENT, NoCourse, collect

    try:
        taken = list(collect(folder, course))
    except NoCourse as error:
        stop(str(error), "go on")
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
    course: Course = Path("."),
    jobs: Annotated[int, typer.Option(help="Submissions at a time; 0 for one per core.")] = 0,
    isolation: Annotated[Isolation, typer.Option(help="Confinement to insist on.")] = "auto",
    seed: Annotated[
        int | None, typer.Option(help="A secret seed: other numbers in every check.")
    ] = None,
    taken: TakenFile = None,
) -> None:
    """Write the grader's marks into the gradebook. Exit status 1: not for everyone."""
    if results:
        given = ("jobs", "isolation", "seed")
        refuse_ignored(context, given, "with results, which are graded already")
    from grader.classroom.nbgrader.gradebook import fill, read_results
    from grader.classroom.nbgrader.submissions import NoCourse, grade_submitted

    troubles: list[str] = []
    try:
        if not results:
            options = Options(shipped_reference(), isolation, seed=seed, course=course_in(taken))
            troubles = grade_submitted(course, options, jobs, console)
        outcomes = list(fill(course, read_results(results or [course / "results"])))
    except (NoCourse, CannotGrade) as error:
        stop(str(error), "go on")
    for each in outcomes:
        if isinstance(each, str):
            troubles.append(each)
            continue
        console.print(f"{clean(each.student)}: {each.points:g} / {each.max_points:g}")
        for note in each.notes:
            console.print(f"  {clean(note)}")
    for trouble in troubles:
        console.print(clean(trouble))
    raise typer.Exit(1 if troubles else 0)


@course_app.command("release")
def release_command() -> None:
    """Renew the notebooks that the starter holds, by nbgrader itself."""
    needs_checkout("nbgrader release")
    from grader.classroom.nbgrader.submissions import NoCourse
    from grader.release import nbgrader_notebooks as notebooks

    try:
        names = notebooks.release(KIT)
    except NoCourse as error:
        stop(str(error), "go on")
    console.print(f"renewed {', '.join(names) or 'nothing'}")


@app.command("gradescope")
def gradescope_command(
    out: Annotated[Path, typer.Option(help="The zip to write.")] = (
        KIT / "build" / "gradescope" / "autograder.zip"
    ),
    wheels: Annotated[
        str, typer.Option(help="Put all packages in, for this Python, such as 3.11.")
    ] = "",
    isolation: Annotated[Isolation, typer.Option(help="Confinement to insist on.")] = "auto",
    seed: Annotated[
        int | None, typer.Option(help="A secret seed: other numbers in every check.")
    ] = None,
    course: CourseFile = None,
) -> None:
    """Make the autograder for Gradescope. It holds the solution: it is for you alone."""
    needs_checkout("gradescope")
    from grader.classroom.gradescope import NoWheels, write_autograder
    from grader.classroom.gradescope.autograder import Settings

    try:
        write_autograder(out, Settings(isolation, seed, course_in(course)), wheels)
    except NoWheels as error:
        stop(str(error), "go on")
    console.print(f"made {out}", soft_wrap=True)


@app.command("dashboard")
def dashboard_command(
    context: typer.Context,
    results: Annotated[Path, typer.Argument(help="The results of a class, a folder.")],
    submissions: Annotated[
        Path | None, typer.Option(help="The class itself: one student's replay per known mistake.")
    ] = None,
    roster: Annotated[
        Path | None, typer.Option(help="Its list, if it was graded with one.")
    ] = None,
    seed: Annotated[int | None, typer.Option(help="The seed it was graded with.")] = None,
    course: CourseFile = None,
) -> None:
    """Make a page of a class, and beside it a report for each student."""
    if submissions is None:
        refuse_ignored(context, ("roster", "seed"), "without --submissions")
    from grader.classroom.dashboard import NoResults, read_class, with_replays, write_dashboard
    from grader.intake.listing import opened_class
    from grader.intake.roster import people_of

    taken = course_in(course)
    try:
        entries = read_class(results)
        if submissions is not None:
            options = Options(shipped_reference(), seed=seed, course=taken)
            with opened_class(submissions, people_of(submissions, roster)) as intake:
                entries = list(with_replays(entries, intake, options, results))
        page = write_dashboard(results, entries, taken)
    except (CannotGrade, NoResults) as error:
        stop(str(error), "go on")
    console.print(f"made {page}", soft_wrap=True)


@app.command("course-check")
def course_check_command(
    submissions: Annotated[
        Path | None, typer.Argument(help="Submissions, all or some: read, and not graded.")
    ] = None,
    roster: Annotated[Path | None, typer.Option(help="The class list.")] = None,
    key: Annotated[str, typer.Option(help="Its column that names students.")] = "",
    adjust: Annotated[Path | None, typer.Option(help="The adjustments.")] = None,
    settings: Annotated[
        Path | None, typer.Option(help="marks.toml: what the parts are worth, and the title.")
    ] = None,
    course: CourseFile = None,
) -> None:
    """Say what would go wrong, before it does. Exit status 1: something would."""
    from grader.classroom.course_check import Files, faults_of_course
    from grader.intake.roster import beside

    if submissions is not None:
        roster = roster or beside(submissions, "roster.csv")
        adjust = adjust or beside(submissions, "adjustments.toml")
    faults = list(faults_of_course(Files(roster, key, adjust, settings, submissions), course))
    for fault in faults:
        console.print(clean(fault), soft_wrap=True)
    if not faults:
        console.print("Nothing would go wrong with what is there.")
    raise typer.Exit(1 if faults else 0)


@app.command("alike")
def alike_command(
    results: Annotated[Path, typer.Argument(help="The results of a class, a folder.")],
    submissions: Annotated[Path, typer.Option(help="The class as it was graded.")],
    also: Annotated[
        list[Path] | None, typer.Option(help="Another class, as last year's; may be repeated.")
    ] = None,
    roster: Annotated[
        Path | None, typer.Option(help="The class list, if it was graded with one.")
    ] = None,
    least: Annotated[
        float, typer.Option(min=0, max=1, help="The share above which a pair is shown.")
    ] = 0.5,
    course: CourseFile = None,
) -> None:
    """Show which submissions are alike, also those of earlier years, on the page of the class."""
    from grader.classroom.dashboard import NoResults, read_class, write_dashboard
    from grader.classroom.similarity import alike, prints_of_class, write_alike
    from grader.intake.roster import people_of

    taken = course_in(course)
    try:
        entries = read_class(results)
        with ExitStack() as stack:
            found, prints = prints_of_class(stack, submissions, people_of(submissions, roster))
            here = {each.name for each in prints}
            for folder in also or []:
                others, more = prints_of_class(stack, folder, people_of(folder, None), folder.name)
                found |= others
                prints += more
            pairs = alike(prints, least, here)
            page = write_alike(results, pairs, found, least)
        write_dashboard(results, entries, taken)
    except (CannotGrade, NoResults) as error:
        stop(str(error), "go on")
    console.print(f"{len(pairs)} pairs are on {page}", soft_wrap=True)


@app.command("feedback")
def feedback_command(
    results: Annotated[Path, typer.Argument(help="The results of a class, a folder.")],
    for_: Annotated[
        Feedbacks, typer.Option("--for", help="Who takes it: the LMS, mail, or nbgrader.")
    ],
    submissions: Annotated[
        Path | None, typer.Option(help="The class as it was graded; for an LMS.")
    ] = None,
    roster: Annotated[Path | None, typer.Option(help="The class list; needed for email.")] = None,
    key: Annotated[str, typer.Option(help="Its column that names students.")] = "",
    out: Annotated[
        Path | None, typer.Option(help="The zip, or for email and nbgrader the folder, to write.")
    ] = None,
    course: CourseFile = None,
) -> None:
    """Put everybody's page where it can go back from. Exit status 1: somebody was left out."""
    from grader.classroom import feedback
    from grader.classroom.dashboard import NoResults, read_class, write_dashboard
    from grader.intake.listing import opened_class
    from grader.intake.roster import CannotRead, beside, people_of, read_roster
    from grader.report.files import write_whole

    taken = course_in(course)
    try:
        entries = read_class(results)
        write_dashboard(results, entries, taken)
        pages = results.resolve()
        if for_ == "nbgrader":
            made = feedback.for_nbgrader(entries, pages)
        elif for_ == "email":
            listed = roster or (beside(submissions, "roster.csv") if submissions else None)
            if listed is None:
                stop("addresses are in the class list: name it with --roster", "go on")
            book = read_roster(listed)
            made = feedback.by_address(book, book.key(key), entries, pages)
        else:
            if submissions is None:
                stop(f"{for_} knows files by the names it gave: name --submissions", "go on")
            people = people_of(submissions, roster)
            with opened_class(submissions, people) as intake:
                made = feedback.by_export(for_, intake, entries, pages, taken, people)
    except (CannotGrade, CannotRead, NoResults) as error:
        stop(str(error), "go on")
    name = results.resolve().name
    if for_ in ("email", "nbgrader"):
        target = out or (
            Path("feedback") if for_ == "nbgrader" else results.parent / f"{name}-mail"
        )
        for file, content in made.files.items():
            write_whole(content, target / file)
    else:
        target = out or results.resolve().with_name(f"{name}-{for_}.zip")
        write_whole(made.zipped(), target)
    for note in made.notes:
        console.print(clean(note), soft_wrap=True)
    console.print(f"{len(made.files)} files are in {target}", soft_wrap=True)
    raise typer.Exit(1 if made.notes else 0)


List = Annotated[Path, typer.Argument(help="The class list: the gradebook as the LMS exports it.")]
Key = Annotated[str, typer.Option(help="Its column that names students as their folders do.")]


@app.command("marks")
def marks_command(
    roster: List,
    course: Annotated[Path | None, typer.Option(help="The course folder of nbgrader.")] = None,
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
    taken: TakenFile = None,
) -> None:
    """Make one mark per student, in the gradebook's own form.

    Exit status 0: everybody in the class list has a mark, 1: not everybody, 2: no file was made.
    """
    if settings is None and course is None:
        needs_checkout("marks", ", or name marks.toml with --settings")
    from grader.classroom.dashboard import NoResults, read_class
    from grader.classroom.marks import ENGINE, load_marking, marks, parts_from_results, why
    from grader.classroom.nbgrader.gradebook import parts_from_gradebook
    from grader.classroom.nbgrader.submissions import NoCourse
    from grader.intake.roster import CannotRead, read_roster
    from grader.release.nbgrader_course import INSTRUCTOR

    try:
        listed = read_roster(roster)
        column = listed.key(key)
        path = settings or (course if course else INSTRUCTOR) / "marks.toml"
        marking = load_marking(path, course_in(taken))
        if results is not None:
            marking = msgspec.structs.replace(marking, shares={ENGINE: 1})
            outcomes = [each.outcome for each in read_class(results)]
            scores = parts_from_results(outcomes)
            told = [f"{each.name}: {why(each)}" for each in outcomes if why(each)]
        else:
            scores, told = parts_from_gradebook(course or Path("."), marking), []
        made = marks(listed, column, scores, marking, so_far, others_known)
    except (CannotRead, NoCourse, NoResults) as error:
        stop(str(error), "go on")
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_bytes(made.text.encode(made.encoding))
    for note in [*told, *made.notes]:
        console.print(clean(note), soft_wrap=True)
    console.print(f"{made.given} of {len(listed.rows)} marks are in {out}")
    raise typer.Exit(0 if made.given == len(listed.rows) else 1)


@course_app.command("roster")
def roster_command(roster: List, course: Course = Path("."), key: Key = "") -> None:
    """Tell the gradebook the names of a class list."""
    from grader.classroom.nbgrader.gradebook import tell_names
    from grader.classroom.nbgrader.submissions import NoCourse
    from grader.intake.roster import CannotRead, read_roster

    try:
        listed = read_roster(roster)
        column = listed.key(key)
        tell_names(course, listed, column)
    except (CannotRead, NoCourse) as error:
        stop(str(error), "go on")
    console.print(f"{len(listed.rows)} students are in the gradebook, by {column}")
