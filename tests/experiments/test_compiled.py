"""Test the compiled build of the stable engine: same source, same bits."""

import importlib
import re
import shutil
import subprocess
import sys
import tomllib

import pytest

from experiments import compiled
from experiments.accuracy import crowds
from experiments.accuracy.runs import Effort
from experiments.compiled import Compiled, build, load, same_bits, sources, use_compiled
from experiments.engines import ENGINES, Stable
from experiments.measures import run
from experiments.scenes import on_floor

NO_COMPILER = not (shutil.which("cc") or shutil.which("gcc"))

WIND = """
from stable_compiled import Body, Bounce, Circle, Contacts, Effect, World, world
class Wind(Effect):
    rank = 1
    def force(self, h):
        for body in self.world.awake:
            body.vx += 100 * h
made = World(gravity=(0, 0), effects=[Wind()])
ball = made.add(Body(Circle(10), (0, 0), 1.0))
for _ in range(120):
    made.step(1 / 120)
print(world.__file__, round(ball.vel.x, 6), made.check())
told = []
contacts = Contacts(on_hit=lambda a, b, speed: told.append(speed))
made = World(gravity=(0, 0), effects=[contacts, Bounce()])
contacts.on_part = lambda a, b: told.append("part")
for place, speed in ((0, 100), (50, 0)):
    made.add(Body(Circle(10), (place, 0), 1.0, restitution=1)).vel = (speed, 0)
for _ in range(120):
    made.step(1 / 120)
print(*told)
"""


@pytest.mark.soak
@pytest.mark.skipif(NO_COMPILER, reason="no C compiler here")
def test_what_make_compiled_makes_has_the_same_bits_and_runs_plain_effects(
    tmp_path, no_package, capsys
):
    (tmp_path / "in").mkdir()
    with pytest.raises(SystemExit) as ended:
        compiled.main(["--out", f"{tmp_path}/in/../out"])  # as the Makefile has it
    assert ended.value.code == 0
    printed = capsys.readouterr().out
    assert "scenes: yes" in printed
    assert not same_bits(0.5)
    done = subprocess.run(
        [sys.executable, "-c", WIND], cwd=tmp_path / "out", capture_output=True, text=True
    )
    where, speed, checked, *told = done.stdout.split()
    assert not where.endswith(".py")
    assert (speed, checked) == ("100.0", "[]")
    assert told == ["100.0", "part"]


def test_the_project_of_a_wheel_names_every_module_that_is_compiled(tmp_path):
    compiled.main(["--project", str(tmp_path)])
    named = re.findall(r"stable_compiled/(\w+)\.py", (tmp_path / "setup.py").read_text("utf-8"))
    written = {path.stem for path in (tmp_path / "stable_compiled").glob("*.py")}
    left = {name.removesuffix(".py") for name in compiled.LEFT_PLAIN}
    assert set(named) == written - left
    assert tomllib.loads((tmp_path / "pyproject.toml").read_text("utf-8"))["project"]["version"]
    trial = tmp_path / "trial" / "falls.py"
    assert "from stable_compiled import" in trial.read_text("utf-8")
    assert not (trial.parent / compiled.NAME).exists()  # it imports the installed package


def stand_in(folder):
    """Make a package that looks compiled: the source with one file renamed."""
    package = folder / compiled.NAME
    package.mkdir()
    for name, text in sources().items():
        (package / name).write_text(text, "utf-8")
    return package


@pytest.fixture
def no_package(monkeypatch):
    """Remove the compiled package from imports and from use."""
    monkeypatch.setattr(Compiled, "package", None)
    monkeypatch.setitem(ENGINES, "stable", Stable)
    yield
    for name in [name for name in sys.modules if name.startswith(compiled.NAME)]:
        del sys.modules[name]


def test_without_a_compiled_build_the_plain_source_runs_and_it_is_said(tmp_path, no_package):
    assert "plain source" in use_compiled([tmp_path / "none", tmp_path])
    assert ENGINES["stable"] is Stable


def test_a_build_of_another_source_or_for_another_python_is_not_used(tmp_path, no_package):
    package = stand_in(tmp_path)
    assert load(tmp_path) is None  # as for another Python: only the source can be imported
    (package / "world.py").write_text("# of yesterday", "utf-8")
    assert load(tmp_path) is None


def test_a_compiled_build_is_used_where_there_is_one_and_it_is_said(
    tmp_path, no_package, monkeypatch
):
    package = stand_in(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    engine = importlib.import_module(package.name)
    monkeypatch.setattr(engine.world, "__file__", "world.so")
    assert str(tmp_path) in use_compiled([tmp_path / "none", tmp_path])
    made = ENGINES["stable"](on_floor())
    assert type(made.world).__module__ == f"{package.name}.world"
    run(made, 0.1)
    rows = crowds.study_crowd(crowds.ask_pile(8), Effort(quick=True, scale=0.1))["runs"]
    compiled_rows = [row for row in rows if row["engine"] == "compiled"]
    assert len(compiled_rows) == len(crowds.SUBSTEPS)
    assert all(min(row["ratio"]) > 0 for row in compiled_rows)


def test_a_build_that_fails_says_what_it_needs(tmp_path, monkeypatch):
    monkeypatch.setattr("sys.executable", shutil.which("false"))
    with pytest.raises(RuntimeError, match="needs mypy and a C compiler"):
        build(tmp_path)


def test_the_decorator_for_plain_effects_is_in_the_compiled_copy_alone():
    assert "mypyc_attr(allow_interpreted_subclasses=True)" in sources()["effect.py"]
    assert "mypyc" not in (compiled.TREE / "stable_engine/effect.py").read_text("utf-8")


def test_constants_are_final_in_the_compiled_copy_alone():
    text = sources()["contacts.py"]
    assert "FREQUENCY: Final = 0.24" in text
    assert text.startswith('"""Contacts') and "from typing import Final\n" in text
    assert "Final" not in (compiled.TREE / "stable_engine/contacts.py").read_text("utf-8")
