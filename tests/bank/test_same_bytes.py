"""Test that results are the same, byte by byte, on a busy machine and with any memory.

The number of checks at a time varies, as do the memory of passed programs and the machine's load.
"""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from whole_bank import bank

from grader.bank.members import Member
from grader.bank.verify import list_trees, shared_worker
from grader.judge.grade import grade
from grader.judge.task import KIT, Options, shipped_reference
from grader.judge.passed import PassedPrograms
from grader.report.files import as_json

JOBS = (1, 2, 4)
BUSY = 8  # processes that never rest
SHARES = {"wrong": 9, "right": 5, "hostile": 4, "ladder": 2}  # members of each kind


def choose_members() -> list[Member]:
    """Return both trees, and members of all kinds, spread over the bank."""
    chosen = list_trees()
    for kind, count in SHARES.items():
        alike = [each for each in bank() if each.kind == kind]
        chosen += [alike[number * len(alike) // count] for number in range(count)]
    return chosen


@pytest.fixture(scope="module")
def passed_programs(tmp_path_factory: pytest.TempPathFactory) -> PassedPrograms:
    """Passed programs, shared by the members of this file, which add to them."""
    return PassedPrograms(tmp_path_factory.mktemp("passed"))


@contextmanager
def busy_machine() -> Iterator[None]:
    loops = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(BUSY)]
    try:
        yield
    finally:
        for each in loops:
            each.kill()
            each.wait()


def grade_as_json(member: Member, tree: Path, jobs: int, passed_programs: PassedPrograms | None) -> bytes:
    options = Options(
        shipped_reference(), only=member.judged_by, trusted=True, jobs=jobs, passed=passed_programs
    )
    return as_json(grade(tree, options, shared_worker()))


@pytest.mark.soak  # half an hour
@pytest.mark.parametrize(
    "member", [pytest.param(each, id=f"{each.kind}-{each.name}") for each in choose_members()]
)
def test_a_result_is_the_same_bytes(member: Member, tmp_path: Path, passed_programs: PassedPrograms):
    tree = tmp_path / member.name
    member.build(tree)
    memories = [None] if member.kind == "hostile" else [None, passed_programs]  # as in verify
    results: dict[object, bytes] = {
        (jobs, memory is not None): grade_as_json(member, tree, jobs, memory)
        for memory in memories
        for jobs in JOBS
    }
    with busy_machine():
        results["busy"] = grade_as_json(member, tree, 2, None)
    right = results[1, False]
    assert [how for how, result in results.items() if result != right] == []
