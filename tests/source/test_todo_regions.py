"""The markers that both trees, the bank and the judge live by."""

import pytest

from grader.source.regions import RegionError, regions_in, replaced, shape_of

TEXT = """def f():
    # TODO 4: clamp
    limit = 1
    # END TODO 4
    return limit
"""


def test_a_region_is_found_with_its_task_and_lines():
    (region,) = regions_in(TEXT)
    assert (region.id, region.task, region.lines) == ("4", "clamp", ("    limit = 1",))


@pytest.mark.parametrize(
    "text",
    [
        TEXT.replace("    # END TODO 4\n", ""),
        TEXT.replace("# END TODO 4", "# END TODO 5"),
        TEXT.replace("    limit = 1", "    # TODO 5: inside"),
        TEXT.replace("    # TODO 4: clamp\n", ""),
        TEXT + TEXT,
    ],
    ids=["never ended", "other id", "nested", "never begun", "twice"],
)
def test_markers_that_do_not_pair_up_are_refused(text: str):
    with pytest.raises(RegionError):
        regions_in(text)


def test_a_region_can_be_replaced_and_the_rest_stays():
    assert replaced(TEXT, {"4": ("    limit = 2",)}) == TEXT.replace("= 1", "= 2")


def test_layout_and_comments_do_not_change_the_shape():
    assert shape_of("    x = f(1,  2)  # so") == shape_of("x = f(\n    1, 2)")
    assert shape_of("x = 1") != shape_of("x = 2")
    assert shape_of("return 1") == shape_of("    return 1")
    assert shape_of("no python !") == "no python !"
