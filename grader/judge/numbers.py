"""Shorten the numbers in what students read: rounding noise becomes 0, long ones lose digits."""

import re

NOISE = 1e-12  # maximum of rounding errors; no check asks for smaller numbers
MAX_WHOLE = 12  # digits before the point
MAX_DIGITS = 9  # digits, enough to distinguish *Expected* from *Got*
NUMBER = re.compile(r"(?<![\w.])-?\d+(?P<rest>\.\d+)?(?P<power>e[-+]?\d+)?(?![\w]|\.\d)")


def shorten_both(expected: str, got: str) -> tuple[str, str]:
    """Shorten the numbers of *Expected* and *Got*, but keep differing ones different."""
    for digits in (MAX_DIGITS, 17):
        short = shorten_numbers(expected, digits), shorten_numbers(got, digits)
        if short[0] != short[1] or expected == got:
            return short
    return expected, got


def shorten_numbers(text: str, digits: int = MAX_DIGITS) -> str:
    """Return a text with its numbers shortened."""
    return NUMBER.sub(lambda found: shorten_number(found, digits), text)


def shorten_number(found: re.Match[str], digits: int) -> str:
    """Return one number as a short text."""
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
    """Return a text with 0.000 instead of -0.000."""
    return re.sub(r"-(?=0(\.0+)?(?![\d.e]))", "", text)
