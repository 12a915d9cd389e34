"""Make trees in which some TODOs are done and others are not."""

import shutil
from collections.abc import Collection
from pathlib import Path

from grader.judge.task import KIT
from grader.source.regions import python_files, regions_in, replace_regions


def mix_trees(folder: Path, base: str, donor: str, todos: Collection[str]) -> Path:
    """Copy the tree `base`, with these TODOs from the tree `donor`."""
    shutil.copytree(KIT / base, folder, ignore=shutil.ignore_patterns("__pycache__", "notebooks"))
    for path in python_files(KIT / donor):
        regions = regions_in(path.read_text(encoding="utf-8"))
        lines = {each.id: each.lines for each in regions if each.id in todos}
        if lines:
            target = folder / path.relative_to(KIT / donor)
            text = replace_regions(target.read_text(encoding="utf-8"), lines)
            target.write_text(text, encoding="utf-8")
    return folder
