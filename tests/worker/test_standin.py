"""Test replacing a function, also where it is already imported or stored."""

import functools
from collections.abc import Callable
from typing import Any

import pytest

from grader.worker.standin import adapt, plain_function, replace_function


def test_all_references_to_a_function_reach_the_replacement():
    def double(x: int, times: int = 2) -> int:
        return times * x

    alias, part, table = double, functools.partial(double, 3), {"double": double}
    bound: Callable[..., int] = lambda x, f=double: f(x)  # noqa: E731
    before = replace_function(double, lambda x, times=0: -x)
    assert [alias(3), part(), table["double"](3), bound(3)] == [-3] * 4
    assert before(3) == 6 and before(3, times=5) == 15


def test_a_closure_and_a_method_keep_what_they_know():
    def counter() -> Callable[[], int]:
        count = [0]

        def more() -> int:
            count[0] += 1
            return count[0]

        return more

    class World:
        def step(self, dt: float) -> tuple[type, float]:
            return __class__, dt  # type: ignore[name-defined]

    more, step = counter(), World().step
    before = replace_function(more, lambda: 0)
    assert (more(), before(), before()) == (0, 1, 2)
    kept = replace_function(World.step, lambda self, dt: -dt)
    assert step(2) == -2 and kept(World(), 2) == (World, 2)


def test_a_decorated_function_is_found_beneath():
    @functools.lru_cache
    def cached(x: int) -> int:
        return x

    def plain() -> None: ...

    assert plain_function(cached) is cached.__wrapped__
    assert plain_function(staticmethod(plain)) is plain
    assert plain_function(3) is None and plain_function(len) is None


def same(a: Any, b: Any) -> None: ...
def renamed(circle: Any, box: Any) -> None: ...
def optional(a: Any, b: Any, log: Any = None, *, deep: bool = False) -> None: ...
def other_order(b: Any, a: Any) -> None: ...
def one_more(a: Any, extra: Any, b: Any) -> None: ...
def anything(*args: Any, **kwargs: Any) -> None: ...
def positional(a: Any, b: Any, /) -> None: ...


@pytest.mark.parametrize(
    ("original", "args", "kwargs"),
    [
        (same, (1, 2), {}),
        (same, (1,), {"b": 2}),
        (renamed, (1, 2), {}),
        (renamed, (), {"box": 2, "circle": 1}),
        (optional, (1, 2), {}),
        (optional, (1, 2, "log"), {"deep": True}),
        (other_order, (2, 1), {}),
        (one_more, (1, "?", 2), {}),
        (anything, (1, 2), {}),
        (positional, (1, 2), {}),
    ],
)
def test_a_function_with_similar_parameters_is_adapted(original: Any, args: Any, kwargs: Any):
    replacement = adapt(lambda a, b: (a, b), ["a", "b"], original)
    assert replacement is not None and replacement(*args, **kwargs) == (1, 2)


def too_few(a: Any) -> None: ...
def too_many(x: Any, y: Any, z: Any) -> None: ...


@pytest.mark.parametrize("original", [too_few, too_many])
def test_a_function_with_other_parameters_is_refused(original: Any):
    assert adapt(lambda a, b: (a, b), ["a", "b"], original) is None
