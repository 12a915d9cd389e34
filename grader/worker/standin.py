"""Replace a function by another, also where it is already imported or stored.

Imports, default arguments and tables of functions all hold a function. So no name is rebound: the
function object itself gets other code, which calls the replacement.
"""

import inspect
import warnings
from collections.abc import Callable, Sequence
from types import CodeType, FunctionType
from typing import Any

Function = Callable[..., Any]

POSITIONAL = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
VARIABLE = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)

PLACEHOLDER = "the replacement"
with warnings.catch_warnings(action="ignore"):  # a text is not callable
    CALL = compile(f"def call(*args, **kw): return {PLACEHOLDER!r}(*args, **kw)", "", "exec")
DETOUR = next(each for each in CALL.co_consts if isinstance(each, CodeType))


def replace_function(original: FunctionType, replacement: Function) -> FunctionType:
    """Make every call of `original` call `replacement`; return a copy of the original."""
    before = FunctionType(
        original.__code__,
        original.__globals__,
        original.__name__,
        original.__defaults__,
        original.__closure__,
    )
    before.__kwdefaults__ = original.__kwdefaults__
    if isinstance(replacement, FunctionType):  # so that an error of a call names the original
        replacement.__qualname__ = original.__qualname__
    original.__code__ = DETOUR.replace(
        co_name=original.__name__,
        co_freevars=original.__code__.co_freevars,  # Python needs one per cell
        co_consts=tuple(replacement if each == PLACEHOLDER else each for each in DETOUR.co_consts),
    )
    return before


def plain_function(thing: Any) -> FunctionType | None:
    """Return the function beneath decorators; None if there is none."""
    if isinstance(thing, staticmethod | classmethod):
        thing = thing.__func__
    try:
        thing = inspect.unwrap(thing)
    except ValueError:  # decorators in a circle
        return None
    return thing if isinstance(thing, FunctionType) else None


def adapt(wanted: Function, parameters: Sequence[str], original: FunctionType) -> Function | None:
    """Wrap `wanted` so that it takes `original`'s arguments; return None if they do not match.

    `parameters` are those of `wanted`, in order. The original may have other names, another order,
    or further parameters with defaults at the end.
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
