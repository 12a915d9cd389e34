"""What a release records, and when it is recorded again."""

from pathlib import Path

from msgspec.structs import replace

from grader.judge.course import FULL
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
