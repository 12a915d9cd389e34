"""Grade the hostile bank on this machine; print the complaint of each member, as JSON."""

import json
import sys
from pathlib import Path

from rich.console import Console
from whole_bank import bank, grade_briefly

from grader.bank.traces import OPEN_TO_ALL, find_named
from grader.bank.verify import collect, run_in_processes


def main(world: str) -> None:
    """Grade one member per core at a time, and show the progress."""
    hostile = [member for member in bank() if member.kind == "hostile"]
    judged = run_in_processes(grade_briefly, hostile, 0)
    verdicts = collect(f"grading with {world}", judged, len(hostile), Console(stderr=True))
    for each in verdicts:
        remove_traces(each.name)
    print(json.dumps({each.name: each.complaint for each in verdicts}))


def remove_traces(name: str) -> None:
    """Remove the files that a member named after itself, before one of the next world finds
    them."""
    for path, _ in find_named(name, [Path("/"), *map(Path, OPEN_TO_ALL)]):
        if path.is_file():
            path.unlink()


if __name__ == "__main__":
    main(sys.argv[1])
