"""How properties draw their examples: the judge's settings, seeds and recorded examples.

Marks depend on it, and hypothesis has no public names for some of it. Its private names are used
here and nowhere else; `tests/judge/test_drawing.py` fails where an upgrade changes one of them, or
what is drawn.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial, wraps
from typing import Any

import hypothesis
from hypothesis.internal.conjecture import providers

EXAMPLES = 25  # per property

Example = Callable[..., None]  # a property with all that was drawn for it; takes a lab

JUDGE_SETTINGS = hypothesis.settings(
    derandomize=True,
    deadline=None,
    database=None,
    max_examples=EXAMPLES,
    report_multiple_bugs=False,
    print_blob=False,
    phases=(hypothesis.Phase.explicit, hypothesis.Phase.generate, hypothesis.Phase.shrink),
    suppress_health_check=list(hypothesis.HealthCheck),  # pyright: ignore[reportArgumentType]
)
hypothesis.settings.register_profile("judge", JUDGE_SETTINGS)

# Without this, examples would depend on which of our modules happen to be loaded, and on what
# hypothesis has drawn in this process before.
NO_CONSTANTS = type(providers._local_constants)()
providers._get_local_constants = lambda: NO_CONSTANTS
providers.CONSTANTS_CACHE.cache.clear()


@contextmanager
def judge_settings() -> Iterator[None]:
    """The judge's settings for every property that has none of its own."""
    usual = hypothesis.settings.get_current_profile_name()
    hypothesis.settings.load_profile("judge")
    try:
        yield
    finally:
        hypothesis.settings.load_profile(usual)


@contextmanager
def kept_examples(function: Any) -> Iterator[list[Example]]:
    """The examples of a property, as they come; of any other check there are none."""
    examples: list[Example] = []
    if not hasattr(function, "hypothesis"):
        yield examples
        return
    inner = function.hypothesis.inner_test

    @wraps(inner)  # hypothesis draws by the source and signature, which stay the same
    def example(*args: Any, **drawn: Any) -> None:
        examples.append(partial(inner, *args, **{k: drawn[k] for k in drawn if k != "lab"}))
        inner(*args, **drawn)

    function.hypothesis.inner_test = example
    try:
        yield examples
    finally:
        function.hypothesis.inner_test = inner


@contextmanager
def seeded(function: Any, seed: int | None) -> Iterator[None]:
    """Let a property draw as the judge does, by this seed, this once.

    The function outlives the grade, and may have been loaded under other settings before it.
    """
    hypothesis.seed(seed)(function)
    if not hasattr(function, "_hypothesis_internal_settings_applied"):  # by a decorator of its own
        function._hypothesis_internal_use_settings = JUDGE_SETTINGS
    try:
        yield
    finally:
        hypothesis.seed(None)(function)
