"""Keep some cases of a large family in `make test` and leave the rest to `make soak`."""

from collections.abc import Iterable
from typing import Any

import pytest


def sample(cases: Iterable[Any], every: int) -> list[Any]:
    """Return the cases of a parametrised test, all but each nth marked `soak`.

    Of `sample("abcde", 2)`, the quick run has a, c and e.
    """
    return [
        case
        if number % every == 0
        else pytest.param(*(case if isinstance(case, tuple) else (case,)), marks=pytest.mark.soak)
        for number, case in enumerate(cases)
    ]
