"""Draw examples by the name of the check and the seed alone."""

import subprocess
import sys
from contextlib import nullcontext
from pathlib import Path

import pytest
from hypothesis import strategies as st

from grader.judge.drawing import EXAMPLES, between, given, kept_examples
from grader.judge.task import KIT

ALL_EXAMPLES = """
import sys
from grader.judge.drawing import given, kept_examples
from grader.judge.jobs import load_checks
from grader.judge.rubric import load_rubric
from hypothesis import strategies as st

if sys.argv[1:]:
    __import__(sys.argv[1])

def show(name, function):
    function.hypothesis.inner_test = lambda lab, **drawn: print(name, drawn)
    with kept_examples(function, 3):
        function(lab=None)

for todo in load_rubric().todos:
    for check in todo.checks:
        function = getattr(load_checks(todo), check.id)
        if hasattr(function, "hypothesis"):
            show(check.id, function)

@given(examples=400, n=st.integers(-10**6, 10**6))
def a_large_number(lab, n): ...

show("a_large_number", a_large_number)
"""


def examples_of_all(folder: Path, *modules: str) -> tuple[list[str], list[str]]:
    """Return the examples of all properties in a new process, and those of large integers."""
    command = [sys.executable, "-c", ALL_EXAMPLES, *modules]
    path = {"PYTHONPATH": f"{KIT}:{folder}", "PATH": ""}
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=path)
    lines = done.stdout.splitlines()
    large = [each for each in lines if each.startswith("a_large_number")]
    return [each for each in lines if each not in large], large


@pytest.mark.soak
def test_loaded_modules_change_no_example(tmp_path: Path):
    """Large integers show that hypothesis takes numbers from this module."""
    numbers = ", ".join(f"{n}, {n / 8}" for n in range(100, 600))
    (tmp_path / "full_of_numbers.py").write_text(f"NUMBERS = [{numbers}]\n")
    usual, usual_large = examples_of_all(tmp_path)
    beside, large = examples_of_all(tmp_path, "full_of_numbers")
    assert len({each.split()[0] for each in usual}) > 8
    assert usual_large != large
    assert usual == beside


class Seen(list):
    """A lab that keeps what was drawn."""

    settled = nullcontext


def draw(function, seed: int | None = 1) -> list:
    found = Seen()
    with kept_examples(function, seed):
        function(lab=found)
    return found


def make_property(text: str = "pass", name: str = "numbers"):
    """Return a property with this name and text."""
    names: dict = {"given": given, "between": between, "st": st}
    exec(
        f"@given(n=between(-1000, 1000), x=st.integers(0, 9))\n"
        f"def {name}(lab, n, x):\n    {text}\n    lab.append((n, x))\n",
        names,
    )
    return names[name]


def test_the_seed_and_the_name_decide_and_the_text_does_not():
    usual = draw(make_property())
    assert len(usual) == EXAMPLES
    assert draw(make_property("y = 1234567")) == usual
    assert draw(make_property(), seed=2) != usual
    assert draw(make_property(name="other_numbers")) != usual


def test_numbers_between_two_are_all_that_can_come():
    @given(examples=400, n=between(-7, 60))
    def spread(lab, n: int) -> None:
        lab.append(n)

    found = draw(spread)
    assert (found[0], min(found), max(found)) == (0, -7, 60)
    assert len(set(found)) > 50


def test_a_failing_property_ends_with_the_simplest_example():
    @given(n=between(-1000, 1000))
    def small(lab, n: int) -> None:
        lab.append(n)
        assert n < 150

    found = Seen()
    with kept_examples(small, None), pytest.raises(AssertionError):
        small(lab=found)
    assert found[-1] == 150


def test_examples_can_be_repeated():
    function = make_property()
    inner = function.hypothesis.inner_test
    with kept_examples(function, 1) as examples:
        function(lab=(found := Seen()))
    assert function.hypothesis.inner_test is inner
    again = Seen()
    for example in examples:
        example(lab=again)
    assert again == found == draw(function)
