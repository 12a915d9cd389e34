"""What should not be in a TODO's region any more, and what never runs there."""

import pytest

from grader.source.leftovers import (
    find_alias,
    find_dead_end,
    find_idle,
    find_leftover,
    find_loop,
    find_rebound,
    find_return_in_loop,
    find_swapped_sign,
    find_unread,
)

STUB = "    world.step(STEP)\n    steps = 1"
RETURN = "    return None"


def function(*lines: str) -> str:
    body = "\n".join(f"    {line}" for line in lines)
    return f"def work(world, x):\n    # TODO 6: steps\n{body}\n    # END TODO 6\n    return x\n"


@pytest.mark.parametrize(
    ("lines", "found"),
    [
        (("world.step(STEP)", "steps = 1", "x += 1"), (3, 4, "world.step(STEP)")),
        (("x += 1", "world.step(STEP)", "steps = 1"), (4, 5, "world.step(STEP)")),
        (("steps = 1", "x += 1"), (3, 3, "steps = 1")),
        (("x += 1", "steps = 1", "x += 2"), None),  # it may well be theirs
        (("world.step(STEP)", "steps = 1"), None),  # nothing else is there
        (("x += 1",), None),
    ],
)
def test_lines_of_the_stub_at_an_end_are_left(lines: tuple[str, ...], found: object):
    left = find_leftover(function(*lines), "6", STUB)
    assert (left and (left.line, left.last, left.text)) == found


def test_the_text_without_them_keeps_its_lines():
    text = function("world.step(STEP)", "steps = 1", "x += 1")
    left = find_leftover(text, "6", STUB)
    assert left is not None and left.without.splitlines()[2:5] == ["", "", "    x += 1"]


@pytest.mark.parametrize(
    ("lines", "line", "is_first"),
    [
        (("return None", "x += 1"), 3, True),
        (("x += 1", "return None", "x += 2"), 4, False),
        (("if x:", "    return 1", "else:", "    raise ValueError", "x += 1"), 3, True),
    ],
)
def test_code_below_a_return_never_runs(lines: tuple[str, ...], line: int, is_first: bool):
    found = find_dead_end(function(*lines), "6", "work")
    assert found is not None and (found.line, found.is_first) == (line, is_first)


@pytest.mark.parametrize("lines", [("return x",), ("if x:", "    return 1", "x += 1"), ("x += (",)])
def test_given_code_below_a_return_is_no_dead_end(lines: tuple[str, ...]):
    assert find_dead_end(function(*lines), "6", "work") is None


def test_an_argument_with_fields_keeps_its_value():
    text = function("world.step(STEP)", "x = 1", "world = 2")
    assert find_rebound(text, "6", "work") == (5, "world")
    assert find_rebound(function("world.step(x)", "x = 1"), "6", "work") is None


def test_a_name_that_nothing_reads_is_found():
    assert find_unread(function("world.step(x)", "gravity = 3", "_ = 4"), "6", "work") == (
        4,
        "gravity",
    )
    assert find_unread(function("y = 3", "x = y"), "6", "work") is None  # given code returns x


@pytest.mark.parametrize(
    ("lines", "answers"),
    [
        (("x += 1", "return None"), True),
        (("if x:", "    return 1", "return None"), False),
    ],
)
def test_a_given_return_below_own_code_gives_every_answer(lines: tuple[str, ...], answers: bool):
    left = find_leftover(function(*lines), "6", "return None")
    assert left is not None and left.answers is answers


def test_the_first_loop_is_the_one_to_look_at():
    assert find_loop(function("while x > 0:", "    pass"), "6") == (3, "while x > 0:")
    assert find_loop(function("for _ in range(3):", "    pass"), "6") is None


def test_code_nested_beyond_all_measure_is_read_all_the_same():
    text = function("y = " + "+".join(["x"] * 900), "while x:", "    pass", "steps = 1")
    left = find_leftover(text, "6", STUB)
    assert (left and left.text) == "steps = 1" and find_loop(text, "6") == (4, "while x:")
    assert find_dead_end(text, "6", "work") is None


def test_a_loop_over_a_range_may_count_with_a_name_that_nothing_reads():
    assert find_unread(function("for i in range(3):", "    x += 1"), "6", "work") is None
    found = find_unread(function("x = any(x for each in x)"), "6", "work")
    assert found == (3, "each")


def test_a_plus_behind_the_sign_is_found():
    assert find_swapped_sign(function("y = 1", "x =+ y"), "6") == (4, "=+", "+=")
    assert find_swapped_sign(function("x = +y", "x =-y", "x == + y"), "6") is None


def test_a_return_that_ends_its_loop_is_found():
    lines = ("for each in x:", "    found = each", "    return found")
    assert find_return_in_loop(function(*lines), "6") == 5
    lines = ("for each in x:", "    if each:", "        return each")
    assert find_return_in_loop(function(*lines), "6") is None


@pytest.mark.parametrize(
    ("inner", "is_lost"),
    [("return max(low, value)", True), ("world.step(value)\n        return low", False)],
)
def test_a_lost_answer_is_told_only_of_functions_that_do_nothing_else(inner, is_lost):
    text = (
        "def run(world, low):\n    # TODO 6: count\n    def own(value):\n"
        f"        {inner}\n    own(3)\n    # END TODO 6\n    return low\n"
    )
    assert (find_idle(text, "6") is not None) == is_lost


@pytest.mark.parametrize(
    ("line", "alias"),
    [
        ("near.x = 3", (3, "near", "a.pos")),
        ("near -= low", (3, "near", "a.pos")),
        ("near = near - low", None),
    ],
)
def test_a_second_name_of_a_vector_is_told_where_it_is_changed(line, alias):
    text = (
        "def run(a, low):\n    # TODO 6: count\n    near = a.pos\n"
        f"    {line}\n    # END TODO 6\n    return near\n"
    )
    assert find_alias(text, "6") == alias
