"""Grade a submission, and make the replays of checks that fail."""

from pathlib import Path

from grader.judge.grade import grading
from grader.judge.result import Result
from grader.judge.task import Options
from grader.judge.wall.children import Worker


def grade_with_replays(
    path: Path | str, options: Options, folder: Path, worker: Worker | None = None
) -> Result:
    """Grade a submission, and write the replay of each failed check into `folder`."""
    with grading(Path(path), options, worker) as run:
        result = run.run()
        if not run.failing and not any(folder.glob("*.html")):
            return result
        # Imported here: it takes 0.04 s, since it loads the modules for pages.
        from grader.player.replay import Replays

        open_right = run.open_right if options.reference else None
        return Replays(folder, run.sandbox.open_child, open_right).add_to(result, run.failing)
