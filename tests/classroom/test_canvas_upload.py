"""Test the upload of marks to Canvas: once, to the right student, overwriting no decision."""

import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import classes
import packed
import pytest
from canvas_server import TOKEN, Canvas
from command_line import run_grader
from points_pool import Inline

from grader.classroom import grading

COURSE = 'title = "Lab 3"\ntodos = ["8a"]\nout_of = 10\n[points]\n8a = 20\n'
POINTS = {"ann": 5, "ben": 10, "cem": 20, "finn": 7}
STUDENTS = ("ann", "ben", "cem", "dora", "eve", "finn")  # 1 to 6 in Canvas
IN_CANVAS = [1, 2, 3, 4, 5]  # finn has left the course
DECISION = '[[adjust]]\nstudent = "ben"\nadd = %d\nreason = "shown in the lab"\n'


@pytest.fixture(scope="module", autouse=True)
def library() -> None:
    """Import the library. While tests are collected, that would slow down every fork."""
    pytest.importorskip(
        "canvasapi", reason="needs the extra `canvas`, whose library sends marks to Canvas"
    )


@pytest.fixture(scope="module")
def listening() -> Iterator[Canvas]:
    made = Canvas()
    yield made
    made.shutdown()
    made.server_close()


@pytest.fixture
def server(listening: Canvas) -> Canvas:
    listening.begin(IN_CANVAS)
    return listening


@pytest.fixture(scope="module")
def graded_class(tmp_path_factory: pytest.TempPathFactory, listening: Canvas) -> Path:
    """Make a graded class: dora handed in nothing, and eve's work needs review.

    Canvas does not have its marks yet, but its address is known.
    """
    rows = [f'"{name.title()}, A",{n},{name},' for n, name in enumerate(STUDENTS, 1)]
    lines = ["Student,ID,SIS Login ID,Section", "    Points Possible,,,", *rows, ""]
    lab = tmp_path_factory.mktemp("class")
    (lab / "roster.csv").write_text("\n".join(lines), encoding="utf-8")
    (lab / "course.toml").write_text(COURSE, encoding="utf-8")
    for name, points in POINTS.items():
        classes.put(lab / "submissions" / f"{name}.zip", packed.as_zip(classes.work(points)))
    classes.put(lab / "submissions" / "eve.zip", b"PK broken")
    run_grader("class", "new", lab)
    listening.begin(IN_CANVAS)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(grading, "open_executor", lambda wanted: Inline())
        patch.setenv("CANVAS_TOKEN", TOKEN)
        decide(lab, 2)
        address = f"{listening.base}/courses/7/assignments/9?module_item_id=3"
        said, _ = upload(lab, "--to", address)
    assert "4 to send, 0 unchanged, 2 skipped" in said
    return lab


