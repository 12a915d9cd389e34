"""A fork bomb, a sleeper and a memory hog in a class: they end, and the others hardly notice."""

import sys
from pathlib import Path

import pytest
from greedy import (
    CLASS,
    GREEDY,
    MOST_CPU,
    MOST_MORE,
    compare,
    least_cpu,
    make_greedy,
)

from grader.protocol import Limits
from grader.source.regions import python_files, read_source, regions_in

pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux"),
    reason="only Linux tells the processor time of all descendants",
)


@pytest.mark.parametrize("name", GREEDY)
def test_a_greedy_submission_is_greedy_in_every_todo(name: str, tmp_path: Path):
    make_greedy(tmp_path / "tree", GREEDY[name])
    regions = [
        region
        for path in python_files(tmp_path / "tree")
        for region in regions_in(read_source(path))
    ]
    assert len(regions) >= 19
    assert len({region.shape for region in regions}) == 1


@pytest.mark.soak  # ten minutes
def test_the_others_of_a_class_pay_a_tenth_more_at_most():
    without, together = compare(rounds=3)
    assert len(together) == CLASS and set(together) - set(without) == set(GREEDY)
    for name, costs in together.items():
        if name in GREEDY:
            assert max(each.cpu for each in costs) <= MOST_CPU
            assert max(each.memory for each in costs) <= Limits().data_mb + 64
            assert max(each.points for each in costs) <= 5
        else:
            assert {each.points for each in costs} == {100}
            assert least_cpu(costs) <= MOST_MORE * least_cpu(without[name])
