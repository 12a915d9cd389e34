"""Putting one function in the place of another, for everybody who holds the other already.

A name can be bound many times over: by an import, as a default argument, in a table of functions.
So no name is bound anew. The function itself gets other code, which calls the one that stands in.
"""

import inspect
import warnings
from collections.abc import Callable, Sequence
from types import CodeType, FunctionType
from typing import Any

Function = Callable[..., Any]

POSITIONAL = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
VARIABLE = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)

PLACEHOLDER = "what stands in"
with warnings.catch_warnings(action="ignore"):  # nobody calls the text itself
    CALL = compile(f"def call(*args, **kw): return {PLACEHOLDER!r}(*args, **kw)", "", "exec")
DETOUR = next(each for each in CALL.co_consts if isinstance(each, CodeType))


def put_in_place(original: FunctionType, stand_in: Function) -> FunctionType:
    """Let every call of `original` reach `stand_in`; returns a function that is as it was."""
    before = FunctionType(
        original.__code__,
        original.__globals__,
        original.__name__,
        original.__defaults__,
        original.__closure__,
    )
    before.__kwdefaults__ = original.__kwdefaults__
    if isinstance(stand_in, FunctionType):  # so that an error of a call has the name it knows
        stand_in.__qualname__ = original.__qualname__
    original.__code__ = DETOUR.replace(
        co_name=original.__name__,
        co_freevars=original.__code__.co_freevars,  # Python wants as many as there are cells
        co_consts=tuple(stand_in if each == PLACEHOLDER else each for each in DETOUR.co_consts),
    )
    return before


def plain_function(thing: Any) -> FunctionType | None:
    """Return the function itself, beneath decorators that say what they wrap; None where there is
    none.
    """
    if isinstance(thing, staticmethod | classmethod):
        thing = thing.__func__
    try:
        thing = inspect.unwrap(thing)
    except ValueError:  # decorators in a circle
        return None
    return thing if isinstance(thing, FunctionType) else None


def fitted(wanted: Function, parameters: Sequence[str], original: FunctionType) -> Function | None:
    """Return `wanted` wrapped to take `original`'s arguments; None if they do not match.

    `parameters` are those of `wanted`, in order. The same ones may be named otherwise, stand in
    another order, or have further ones with defaults behind them.
    """
    signature = inspect.signature(original)
    theirs = list(signature.parameters.values())
    ordered = [each.name for each in theirs if each.kind in POSITIONAL]
    takes_any = any(each.kind is inspect.Parameter.VAR_POSITIONAL for each in theirs)
    alone = [each for each in theirs if each.kind not in VARIABLE]
    required = [each.name for each in alone if each.default is inspect.Parameter.empty]
    count = len(parameters)
    if set(parameters) <= {each.name for each in alone}:
        names = list(parameters)
    elif len(ordered) >= count and set(required) <= set(ordered[:count]):
        names = ordered[:count]
    elif takes_any and not ordered:
        return lambda *args, **kwargs: wanted(*args[:count])
    else:
        return None
    in_order = names == ordered[:count]

    def call(*args: Any, **kwargs: Any) -> Any:
        if in_order and len(args) >= count:
            return wanted(*args[:count])
        given = signature.bind(*args, **kwargs)
        given.apply_defaults()
        return wanted(*(given.arguments[name] for name in names))

    return call
