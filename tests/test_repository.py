"""Test that the repository's public files agree with the kit."""

import re
import tomllib
from itertools import chain
from typing import Any

import pytest
from conftest import KIT
from ruamel.yaml import YAML
from whole_bank import bank

import grader

PROJECT = tomllib.loads((KIT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
WORKFLOWS = sorted(KIT.glob("*/.github/workflows/*.yml")) + sorted(KIT.glob(".github/*/*.yml"))
SCHEMAS = {
    "CITATION.cff": "citation-file-format",
    ".github/dependabot.yml": "dependabot",
    "solution/.github/workflows/grade.yml": "github-workflows",
    "solution/.gitlab-ci.yml": "gitlab-ci",
}


def read(name: str) -> Any:
    return YAML(typ="safe").load(KIT / name)


def test_files_keep_their_published_schemas():
    """Import the validator here: it takes seconds, and only this test needs it."""
    from check_jsonschema.builtin_schemas import get_builtin_schema
    from jsonschema.validators import validator_for

    for name, schema in SCHEMAS.items():
        published = get_builtin_schema(f"vendor.{schema}")
        check = validator_for(published)(published)
        assert [error.message for error in check.iter_errors(read(name))] == [], name
        wrong = {"no-such-key": 1, "jobs": 1, "grade": 1}
        assert list(check.iter_errors({**read(name), **wrong})), name


def test_the_citation_is_of_this_version():
    citation = read("CITATION.cff")
    assert citation["version"] == grader.__version__
    assert (citation["license"], citation["keywords"]) == (PROJECT["license"], PROJECT["keywords"])


def test_the_badges_say_what_the_project_says():
    badge = (KIT / "handouts" / "front" / "python.svg").read_text(encoding="utf-8")
    versions = re.findall(r":: (3\.\d+)$", "\n".join(PROJECT["classifiers"]), re.M)
    assert f">{' | '.join(versions)}<" in badge
    licence = (KIT / "handouts" / "front" / "licence.svg").read_text(encoding="utf-8")
    assert f">{PROJECT['license']}<" in licence


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.relative_to(KIT).as_posix())
def test_every_action_is_pinned_by_its_hash(path):
    used = re.findall(r"uses: (\S+)", path.read_text(encoding="utf-8"))
    assert used
    assert not [action for action in used if not re.fullmatch(r"[\w./-]+@[0-9a-f]{40}", action)]


def test_a_commit_is_held_to_what_ci_runs():
    (hook,) = read(".pre-commit-config.yaml")["repos"][0]["hooks"]
    steps = read(".github/workflows/ci.yml")["jobs"]["lint"]["steps"]
    assert hook["entry"] in [step.get("run") for step in steps]


def test_every_dependency_has_a_reason():
    rows = (KIT / "CONTRIBUTING.md").read_text(encoding="utf-8").partition("\n| package |")[2]
    named = set(re.findall(r"[\w-]+", " ".join(re.findall(r"^\| ([^|]+) \|", rows, re.M))))
    wanted = chain(PROJECT["dependencies"], *PROJECT["optional-dependencies"].values())
    assert {re.split("[<>=]", each)[0] for each in wanted} <= named


def test_the_readme_counts_known_mistakes_and_the_bank():
    readme = (KIT / "README.md").read_text(encoding="utf-8")
    sentences = tomllib.loads((KIT / "grader/checks/mistakes.toml").read_text("utf-8"))
    (mistakes,) = re.findall(r"more than (\d+) known mistakes", readme)
    assert int(mistakes) <= sum(map(len, sentences.values()))
    (size,) = re.findall(r"A bank of about ([\d,]+) wrong, right and hostile", readme)
    assert int(size.replace(",", "")) == pytest.approx(len(bank()), rel=0.25)
