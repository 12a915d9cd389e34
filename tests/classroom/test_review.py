"""Test decisions about a class: in the file, on the local page, and by mail."""

import csv
import email
import email.policy
import http.client
import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from threading import Thread
from typing import Any
from urllib.parse import urlencode

import classes
import packed
import pytest
from command_line import call_class
from packed import put
from page_readers import PATIENCE, Reader, barriers, chromium
from points_pool import Inline

from grader.classroom import grading
from grader.classroom.comments import LONGEST_LINE, Comment, place_comment, write_comment
from grader.classroom.decisions import DecisionsFile
from grader.classroom.folder import read_class_folder
from grader.classroom.mail import is_unedited, make_draft, write_body
from grader.classroom.review import (
    MOST_LINES,
    Request,
    Response,
    list_files,
    respond,
    show_file,
)
from grader.classroom.review_server import ReviewServer, open_review
from grader.errors import Stop
from grader.intake.found import Intake, Work
from grader.intake.listing import apply_choices, open_class
from grader.intake.packing import Contents, pack
from grader.intake.roster import ClassList
from grader.judge.course import FULL

BY_HAND = """\
# mine
zone = "UTC"

# about Ann
[[adjust]]
student = "ann"  # the tall one
points = 70   # shown
reason = "it's # fine"

# about two
[[adjust]] # b
student = ["ben", "cem"]
late = false
reason = "ill"
# the end
"""
CODE = b"def euler(x, v, dt):\n    x = x + v * dt\n    return x\n\n\ndef other(x):\n    return x\n"


def decisions(folder: Path, text: str = BY_HAND) -> DecisionsFile:
    (folder / "decisions.toml").write_text(text, encoding="utf-8")
    return DecisionsFile(folder / "decisions.toml", FULL)


def test_a_changed_decision_leaves_every_other_line_as_it_was(tmp_path: Path):
    file = decisions(tmp_path)
    ann, two = file.list_decisions()
    file.put("adjust", ann.values | {"points": 71, "reason": 'a "new" one\n# of two lines'}, ann)
    before, table, after = BY_HAND.partition(
        BY_HAND[BY_HAND.index("[[") : BY_HAND.index("\n# about two")]
    )
    new = '[[adjust]]\nstudent = "ann"\npoints = 71\nreason = "a \\"new\\" one\\n# of two lines"\n'
    assert table and file.text == before + new + after
    file.put("comment", {"student": "ann", "comment": "Well done"})
    assert file.text == before + new + after + (
        '\n[[comment]]\nstudent = "ann"\ncomment = "Well done"\n'
    )
    file.remove(two.key)
    assert [each.what for each in file.list_decisions()] == ["points", "comment"]
    assert "# about two\n# the end\n" in file.text
    now = file.text
    with pytest.raises(Stop, match="101 of 'dora' is more than the 100"):
        file.put("adjust", {"student": "dora", "points": 101, "reason": "x"})
    with pytest.raises(Stop, match="has changed meanwhile"):
        file.remove(two.key)
    assert file.text == now


@pytest.mark.parametrize(
    "text",
    [
        '[[adjust]]\nstudent = "a"\nlate = false\nreason = """x\n[[adjust]]\n"""\n',
        'adjust = [{student = "a", late = false, reason = "x"}]\n',
    ],
)
def test_a_file_of_unusual_form_is_left_to_its_writer(tmp_path: Path, text: str):
    file = decisions(tmp_path, text)
    with pytest.raises(Stop, match="has a form that only people can change"):
        file.list_decisions()
    assert file.text == text


@pytest.mark.parametrize(
    "now, line, note",
    [
        (CODE, 2, ""),
        (b"import math\n\n\n" + CODE, 5, ""),
        (CODE.replace(b"v * dt", b"dt * v"), 2, "the line has changed; it was: x = x + v * dt"),
        (CODE.replace(b"    x = x + v * dt\n", b""), 0, "not found"),
        (b"", 0, "not found"),
    ],
)
def test_a_comment_follows_its_line(now: bytes, line: int, note: str):
    comment = write_comment("ann", "Which x?", "work/integrators.py", 2, CODE)
    remark = place_comment(comment, {"integrators.py": now})
    assert remark.line == line and note in remark.note
    assert not line or (line, now.decode().splitlines()[line - 1]) in remark.code


