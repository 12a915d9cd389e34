"""Read the markers of TODO regions, which both trees, the bank and the judge use."""

from pathlib import Path

import pytest

from grader.source.regions import (
    RegionError,
    encode,
    find_regions,
    read_source,
    regions_in,
    replace_regions,
    shape_of,
)

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


@pytest.mark.parametrize(
    "marker",
    ["# TODO 8E: x", "# TODO b1: x", "#TODO 4: x", "# TODO4: x", "# END TODO 4x4", "# ENDTODO 4"],
)
def test_a_marker_that_is_written_otherwise_is_an_error_with_its_line(marker: str):
    with pytest.raises(RegionError, match=r"solver\.py:6: .* is no marker"):
        regions_in(f"{TEXT}    {marker}\n", "solver.py")
    assert [*find_regions(f"{TEXT}    {marker}\n")] == ["4"]  # in a student's file the others count


@pytest.mark.parametrize("id", ["8e", "12", "10b", "B10"])
def test_an_id_is_a_number_with_a_letter_or_a_bonus_number(id: str):
    assert [each.id for each in regions_in(f"# TODO {id}: x\n# END TODO {id}\n")] == [id]


@pytest.mark.parametrize("line", ["# TODO: tidy", "# TODO 4 is done", "x = 1  # TODO 5: later"])
def test_a_comment_is_no_marker(line: str):
    assert len(regions_in(f"{TEXT}    {line}\n")) == 1


def test_a_region_can_be_replaced_and_the_rest_stays():
    assert replace_regions(TEXT, {"4": ("    limit = 2",)}) == TEXT.replace("= 1", "= 2")


def test_layout_and_comments_do_not_change_the_shape():
    assert shape_of("    x = f(1,  2)  # so") == shape_of("x = f(\n    1, 2)")
    assert shape_of("x = 1") != shape_of("x = 2")
    assert shape_of("return 1") == shape_of("    return 1")
    assert shape_of("no python !") == "no python !"


@pytest.mark.parametrize(
    ("head", "encoding"),
    [
        ("", "utf-8"),
        ("# coding: latin-1\n", "latin-1"),
        ("#!/usr/bin/env python\n# -*- coding: cp1252 -*-\n", "cp1252"),
        ("# coding: no-such-encoding\n", "utf-8"),
        ("# coding: punycode\n", "utf-8"),
    ],
)
def test_a_source_is_read_and_written_as_it_declares(tmp_path: Path, head: str, encoding: str):
    text = f'{head}name = "Größe"\n'
    path = tmp_path / "a.py"
    path.write_bytes(text.encode(encoding))
    assert read_source(path) == text
    assert encode(text) == text.encode(encoding)
