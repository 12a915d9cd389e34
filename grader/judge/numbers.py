"""Numbers in what students read: as many digits as tell something, and none that only frighten."""

import re

NOISE = 1e-12  # what rounding leaves around 0; no check asks for less
MAX_WHOLE = 12  # digits before the point
MAX_DIGITS = 9  # in all, where fewer than that tell *Expected* from *Got*
NUMBER = re.compile(r"(?<![\w.])-?\d+(?P<rest>\.\d+)?(?P<power>e[-+]?\d+)?(?![\w]|\.\d)")


def readable(expected: str, got: str) -> tuple[str, str]:
    """*Expected* and *Got* with tidy numbers; what differed before differs afterwards, too."""
    for digits in (MAX_DIGITS, 17):
        told = tidied(expected, digits), tidied(got, digits)
        if told[0] != told[1] or expected == got:
            return told
    return expected, got


def tidied(text: str, digits: int = MAX_DIGITS) -> str:
    """Return a text in which no number is longer than it must be, and 0 is 0."""
    return NUMBER.sub(lambda found: tidy(found, digits), text)


def tidy(found: re.Match[str], digits: int) -> str:
    """Return one number as text; a short one is unchanged."""
    text = found[0]
    whole = len(re.match(r"-?(\d+)", text)[1])  # type: ignore[index]
    if whole > 300:
        return f"a number of {whole} digits"
    value = float(text)
    if found["power"] and abs(value) < NOISE:
        return "0"
    if whole > MAX_WHOLE:
        return f"{value:.6g}"
    if not value:
        return text.removeprefix("-")
    if found["rest"] and len(text.partition("e")[0].strip("-0.").replace(".", "")) > digits:
        return f"{value:.{digits}g}"
    return text


def without_minus_zero(text: str) -> str:
    """Return the number without a sign where it is 0 in the digits shown: -0.000 reads as 0.000."""
    return re.sub(r"-(?=0(\.0+)?(?![\d.e]))", "", text)
