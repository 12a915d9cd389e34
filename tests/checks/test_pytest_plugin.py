"""Test that authors can run checks as ordinary tests."""

import subprocess
import sys

import pytest
from conftest import KIT

CHECK = "friction_stops_at_its_limit_both_ways"


@pytest.mark.parametrize(("tree", "words"), [("solution", "1 passed"), ("starter", "1 failed")])
def test_a_check_is_a_test_of_a_submission(tree: str, words: str):
    quick = ("-p", "no:cacheprovider", "--assert=plain")  # a check brings its own words
    command = [sys.executable, "-m", "pytest", *quick, "-k", CHECK]
    done = subprocess.run(
        [*command, "grader/checks/todo_4", "--submission", tree],
        cwd=KIT,
        capture_output=True,
        text=True,
    )
    assert words in done.stdout, done.stdout + done.stderr
    assert ("Expected  " in done.stdout) == (tree == "starter")
