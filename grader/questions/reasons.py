"""Say why: questions that a person marks, about a line of the student's own.

Each depends on how the student wrote a TODO: a line that does it in one way or another is found in
the syntax tree, quoted, and asked about.
"""

import ast
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from grader.questions.program import FUNCTIONS, CannotAsk, Program, Text
from grader.questions.question import Question
from grader.source.regions import parsed
from grader.text import printable

MOST_CODE = 8000  # characters of a function that is looked through
MOST_QUOTED = 160  # characters of a line


@dataclass(frozen=True)
class Reason:
    """A question about a statement of a certain form."""

    name: str
    todo: str
    has: Callable[[ast.stmt], bool]
    text: str
    rubric: tuple[str, ...]  # a point each


def has_call(*names: str) -> Callable[[ast.stmt], bool]:
    """Test whether a statement calls a function or method of one of these names."""
    return lambda node: any(
        isinstance(each, ast.Call) and ast.unparse(each.func).rpartition(".")[2] in names
        for each in walk_statement(node)
    )


def walk_statement(node: ast.stmt) -> Iterator[ast.AST]:
    """Walk a statement without the statements in it: of an `if`, its condition alone."""
    waiting: list[ast.AST] = [node]
    while waiting:
        each = waiting.pop()
        yield each
        waiting += [
            below for below in ast.iter_child_nodes(each) if not isinstance(below, ast.stmt)
        ]


def has_operator(*kinds: type[ast.AST]) -> Callable[[ast.stmt], bool]:
    return lambda node: any(isinstance(each, kinds) for each in walk_statement(node))


def is_kind(*kinds: type[ast.stmt]) -> Callable[[ast.stmt], bool]:
    return lambda node: isinstance(node, kinds)


def names(*wanted: str) -> Callable[[ast.stmt], bool]:
    """Whether a statement speaks of one of these names or attributes."""

    def speaks(node: ast.stmt) -> bool:
        said = {each.id for each in walk_statement(node) if isinstance(each, ast.Name)}
        said |= {each.attr for each in walk_statement(node) if isinstance(each, ast.Attribute)}
        return not said.isdisjoint(wanted)

    return speaks


CLAMP = (
    "The total is what the contact has pushed so far in this step; friction may not be more than "
    "the limit in all.",
    "A later pass may find that an earlier one pushed too much, and must be able to take it back.",
    "Clamped alone, each change may be up to the limit: after eight passes that is eight times it.",
)
ACCUMULATOR = (
    "What is not enough for a step is kept for the next frame, so no time is lost.",
    "Every step has the same length, so the physics does not hang on the frame rate.",
    "Without the upper bound a slow frame owes more steps, which make the next one slower still.",
)
CENTRE_INSIDE = (
    "Inside, the closest point is the centre itself, so the offset is 0 and has no direction.",
    "Dividing by its length would be a division by 0.",
    "The way out is then through the nearest face, and the depth is the radius and the gap.",
)
EXPONENTIAL = (
    "Each second the same share of what is left goes, so the speed falls exponentially.",
    "exp(-k dt) of many short steps multiplied is exp(-k t): the step cancels out.",
    "A fixed share per step, or 1 - k dt, would depend on how many steps a second has.",
)

