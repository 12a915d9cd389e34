"""Nothing that is told of a submission comes from a run in which the reference took part."""

import shutil
from pathlib import Path

import pytest

from grader.judge.grade import KIT, Options, grade, shipped_reference
from grader.report.files import as_json

TOLD = 424_242.0  # px: the depth of a contact where the reference stands in
CONTACTS = "mini_engine/contacts.py"
BEGIN, END = "    # TODO 1", "    # END TODO 1"
READS = """
    from . import solver
    code = solver.effective_mass.__code__
    stand_ins = [each for each in code.co_consts if hasattr(each, "__closure__")]
    return Contact(a, b, Vector2(1, 0), {told} if stand_ins else 7.25, Vector2(a.pos))
"""


def telling(tree: Path, told: str) -> Path:
    """The solution, but that circle_box tells by its depth whether the reference is there."""
    shutil.copytree(KIT / "solution", tree, ignore=shutil.ignore_patterns("notebooks"))
    path = tree / CONTACTS
    text = path.read_text(encoding="utf-8")
    begin, end = text.index("\n", text.index(BEGIN)), text.index(END)
    path.write_text(text[:begin] + READS.format(told=told) + text[end:], encoding="utf-8")
    return tree


def test_numbers_of_a_run_with_the_reference_are_not_told(tmp_path: Path):
    tree, pages = telling(tmp_path / "tree", str(TOLD)), tmp_path / "pages"
    options = Options(shipped_reference(), only=frozenset({"1"}), replays=pages)
    result = grade(tree, options)
    failed = [check for check in result.todos[0].checks if check.state == "not yet"]
    assert len(failed) >= 5 and any("7.25" in check.got for check in failed)
    told = as_json(result).decode() + "".join(p.read_text("utf-8") for p in pages.glob("*.html"))
    assert "424242" not in told.replace(",", "").replace("_", "")


@pytest.mark.soak
@pytest.mark.parametrize("told", ['"a word"', "None", "1e300"])
def test_nor_are_its_types(tmp_path: Path, told: str):
    tree = telling(tmp_path / "tree", told)
    result = grade(tree, Options(shipped_reference(), only=frozenset({"1"})))
    alone = grade(tree, Options(None, only=frozenset({"1"})))
    words = [(c.ran, c.expected, c.got) for c in result.todos[0].checks if c.state == "not yet"]
    theirs = {c.id: (c.ran, c.expected, c.got) for c in alone.todos[0].checks}
    assert words and set(words) <= set(theirs.values())


RAISES = """
    import os
    name = {name}
    exec(compile("\\n" * 4 + "raise ValueError('no ' + chr(0xdc80))", name, "exec"))
"""


@pytest.mark.parametrize(
    "name",
    [
        "__file__ + '/../../../../../../etc/passwd'",
        "os.path.dirname(__file__) + '/not-there.py'",
        "__file__.replace('integrators', '\\u202egrators')",
        "'/etc/passwd'",
    ],
)
def test_only_files_of_the_submission_are_told_as_places(tmp_path: Path, name: str):
    """Code may name any file as its own, and a workflow would put its error there."""
    tree = tmp_path / "tree"
    tree.mkdir()
    text = (KIT / "solution" / "integrators.py").read_text(encoding="utf-8")
    begin = text.index("\n", text.index("    # TODO 8a"))
    text = text[:begin] + RAISES.format(name=name) + text[begin:]
    (tree / "integrators.py").write_text(text, encoding="utf-8")
    result = grade(tree, Options(shipped_reference(), only=frozenset({"8a"})))
    for check in result.todos[0].checks:
        assert check.state == "error" and check.got.startswith("ValueError: no \\udc80"), check
        assert check.where is not None and check.where.file == "integrators.py"
    assert "passwd" not in as_json(result).decode().replace(name, "")
