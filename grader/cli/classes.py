"""Define `grader class`: a class from its first day to its marks, in a folder with its settings."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer

from grader.classroom.job import JOB
from grader.cli.shared import (
    COURSE_HELP,
    Confinement,
    Jobs,
    SecretSeed,
    console,
    print_note,
    print_notes,
    require_checkout,
    require_folder_target,
)
from grader.errors import Stop
from grader.judge.task import Options, shipped_reference
from grader.judge.wall.starting import count_cores, start_server_ahead
from grader.text import join_words, name_command, plural

if TYPE_CHECKING:
    from grader.classroom.dashboard import Entry
    from grader.classroom.feedback import Feedback
    from grader.classroom.folder import ClassFolder
    from grader.classroom.grading import ClassOptions
    from grader.classroom.marks import Scores
    from grader.questions.marking import Marking

OTHER_RECIPIENTS = ("email", "nbgrader")  # recipients of feedback besides learning systems

app = typer.Typer()
class_app = typer.Typer(help="A class, in a folder with its settings.", no_args_is_help=True)
app.add_typer(class_app, name="class")

Folder = Annotated[Path, typer.Argument(help="The folder of the class.")]
OtherCourse = Annotated[
    bool, typer.Option("--other-course", help="Replace results of another course.")
]


@class_app.command("new")
def new_command(
    folder: Folder,
    roster: Annotated[
        Path | None, typer.Option(help="The class list, as the learning system exports it.")
    ] = None,
    submissions: Annotated[
        Path | None, typer.Option(help="The export: a zip or folder; may come later.")
    ] = None,
    course: Annotated[Path | None, typer.Option(help=COURSE_HELP)] = None,
    seed: SecretSeed = None,
    earlier: Annotated[
        list[Path] | None, typer.Option(help="An earlier class to compare with; repeatable.")
    ] = None,
    other_course: OtherCourse = False,
) -> None:
    """Make a class, or change its settings. Exit status 1: there are problems."""
    require_folder_target(folder, "the class")
    from grader.classroom.course_check import find_problems
    from grader.classroom.folder import FILE, remember_class, shorten_path

    paths = {"roster": roster, "submissions": submissions, "course": course}
    for name, path in paths.items():
        if path is not None and not path.exists():
            raise Stop(f"--{name} {path}: there is no such file: name one that exists")
    named: dict[str, object] = {
        name: shorten_path(path, folder) for name, path in paths.items() if path is not None
    }
    if seed is not None:
        named["seed"] = seed
    if earlier:
        named["earlier"] = [shorten_path(path, folder) for path in earlier]
    made = remember_class(folder, named, other_course)
    problems = find_problems(made)
    print_notes(describe_class(made))
    print_notes(problems or ["No problems found."])
    print_note(f"The class is in {folder / FILE}. Next: {name_command('class grade', folder)}")
    raise typer.Exit(1 if problems else 0)


def describe_class(made: "ClassFolder") -> list[str]:
    """Return lines on the course, students and submissions of a class."""
    course, students = made.course, len(made.list_people().names)
    listed = f"{plural(students, 'student')} in {made.roster}" if made.roster else "no class list"
    counted = course.rubric.main_todos
    bonus = [todo.id for todo in course.rubric.todos if todo not in counted]
    todos = ", ".join(todo.id for todo in counted) + f"; bonus {', '.join(bonus)}" * bool(bonus)
    here = "" if made.submissions.exists() else ", not there yet"
    return [
        f"course:      {course.title}, {course.rubric.max_points} points, TODO {todos}",
        f"students:    {listed}" + f" ({made.settings.system})" * bool(made.settings.system),
        f"submissions: {made.submissions}{here}",
    ]


@class_app.command("grade")
def grade_command(
    folder: Folder = Path("."),
    jobs: Jobs = 0,
    isolation: Confinement = "auto",
    cluster: Annotated[str, typer.Option(help="Grade on the Dask cluster at this address.")] = "",
    other_course: OtherCourse = False,
) -> None:
    """Grade new and changed submissions, and write pages and table.

    Exit status 0: all graded, 2: some need manual review, or nothing could be graded.
    """
    if cluster and jobs:
        raise Stop("--jobs would be ignored with --cluster: its workers say how many at a time")
    if not cluster:
        start_server_ahead(JOB)  # it loads while this process reads the class
    known = open_folder(folder)
    submissions = known.find_submissions()
    if not other_course:
        known.refuse_other_course("grade all of it again with --other-course")
    from grader.classroom.grading import ClassOptions

    options = Options(shipped_reference(), isolation, seed=known.settings.seed, course=known.course)
    wanted = ClassOptions(
        options,
        known.results,
        jobs or count_cores(),
        adjust=known.decisions,
        cluster=cluster,
        people=known.list_people(),
        earlier=known.earlier,
    )
    grade_folder(submissions, wanted, known.locate(known.settings.decisions), folder)


def open_folder(folder: Path) -> "ClassFolder":
    from grader.classroom.folder import read_class_folder

    return read_class_folder(folder)


def grade_folder(
    path: Path, wanted: "ClassOptions", decisions: Path | None = None, folder: Path = Path()
) -> NoReturn:
    """Grade a class, and end with the status of the command."""
    from grader.classroom.grading import run_class

    try:
        run = run_class(path, wanted, console)
    except KeyboardInterrupt:
        words = "stopped; what is graded stays, and the same command goes on from there"
        raise Stop(words) from None
    open_ones = [each for each in run.outcomes if each.mark is None]
    if open_ones and decisions is not None:
        needed = "1 needs" if len(open_ones) == 1 else f"{len(open_ones)} need"
        print_note(f"{needed} manual review: set points in {decisions}")
        print_note(f"or decide on a page: {name_command('class review', folder)}")
    raise typer.Exit(2 if open_ones else 0)


@class_app.command("review")
def review_command(folder: Folder = Path(".")) -> None:
    """Open a local page to decide what needs manual review."""
    known = open_folder(folder)
    from grader.classroom.review_server import open_review

    with open_review(known) as server:
        print_note(f"Review: {server.address}")
        print_note("Only this machine and this address reach it. Ctrl-C ends it.")
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            print_note(f"Ended. Next: {name_command('class grade', folder)}")


@class_app.command("mail")
def mail_command(folder: Folder = Path(".")) -> None:
    """Write mail drafts to students who must hand in again. Nothing is sent."""
    known = open_folder(folder)
    results, path = known.find_results(), known.find_roster("a mail")
    from grader.classroom.dashboard import read_outcomes
    from grader.classroom.mail import DRAFTS, find_decided, keep_edited, write_mail
    from grader.intake.systems import read_roster
    from grader.report.files import write_whole

    listed = read_roster(path)
    key = listed.choose_key(known.settings.key)
    outcomes = list(read_outcomes(results))
    decided = list(find_decided(outcomes, known.resolve_decisions([o.name for o in outcomes])))
    asked = [each for each in outcomes if each not in decided]
    made = write_mail(listed, key, asked, known.course.title)
    made.notes += [f"{each.label}: no mail, decided since: grade again" for each in decided]
    keep_edited(folder, made)
    for name, content in made.files.items():
        write_whole(content, folder / name)
    drafts = plural(len(made.files) - 1, "draft")
    print_notes(
        [*made.notes, f"{drafts} in {folder / DRAFTS}, and a list in {folder / 'mail.csv'}"]
    )
    print_note("Nothing was sent: open the drafts with your mail program.")


@class_app.command("marks")
def marks_command(
    folder: Folder = Path("."),
    so_far: Annotated[bool, typer.Option(help="Count ungraded work as 0.")] = False,
    others_known: Annotated[
        bool, typer.Option(help="No submission outside the class list is by a listed student.")
    ] = False,
) -> None:
    """Write marks.csv, the gradebook with marks. Exit status 1: some students have none.

    With a gradebook of nbgrader, its notebooks count as marks.toml says.
    """
    known = open_folder(folder)
    path = known.find_roster("a gradebook")
    from grader.classroom.marks import make_marks
    from grader.intake.systems import read_roster
    from grader.report.files import write_whole

    listed, out = read_roster(path), folder / "marks.csv"
    scores, notes = read_scores(known, so_far, others_known)
    made = make_marks(listed, listed.choose_key(known.settings.key), scores)
    write_whole(made.text.encode(made.encoding), out)
    print_notes([*notes, *made.notes])
    print_note(f"{made.given} of {len(listed.rows)} marks are in {out}")
    raise typer.Exit(0 if made.given == len(listed.rows) else 1)


def read_scores(
    known: "ClassFolder", so_far: bool, others_known: bool
) -> "tuple[Scores, list[str]]":
    """Return each student's parts of the mark, the rules to combine them, and notes on results.

    Results cover the engine only, so the shares of notebooks do not count there.
    """
    from grader.classroom.dashboard import read_outcomes
    from grader.classroom.marks import (
        Scores,
        compare_totals,
        load_marking,
        make_parts,
        mark_engine,
    )

    if known.nbgrader:
        from grader.classroom.nbgrader.gradebook import read_parts

        marking = load_marking(known.marks, known.course)
        return Scores(read_parts(known.nbgrader, marking), marking, so_far, others_known), []
    outcomes = read_outcomes(known.find_results())
    marking = mark_engine(known.marks, known.course)
    notes = [f"{each.name}: {each.explain()}" for each in outcomes if each.explain()]
    notes += compare_totals(marking, known.course)
    return Scores(make_parts(outcomes), marking, so_far, others_known), notes


@class_app.command("upload")
def upload_command(
    folder: Folder = Path("."),
    to: Annotated[str, typer.Option(help="The assignment in Canvas, by its page's address.")] = "",
    send: Annotated[bool, typer.Option("--send", help="Send what the table shows.")] = False,
    over: Annotated[
        bool, typer.Option("--over", help="Replace marks that a person entered in Canvas.")
    ] = False,
    others_known: Annotated[
        bool, typer.Option(help="No submission outside the class list is by a listed student.")
    ] = False,
) -> None:
    """Show the marks and pages to send to Canvas, or send them. Exit status 1: some were skipped.

    The environment variable CANVAS_TOKEN holds the access token.
    """
    known = open_folder(folder)
    try:
        from grader.classroom.canvas import upload_class
    except ModuleNotFoundError as error:
        words = f"class upload needs {error.name}: {sys.executable} -m pip install canvasapi"
        raise Stop(words) from error
    left_out = upload_class(known, to, send, over, others_known, console)
    raise typer.Exit(1 if left_out else 0)


@class_app.command("feedback")
def feedback_command(
    folder: Folder = Path("."),
    for_: Annotated[
        str,
        typer.Option(
            "--for", help="email, nbgrader or a learning system; the class's own if left out."
        ),
    ] = "",
) -> None:
    """Write each student's page for feedback. Exit status 1: some students were skipped."""
    known = open_folder(folder)
    results = known.find_results()
    from grader.classroom.dashboard import read_class, write_dashboard
    from grader.classroom.feedback import zip_files
    from grader.intake.learning_systems import BY_NAME
    from grader.report.files import write_whole

    system = BY_NAME.get(known.settings.system)
    recipient = for_ or (system.name if system and system.takes_feedback else "email")
    systems = [name for name, each in BY_NAME.items() if each.takes_feedback]
    if recipient not in (*systems, *OTHER_RECIPIENTS):
        every = ", ".join((*systems, *OTHER_RECIPIENTS))
        raise Stop(f"--for {recipient}: it is not one of {every}")
    entries = read_class(results)
    write_dashboard(results, entries, known.course)
    made = make_feedback(known, recipient, entries)
    target = folder / "feedback"
    if recipient in systems:
        target = folder / "feedback.zip"
        write_whole(zip_files(made.files), target)
    else:
        for file, content in made.files.items():
            write_whole(content, target / file)
    print_notes([*made.notes, f"wrote {plural(len(made.files), 'file')} to {target}"])
    raise typer.Exit(1 if made.notes else 0)


