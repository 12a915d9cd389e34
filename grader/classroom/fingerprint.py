"""Make the key of results: a hash of everything they depend on except the submission."""

import hashlib
from pathlib import Path

import msgspec

from grader.intake.found import Package
from grader.judge.fingerprint import fingerprint
from grader.judge.rubric import load_rubric
from grader.judge.submission import module_of
from grader.judge.task import Options
from grader.source.regions import python_files


def make_key(options: Options) -> str:
    reference = pack_reference(options.reference)
    digest = reference.digest if reference else ""
    rubric = options.course.rubric
    decides = [sorted(options.only), options.seed, options.isolation, options.spawn, rubric]
    return hashlib.sha256(msgspec.json.encode([fingerprint(), digest, decides])).hexdigest()


def pack_reference(folder: Path | None) -> Package | None:
    """Return the programs of the reference that the rubric names."""
    if folder is None:
        return None
    modules = load_rubric().modules
    files = [
        (path.relative_to(folder).as_posix(), path.read_bytes())
        for path in python_files(folder)
        if module_of(path.relative_to(folder)) in modules
    ]
    return Package("reference", sorted(files))
