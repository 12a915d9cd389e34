"""Test that a release keeps its recordings until their sources change."""

from pathlib import Path

import pytest
from msgspec.structs import replace

from grader.judge.course import FULL
from grader.release import build
from grader.release.recordings import Recordings


def test_what_was_recorded_is_kept_for_its_course(tmp_path: Path):
    made = []

    def make() -> bytes:
        made.append(len(made))
        return b"some answers"

    other = replace(FULL, todos=("1", "2"))
    for course, times in ((FULL, 1), (FULL, 1), (other, 2), (FULL, 2)):
        assert Recordings(course, tmp_path)("answers", make) == b"some answers"
        assert len(made) == times
    assert Recordings(FULL, tmp_path)("runs", make) == b"some answers" and len(made) == 3
    assert Recordings(FULL, tmp_path, fresh=True)("runs", make) == b"some answers"
    assert len(made) == 4


def test_the_same_release_is_proven_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    proven: list[str] = []
    monkeypatch.setattr(build, "prove", lambda *_: proven.append("marks"))
    monkeypatch.setattr(build, "look_for_leaks", lambda *_: proven.append("leaks"))
    folders = [tmp_path / name for name in ("built", "installed", "tree")]
    for folder in folders:
        folder.mkdir()
        (folder / "file").write_text("as it was")
    record = Recordings(FULL, tmp_path / "recorded")
    for changed in (None, None, *folders):
        if changed:
            (changed / "file").write_text("as it is")
        build.prove_built(*folders, record=record)
    assert proven == ["marks", "leaks"] * 4
    monkeypatch.setattr(build, "look_for_leaks", lambda *_: 1 / 0)
    (tmp_path / "tree" / "file").write_text("with an answer")
    for _ in range(2):  # a refusal is repeated
        with pytest.raises(ZeroDivisionError):
            build.prove_built(*folders, record=record)