@pytest.fixture
def lab(graded_class: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Copy the class."""
    monkeypatch.setattr(grading, "open_executor", lambda wanted: Inline())
    monkeypatch.setattr("grader.classroom.canvas.time.sleep", lambda seconds: None)
    monkeypatch.setenv("CANVAS_TOKEN", TOKEN)
    return shutil.copytree(graded_class, tmp_path / "lab")


def decide(lab: Path, points: int) -> None:
    """Add points to those of the checks, for Ben."""
    (lab / "decisions.toml").write_text(DECISION % points, encoding="utf-8")
    run_grader("class", "grade", lab)


def upload(lab: Path, *more: object) -> tuple[str, int]:
    """Return the output and the exit status."""
    done = run_grader("class", "upload", lab, *more)
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    assert TOKEN not in done.output
    for path in lab.rglob("*"):
        assert path.is_dir() or TOKEN.encode() not in path.read_bytes(), path
    return " ".join(done.output.split()), done.exit_code


def scores(server: Canvas) -> list[float | None]:
    return [each["entered_score"] for _, each in sorted(server.users.items())]


def test_a_first_run_sends_nothing_and_a_second_run_nothing_again(lab: Path, server: Canvas):
    assert scores(server) == [None] * 5 and not server.files
    said, status = upload(lab, "--send")
    assert "4 sent, 0 unchanged, 2 skipped" in said and status == 1
    assert "Finn, A (finn): skipped, Canvas has no student 6" in said
    assert "eve: no mark yet, needs manual review: engine" in said
    assert scores(server) == [2.5, 6.0, 10.0, 0.0, None]  # those of the gradebook
    said, _ = upload(lab, "--send")
    assert "0 sent, 4 unchanged" in said and server.graded == [1, 2, 3, 4]


def test_a_comment_says_what_was_decided_and_has_the_students_own_page(lab: Path, server: Canvas):
    upload(lab, "--send")
    (comment,) = server.users[2]["submission_comments"]
    assert "Mark: 12 / 20, which is 6.0 of 10 in the gradebook" in comment["comment"]
    assert "Decided: shown in the lab: +2" in comment["comment"]
    page = server.files[comment["attachments"][0]["id"]]["content"]
    assert page == (lab / "results" / "ben.html").read_bytes()
    assert server.users[4]["submission_comments"][0]["comment"] == "nothing handed in"


def test_only_marks_that_changed_are_sent(lab: Path, server: Canvas):
    upload(lab, "--send")
    decide(lab, 4)
    said, _ = upload(lab)
    assert "1 to send, 3 unchanged" in said and "│ 6 │ 7.0" in said
    upload(lab, "--send")
    assert server.graded == [1, 2, 3, 4, 2] and scores(server)[1] == 7
    run_grader("class", "grade", lab)
    assert "0 sent, 4 unchanged" in upload(lab, "--send")[0]


def test_what_a_person_entered_in_canvas_stays_unless_told(lab: Path, server: Canvas):
    upload(lab, "--send")
    server.users[1]["entered_score"] = 9.0
    server.users[3]["excused"] = True
    said, status = upload(lab, "--send", "--over")
    assert "Cem, A (cem): skipped, Canvas has them excused" in said and scores(server)[0] == 2.5
    server.users[1]["entered_score"] = 9.0
    said, status = upload(lab, "--send")
    assert "Ann, A (ann): skipped, a person entered 9 in Canvas, and the mark here is 2.5" in said
    assert status == 1 and scores(server)[0] == 9.0


@pytest.mark.parametrize(
    "where, mark", [("lost before", 6.0), pytest.param("lost after", 7.0, marks=pytest.mark.soak)]
)
def test_a_lost_connection_is_a_sentence_and_the_same_command_goes_on(
    lab: Path, server: Canvas, where: str, mark: float
):
    upload(lab, "--send")
    decide(lab, 4)
    server.users[1]["entered_score"] = None  # Ann comes first again
    server.troubles = [("PUT", ""), ("PUT", where)]
    said, status = upload(lab, "--send")
    assert (
        "cannot be reached; sent already: Ann, A (ann); Ben, A (ben): may have arrived. The" in said
    )
    assert status == 2 and scores(server)[:2] == [2.5, mark]
    decide(lab, 6)
    assert "1 sent, 3 unchanged" in upload(lab, "--send")[0]
    assert scores(server) == [2.5, 8.0, 10.0, 0.0, None]


def test_an_answer_that_was_lost_is_not_sent_again(lab: Path, server: Canvas):
    server.troubles = [("PUT", "lost after")]
    assert "sent already: none; Ann, A (ann): may have arrived" in upload(lab, "--send")[0]
    assert "3 sent, 1 unchanged" in upload(lab, "--send")[0]
    assert server.graded == [1, 2, 3, 4]


@pytest.mark.parametrize("trouble", [429, "throttled"])
def test_a_throttled_request_is_made_again_but_not_for_ever(
    lab: Path, server: Canvas, trouble: int | str
):
    server.troubles = [(each, trouble) for each in ("GET", "GET", "PUT", "POST", "PUT")]
    assert "4 sent" in upload(lab, "--send")[0] and server.graded == [1, 2, 3, 4]
    server.troubles = [("GET", trouble)] * 5
    said, code = upload(lab, "--send")
    assert "it accepts no more requests for now (rate limit)" in said and code == 2


@pytest.mark.parametrize(
    "method, status", [("PUT", 400), ("PUT", 401), ("POST", 403), ("PUT", 404), ("POST", 422)]
)
def test_a_mark_that_is_refused_stops_no_other(lab: Path, server: Canvas, method: str, status: int):
    server.troubles = [(method, status)]
    said, code = upload(lab, "--send")
    assert "Ann, A (ann): skipped, Canvas refuses 2.5" in said and "3 sent" in said and code == 1
    assert "1 sent, 3 unchanged" in upload(lab, "--send")[0]


def test_a_persons_mark_stays_theirs_though_replacing_it_was_tried(lab: Path, server: Canvas):
    server.users[1]["entered_score"] = 9.0
    server.troubles = [("PUT", 400)]
    assert "Canvas refuses 2.5" in upload(lab, "--send", "--over")[0]
    assert "a person entered 9 in Canvas" in upload(lab, "--send")[0] and scores(server)[0] == 9.0


def test_what_canvas_takes_away_for_lateness_is_said(lab: Path, server: Canvas):
    server.deducted = 1.5
    said, _ = upload(lab, "--send")
    assert "Ann, A (ann): Canvas's own late policy takes 1.5 more points from the mark" in said


CALL = "https://canvas.x.edu/courses/7/assignments/9"


@pytest.mark.parametrize(
    "change, words",
    [
        ({"token": "wrong"}, "it does not accept the token in CANVAS_TOKEN (401)"),
        ({"token": ""}, "the environment variable CANVAS_TOKEN holds no token"),
        ({"token": "two words"}, "the environment variable CANVAS_TOKEN holds no token"),
        ({"to": "/courses/7/assignments/8"}, "it has no such assignment or student (404)"),
        ({"to": "/courses/7"}, "is no assignment in Canvas: copy the address"),
        ({"to": CALL.replace("https", "http")}, "is no assignment in Canvas: copy the address"),
        ({"points": 20.0}, "out of 10, and the assignment in Canvas is out of 20.0"),
        ({"kind": "pass_fail"}, "graded as pass_fail"),
        ({"troubles": [("GET", 500)]}, "status code 500"),
        ({"troubles": [("GET", 403)]}, "the owner of the token may not do that (403)"),
    ],
)
def test_what_cannot_be_asked_is_a_sentence_before_anything_is_sent(
    lab: Path, server: Canvas, monkeypatch: pytest.MonkeyPatch, change: dict, words: str
):
    before = (lab / "class.toml").read_bytes()
    monkeypatch.setenv("CANVAS_TOKEN", change.pop("token", TOKEN))
    to = change.pop("to", "/courses/7/assignments/9")
    for name, value in change.items():
        setattr(server, name, value)
    said, code = upload(lab, "--send", "--to", to if "//" in to else server.base + to)
    assert words in said and "goes on" not in said and code == 2
    assert not server.graded and not server.files
    assert (lab / "class.toml").read_bytes() == before


def test_students_who_cannot_be_told_apart_get_nothing(lab: Path, server: Canvas):
    roster = lab / "roster.csv"
    text = roster.read_text(encoding="utf-8")
    roster.write_text(text.replace('A",2,', 'A",1,').replace('A",3,', 'A",,'), encoding="utf-8")
    said, _ = upload(lab, "--send")
    assert "the class list has ID '1' 2 times" in said and server.graded == [4]
    roster.write_text(text.replace("ID,SIS", "Number,SIS"), encoding="utf-8")
    assert "has no column ID, Canvas's number of a student" in upload(lab)[0]


def test_without_canvasapi_it_is_said_how_to_get_it(lab: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(sys.modules, "canvasapi", None)
    monkeypatch.delitem(sys.modules, "grader.classroom.canvas")
    assert "-m pip install canvasapi" in upload(lab)[0]
