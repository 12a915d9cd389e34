"""Known mistakes in TODO B6, by which keys give a heavy ball."""

from collections.abc import Callable
from functools import partial

from grader.checks.todo_b6.checks import CLICKS
from grader.judge.misconceptions import always, mistake, truth

HEAVY = 10.0


def heavy_where(held: Callable[[set[str]], bool]) -> Callable[[], list[float]]:
    """Heavy where the keys that are held are such."""
    return always([HEAVY if held(set(keys.split("+")) - {""}) else 1.0 for keys, _ in CLICKS])


LEFT, RIGHT = "left shift", "right shift"

truth("heaviness", heavy_where(lambda keys: LEFT in keys or RIGHT in keys))

known = partial(mistake, "B6", "heaviness")

known(
    "always-heavy",
    "Every ball is heavy: ask pygame whether Shift is held now.",
    heavy_where(lambda keys: True),
)
known(
    "only-the-left-shift",
    "Only the left Shift counts; KMOD_SHIFT is the mask for both.",
    heavy_where(lambda keys: LEFT in keys),
)
known(
    "only-the-right-shift",
    "Only the right Shift counts; KMOD_SHIFT is the mask for both.",
    heavy_where(lambda keys: RIGHT in keys),
)
known(
    "both-shifts-at-once",
    "No Shift counts alone: KMOD_SHIFT is a mask for two keys, so test with & and not with ==.",
    heavy_where(lambda keys: keys == {LEFT, RIGHT}),
)
known(
    "nothing-else-held",
    "Shift does not count beside another key or Num Lock: test with & and not with ==.",
    heavy_where(lambda keys: keys in ({LEFT}, {RIGHT}, {LEFT, RIGHT})),
)
known(
    "any-modifier",
    "Other keys count as well, such as Ctrl; look at KMOD_SHIFT only.",
    heavy_where(bool),
)
known(
    "heavy-without-shift",
    "The two cases are the wrong way round: a ball is heavy without Shift.",
    heavy_where(lambda keys: LEFT not in keys and RIGHT not in keys),
)
known(
    "shift-does-not-count",
    "Shift makes no ball heavy: get_mods() & KMOD_SHIFT tells whether it is held now. Events are "
    "gone once the window has read them.",
    heavy_where(lambda keys: False),
)
known(
    "control-for-shift",
    "Ctrl makes a ball heavy, and Shift does not: KMOD_SHIFT is the mask for Shift.",
    # The last click comes in the frame of the one before it.
    always([HEAVY if "ctrl" in keys else 1.0 for keys, _ in CLICKS[:-1]] + [1.0]),
)
