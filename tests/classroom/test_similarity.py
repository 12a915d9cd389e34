"""Test similar submissions: changed copies are shown, independent ones are not."""

import io
import re
import tokenize
from pathlib import Path

import pytest
from counting import count_calls
from page_readers import HOSTILE, Reader
from points_pool import Inline
from rich.console import Console
from samples import sample
from whole_bank import bank

from grader.classroom import grading, similarity
from grader.classroom.grading import ClassOptions, run_class
from grader.classroom.similarity import (
    EXPECTED,
    Pair,
    Prints,
    compare,
    find_pairs,
    make_prints,
    read_pairs,
    read_tokens,
)
from grader.intake.found import Package, Work
from grader.intake.packing import pack
from grader.judge.task import KIT, Options

WHOLE = [  # members of the bank, each with an engine written independently
    "whole-functional-style",
    "whole-numpy-inside",
    "whole-slots-and-floats",
    "whole-very-terse",
    "single-file-dataclasses",
]


@pytest.fixture(scope="module")
def right_members(tmp_path_factory) -> dict[str, Package]:
    """Return right members of the bank with independent engines: whole programs."""
    return pack_members(tmp_path_factory.mktemp("right"), "|".join(WHOLE))


def pack_members(place: Path, pattern: str) -> dict[str, Package]:
    """Return the right members of the bank with these names."""
    found = {}
    for member in bank():
        if member.kind == "right" and re.fullmatch(pattern, member.name):
            member.build(place / member.name)
            found[member.name] = pack(Work(member.name, (place / member.name,)))
    return found


def shares(packages: list[Package]) -> list[Pair]:
    return find_pairs([make_prints(each) for each in packages], 0.0)


@pytest.mark.soak
def test_independent_right_answers_stay_below_what_is_expected(right_members, tmp_path):
    whole = shares([keep_own_files(right_members[name]) for name in WHOLE])
    assert len(whole) == 10 and max(each.share for each in whole) < 0.2 < EXPECTED
    tasks = [each for _, each in sorted(pack_members(tmp_path, "[1-8].*").items())]
    assert max((each.share for each in shares(tasks)), default=0.0) <= EXPECTED


def keep_own_files(package: Package) -> Package:
    """Leave out what a member takes from another one and edits, such as the window."""
    own = KIT / "tests" / "bank" / "right" / package.name
    files = [(name, content) for name, content in package.files if (own / name).is_file()]
    return Package(package.name, files)


def disguise(package: Package) -> Package:
    """Return the same code with other names, numbers, comments, line breaks and order of
    functions."""
    files = []
    for name, content in package.files:
        text = content.decode()
        if name.endswith(".py"):
            text = re.sub(r"\b(body|velocity|normal|dt|state)\b", r"my_\1", text)
            text = re.sub(r"\b\d+\.\d+\b", "3.25", text)
            parts = re.split(r"(?m)^(?=def |class )", text)
            text = "# mine\n".join([parts[0], *reversed(parts[1:])])
        files.append((name, text.encode()))
    return Package("copy", files)


@pytest.mark.parametrize("name", sample(["whole-very-terse", "whole-functional-style"], 2))
def test_a_copy_is_shown_however_it_is_dressed(right_members, name):
    (pair,) = find_pairs(
        [
            make_prints(p)
            for p in [*(right_members[n] for n in WHOLE), disguise(right_members[name])]
        ]
    )
    assert set(pair.names) == {"copy", name} and pair.share > 0.8


def test_what_everybody_was_given_and_the_solutions_wording_tell_nothing(tmp_path):
    trees = [pack(Work(name, (KIT / name,))) for name in ("starter", "solution")]
    assert all(not make_prints(each).runs for each in trees)
    twins = [Package(name, trees[1].files) for name in ("ann", "ben")]
    assert find_pairs([make_prints(each) for each in twins], 0.0) == []