REASONS = (
    Reason(
        "clamp",
        "4",
        has_call("max", "min", "clamp", "clip", "copysign"),
        "Your program clamps friction here. Why the total of all passes, and not the change that "
        "this pass makes? Say what would go wrong otherwise, with an example.",
        CLAMP,
    ),
    Reason(
        "clamp-by-hand",
        "4",
        is_kind(ast.If),
        "Your program compares the friction with its limit here. Why the total of all passes, and "
        "not the change that this pass makes? Say what would go wrong otherwise, with an example.",
        CLAMP,
    ),
    Reason(
        "accumulator",
        "6",
        is_kind(ast.While),
        "Your program runs steps in this loop. Why does it keep what is left afterwards, and why "
        "may a frame add only 8 steps?",
        ACCUMULATOR,
    ),
    Reason(
        "accumulator-by-division",
        "6",
        has_operator(ast.FloorDiv, ast.Mod),
        "Your program works out the number of steps here, by a division. Why does it keep what is "
        "left, and why may a frame add only 8 steps?",
        ACCUMULATOR,
    ),
    Reason(
        "centre-inside",
        "1",
        has_call("length", "length_squared", "magnitude", "magnitude_squared", "hypot", "sqrt"),
        "Your program takes a length here. Why does a centre inside of the box need a case of its "
        "own, and what is done there?",
        CENTRE_INSIDE,
    ),
    Reason(
        "exponential",
        "5",
        has_call("exp", "pow"),
        "Your program damps by this. Why is the speed after one second the same at every step?",
        EXPONENTIAL,
    ),
    Reason(
        "power",
        "5",
        has_operator(ast.Pow),
        "Your program damps by this power. Why is the speed after one second the same at every "
        "step?",
        EXPONENTIAL,
    ),
    Reason(
        "rod-impulse",
        "3",
        has_operator(ast.Div),
        "Your program divides here. What does that do, and why is one pass enough for a single "
        "rod, but not for a chain of them?",
        (
            "The impulse is the wanted change of speed, divided by the change per unit of impulse.",
            "After the pass the speed along the rod is exactly the wanted one.",
            "In a chain the next rod's impulse changes the speed of the body that both hold.",
        ),
    ),
    Reason(
        "spin-terms",
        "2",
        has_call("cross"),
        "Your program adds this. Why does a disc that can turn give way to friction three times "
        "as easily as one that cannot, and to a push at its centre not at all more?",
        (
            "An impulse off the centre turns the disc too, which moves the point of contact.",
            "With r² / (½ m r²) = 2/m the sum is 3/m instead of 1/m.",
            "A push along the line through the centre has no lever: the cross product is 0.",
        ),
    ),
    Reason(
        "two-accelerations",
        "8b",
        has_call("accel"),
        "Your velocity Verlet asks for the acceleration in this line and in another one. Which of "
        "the two answers could the next step use again, and what is won by the mean of both?",
        (
            "The one at the new place: the next step begins there.",
            "The mean makes the error of the velocity smaller by one order of dt.",
            "So half the step makes a quarter of the error, at the cost of one question per step.",
        ),
    ),
    Reason(
        "order-of-lines",
        "8a",
        is_kind(ast.Assign, ast.AugAssign, ast.Return),
        "Your semi-implicit Euler has this line. What would change if the place were moved before "
        "the velocity, and why do engines want it this way round?",
        (
            "It would be explicit Euler: moved with the old velocity.",
            "Explicit Euler gains energy in each swing, here the energy stays bounded.",
            "It costs the same: one question for the acceleration per step.",
        ),
    ),
    Reason(
        "four-samples",
        "8c",
        has_call("accel"),
        "Your RK4 asks for the acceleration here and three times more. What does it get for four "
        "questions per step, and when are four smaller steps of a simpler method better?",
        (
            "The error goes with the fourth power of dt: half the step, a sixteenth.",
            "Contacts make forces jump, and then the high order is lost.",
            "It does not keep the energy over a long time, as the symplectic methods do.",
        ),
    ),
    Reason(
        "moment",
        "7b",
        lambda node: True,
        "Your pymunk ball gets its moment here. What would be seen if the moment were infinite, "
        "and what if it were that of a ring?",
        (
            "Infinite: the ball never turns, friction only brakes it.",
            "A ring has m r², twice as much: it is harder to turn.",
            "So it rolls more slowly off a slope, and takes longer to roll without slipping.",
        ),
    ),
)


def find_reasons(program: Program) -> list[Reason]:
    """Return the questions about TODOs that are right, one for each, in a fixed order."""
    found: dict[str, Reason] = {}
    for each in REASONS:
        if each.todo in program.right and each.todo not in found and quote_line(program, each):
            found[each.todo] = each
    return list(found.values())


def ask_reason(each: Reason, program: Program, points: int) -> Question:
    """Ask the question with the student's own line in it."""
    line = quote_line(program, each)
    if not line:
        raise CannotAsk("no line of theirs has this form")
    name = FUNCTIONS[each.todo].partition(":")[2]
    return Question(
        f"why-{each.name}",
        "why",
        (each.todo,),
        f"The line below is of your `{name}`.\n{each.text}",
        points,
        code=(line,),
        rubric=each.rubric,
        by_hand=points,
    )


def quote_line(program: Program, each: Reason) -> str:
    """Return the first line of the student's function that has the form, as they wrote it."""
    text = program.own.find_function(FUNCTIONS[each.todo])
    module = parsed(text.source, MOST_CODE) if text else None
    if text is None or module is None or not module.body:
        return ""
    function = module.body[0]
    found = (
        node
        for node in ast.walk(function)
        if isinstance(node, ast.stmt) and node is not function and not is_docstring(node)
    )
    try:
        node = next(filter(each.has, found), None)
    except RecursionError:  # nested deeper than anybody writes
        return ""
    return line_of(text, node) if node is not None else ""


def is_docstring(node: ast.stmt) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


def line_of(text: Text, node: ast.stmt) -> str:
    """Return the line on which a statement begins."""
    return printable(text.source.splitlines()[node.lineno - 1]).strip()[:MOST_QUOTED]
