"""Known mistakes in TODO B6, by which clicks gave a heavy ball: no key, two Shifts, Ctrl."""

from functools import partial

from grader.judge.misconceptions import always, mistake, truth

HEAVY = 10.0


truth("heaviness", always([1.0, HEAVY, HEAVY, 1.0]))

known = partial(mistake, "B6", "heaviness")

known(
    "always-heavy",
    "Every ball is heavy: ask pygame whether Shift is held now.",
    always([HEAVY, HEAVY, HEAVY, HEAVY]),
)
known(
    "only-the-left-shift",
    "Only the left Shift counts; KMOD_SHIFT is the mask for both.",
    always([1.0, HEAVY, 1.0, 1.0]),
)
known(
    "both-shifts-at-once",
    "No Shift counts alone: KMOD_SHIFT is a mask for two keys, so test with & and not with ==.",
    always([1.0, 1.0, 1.0, 1.0]),
)
known(
    "any-modifier",
    "Other keys count as well, such as Ctrl; look at KMOD_SHIFT only.",
    always([1.0, HEAVY, HEAVY, HEAVY]),
)
known(
    "heavy-without-shift",
    "The two cases are the wrong way round: a ball is heavy without Shift.",
    always([HEAVY, 1.0, 1.0, HEAVY]),
)