def make_feedback(known: "ClassFolder", recipient: str, graded: "list[Entry]") -> "Feedback":
    """Make each student's page for a learning system, for mail or for nbgrader."""
    from grader.classroom import feedback
    from grader.intake.learning_systems import BY_NAME
    from grader.intake.listing import open_class
    from grader.intake.systems import read_roster

    if recipient == "nbgrader":
        return feedback.place_for_nbgrader(graded)
    if recipient == "email":
        roster = read_roster(known.find_roster("a mail"))
        return feedback.address_pages(roster, roster.choose_key(known.settings.key), graded)
    people, submissions = known.list_people(), known.find_submissions()
    with open_class(submissions, people) as intake:
        if others := sorted(set(intake.names) - {each.outcome.name for each in graded}):
            raise Stop(
                f"{known.results} has no result of {join_words(others)} in {submissions}: name the "
                "class as it was graded, or grade it again"
            )
        return feedback.answer_export(BY_NAME[recipient], intake, graded, people, known.course)


@class_app.command("questions")
def questions_command(
    folder: Folder = Path("."),
    practice: Annotated[
        bool, typer.Option("--practice", help="Sheets with other numbers, and answers to open.")
    ] = False,
    mark: Annotated[
        Path | None, typer.Option(help="Mark answers on paper, a CSV: student, question, answer.")
    ] = None,
    isolation: Confinement = "auto",
) -> None:
    """Make a sheet of questions for each student about their own program, with its key.

    Exit status 0: every student has a sheet, or every answer is marked, 1: some are missing.
    """
    require_checkout("class questions")
    known, out = open_folder(folder), folder / "questions"
    from grader.cli.questions import make_sheets, mark_class

    if mark is not None:
        if practice:
            raise Stop("--practice would be ignored with --mark, which makes no sheets")
        mark_class(mark, out, lambda marked: write_sheet_marks(known, marked, out))
    results, submissions = known.find_results(), known.find_submissions()
    from grader.questions.making import Making

    options = Options(shipped_reference(), isolation, course=known.course)
    making = Making(out, options, None, practice, results)
    make_sheets(making, submissions, known.list_people())


def write_sheet_marks(known: "ClassFolder", marked: "Marking", out: Path) -> list[str]:
    """Write the points of the sheets into a gradebook; return notes on it."""
    if known.roster is None:
        return []
    from grader.classroom.marks import load_marking, make_marks, score_sheets
    from grader.intake.systems import read_roster

    listed = read_roster(known.roster)
    counted = [each for each in marked.totals if each.student not in marked.silent]
    scores = score_sheets(counted, known.course, load_marking(known.marks, known.course).decimals)
    made = make_marks(listed, listed.choose_key(known.settings.key), scores)
    (out / "marks.csv").write_bytes(made.text.encode(made.encoding))
    title, total = scores.marking.title, scores.marking.total
    column = f"column {title!r}, out of {total:g}"
    count = f"{made.given} of {len(listed.rows)} marks are in {out / 'marks.csv'}, {column}"
    return [*made.notes, count]
