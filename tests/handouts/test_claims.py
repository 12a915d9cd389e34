"""What the handouts claim of measurements is what results.json beside them has.

claims.toml names, for each such sentence, the lines it rests on and what they must say.
"""

import json
import math
import operator
import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

import accuracy

HANDOUTS = Path(__file__).parents[2] / "handouts"
RESULTS = json.loads((HANDOUTS / "results.json").read_text(encoding="utf-8"))
CLAIMS = tomllib.loads((HANDOUTS / "claims.toml").read_text(encoding="utf-8"))
RULES = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "=": operator.eq}
ROWS = {  # of the leaderboard: how far off each engine is at equal substeps
    f"{title}: {name}": float(off) if (off := cell.split(" / ")[0])[0].isdigit() else off
    for title, row in RESULTS["rows"].items()
    for name, cell in row.items()
    if name not in ("physics", "may be off by")
}
RESULTS["hard-cases.md"] |= ROWS
PAGES = [page for page in RESULTS if page not in ("charts", "rows")]
LINES = {name: line for page in PAGES for name, line in RESULTS[page].items()}
EACH = [(page, says) for page, claims in CLAIMS.items() for says in claims]


def in_one_line(text: str) -> str:
    return re.sub(r"\s+", " ", text)


def value(lines: dict[str, Any], term: Any) -> Any:
    """A number as it is; a line by its name; [factor, line] for a multiple of a line."""
    if isinstance(term, list):
        factor, name = term
        return factor * lines[name]
    return lines.get(term, term)


def wrong(lines: dict[str, Any], evidence: list[Any]) -> str:
    """What is wrong with a claim's evidence, or nothing."""
    name, rule, limit = evidence
    if name not in lines:
        return f"{name}: there is no such line"
    found, wanted = lines[name], value(lines, limit)
    if isinstance(found, str) != isinstance(wanted, str) or not RULES[rule](found, wanted):
        return f"{name}: {found}, not {rule} {wanted}"
    return ""


@pytest.mark.parametrize(("page", "says"), EACH)
def test_a_claim_stands_in_its_handout_and_its_lines_say_so(page: str, says: str) -> None:
    assert in_one_line(says) in in_one_line((HANDOUTS / page).read_text(encoding="utf-8"))
    evidence = CLAIMS[page][says]
    assert evidence
    assert not [problem for line in evidence if (problem := wrong(RESULTS.get(page, LINES), line))]


def test_every_page_with_measurements_has_claims() -> None:
    pages = {"accuracy.md", "effects.md", "hard-cases.md"}
    assert set(PAGES) == pages
    assert set(CLAIMS) == pages | {"engines.md"}


@pytest.mark.parametrize(
    ("evidence", "is_wrong"),
    [
        (["a", "<", 2], False),
        (["a", ">", 2], True),
        (["a", "<", "b"], False),
        (["b", "<=", [2, "a"]], True),
        (["b", "<=", [4, "a"]], False),
        (["gone", "<", 1], True),
        (["word", "=", "cannot help"], False),
        (["word", "<", 1], True),
    ],
)
def test_a_claim_that_differs_from_its_line_is_found(evidence: list[Any], is_wrong: bool) -> None:
    lines = {"a": 1.0, "b": 3.0, "word": "cannot help"}
    assert bool(wrong(lines, evidence)) == is_wrong


TIMED = re.compile("time|within")  # lines that a clock has a part in


@pytest.mark.soak
def test_a_quick_run_agrees_with_the_full_one_in_all_that_they_share(tmp_path: Path) -> None:
    accuracy.main(["--quick", "--no-figures", "--out", str(tmp_path)])
    results = json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))
    lines = results["lines"]
    shared = [line for claim in CLAIMS["accuracy.md"].values() for line in claim]
    shared = [line for line in shared if line[0] in lines and known(lines, line[2])]
    assert len(shared) > 10
    assert not [problem for line in shared if (problem := wrong(lines, line))]
    full = RESULTS["accuracy.md"]
    both = [name for name in lines if name in full and not TIMED.search(name)]
    assert len(both) > 100
    assert not [
        (name, lines[name], full[name])
        for name in both
        if not agree(lines[name], full[name], 0.05 if name.endswith("work") else 1e-9)
    ]


def agree(one: Any, other: Any, share: float) -> bool:
    """Whether two lines agree but for a share: of rounding, or of opcodes in code tidied since."""
    words = isinstance(one, str) or isinstance(other, str)
    return one == other if words else math.isclose(one, other, rel_tol=share)


def known(lines: dict[str, Any], term: Any) -> bool:
    """Whether a run has what a claim's line is compared with."""
    name = term[1] if isinstance(term, list) else term
    return not isinstance(name, str) or name in lines or name not in RESULTS["accuracy.md"]
