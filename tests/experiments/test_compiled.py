"""The compiled build of the stable engine: the same source, the same bits."""

import shutil

import pytest

from experiments.compiled import build, compare


@pytest.mark.soak
@pytest.mark.skipif(not (shutil.which("cc") or shutil.which("gcc")), reason="no C compiler here")
def test_the_compiled_build_gives_the_same_bits(tmp_path):
    build(tmp_path)
    assert list((tmp_path / "stable_engine").glob("world.*.so"))
    same, faster = compare(tmp_path, rounds=3)
    assert same
    assert faster > 0


def test_a_build_that_fails_says_what_it_needs(tmp_path, monkeypatch):
    monkeypatch.setattr("sys.executable", shutil.which("false"))
    with pytest.raises(RuntimeError, match="needs mypy and a C compiler"):
        build(tmp_path)