def test_of_two_lines_of_one_text_the_neighbours_decide():
    comment = write_comment("ann", "Why?", "a.py", 7, CODE)
    assert place_comment(comment, {"a.py": b"\n\n" + CODE}).line == 9
    alone = Comment("ann", "Why?", "a.py", 7, "return x")
    assert place_comment(alone, {"a.py": CODE}).line == 0


def test_of_long_files_only_a_part_is_kept_and_shown():
    content = b"x = 1\n" + b"y" * 10**6 + b"\nz = 2\n"
    comment = write_comment("ann", "Why?", "a.py", 2, content)
    remark = place_comment(comment, {"a.py": content})
    assert remark.line == 2 and all(len(text) <= LONGEST_LINE for _, text in remark.code)
    assert len(comment.code) == LONGEST_LINE
    shown = Contents([(f"{number}.py", b"\n" * 200_000) for number in range(60)])
    files = list_files(shown, [])
    assert sum(len(each.lines) for each in files) == MOST_LINES
    assert len(files) == 60 and all("cut off" in each.note for each in files)
    text = show_file("onlinetext.html", b"<html><p>I am ill</p></html>", [], 9)
    assert text.lines == ["<html><p>I am ill</p></html>"] and text.note == "a web page"
    assert show_file("report.pdf", b"%PDF-1.7", [], 9).lines == []


# ---------------------------------------------------------------- finding the submission


TWO = {"a/integrators.py": "1", "b/integrators.py": "2"}


@pytest.mark.parametrize(
    "folder, files, path, text",
    [
        ("ann", {"integrators.py": "1", "integrators (1).py": "2"}, "integrators (1).py", "2"),
        ("ann", TWO, "b", "2"),
        ("ann", TWO, "ann/a", "1"),
        ("odd", {"integrators.py": "3"}, "odd", "3"),
        ("odd", TWO, "odd/b", "2"),
    ],
)
def test_the_work_that_a_person_takes_counts(
    tmp_path: Path, folder: str, files: dict[str, str], path: str, text: str
):
    put(tmp_path, {"zed/integrators.py": "9"} | {f"{folder}/{n}": t for n, t in files.items()})
    people = ClassList()
    people.chosen = [("ann", path), ("yan", "gone.zip")]
    with open_class(tmp_path, people) as intake:
        found = {each.name: each for each in intake.found}
        assert set(found) == {"ann", "zed"} and not intake.troubles
        assert dict(pack(found["ann"]).files)["integrators.py"] == text.encode()
        assert intake.notes == ["yan: 'gone.zip' was chosen, and nothing of that name is there"]


def test_a_choice_holds_for_all_who_handed_in_together(tmp_path: Path):
    put(tmp_path, {"s/a/integrators.py": "1", "s/b/integrators.py": "2"})
    found = [Work(name, (tmp_path / "s",)) for name in ("ann", "ben")]
    intake, people = Intake(found), ClassList()
    people.chosen = [("ben", "a")]
    apply_choices(intake, people)
    assert {(each.name, each.taken) for each in intake.found} == {("ann", ("a",)), ("ben", ("a",))}


# ---------------------------------------------------------------- the page

COURSE = 'title = "Lab 3"\ntodos = ["8a"]\n[points]\n8a = 20\n'
BAD = "</pre><script>alert(1)</script>"


def code(points: int) -> str:
    return f"points = {points}\n{CODE.decode()}"


def lock(archive: bytes) -> bytes:
    """Return a zip marked as encrypted."""
    content = bytearray(archive)
    for sign, at in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        for found in re.finditer(re.escape(sign), archive):
            content[found.start() + at] |= 1
    return bytes(content)


