"""Make course folders and collect submissions into them, without nbgrader."""

import zipfile
from pathlib import Path

import pytest
from command_line import run_grader
from handed_in import NAMES, RELEASED, hand_in, read

from grader.bank.sync import list_students_files
from grader.classroom.nbgrader.submissions import ASSIGNMENT, collect_submissions
from grader.errors import Stop
from grader.judge.course import Course
from grader.judge.task import KIT
from grader.release import nbgrader_course as courses
from grader.release.nbgrader_course import find_newest_release, make_course
from grader.source.regions import python_files, regions_in


@pytest.fixture
def course(tmp_path):
    make_course(tmp_path / "course")
    return tmp_path / "course"


@pytest.fixture
def classroom(tmp_path):
    (tmp_path / "class").mkdir()
    return tmp_path / "class"


def untouched(folder):
    return hand_in(folder, "starter", {name: read(RELEASED / f"{name}.ipynb") for name in NAMES})


def collect(classroom, course):
    return {each.student: each for each in collect_submissions(classroom, course)}


# ---------------------------------------------------------------- the course


def test_the_source_holds_every_notebook_and_the_students_files(course):
    source = course / "source" / ASSIGNMENT
    assert sorted(path.stem for path in source.glob("*.ipynb")) == NAMES
    for name, path in list_students_files(KIT).items():
        if not name.startswith("."):
            assert (source / name).read_bytes() == path.read_bytes()


def test_no_region_of_the_reference_is_in_the_source(course):
    source = course / "source" / ASSIGNMENT
    found = {}
    for path in python_files(source):
        ours = KIT / "solution" / path.relative_to(source)
        for region in regions_in(path.read_text(encoding="utf-8")):
            found[region.id] = region.shape
        for region in regions_in(ours.read_text(encoding="utf-8")):
            assert found[region.id] != region.shape
    assert len(found) == 13 + 6  # with the bonus tasks


def test_a_second_time_needs_renew_and_keeps_the_settings(course):
    with pytest.raises(Stop, match="--renew"):
        make_course(course)
    (course / "marks.toml").write_text("mine", encoding="utf-8")
    (course / "source" / ASSIGNMENT / "old.py").touch()
    make_course(course, renew=True)
    assert (course / "marks.toml").read_text(encoding="utf-8") == "mine"
    assert not (course / "source" / ASSIGNMENT / "old.py").exists()


@pytest.mark.parametrize("inside", [".", "solution", "starter/notebooks", "grader"])
def test_a_course_inside_the_kit_is_refused(inside):
    with pytest.raises(Stop, match="inside the kit"):
        make_course(KIT / inside)


# ---------------------------------------------------------------- submissions


def test_notebooks_come_to_the_top_and_files_stay_as_they_are(course, classroom):
    tree = untouched(classroom / "anna")
    (tree / "helper.py").write_text("x = 1\n", encoding="utf-8")
    assert collect(classroom, course)["anna"].words == "5 notebooks"
    target = course / "submitted" / "anna" / ASSIGNMENT
    assert sorted(path.stem for path in target.glob("*.ipynb")) == NAMES
    assert not (target / "notebooks").exists() or not list((target / "notebooks").iterdir())
    for name in ("helper.py", "mini_engine/world.py"):
        assert (target / name).read_bytes() == (tree / name).read_bytes()


def test_notebooks_may_lie_beside_the_engine_as_nbgrader_releases_them(course, classroom):
    tree = untouched(classroom / "anna")
    for path in (tree / "notebooks").iterdir():
        path.rename(tree / path.name)
    (tree / "notebooks").rmdir()
    assert collect(classroom, course)["anna"].words == "5 notebooks"
    assert (course / "submitted" / "anna" / ASSIGNMENT / "quiz.ipynb").exists()


def test_notebooks_may_lie_beside_a_folder_of_programs(course, classroom):
    """Also if programs are found by their names."""
    for student, names in {"anna": (), "ben": ("integrators.py",)}.items():
        tree = untouched(classroom / student / "lab3")
        (tree / "notebooks").rename(tree.parent / "my notebooks")
        (tree.parent / "my notebooks" / "quiz.ipynb").rename(tree.parent / "quiz.ipynb")
        for name in names:
            (tree / name).rename(tree / name.replace(".py", " (1).py"))
    found = collect(classroom, course)
    for student in ("anna", "ben"):
        assert found[student].words == "5 notebooks"
        submitted = course / "submitted" / student / ASSIGNMENT
        assert sorted(path.stem for path in submitted.glob("*.ipynb")) == NAMES
        assert (submitted / "integrators.py").is_file()


def test_of_two_notebooks_that_are_as_near_nobody_takes_one(course, classroom):
    tree = untouched(classroom / "anna" / "lab3")
    (tree / "notebooks").rename(tree.parent / "new")
    (tree.parent / "old").mkdir()
    (tree.parent / "old" / "quiz.ipynb").write_text("{}")
    found = collect(classroom, course)["anna"]
    assert not found.taken and "new/quiz.ipynb and old/quiz.ipynb are" in found.words


def test_python_files_alone_are_taken_too(course, classroom):
    hand_in(classroom / "farid", "starter", {})
    assert collect(classroom, course)["farid"].words == "no notebook"
    assert (course / "submitted" / "farid" / ASSIGNMENT / "mini_engine" / "world.py").exists()


@pytest.mark.parametrize("around", ["physics-engine", "hand-in/physics-engine"])
def test_folders_around_a_submission_are_taken_off(course, classroom, around):
    untouched(classroom / "Zoë Müller" / around)
    collect(classroom, course)
    target = course / "submitted" / "Zoë Müller" / ASSIGNMENT
    assert (target / "quiz.ipynb").exists() and (target / "integrators.py").exists()


