"""Test that results.json supports the handouts' claims about measurements.

For each such sentence, claims.toml names the lines it depends on and their required values.
"""

import json
import operator
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

HANDOUTS = Path(__file__).parents[2] / "handouts"
RESULTS = json.loads((HANDOUTS / "results.json").read_text(encoding="utf-8"))
CLAIMS = tomllib.loads((HANDOUTS / "claims.toml").read_text(encoding="utf-8"))
RULES = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "=": operator.eq}
ROWS = {  # of the leaderboard: each engine's error at equal substeps
    f"{title}: {name}": float(off) if (off := cell.split(" / ")[0])[0].isdigit() else off
    for title, row in (RESULTS["rows"] | RESULTS["rows that every engine holds"]).items()
    for name, cell in row.items()
    if name not in ("physics", "may be off by")
}
RESULTS["hard-cases.md"] |= ROWS
PAGES = [page for page in RESULTS if page.endswith(".md")]
LINES = {name: line for page in PAGES for name, line in RESULTS[page].items()}
EACH = [(page, says) for page, claims in CLAIMS.items() for says in claims]


def in_one_line(text: str) -> str:
    return re.sub(r"\s+", " ", text)


def value(lines: dict[str, Any], term: Any) -> Any:
    """Return a number, the line of a name, or for [factor, line] a multiple of a line."""
    if isinstance(term, list):
        factor, name = term
        return factor * lines[name]
    return lines.get(term, term)


def expand(lines: dict[str, Any], evidence: list[Any]) -> Iterator[list[Any]]:
    """Yield evidence of three terms for each line that its first term means."""
    name, rule, limit, *exceptions = evidence
    pattern = re.compile("(.+?)".join(map(re.escape, name.split("*"))))
    matches = [found for line in lines if (found := pattern.fullmatch(line))]
    texts = [found.groups() for found in matches if not {*found.groups()[:1]} & {*exceptions}]
    for each in texts or [()]:
        yield [fill(name, each), rule, fill(limit, each)]


def fill(term: Any, texts: tuple[str, ...]) -> Any:
    """Replace each * of a term by a text, in order."""
    if isinstance(term, list):
        return [fill(part, texts) for part in term]
    for text in texts if isinstance(term, str) else ():
        term = term.replace("*", text, 1)
    return term


def find_fault(lines: dict[str, Any], name: str, rule: str, limit: Any) -> str:
    """Return the fault in a claim's evidence, or an empty text."""
    if name not in lines:
        return f"{name}: there is no such line"
    found, wanted = lines[name], value(lines, limit)
    if isinstance(found, str) != isinstance(wanted, str) or not RULES[rule](found, wanted):
        return f"{name}: {found}, not {rule} {wanted}"
    return ""


@pytest.mark.parametrize(("page", "says"), EACH)
def test_a_claim_is_in_its_handout_and_its_lines_support_it(page: str, says: str) -> None:
    assert in_one_line(says) in in_one_line((HANDOUTS / page).read_text(encoding="utf-8"))
    lines = RESULTS.get(page, LINES)
    evidence = [each for row in CLAIMS[page][says] for each in expand(lines, row)]
    assert evidence
    assert not [*filter(None, (find_fault(lines, *each) for each in evidence))]


def test_every_page_with_measurements_has_claims() -> None:
    pages = {"accuracy.md", "effects.md", "hard-cases.md"}
    assert set(PAGES) == pages
    assert set(CLAIMS) == pages | {"engines.md"}
