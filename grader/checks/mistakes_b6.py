"""Known mistakes in TODO B6, by which clicks gave a heavy ball: no key, two Shifts, Ctrl."""

from grader.judge.misconceptions import mistake, truth

HEAVY = 10.0


@truth("heaviness")
def right() -> list[float]:
    return [1.0, HEAVY, HEAVY, 1.0]


def wrong(name: str, meaning: str, *weights: float) -> None:
    mistake("B6", name, meaning, about="heaviness")(lambda: list(weights))


wrong(
    "always-heavy",
    "Every ball is heavy: ask pygame whether Shift is held now.",
    *(HEAVY, HEAVY, HEAVY, HEAVY),
)
wrong(
    "only-the-left-shift",
    "Only the left Shift counts; KMOD_SHIFT is the mask for both.",
    *(1.0, HEAVY, 1.0, 1.0),
)
wrong(
    "both-shifts-at-once",
    "No Shift counts alone: KMOD_SHIFT is a mask for two keys, so test with & and not with ==.",
    *(1.0, 1.0, 1.0, 1.0),
)
wrong(
    "any-modifier",
    "Other keys count as well, such as Ctrl; look at KMOD_SHIFT only.",
    *(1.0, HEAVY, HEAVY, HEAVY),
)
wrong(
    "heavy-without-shift",
    "The two cases are the wrong way round: a ball is heavy without Shift.",
    *(HEAVY, 1.0, 1.0, HEAVY),
)
