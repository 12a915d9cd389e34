"""Where no right version can stand in for a TODO, its mistakes cost no other TODO a point."""

import re
import shutil
import textwrap
from pathlib import Path

import pytest

from grader.bank.verify import shared_worker
from grader.judge.grade import KIT, Options, grade, shipped_reference
from grader.source.regions import regions_in, replaced

SINGLE = KIT / "tests" / "bank" / "single_file" / "mini_engine.py"
STUBS = {"4": "solver.py", "5": "world.py"}


@pytest.mark.parametrize(
    ("stub", "others"), [pytest.param("4", "2", marks=pytest.mark.soak), ("5", "4")]
)
def test_a_stub_in_a_single_file_costs_its_own_points(tmp_path: Path, stub: str, others: str):
    text = (KIT / "starter" / "mini_engine" / STUBS[stub]).read_text("utf-8")
    (code,) = [each.lines for each in regions_in(text) if each.id == stub]
    tree = tmp_path / "tree"
    tree.mkdir()
    shutil.copy(KIT / "solution" / "lab_runtime.py", tree)
    engine = SINGLE.read_text("utf-8")
    (own,) = [each.lines for each in regions_in(engine) if each.id == stub]
    margin = re.match(" *", own[0])[0]  # type: ignore[index]
    lines = textwrap.indent(textwrap.dedent("\n".join(code)), margin).splitlines()
    (tree / "mini_engine.py").write_text(replaced(engine, {stub: tuple(lines)}), "utf-8")
    options = Options(shipped_reference(), only=frozenset({stub, *others}), trusted=True)
    graded = grade(tree, options, shared_worker())
    points = {todo.id: (todo.points, todo.max_points) for todo in graded.todos}
    for id in others:
        assert points[id][0] == points[id][1]
    assert points[stub][0] == 0
