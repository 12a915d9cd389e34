"""Find the function that runs among the files of a submission."""

import shutil
from pathlib import Path

import pytest
from conftest import HandIn
from hypothesis import given, settings
from hypothesis import strategies as st

from grader.judge.submission import Submission, take_in
from grader.judge.task import KIT
from grader.source.definitions import MAX_CALLED, MAX_HOPS, MAX_NAME, MAX_TRIED, Program, source_of
from grader.source.regions import read_source

SOLVED = read_source(KIT / "solution" / "integrators.py")
STUBS = read_source(KIT / "starter" / "integrators.py")
F = "def f(): pass"
B = "class B:\n    def f(self): pass"


def defined_in(module: str, path: str, files: dict[str, str]) -> str | None:
    found = Program({Path(name): text for name, text in files.items()}).definition(module, path)
    return found and f"{found.module}:{found.function and found.function.name}"


@pytest.mark.parametrize(
    ("files", "where"),
    [
        ({"m.py": "def f(): pass"}, "m:f"),
        ({"m.py": "from other import f", "other.py": "def f(): pass"}, "other:f"),
        ({"m.py": "from other import g as f", "other.py": "def g(): pass"}, "other:g"),
        ({"m.py": "from other import *", "other.py": "def f(): pass"}, "other:f"),
        ({"m.py": "def g(): pass\nf = g"}, "m:g"),
        ({"m.py": "import other as o\nf = o.g", "other.py": "def g(): pass"}, "other:g"),
        ({"m.py": "def f(): return 1\ndef f(): return 2"}, "m:f"),
        ({"m.py": "try:\n    from fast import f\nexcept ImportError:\n    def f(): pass"}, "m:f"),
        ({"m/__init__.py": "from .a import f", "m/a.py": "def f(): pass"}, "m.a:f"),
        ({"m/__init__.py": "from . import a\nf = a.f", "m/a.py": "def f(): pass"}, "m.a:f"),
        ({"m/__init__.py": "from m.a import f", "m/a.py": "def f(): pass"}, "m.a:f"),
        ({"m/__init__.py": "from .a import *", "m/a.py": "from .b import f", "m/b.py": F}, "m.b:f"),
        ({"m/__init__.py": "from . import a", "m/a.py": "def f(): pass"}, "m.a:f"),
        # Files that do not run, or that run but do not matter.
        ({"m.py": "def f(): pass", "m_old.py": "def f(): pass"}, "m:f"),
        ({"m/__init__.py": "from .a import f", "m/a.py": F, "m/a_old.py": F}, "m.a:f"),
        ({"m/__init__.py": "def f(): pass", "m.py": "def f(): pass"}, "m:f"),
        ({"m.py": "import original\ndef f(): pass", "original.py": "def f(): pass"}, "m:f"),
        ({"m.py": "x = 1", "other.py": "def f(): pass"}, None),
        ({"m.py": "def f(:", "m_old.py": "def f(): pass"}, "m:None"),
        ({}, None),
    ],
)  # fmt: skip
def test_a_function_is_found_where_python_finds_it(files: dict[str, str], where: str | None):
    assert defined_in("m", "f", files) == where


@pytest.mark.parametrize(
    ("files", "where"),
    [
        ({"m.py": "class C:\n    def f(self): pass"}, "m:f"),
        ({"m.py": "class B:\n    def f(self): pass\nclass C(B): pass"}, "m:f"),
        ({"m.py": "from b import B\nclass C(B): pass", "b.py": B}, "b:f"),
        ({"m.py": "import b\nclass C(b.B): pass", "b.py": B}, "b:f"),
        ({"m.py": "def g(self): pass\nclass C:\n    f = g"}, "m:g"),
        ({"m.py": "def g(self): pass\nclass C: pass\nC.f = g"}, "m:g"),
        ({"m.py": "class D:\n    def f(self): pass\nC = D"}, "m:f"),
        ({"m.py": "class C:\n    if True:\n        def f(self): pass"}, "m:f"),
    ],
)  # fmt: skip
def test_a_method_is_found_where_python_finds_it(files: dict[str, str], where: str | None):
    assert defined_in("m", "C.f", files) == where


def test_names_in_a_circle_end_nowhere():
    files = {"m.py": "from n import f", "n.py": "from m import f"}
    assert defined_in("m", "f", files) is None


def taken_in(folder: Path, tmp_path: Path) -> Submission:
    return take_in(folder, tmp_path / "copy")


@pytest.mark.parametrize(
    "name", ["integrators_original.py", "original/integrators.py", "z/deep/integrators.py"]
)
def test_a_copy_of_the_starter_does_not_undo_the_work(name: str, hand_in: HandIn, tmp_path: Path):
    folder = hand_in("solution", **{name.replace("/", "__").replace(".py", "_py"): STUBS})
    assert taken_in(folder, tmp_path).begun["8b"]


