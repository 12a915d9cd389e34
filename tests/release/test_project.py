"""Test that uv sets up a student's folder with the packages that pip would take."""

import re
import tomllib

from grader.judge.task import KIT
from grader.release.project import make_project

REQUIREMENTS = """\
colorama==0.4.6 ; sys_platform == 'win32' \\
    --hash=sha256:aa
rich==15.0.0 \\
    --hash=sha256:bb \\
    --hash=sha256:cc
./physics_grader-0.1.0.whl --hash=sha256:dd
"""


def test_each_package_is_pinned_as_for_pip():
    uv = tomllib.loads(make_project(REQUIREMENTS, "physics_grader-0.1.0.whl"))["tool"]["uv"]
    assert uv["constraint-dependencies"] == [
        "colorama==0.4.6; sys_platform == 'win32'",
        "rich==15.0.0",
    ]
    assert uv["sources"]["physics-grader"] == {"path": "physics_grader-0.1.0.whl"}


def test_every_pin_of_the_kit_is_taken_and_no_address():
    requirements = (KIT / "requirements.txt").read_text(encoding="utf-8")
    project = make_project(requirements, "physics_grader.whl")
    pins = tomllib.loads(project)["tool"]["uv"]["constraint-dependencies"]
    assert [pin.partition("=")[0] for pin in pins] == re.findall(
        r"^([\w.-]+)==", requirements, re.MULTILINE
    )
    assert "://" not in project