@pytest.mark.parametrize("end", ["$", "$ $", "?", "'", "'\\'\\'", '"""', '"""\\"'])
def test_a_line_that_is_no_python_has_tokens_too_and_costs_no_more(end: str):
    tokens = [*(("name", 1), ("=", 1), ("number", 1), ("name", 2), ("=", 2))]
    tokens += [("text", 2)] * ("'" in end or '"' in end)
    tokens += [*(("name", 3), ("=", 3), ("number", 3))] * ('"' not in end)
    assert read_tokens(f"x = 1\ny = {end}\nz = 2\n") == tokens
    few, many = (count_calls(lambda n=n: read_tokens(f"{end} x" * n)) for n in (100, 200))
    assert many < 3 * few


def test_tokens_are_those_of_python():
    text = (KIT / "grader" / "text.py").read_text(encoding="utf-8")
    layout = (tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT)
    lines = [
        each.start[0]
        for each in tokenize.generate_tokens(io.StringIO(text).readline)
        if each.type not in (*layout, tokenize.ENDMARKER)
    ]
    assert [line for _, line in read_tokens(text)] == lines


def test_no_more_is_shown_of_two_than_a_person_reads(monkeypatch):
    monkeypatch.setattr(similarity, "MOST_SHOWN", 50)
    text = "".join(f"x{n} = {'+'.join('x' * (n % 97 + 2))}\n" for n in range(100)).encode()
    files = [(f"{letter}.py", text) for letter in "ab"]
    sides = compare(Package("ann", files), Package("ben", files))
    assert all(sum(map(len, side.values())) == 50 for side in sides)


def test_pairs_are_of_two_students_of_the_class_who_share_what_few_have(right_members):
    package = right_members["whole-very-terse"]

    def prints(*names: str, team: tuple[str, ...] = ()) -> list[Prints]:
        return [make_prints(Package(name, package.files), team) for name in names]

    (pair,) = find_pairs(prints("ann", "ben"))
    assert pair == Pair("ann", "ben", 1.0, pair.runs)
    assert not find_pairs(prints("ann", "ben", team=("one folder",)))
    pairs = {each.names for each in find_pairs(prints("a", "b", "c"), of={"a"})}
    assert pairs == {("a", "b"), ("a", "c")}
    assert not find_pairs(prints(*(f"s{number}" for number in range(9))))


def test_pairs_are_on_the_class_page_side_by_side_and_in_a_table(
    tmp_path, right_members, monkeypatch
):
    monkeypatch.setattr(grading, "open_executor", lambda wanted: Inline())
    package, classroom = right_members["whole-very-terse"], tmp_path / "class"
    wrong = "<script>alert(1)</script>"
    for name, each in (
        ("ann", package),
        ("ben", disguise(package)),
        ("zoe", right_members[WHOLE[0]]),
    ):
        files = [*each.files, ("note.py", f"x = '{wrong}{HOSTILE}'\n".encode())]
        Package(name, files).unpack(classroom) if classroom.mkdir(exist_ok=True) is None else None
    run_class(classroom, ClassOptions(Options()), Console(quiet=True))
    results = tmp_path / "class-results"
    (pair,) = read_pairs(results)
    assert pair.names == ("ann", "ben")
    page = (tmp_path / "class-results.class.html").read_text(encoding="utf-8")
    assert "ann and ben" in page and "class-results.alike.html#pair-1" in page
    shown = (tmp_path / "class-results.alike.html").read_text(encoding="utf-8")
    assert 'id="pair-1"' in shown and "<mark>" in shown and wrong not in shown
    assert not Reader(shown).count("script")
    table = (tmp_path / "class-results.alike.csv").read_text(encoding="utf-8-sig")
    assert table.splitlines()[1].startswith("ann,ben,")

    last = tmp_path / "2025"
    last.mkdir()
    Package("old", right_members[WHOLE[0]].files).unpack(last)
    run_class(classroom, ClassOptions(Options(), earlier=[last]), Console(quiet=True))
    assert {each.names for each in read_pairs(results)} == {("ann", "ben"), ("2025/old", "zoe")}
