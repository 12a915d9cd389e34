"""Marks on their way into Canvas: once, to the right student, and over nobody's decision."""

from collections.abc import Iterator
from pathlib import Path

import classes
import packed
import pytest
from canvas_server import TOKEN, Canvas
from command_line import run_grader
from points_pool import Inline

from grader.classroom import canvas, grading

pytest.importorskip("canvasapi", reason="the extra `canvas` is not installed")

COURSE = 'title = "Lab 3"\ntodos = ["8a"]\nout_of = 10\n[points]\n8a = 20\n'
POINTS = {"ann": 5, "ben": 10, "cem": 20}
STUDENTS = ("ann", "ben", "cem", "dora", "eve", "finn")  # 1 to 6 in Canvas
DECISION = '[[adjust]]\nstudent = "ben"\nadd = 2\nreason = "shown in the lab"\n'


@pytest.fixture
def server() -> Iterator[Canvas]:
    made = Canvas([1, 2, 3, 4, 5])  # finn has left the course
    yield made
    made.shutdown()
    made.server_close()


@pytest.fixture
def lab(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, server: Canvas) -> Path:
    """A graded class: dora handed in nothing, and eve what needs review."""
    monkeypatch.setattr(grading, "open_executor", lambda wanted: Inline())
    monkeypatch.setattr(canvas.time, "sleep", lambda seconds: None)
    monkeypatch.setenv("CANVAS_TOKEN", TOKEN)
    rows = [f'"{name.title()}, A",{n},{name},' for n, name in enumerate(STUDENTS, 1)]
    lines = ["Student,ID,SIS Login ID,Section", "    Points Possible,,,", *rows, ""]
    lab = tmp_path / "lab"
    lab.mkdir()
    (lab / "roster.csv").write_text("\n".join(lines), encoding="utf-8")
    (lab / "course.toml").write_text(COURSE, encoding="utf-8")
    (lab / "decisions.toml").write_text(DECISION, encoding="utf-8")
    for name, points in POINTS.items():
        classes.put(lab / "submissions" / f"{name}.zip", packed.as_zip(classes.work(points)))
    classes.put(lab / "submissions" / "finn.zip", packed.as_zip(classes.work(7)))
    classes.put(lab / "submissions" / "eve.zip", b"PK broken")
    run_grader("class", "new", lab)
    run_grader("class", "grade", lab)
    said, _ = upload(lab, "--to", f"{server.base}/courses/7/assignments/9?module_item_id=3")
    assert "4 to send, 0 unchanged, 2 left out" in said
    return lab


def upload(lab: Path, *more: object) -> tuple[str, int]:
    """Return what is said, and the exit status."""
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
    assert "4 sent, 0 unchanged, 2 left out" in said and status == 1
    assert "Finn, A: left out, Canvas has no student 6" in said
    assert "eve: no mark yet, engine must be graded by hand" in said
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
    (lab / "decisions.toml").write_text(DECISION.replace("2", "4"), encoding="utf-8")
    run_grader("class", "grade", lab)
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
    assert "Cem, A: left out, Canvas has them excused" in said and scores(server)[0] == 2.5
    server.users[1]["entered_score"] = 9.0
    said, status = upload(lab, "--send")
    assert "Ann, A: left out, a person entered 9 in Canvas, and the mark here is 2.5" in said
    assert status == 1 and scores(server)[0] == 9.0


@pytest.mark.parametrize("where, mark", [("lost before", None), ("lost after", 6.0)])
def test_a_lost_connection_is_a_sentence_and_the_same_command_goes_on(
    lab: Path, server: Canvas, where: str, mark: float | None
):
    server.troubles = [("PUT", ""), ("PUT", where)]
    said, status = upload(lab, "--send")
    assert "it cannot be reached (ConnectionError); sent already: Ann, A. The same" in said
    assert status == 2 and scores(server)[1] == mark
    (lab / "decisions.toml").write_text("", encoding="utf-8")
    run_grader("class", "grade", lab)
    upload(lab, "--send")
    assert scores(server)[:4] == [2.5, 5.0, 10.0, 0.0] and server.graded.count(1) == 1


@pytest.mark.parametrize("status", [403, 429])
def test_a_throttled_request_is_made_again_and_not_for_ever(lab: Path, server: Canvas, status: int):
    server.troubles = [(each, status) for each in ("GET", "GET", "PUT", "POST", "PUT")]
    assert "4 sent" in upload(lab, "--send")[0]
    server.troubles = [("GET", status)] * 5
    said, code = upload(lab, "--send")
    assert "it takes no more requests for now (rate limit)" in said and code == 2


@pytest.mark.parametrize("status", [400, 403, 404, 422])
def test_a_mark_that_is_refused_stops_no_other(lab: Path, server: Canvas, status: int):
    if status == 403:
        server.users.pop(1)
        server.users[1] = server.users.pop(1, {"entered_score": None, "submission_comments": []})
    server.troubles = [("PUT", status)]
    said, _ = upload(lab, "--send")
    assert "sent" in said


@pytest.mark.parametrize("status, words", [(401, "may not do that (401)"), (500, "500")])
def test_errors(lab: Path, server: Canvas, status: int, words: str):
    server.troubles = [("GET", status)]
    said, code = upload(lab)
    assert words in said and code == 2
