"""The bank: every wrong, right and hostile submission gets the marks it must."""

from collections import Counter
from typing import Any

import pytest

from grader.judge.grade import KIT
from grader.judge.rubric import load_rubric
from grader.maintain.bank import Member, members
from grader.maintain.verify import grade_member, kit_complaints, trees
from grader.todo_regions import python_files, read_source, regions_in

MEMBERS = [*trees(), *members(KIT)]


def cases() -> list[Any]:
    """What `make test` has time for; `make verify` and `make soak` grade all members on all.

    Of the wrong packages, every sixth is graded on its whole program, the others on the TODO that
    they spoil. Of bonus tasks, one right and one wrong member of each; of the wrong single files,
    one a TODO; of the other right ones every second.
    """
    wrong = [m for m in MEMBERS if m.kind == "wrong" and m.form == "package" and not m.bonus]
    single = [m for m in MEMBERS if m.kind == "wrong" and m.form == "single file" and not m.bonus]
    one_each = [
        *{(m.kind, m.todos): m for m in MEMBERS if m.bonus}.values(),
        *{m.todos: m for m in single}.values(),
    ]
    briefly = [m for m in [*wrong, *one_each] if m.kind == "wrong" and m not in wrong[::6]]
    right = [m for m in MEMBERS if m.kind == "right" and not m.bonus]
    hostile = [m for m in MEMBERS if m.kind == "hostile"]
    fully = [*wrong[::6], *right[::2], *hostile, *(m for m in one_each if m.kind == "right")]
    return [
        *(pytest.param(m, m.todos, id=f"{named(m)} alone") for m in briefly),
        *(
            pytest.param(m, m.judged_by, id=named(m), marks=() if m in fully else pytest.mark.soak)
            for m in MEMBERS
        ),
    ]


def named(member: Member) -> str:
    return f"{member.kind}/{member.name} as {member.form}"


@pytest.mark.parametrize(("member", "todos"), cases())
def test_a_member_gets_the_marks_it_must(member: Member, todos: frozenset[str]):
    verdict = grade_member(member, todos)
    assert not verdict.complaint
    if member.kind == "wrong" and verdict.result is not None:
        assert member.misnamed(verdict.result) != "wrong"


@pytest.mark.parametrize("name", ["tells-the-reference", "harvests-the-reference"])
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


def test_the_bank_is_as_large_as_it_must_be():
    names = Counter(kind for kind, _ in {(member.kind, member.name) for member in MEMBERS})
    assert names["wrong"] >= 60 and names["right"] >= 20 and names["hostile"] >= 15


def test_every_todo_has_wrong_submissions():
    spoiled = {todo for member in MEMBERS if member.kind == "wrong" for todo in member.todos}
    assert spoiled == {todo.id for todo in load_rubric().todos if todo.function}


def test_trees_and_rubric_have_nothing_to_complain_of():
    assert list(kit_complaints()) == []
