"""Read files of a submission only if they are not links, even if they are swapped meanwhile."""

import os
from pathlib import Path

import pytest

from grader.intake import packing
from grader.intake.found import CannotTake, Work
from grader.intake.packing import open_found, pack
from grader.judge import plain, submission
from grader.judge.plain import open_plain, read_plain
from grader.judge.submission import CannotGrade, take_in

LINKS = pytest.mark.skipif(os.name == "nt", reason="links are for administrators there")
SECRET = "SECRET = 1\n"


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """Return a submission, beside a file and a folder outside of it."""
    for name in ("ann/integrators.py", "ann/mini_engine/__init__.py", "out/__init__.py"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(SECRET if name.startswith("out") else "mine = 1\n")
    return tmp_path / "ann"


@LINKS
@pytest.mark.parametrize("by_folders", [True, False])
def test_no_link_is_followed_wherever_on_the_way(tree: Path, monkeypatch, by_folders: bool):
    if not by_folders:  # as on Windows, which only detects a link in the last part
        monkeypatch.setattr(plain, "BY_FOLDERS", False)
    (tree / "link.py").symlink_to(tree.parent / "out" / "__init__.py")
    (tree / "folder").symlink_to(tree.parent / "out")
    os.mkfifo(tree / "pipe.py")
    assert read_plain(tree, "mini_engine/__init__.py") == b"mine = 1\n"
    assert read_plain(tree, "mini_engine/__init__.py", 4) == b"mine"
    for name in ("link.py", "pipe.py", "mini_engine", "nothing.py"):
        with pytest.raises(OSError) as raised:
            open_plain(tree, name)
        assert raised.value.filename == str(tree / name)
    if by_folders:
        with pytest.raises(OSError, match="folder"):
            open_plain(tree, "folder/__init__.py")


@LINKS
def test_the_folder_that_somebody_names_may_be_a_link(tree: Path):
    (tree.parent / "named").symlink_to(tree)
    assert read_plain(tree.parent / "named", "integrators.py") == b"mine = 1\n"


def swap(tree: Path, what: str) -> None:
    """Put a link in the place of a file or a folder."""
    (tree / what).rename(tree.parent / "old")
    outside = tree.parent / "out"
    (tree / what).symlink_to(outside if what == "mini_engine" else outside / "__init__.py")


SWAPPED = ["integrators.py", "mini_engine", "mini_engine/__init__.py"]


@LINKS
@pytest.mark.parametrize("what", SWAPPED)
def test_a_link_put_in_after_the_look_is_not_taken_in(tree: Path, monkeypatch, what: str):
    def look(path: Path, real=submission.plain_files):
        found = list(real(path))
        swap(tree, what)
        return found

    monkeypatch.setattr(submission, "plain_files", look)
    with pytest.raises(CannotGrade, match="cannot be read"):
        take_in(tree, tree.parent / "copy")
    copied = (path for path in (tree.parent / "copy").rglob("*") if path.is_file())
    assert all(path.read_text() != SECRET for path in copied)


@LINKS
@pytest.mark.parametrize("what", SWAPPED)
@pytest.mark.parametrize("beside", ["", "more.zip"])
def test_a_link_put_in_after_the_look_is_not_packed(
    tree: Path, monkeypatch, what: str, beside: str
):
    """Test a submission as handed in, and as copied when it has an archive."""
    if beside:
        (tree / beside).write_bytes(b"PK")

    def look(*args, real=packing.arrange):
        laid = real(*args)
        if not (tree.parent / "old").exists():
            swap(tree, what)
        return laid

    monkeypatch.setattr(packing, "arrange", look)
    try:
        package = pack(Work("ann", (tree,)))
    except CannotTake:
        return
    assert SECRET.encode() not in dict(package.files).values()


@LINKS
@pytest.mark.parametrize("kind", ["pipe", "link"])
def test_an_upload_that_is_no_file_has_a_sentence(tree: Path, kind: str):
    upload = tree.parent / "ann_integrators.py"
    if kind == "pipe":
        os.mkfifo(upload)
    else:
        upload.symlink_to(tree / "integrators.py")
    with (
        pytest.raises(CannotTake, match=r"^it cannot be read: "),
        open_found(Work("ann", (upload,))),
    ):
        pass


@LINKS
def test_a_file_that_grows_while_it_is_copied_is_cut(tree: Path):
    with open_plain(tree, "integrators.py") as file:
        length = plain.size_of(file)
        with open(tree / "integrators.py", "a") as more:
            more.write("x" * 1000)
        plain.copy_plain(file, tree / "copy.py", length)
    assert (tree / "copy.py").read_text() == "mine = 1\n"