@pytest.fixture(scope="module")
def graded_class(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Grade a class with everything that needs a person."""
    lab = tmp_path_factory.mktemp("term") / "lab"
    work = classes.work(5)
    two = {f"{at}/{name}": text for at in "ab" for name, text in work.items()}
    export = {
        "ann.zip": packed.as_zip(work | {"integrators.py": code(5)}),
        "ben.zip": packed.as_zip(two | {"b/integrators.py": code(9)}),
        "dora.zip": lock(packed.as_zip(work)),
        "eve/x.py": BAD,
        "finn.zip": packed.as_zip(work),
        "finn/integrators.py": code(7),
        "Gil_77.zip": packed.as_zip(work | {"integrators.py": code(8)}),
        "hana.zip": packed.as_zip(work | {"integrators.py": "x = '\xfc'".encode("latin-1")}),
    }
    for name, content in export.items():
        classes.put(lab / "export" / name, content)
    students = ("ann", "ben", "dora", "eve", "finn", "gil", "hana")
    rows = [f"{name}@x.edu,{name.title()} Lee" for name in students]
    (lab / "roster.csv").write_text("\n".join(["Email address,Full name", *rows, ""]))
    (lab / "course.toml").write_text(COURSE)
    call_class("new", lab, "--submissions", lab / "export")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(grading, "open_executor", lambda wanted: Inline())
        assert "5 need manual review" in call_class("grade", lab)
    return lab


@pytest.fixture
def lab(graded_class: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(grading, "open_executor", lambda wanted: Inline())
    return shutil.copytree(graded_class, tmp_path / "lab")


@pytest.fixture
def server(lab: Path) -> Iterator[ReviewServer]:
    with open_review(read_class_folder(lab)) as server:
        yield server


def ask(
    server: ReviewServer, path: str, form: dict[str, object] | None = None, **more: Any
) -> Response:
    review, (where, _, query) = server.review, path.partition("?")
    values = {
        "method": "GET" if form is None else "POST",
        "path": where,
        "query": dict(pair.split("=") for pair in query.split("&") if pair),
        "form": {name: str(value) for name, value in (form or {}).items()},
        "host": review.host,
        "origin": f"http://{review.host}",
        "cookie": review.token,
    }
    return respond(review, Request(**values | more))


def test_nobody_else_reads_the_page_and_no_other_page_sends_a_form(server: ReviewServer, lab: Path):
    for more in (
        {"cookie": ""},
        {"cookie": "x"},
        {"host": "evil.example"},
        {"host": "127.0.0.1"},
        {"query": {"token": "\u00fc"}, "cookie": ""},
    ):
        assert ask(server, "/", **more).status == 403, more
    form = {"name": "dora", "kind": "points", "points": 9, "reason": "x"}
    for origin in ("", "null", "http://evil.example", "http://127.0.0.1:1"):
        assert ask(server, "/points", form, origin=origin).status == 403, origin
    assert not (lab / "decisions.toml").exists()


def test_what_a_person_decides_on_the_page_counts(server: ReviewServer, lab: Path):
    listed = Reader(ask(server, "/").body).text
    assert (
        "Needs manual review: 6" in listed
        and "encrypted" in listed
        and "not in the class list" in listed
        and "nothing was handed in" in listed
    )
    forms: list[tuple[str, dict[str, object]]] = [
        ("/points", {"name": "dora", "kind": "points", "points": 8, "reason": "wrong"}),
        ("/points", {"name": "dora", "kind": "points", "points": 9, "reason": "shown\r\nto me"}),
        ("/points", {"name": "ann", "kind": "add", "points": -1, "reason": "no docstring"}),
        ("/work", {"name": "ben", "path": "ben.zip/a", "reason": "told me"}),
        ("/work", {"name": "ben", "path": "ben.zip/b", "reason": "told me so"}),
        ("/work", {"name": "finn", "path": "finn.zip", "reason": "the whole"}),
        ("/owner", {"name": "Gil_77", "student": "gil@x.edu", "reason": "his number"}),
        ("/comment", {"name": "ann", "file": "integrators.py", "line": 3, "comment": "Which x?"}),
        ("/comment", {"name": "dora", "comment": f"No password, please.\n{BAD}"}),
    ]
    for path, form in forms:
        assert ask(server, path, form).status == 303, ask(server, path, form).body
    text = (lab / "decisions.toml").read_text(encoding="utf-8")
    assert text.count("[[adjust]]") == 5 and text.count("[[comment]]") == 2
    assert 'student = "gil@x.edu"\ntake = "Gil_77"\nreason = "his number"' in text
    assert "2 need manual review" in call_class("grade", lab)
    with open_review(read_class_folder(lab)) as again:
        assert "Needs manual review: 2" in Reader(ask(again, "/").body).text
    with open(lab / "results.class.csv", encoding="utf-8-sig") as table:
        points = {line.split(",")[0]: line.split(",")[2] for line in table}
    wanted = {"ann": "4", "ben": "9", "dora": "9", "finn": "5", "gil@x.edu": "8"}
    assert {name: points[name] for name in wanted} == wanted
    page = (lab / "results" / "ann.html").read_text(encoding="utf-8")
    assert "integrators.py, line 3" in page and "Which x?" in page
    page = (lab / "results" / "dora.html").read_text(encoding="utf-8")
    assert "No password, please." in page and BAD not in page
    work = classes.work(6) | {"integrators.py": f"import math\n\n{code(6)}"}
    classes.put(lab / "export" / "ann.zip", packed.as_zip(work))
    call_class("grade", lab)
    page = (lab / "results" / "ann.html").read_text(encoding="utf-8")
    assert "integrators.py, line 5" in page and "<mark>5     x = x + v * dt</mark>" in page


def test_a_form_that_means_nothing_writes_nothing_and_words_are_text(
    server: ReviewServer, lab: Path
):
    points = {"points": "9", "kind": "points", "reason": "x"}
    for path, form, words in [
        ("/points", points | {"reason": ""}, "the reason is missing"),
        ("/points", points | {"points": "x"}, "is not a whole number"),
        ("/points", points | {"points": "99"}, "more than the 20"),
        ("/points", points | {"kind": "zone"}, "choose what"),
        ("/work", {"path": "/etc/passwd", "reason": "x"}, "choose one of the files"),
        ("/owner", {"student": "gil@x.edu", "reason": "x"}, "choose a student"),
        ("/comment", {"comment": " "}, "the comment is empty"),
        ("/comment", {"comment": "x", "file": "../x", "line": "1"}, "has no line 1"),
        ("/remove", {"key": "x"}, "has changed meanwhile"),
    ]:
        answer = ask(server, path, {"name": "ben"} | form)
        assert answer.status == 400 and words in answer.body
    assert not (lab / "decisions.toml").exists()
    page = Reader(ask(server, "/student?name=eve").body)
    assert BAD in page.text and page.count("script") == 0 and not page.handlers


def test_the_server_answers_who_has_the_address(server: ReviewServer):
    Thread(target=server.serve_forever, daemon=True).start()
    try:
        client = http.client.HTTPConnection(server.review.host, timeout=60)

        def send(
            method: str, path: str, body: str = "", **headers: str
        ) -> http.client.HTTPResponse:
            client.request(method, path, body, headers)
            answer = client.getresponse()
            answer.read()
            return answer

        assert send("GET", "/").status == 403
        entered = send("GET", "/" + server.address.rpartition("/")[2])
        cookie = entered.headers["Set-Cookie"].partition(";")[0]
        assert entered.status == 303 and "SameSite=Strict" in entered.headers["Set-Cookie"]
        assert send("GET", "/", Cookie=cookie).headers["Cache-Control"] == "no-store"
        form = urlencode({"name": "dora", "kind": "points", "points": 9, "reason": "shown"})
        assert send("POST", "/points", form, Cookie=cookie).status == 403
        sure = {"Cookie": cookie, "Origin": f"http://{server.review.host}"}
        assert send("POST", "/points", form, **sure).status == 303
        assert send("POST", "/points", "x" * 200_000, **sure).status == 413
    finally:
        server.shutdown()


def test_a_person_decides_with_the_keyboard_alone(server: ReviewServer, lab: Path, tmp_path: Path):
    Thread(target=server.serve_forever, daemon=True).start()
    with chromium() as browser:
        page = browser.new_page(java_script_enabled=False)
        page.set_default_timeout(PATIENCE)
        page.goto(server.address)
        tab_to(page, "Ben Lee", "ben")
        page.keyboard.press("Enter")
        page.wait_for_url("**/student?name=ben")
        for key in ("Tab", "Tab", "Space", "Tab"):
            page.keyboard.press(key)
        page.keyboard.type("told me")
        page.keyboard.press("Enter")
        page.wait_for_url("**done=1")
        assert "Written to decisions.toml" in page.inner_text("[role=status]")
        for name in ("ben", "eve"):
            body = ask(server, f"/student?name={name}").body
            (tmp_path / f"{name}.html").write_text(body, encoding="utf-8")
        (tmp_path / "class.html").write_text(ask(server, "/").body, encoding="utf-8")
        shown = [tmp_path / f"{name}.html" for name in ("ben", "eve", "class")]
        assert barriers(browser, *shown) == []
    server.shutdown()
    assert 'take = "ben.zip/' in (lab / "decisions.toml").read_text(encoding="utf-8")


def tab_to(page: Any, *names: str) -> None:
    """Press Tab until the link of one of these names has the focus."""
    for _ in range(50):
        page.keyboard.press("Tab")
        if page.locator("a:focus").all_inner_texts() and page.inner_text("a:focus") in names:
            return
    raise AssertionError(f"no Tab leads to {names}")


# ---------------------------------------------------------------- mail


def test_who_must_send_work_again_gets_a_draft(lab: Path):
    said = call_class("mail", lab)
    assert "5 drafts in" in said and "Nothing was sent" in said
    drafts = {path.stem: path.read_bytes() for path in (lab / "mail").glob("*.eml")}
    assert set(drafts) == {f"{name}@x.edu" for name in ("ben", "dora", "eve", "finn", "hana")}
    mail = email.message_from_bytes(drafts["dora@x.edu"], policy=email.policy.default)
    assert mail["X-Unsent"] == "1" and mail["To"] == "dora@x.edu" and mail["From"] is None
    assert mail["Subject"] == "Lab 3: please send your work again"
    text = mail.get_content()
    assert "Hello Dora Lee," in text and "has a password. Please send it again" in text
    with open(lab / "mail.csv", encoding="utf-8-sig", newline="") as table:
        rows = {row["address"]: row for row in csv.DictReader(table)}
    assert set(rows) == set(drafts) and "save it as UTF-8" in rows["hana@x.edu"]["text"]


def test_an_address_beyond_ascii_stays_one():
    draft = make_draft("gábor@x.edu", "Übung", "Hello Gábor,")
    assert "To: gábor@x.edu\r\n".encode() in draft and is_unedited(draft)
    assert not is_unedited(draft.replace(b"Hello", b"Dear"))


@pytest.mark.parametrize(
    "reason", ["it is empty or cut off", "text in UTF-16: it is needed in UTF-8"]
)
def test_a_draft_asks_the_student_and_not_the_teacher(reason: str):
    body = write_body("Ann", f"work.zip: {reason}", "Lab")
    assert "ask for" not in body and ("empty or incomplete" in body or "save it as UTF-8" in body)


def test_an_edited_draft_stays(lab: Path):
    call_class("mail", lab)
    drafts = {name: lab / "mail" / f"{name}@x.edu.eml" for name in ("ben", "dora", "eve", "finn")}
    edited = drafts["dora"].read_bytes().replace(b"Thank you.", b"See you on Monday.")
    drafts["dora"].write_bytes(edited)
    drafts["finn"].write_bytes(b"From: me@x.edu\nTo: finn@x.edu\n\nas sent\n")
    own = lab / "mail" / "all.eml"
    own.write_bytes(b"To: all@x.edu\n\nhello\n")
    said = call_class("mail", lab)
    assert "3 drafts in" in said and said.count("stays: to have a new one, remove it") == 2
    assert drafts["dora"].read_bytes() == edited and b"as sent" in drafts["finn"].read_bytes()
    assert own.exists() and "stays: its student needs none now" in said


def test_only_those_who_must_still_send_work_get_a_draft(lab: Path):
    """Decided points are enough; unreadable work is not."""
    call_class("mail", lab)
    decision = '[[adjust]]\nstudent = "Dora Lee"\npoints = 9\nreason = "shown"\n'
    late = '[[adjust]]\nstudent = "eve"\nlate = false\nreason = "ill"\n'
    again = '[[adjust]]\nstudent = "hana"\ntake = "hana.zip"\nreason = "this"\n'
    (lab / "decisions.toml").write_text(decision + late + again, encoding="utf-8")
    said = call_class("mail", lab)
    assert "dora: no mail, decided since: grade again" in said and "3 drafts in" in said
    call_class("grade", lab)
    assert "4 drafts in" in call_class("mail", lab)
    assert not (lab / "mail" / "dora@x.edu.eml").exists()
    assert (lab / "mail" / "eve@x.edu.eml").exists()


def test_a_class_list_without_addresses_is_told_what_it_lacks(lab: Path):
    (lab / "roster.csv").write_text("SIS Login ID,Full name\nann,Ann Lee\n", encoding="utf-8")
    assert "holds no address in any column: add a column 'Email address'" in call_class("mail", lab)