def test_a_copy_of_the_work_does_not_replace_a_stub(hand_in: HandIn, tmp_path: Path):
    folder = hand_in("starter", aaa_py=SOLVED, zzz_py=SOLVED)
    assert not taken_in(folder, tmp_path).begun["8b"]


def test_a_region_outside_the_function_that_runs_says_nothing(hand_in: HandIn, tmp_path: Path):
    again = SOLVED.replace("def rk4", "def rk4_first_try")
    again += "\n\ndef rk4(x, v, dt, accel):\n    return x, v\n"
    submission = taken_in(hand_in("solution", integrators_py=again), tmp_path)
    assert submission.begun["8c"]
    assert submission.where["8c"].line == again.splitlines().index("def rk4(x, v, dt, accel):") + 1


# ---------------------------------------------------------------- texts made to cost much

NAMES = st.sampled_from(["f", "a", "b", "C", "D", "m", "o"])
PATHS = st.lists(NAMES, min_size=1, max_size=3).map(".".join)
MODULES = st.sampled_from(["m", "o", "p"])
LINES = st.one_of(
    st.builds("{} = {}".format, PATHS, PATHS),
    st.builds("def {}(): pass".format, NAMES),
    st.builds("class {}({}, {}): f = a".format, NAMES, PATHS, PATHS),
    st.builds("from {} import *".format, MODULES),
    st.builds("from {} import {} as {}".format, MODULES, NAMES, NAMES),
    st.builds("import {} as {}".format, MODULES, NAMES),
)
TEXTS = st.lists(LINES, max_size=12).map("\n".join)
PROGRAMS = st.fixed_dictionaries({"m": TEXTS, "o": TEXTS, "p": TEXTS})


def follow_names(texts: dict[str, str]) -> None:
    program = Program({Path(f"{name}.py"): text for name, text in texts.items()})
    for path in ("f", "C.f", "D.a"):
        program.definition("m", path)
        assert program.tried <= MAX_TRIED + MAX_HOPS * len(texts)
        assert all(len(name) <= MAX_NAME for _, name in program.found)


@pytest.mark.parametrize("examples", [50, pytest.param(5000, marks=pytest.mark.soak)])
def test_no_name_is_followed_without_end(examples: int):
    settings(max_examples=examples, deadline=None)(given(PROGRAMS)(follow_names))()


def test_a_function_of_many_names_is_read_once(monkeypatch: pytest.MonkeyPatch):
    """Otherwise a few kilobytes of names would cost thousands of readings of a long function."""
    names = [f"a{number}" for number in range(MAX_CALLED - 10)]
    lines = ["def f(): pass", *(f"{name} = f" for name in names), f"def g(): {'; '.join(names)}"]
    program = Program({Path("m.py"): "\n".join(lines)})
    read: list[str] = []
    monkeypatch.setattr(
        "grader.source.definitions.source_of",
        lambda text, each, real=source_of: read.append(each.name) or real(text, each),
    )
    assert set(names) <= program.names_used("m", "g")
    assert sorted(read) == ["f", "g"]


# ---------------------------------------------------------------- given files


def test_a_given_file_is_supplied_only_if_it_is_missing(hand_in: HandIn, tmp_path: Path):
    files = {"lab_runtime_py": "frames = 1\n", "mini_engine__validate_py": None}
    folder = taken_in(hand_in("solution", **files), tmp_path).folder
    given = (KIT / "starter" / "mini_engine" / "validate.py").read_text()
    assert (folder / "mini_engine" / "validate.py").read_text() == given
    assert (folder / "lab_runtime.py").read_text() == "frames = 1\n"


def test_nothing_is_put_where_something_else_is_in_the_way(hand_in: HandIn, tmp_path: Path):
    folder = hand_in("solution", lab_runtime_py=None)
    shutil.rmtree(folder / "mini_engine" / "bonus")
    (folder / "mini_engine" / "bonus").write_text("a file\n")
    (folder / "lab_runtime.py").mkdir()
    submission = taken_in(folder, tmp_path)
    assert (submission.folder / "mini_engine" / "bonus").read_text() == "a file\n"


def test_nothing_is_laid_over_an_engine_in_one_file(hand_in: HandIn, tmp_path: Path):
    submission = taken_in(hand_in(mini_engine_py="x = 1\n", notes_txt="n"), tmp_path)
    assert not (submission.folder / "mini_engine").exists()
    assert not (submission.folder / "pymunk_scene.py").exists()  # a program is not given
