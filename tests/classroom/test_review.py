"""What a person decides about a class: in the file, on the local page, and by mail."""

from pathlib import Path

import pytest

from grader.classroom.comments import Comment, place_comment, write_comment
from grader.classroom.decisions import DecisionsFile
from grader.errors import Stop
from grader.intake.listing import open_class
from grader.intake.packing import pack
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
    file.replace(ann, ann.values | {"points": 71, "reason": 'a "new" one\n# of two lines'})
    now = BY_HAND.replace("points = 70 ", "points = 71 ")
    now = now.replace('"it\'s # fine"', '"a \\"new\\" one\\n# of two lines"')
    assert file.text == now
    file.add("comment", {"student": "ann", "comment": "Well done"})
    assert file.text == now + '\n[[comment]]\nstudent = "ann"\ncomment = "Well done"\n'
    file.remove(two.key)
    assert [each.what for each in file.list_decisions()] == ["points", "comment"]
    assert "# about two\n# the end\n" in file.text


@pytest.mark.parametrize(
    "text",
    [
        '[[adjust]]\nstudent = "a"\nlate = false\nreason = """x\n[[adjust]]\n"""\n',
        'adjust = [{student = "a", late = false, reason = "x"}]\n',
    ],
)
def test_a_file_of_unusual_form_is_left_to_its_writer(tmp_path: Path, text: str):
    file = decisions(tmp_path, text)
    with pytest.raises(Stop, match="is not changed here: edit it"):
        file.list_decisions()
    assert file.text == text


def test_a_decision_that_means_nothing_is_not_written(tmp_path: Path):
    file = decisions(tmp_path)
    with pytest.raises(Stop, match="101 of 'dora' is more than the 100"):
        file.add("adjust", {"student": "dora", "points": 101, "reason": "x"})
    with pytest.raises(Stop, match="has changed meanwhile"):
        file.remove("adjust []")
    assert file.text == BY_HAND


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


# ---------------------------------------------------------------- which work is meant

PROGRAM = {"mini_engine/__init__.py": "", "pymunk_scene.py": ""}


def put(folder: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)


@pytest.mark.parametrize(
    "student, files, path, text",
    [
        (
            "ann",
            {"ann/integrators.py": "1", "ann/integrators (1).py": "2"},
            "integrators (1).py",
            "2",
        ),
        ("ann", {"ann/a/integrators.py": "1", "ann/b/integrators.py": "2"}, "b", "2"),
        ("ann", {"ann/a/integrators.py": "1", "ann/b/integrators.py": "2"}, "ann/a", "1"),
        ("ann", {"odd/integrators.py": "3"}, "odd", "3"),
        ("ann", {"odd/a/integrators.py": "3", "odd/b/integrators.py": "4"}, "odd/b", "4"),
    ],
)
def test_the_work_that_a_person_takes_counts(
    tmp_path: Path, student: str, files: dict[str, str], path: str, text: str
):
    put(tmp_path, files | {"zed/integrators.py": "9"})
    people = ClassList()
    people.chosen = [(student, path)]
    with open_class(tmp_path, people) as intake:
        found = {each.name: each for each in intake.found}
        assert set(found) == {"ann", "zed"} and not intake.troubles
        assert dict(pack(found["ann"]).files)["integrators.py"] == text.encode()


def test_a_choice_of_nothing_is_noted(tmp_path: Path):
    put(tmp_path, {"ann/integrators.py": "1"})
    people = ClassList()
    people.chosen = [("zed", "gone.zip")]
    with open_class(tmp_path, people) as intake:
        assert intake.notes == ["zed: 'gone.zip' was chosen, and nothing of that name is there"]
