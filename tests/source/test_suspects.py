"""Find lines of a TODO's region that look wrong, or never run."""

import pytest

from grader.source.suspects import (
    RegionCode,
    find_dead_end,
    find_idle,
    find_leftover,
    find_suspects,
)

STUB = "    world.step(STEP)\n    steps = 1"


def region(*lines: str) -> RegionCode:
    """Return a region of these lines, which begins in line 3."""
    body = "\n".join(f"    {line}" for line in lines)
    text = f"def work(world, x):\n    # TODO 6: steps\n{body}\n    # END TODO 6\n    return x\n"
    return RegionCode(text, "6", "work")


@pytest.mark.parametrize(
    ("lines", "first", "last"),
    [
        (("world.step(STEP)", "steps = 1", "x += 1"), 3, 4),
        (("x += 1", "world.step(STEP)", "steps = 1"), 4, 5),
        (("steps = 1", "x += 1"), 3, 3),
        (("x += 1", "steps = 1", "x += 2"), 0, 0),  # it may well be theirs
        (("world.step(STEP)", "steps = 1"), 0, 0),  # nothing else is there
        (("x += 1",), 0, 0),
    ],
)
def test_lines_of_the_stub_at_an_end_are_left_over(lines: tuple[str, ...], first: int, last: int):
    found = find_leftover(region(*lines), STUB)
    assert bool(found) == bool(first)
    if found is not None:
        assert (found.line, found.last.line) == (first, last)
        left = [line.strip() for line in found.without.splitlines()[2 : 2 + len(lines)]]
        assert left == [line if line.startswith("x") else "" for line in lines]


@pytest.mark.parametrize(
    ("lines", "answers"),
    [(("x += 1", "return None"), True), (("if x:", "    return 1", "return None"), False)],
)
def test_a_given_return_below_own_code_gives_every_answer(lines: tuple[str, ...], answers: bool):
    found = find_leftover(region(*lines), "return None")
    assert found is not None and found.is_only_return is answers


@pytest.mark.parametrize(
    ("lines", "line", "is_first"),
    [
        (("return None", "x += 1"), 3, True),
        (("x += 1", "return None", "x += 2"), 4, False),
        (("if x:", "    return 1", "else:", "    raise ValueError", "x += 1"), 3, True),
        (("return x",), 0, False),  # only given code stands below it
        (("if x:", "    return 1", "x += 1"), 0, False),
        (("x += (",), 0, False),
    ],
)
def test_code_below_a_return_never_runs(lines: tuple[str, ...], line: int, is_first: bool):
    code = region(*lines)
    found = find_dead_end(code)
    assert (found.line if found else 0) == line
    assert bool(found and found.line == code.first_line) == is_first


@pytest.mark.parametrize(
    ("kind", "lines", "line", "words"),
    [
        ("rebound", ("world.step(STEP)", "x = 1", "world = 2"), 5, "`world` another value"),
        ("rebound", ("world.step(x)", "x = 1"), 0, ""),
        ("unread", ("world.step(x)", "gravity = 3", "_ = 4"), 4, "gives `gravity` a value"),
        ("unread", ("y = 3", "x = y"), 0, ""),  # given code returns x
        ("unread", ("for i in range(3):", "    x += 1"), 0, ""),
        ("unread", ("x = any(x for each in x)",), 3, "`each`"),
        ("loop", ("while x > 0:", "    pass"), 3, "`while x > 0:`"),
        ("loop", ("for _ in range(3):", "    pass"), 0, ""),
        ("swapped sign", ("y = 1", "x =+ y"), 4, "has =+, which"),
        ("swapped sign", ("x = +y", "x =-y", "x == + y"), 0, ""),
        ("return in loop", ("for each in x:", "    y = each", "    return y"), 5, "first round"),
        ("return in loop", ("for each in x:", "    if each:", "        return each"), 0, ""),
        ("alias", ("near = world.pos", "near.x = 3"), 3, "`near` is `world.pos` itself"),
        ("alias", ("near = world.pos", "near -= x"), 3, "Vector2(world.pos)"),
        ("alias", ("near = world.pos", "near = near - x"), 0, ""),
    ],
)
def test_a_line_that_looks_wrong_is_named(kind: str, lines: tuple[str, ...], line: int, words: str):
    found = find_suspects(region(*lines)).get(kind)
    assert (found.line if found else 0) == line
    assert found is None or (f"ine {line}" in found.words and words in found.words)


@pytest.mark.parametrize(
    ("inner", "is_lost"),
    [("return max(x, value)", True), ("world.step(value)\n        return x", False)],
)
def test_an_answer_is_lost_only_of_functions_that_do_nothing_else(inner: str, is_lost: bool):
    code = region("def own(value):", f"    {inner}", "own(3)")
    assert (find_idle(code) is not None) == is_lost


def test_code_that_is_nested_deeply_is_read_all_the_same():
    code = region("y = " + "+".join(["x"] * 900), "while x:", "    pass", "steps = 1")
    left = find_leftover(code, STUB)
    assert left is not None and left.line == 6
    assert find_suspects(code)["loop"].line == 4 and find_dead_end(code) is None
