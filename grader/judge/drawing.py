"""Draw the examples of properties: by explicit seeds, the same on every machine.

Only the public interface of hypothesis is used. The examples do not depend on the text of a check,
nor on other modules: hypothesis draws integers that it finds in modules, but none below 100, so
`between` builds its integers from smaller ones.
"""

import gc
import hashlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial, wraps
from pathlib import Path
from typing import Any

import hypothesis
from hypothesis import HealthCheck, Phase
from hypothesis import strategies as st
from hypothesis.configuration import set_hypothesis_home_dir

EXAMPLES = 25  # examples per property, by default
BASE = 100  # hypothesis takes only larger integers from loaded modules

Example = Callable[..., None]  # a property with its drawn arguments; takes a lab
Property = Callable[..., None]

CACHE = Path(__file__).parents[2] / "build" / "hypothesis"  # saves 0.4 s in each process
set_hypothesis_home_dir(CACHE)
gc.freeze()  # hypothesis collects all garbage before its first draw; what is loaded is none


def given(
    examples: int = EXAMPLES, **strategies: st.SearchStrategy[Any]
) -> Callable[[Property], Property]:
    """Make a check a property: hypothesis' own `given`, under the judge's settings.

    The first example is the simplest. With two examples or fewer, shrinking is not worth its time.
    """
    phases = [Phase.explicit, Phase.generate, Phase.shrink]
    settings = hypothesis.settings(
        deadline=None,
        database=None,
        max_examples=examples,
        report_multiple_bugs=False,
        print_blob=False,
        phases=phases if examples > 2 else phases[:2],
        suppress_health_check=list(HealthCheck),  # pyright: ignore[reportArgumentType]
    )
    return lambda function: settings(hypothesis.given(**strategies)(settled(function)))


def settled(function: Property) -> Property:
    """Make each example judge all its answers."""

    @wraps(function)
    def example(lab: Any, **drawn: Any) -> None:
        with lab.settled():
            function(lab, **drawn)

    return example


def between(low: int, high: int) -> st.SearchStrategy[int]:
    """Draw an integer from low to high, as two digits below 100; the simplest is nearest to 0."""
    size, simplest = high - low + 1, max(low, min(0, high))
    return st.builds(
        lambda large, small: low + (simplest - low + BASE * large + small) % size,
        st.integers(0, (size - 1) // BASE),
        st.integers(0, BASE - 1),
    )


@contextmanager
def kept_examples(function: Any, seed: int | None) -> Iterator[list[Example]]:
    """Seed a property by its name; collect the examples that it draws."""
    examples: list[Example] = []
    if not hasattr(function, "hypothesis"):
        yield examples
        return
    hypothesis.seed(number_of(f"{function.__name__} {seed}"))(function)
    inner = function.hypothesis.inner_test

    @wraps(inner)
    def example(*args: Any, **drawn: Any) -> None:
        examples.append(partial(inner, *args, **{k: drawn[k] for k in drawn if k != "lab"}))
        inner(*args, **drawn)

    function.hypothesis.inner_test = example
    try:
        yield examples
    finally:
        function.hypothesis.inner_test = inner


def number_of(text: str) -> int:
    """Hash a text to a number that is the same in every process."""
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:8], "big")
