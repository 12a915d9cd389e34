"""Test that members of the bank get the marks they must."""

from dataclasses import replace
from hashlib import sha256
from pathlib import Path

import pytest
from whole_bank import bank, grade_briefly

from grader.bank.members import Member, change_files, change_text
from grader.bank.verify import check_kit, grade_member
from grader.judge.task import KIT
from grader.judge.rubric import load_rubric
from grader.source.regions import python_files, read_source, regions_in

EVERY = bank()
MEMBERS = [member for member in EVERY if member.kind != "ladder"]
RUNGS = [member for member in EVERY if member.kind == "ladder" and member.replaced_todos]
WHOLE = "lesson-as-printed"  # graded in full
# Each of these takes as long as ten others.
TOO_LONG = (
    "in-every-todo",
    "B3-only-the-nearest",
    "B3-a-pair-once-per-cell",
    "2-no-spin-terms",
    "2-divides-by-the-inverse",
    "sends-a-million-lists",
    "too-deep-to-parse",
)


def chosen(every: list[Member]) -> list[Member]:
    """Return the members for `make test`: one of each group, and the lesson's program.

    The wrong members of a program form a group, as do those of bonus tasks and single files.
    Members are chosen by the hash of their names, so that a new one replaces at most one. `make
    verify`, a CI job of its own, grades all members.
    """
    programs = {todo.id: todo.module for todo in load_rubric().todos}
    groups: dict[tuple[str, str], list[Member]] = {}
    for member in every:
        whole_program = "whole" in member.todos or (member.kind == "right" and not member.todos)
        if whole_program or member.name.endswith(TOO_LONG):
            continue
        about = str(bool(member.todos))
        if member.kind == "wrong":
            about = member.form + "".join(sorted({programs[todo] for todo in member.todos}))
            about = "bonus" if member.bonus else about
        groups.setdefault((member.kind, about), []).append(member)
    lesson = [member for member in every if (member.name, member.form) == (WHOLE, "package")]
    return lesson + [min(group, key=draw) for group in groups.values()]


def draw(member: Member) -> float:
    """Return a number from 0 to 1 that depends on its name."""
    return int(sha256(name_member(member).encode()).hexdigest()[:12], 16) / 16**12


def name_member(member: Member) -> str:
    return f"{member.kind}/{member.name} as {member.form}"


@pytest.mark.parametrize("member", chosen(MEMBERS), ids=name_member)
def test_a_member_gets_the_marks_it_must(member: Member):
    assert not grade_briefly(member).complaint


def test_a_text_is_changed_if_it_stands_there_once(tmp_path: Path):
    (tmp_path / "a.py").write_text("ITERATIONS = 8\nMAX_STEPS = 8\n", encoding="utf-8")
    change_files({"a.py": [("IONS = 8", "IONS = 1")]}, tmp_path)
    assert (tmp_path / "a.py").read_text(encoding="utf-8") == "ITERATIONS = 1\nMAX_STEPS = 8\n"
    for old in ("S = ", "nowhere"):
        with pytest.raises(ValueError, match="times, not once"):
            change_files({"a.py": [(old, "")]}, tmp_path)


def test_three_dots_stand_for_any_number_of_lines():
    text = "a\nb\nc\nd\n"
    for old, new in [("a\n...\nb", "x\nc\nd\n"), ("a\n...\nd", "x\n"), ("b\n...\nd", "a\nx\n")]:
        assert change_text(text, [(old, "x")]) == new
    with pytest.raises(ValueError, match="0 times"):
        change_text(text, [("b\n...\na", "x")])


def test_a_breach_breaks_what_is_given_and_no_region(tmp_path: Path):
    """A TODO's own mistakes are patches. `make verify` builds all breaches."""
    breaches = [member for member in MEMBERS if member.breach is not None]
    for member in breaches[::8]:
        member.build(tmp_path / member.name)
        for path in python_files(tmp_path / member.name):
            original = KIT / "solution" / path.relative_to(tmp_path / member.name)
            texts = [read_source(each) for each in (path, original)]
            ours, theirs = ([r.lines for r in regions_in(text)] for text in texts)
            assert ours == theirs, member.name


def test_a_member_knows_what_it_is_based_on():
    (member,) = [each for each in MEMBERS if each.name == "window-at-import"]
    assert [each.name for each in member.lineage] == [
        "window-at-import",
        "nanoseconds-without-pacing",
        "updates-twice-a-frame",
    ]


def test_a_new_member_changes_little_of_what_is_drawn():
    before = set(chosen(MEMBERS))
    more = [replace(member, name=f"{member.name}-again") for member in MEMBERS]
    for member in more[::200]:
        assert len(before - set(chosen([*MEMBERS, member]))) <= 1
    assert len(chosen([*MEMBERS, *more])) == len(before)


def test_every_kind_every_form_and_every_program_is_drawn():
    drawn = chosen(MEMBERS)
    assert {member.kind for member in drawn} == {member.kind for member in MEMBERS}
    spoiled = {todo for member in drawn if member.kind == "wrong" for todo in member.todos}
    todos = load_rubric().todos
    assert {each.module for each in todos if each.id in spoiled} == {each.module for each in todos}
    assert {member.form for member in drawn} == {member.form for member in MEMBERS}


@pytest.mark.parametrize(
    "name",
    [
        "tells-the-reference",
        pytest.param("harvests-the-reference", marks=pytest.mark.soak),
    ],
)
def test_no_line_of_the_reference_gets_into_the_result(name: str):
    (member,) = [each for each in MEMBERS if each.name == name]
    result = grade_member(member).result
    assert result is not None
    words = [
        getattr(check, field)
        for todo in result.todos
        for check in todo.checks
        for field in ("ran", "expected", "got", "meaning")
    ]
    shown = " ".join(" ".join(words).split())
    lines = {
        " ".join(line.split())
        for path in python_files(KIT / "solution")
        for region in regions_in(read_source(path))
        for line in region.lines
    }
    telling = {line for line in lines if len(line) > 12}
    assert len(telling) > 30
    assert not {line for line in telling if line in shown}


def test_trees_and_rubric_have_nothing_to_complain_of():
    assert list(check_kit()) == []
