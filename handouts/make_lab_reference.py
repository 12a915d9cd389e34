"""Print all that a check can ask, from the docstrings of what it is given.

python handouts/make_lab_reference.py
"""

import ast
import inspect
import textwrap

from grader.judge.decode import Decoder
from grader.judge.lab import Advance, Lab, Moment, Run

SETTINGS = {"__init__", "opened", "probe", "remember", "ended"}  # the judge's own
HEAD = """# What a check can ask

For whoever writes a check: all that a `Lab` can do, from its docstrings, by
`handouts/make_lab_reference.py`. How a check is added is in `CONTRIBUTING.md`.

A check builds what it needs, asks one thing, and says what it wants. Bodies, worlds and joints live
with the submission: a check holds a `Thing` that stands for one, and reads its numbers by
`lab.state(body)` or `lab.get(thing, "name")`. Whatever comes back is a `Value`, which may be of any
type, and becomes numbers only through `lab.number`, `lab.pair` and the others
[below](#making-sure-of-an-answer). Write pairs as tuples: they come to the submission as `Vector2`.

```python
def the_second_body_is_pushed_the_other_way(lab: Lab) -> None:
    \"\"\"The second body is pushed the other way\"\"\"
    a, b = lab.circle((0, 0)), lab.circle((20, 0))
    lab.ran("two balls at rest, an impulse of (3, 0)")
    push, centre = (3.0, 0.0), (0.0, 0.0)
    lab.call("apply_impulse", a, b, push, centre, centre, changes={a: "vel", b: "vel"})
    first, second = lab.state(a).vel.x, lab.state(b).vel.x
    lab.want((first, second) == (-3, 3), "-3 and 3 px/s", f"{first:g} and {second:g} px/s")
```

`lab.call` and `lab.tell` want the name of a function or method. What is no function there, such as
`vel` of a body, is read with `lab.get`. A check that the solution fails is blamed by name when the
solution is graded, and nothing is graded until it is mended.
"""


def page():
    """Return the reference of Lab, in Markdown."""
    parts = [HEAD]
    for title, kind, name in (
        ("Asking", Lab, "lab."),
        ("Making sure of an answer", Decoder, "lab."),
        ("A recorded run", Run, "run."),
        ("One moment of it", Moment, "moment."),
        ("A frame of advance", Advance, "frame."),
    ):
        parts += [f"## {title}\n", *described(kind, name)]
    return "\n".join(parts)


def described(kind, name):
    """Return what a class is for, its fields, and its methods with their docstrings."""
    if kind not in (Lab, Decoder):
        yield f"{inspect.getdoc(kind)}\n"
    fields = getattr(kind, "__annotations__", {})
    if fields and kind is not Lab:
        yield ", ".join(f"`{name}{field}`" for field in fields) + "\n"
    for method, value in vars(kind).items():
        if method.startswith("_") or method in SETTINGS:
            continue
        if isinstance(value, property):
            yield f"### `{name}{method}`\n\n{inspect.getdoc(value) or ''}\n"
        elif inspect.isfunction(value) and value.__module__.startswith("grader"):
            yield f"### `{name}{method}`\n\n```python\n{shown(value, name)}\n```\n"
            yield f"{inspect.getdoc(value)}\n"


def shown(function, name):
    """A call with its parameters, their types and what they are if left out."""
    (node,) = ast.parse(textwrap.dedent(inspect.getsource(function))).body
    node.args.args = node.args.args[1:]  # without self
    back = ast.unparse(node.returns).strip("'")
    return f"{name}{node.name}({ast.unparse(node.args)}) -> {back}"


def main():
    print(page())


if __name__ == "__main__":
    main()