def test_links_and_hidden_files_stay_outside(course, classroom, tmp_path):
    tree = untouched(classroom / "eve")
    (tmp_path / "secret.py").write_text("secret", encoding="utf-8")
    (tree / "stolen.py").symlink_to(tmp_path / "secret.py")
    (tree / "all").symlink_to(KIT / "solution")
    (tree / ".hidden").mkdir()
    (tree / ".hidden" / "x.py").touch()
    (classroom / "linked").symlink_to(KIT / "solution")
    all_of_them = collect(classroom, course)
    assert {name for name, each in all_of_them.items() if each.taken} == {"eve"}
    assert "link" in all_of_them["linked"].words
    assert not (course / "submitted" / "linked").exists()
    target = course / "submitted" / "eve" / ASSIGNMENT
    assert not any((target / name).exists() for name in ("stolen.py", "all", ".hidden"))


def test_a_name_that_nbgrader_would_take_for_a_pattern_is_refused(course, classroom):
    untouched(classroom / "a[bc]")
    untouched(classroom / "ben")
    found = collect(classroom, course)
    assert not found["a[bc]"].taken and "rename" in found["a[bc]"].words
    assert found["ben"].taken


def test_only_a_submission_that_changed_is_graded_anew(course, classroom):
    for name in ("anna", "ben"):
        untouched(classroom / name)
    collect(classroom, course)
    for name in ("anna", "ben"):
        (course / "autograded" / name / ASSIGNMENT).mkdir(parents=True)
    with (classroom / "ben" / "integrators.py").open("a", encoding="utf-8") as file:
        file.write("# one more line\n")
    found = collect(classroom, course)
    assert found["anna"].words == "unchanged" and found["ben"].words == "5 notebooks"
    assert (course / "autograded" / "anna" / ASSIGNMENT).exists()
    assert not (course / "autograded" / "ben" / ASSIGNMENT).exists()


def test_what_is_missing_is_said(tmp_path, classroom, course):
    with pytest.raises(Stop, match="no course yet"):
        list(collect_submissions(classroom, tmp_path / "elsewhere"))
    with pytest.raises(Stop, match="holds no submission"):
        list(collect_submissions(classroom, course))
    with pytest.raises(Stop, match="there is no folder"):
        list(collect_submissions(Path(tmp_path / "nowhere"), course))


# ---------------------------------------------------------------- the checks


def test_students_get_the_checks_of_a_release(tmp_path):
    archive = tmp_path / "physics-engine-1.0-0.zip"
    with zipfile.ZipFile(archive, "w") as out:
        for name in ("grader.whl", "requirements.txt", "notebooks/quiz.ipynb"):
            out.writestr(f"physics-engine/{name}", "released")
        rows = ["# content 0", "00  grader.whl", "00  .gitignore", "00  notebooks/quiz.ipynb"]
        out.writestr("physics-engine/MANIFEST.txt", "\n".join(rows) + "\n")
        released = (KIT / "starter" / "integrators.py").read_bytes() + b"# released\n"
        out.writestr("physics-engine/integrators.py", released)
    assert (
        find_newest_release(tmp_path) == archive and find_newest_release(tmp_path / "none") is None
    )
    taken = Course(todos=("8a", "8b", "8c"))
    files = make_course(tmp_path / "course", release=archive, taken=taken)
    source = tmp_path / "course" / "source" / ASSIGNMENT
    assert {"grader.whl", "requirements.txt"} < set(files)
    assert (source / "integrators.py").read_bytes() == released
    assert (source / "quiz.ipynb").read_text() != "released"  # with the answers
    assert (source / "MANIFEST.txt").read_text() == "# content 0\n00  grader.whl\n"
    with pytest.raises(Stop, match="there is no release at"):
        make_course(tmp_path / "course", renew=True, release=tmp_path / "none.zip")
    with pytest.raises(Stop, match="not of this course, they differ in TODO 1, 2, 3"):
        make_course(tmp_path / "course", renew=True, release=archive)
    assert (source / "integrators.py").read_bytes() == released  # what stands is not lost


def test_a_course_without_checks_is_only_made_where_it_is_asked_for(tmp_path, monkeypatch):
    monkeypatch.setattr(courses, "find_newest_release", lambda folder: None)
    words = ["course", str(tmp_path / "course")]
    done = run_grader("nbgrader", *words)
    assert done.exit_code == 2 and "make release" in " ".join(done.output.split())
    assert not (tmp_path / "course").exists()
    done = run_grader("nbgrader", *words, "--without-checks")
    assert done.exit_code == 0, done.output


def test_one_that_cannot_be_laid_out_leaves_the_others(classroom, course):
    for student in ("anna", "ben", "zoe"):
        untouched(classroom / student)
    (classroom / "ben" / "notebooks").mkdir(exist_ok=True)
    (classroom / "ben" / f"{NAMES[0]}.ipynb").unlink(missing_ok=True)
    (classroom / "ben" / f"{NAMES[0]}.ipynb").mkdir()
    (classroom / "ben" / f"{NAMES[0]}.ipynb" / "a.txt").write_text("x")
    (classroom / "ben" / "notebooks" / f"{NAMES[0]}.ipynb").write_text("{}")
    found = collect(classroom, course)
    assert found["anna"].taken and found["zoe"].taken
    assert not found["ben"].taken and "/" not in found["ben"].words
