"""Grade a course with zip_collect, autograde, feedback and the formgrader of nbgrader.

Needs nbgrader beside the grader, and Chromium; takes some minutes.
"""

import re
import secrets
import shutil
import subprocess
import time
from contextlib import contextmanager

import pytest
from command_line import run_grader
from handed_in import NAMES, SCRIPTS, active_environment, answers, hand_in, replace_in, run
from page_readers import PATIENCE, chromium

from grader.classroom.nbgrader.submissions import ASSIGNMENT
from grader.release import nbgrader_course as courses

pytestmark = pytest.mark.soak
FULL, BY_HAND = 142, 20  # points of all notebooks, and those that need manual grading
COLLECTOR = r".*/extracted/(?P<student_id>[^/]+)/(?:notebooks/)?(?P<file_id>.+)"
ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+/")


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """Make a course: Anna's work is complete, and Ben has one wrong answer in the quiz."""
    pytest.importorskip(
        "nbgrader.api", reason="needs the extra notebooks, which make soak installs"
    )
    top = tmp_path_factory.mktemp("formgrader")
    course = top / "course"
    courses.make_course(course)
    done = run(course, "generate_assignment", ASSIGNMENT)
    assert done.returncode == 0, done.stderr[-2000:]
    archive = course / "downloaded" / ASSIGNMENT / "archive"
    archive.mkdir(parents=True)
    wrong = answers()
    replace_in(wrong["quiz"], "answer-3", 'answer_3 = "a"')
    for name, notebooks in {"anna": answers(), "ben": wrong}.items():
        folder = hand_in(top / name, "solution", notebooks)
        shutil.make_archive(str(archive / name), "zip", folder)
    plugin = "--FileNameCollectorPlugin"
    extensions = [f"{plugin}.valid_ext={ext}" for ext in (".ipynb", ".py", ".toml")]
    for words in (
        ["zip_collect", ASSIGNMENT, f"{plugin}.named_regexp={COLLECTOR}", *extensions],
        ["autograde", ASSIGNMENT],
    ):
        done = run(course, *words)
        assert done.returncode == 0, done.stderr[-2000:]
    bridged = run_grader("nbgrader", "bridge", "--folder", course, "--jobs", "1")
    assert bridged.exit_code == 0, bridged.output
    done = run(course, "generate_feedback", ASSIGNMENT)
    assert done.returncode == 0, done.stderr[-2000:]
    return course


def test_nbgraders_own_collecting_takes_the_program_too(course):
    for name in ("anna", "ben"):
        submitted = course / "submitted" / name / ASSIGNMENT
        assert (submitted / "mini_engine" / "solver.py").is_file()
        pages = (course / "feedback" / name / ASSIGNMENT).glob("*.html")
        assert sorted(page.stem for page in pages) == NAMES


@contextmanager
def jupyter(course):
    """Yield the address of a Jupyter server in the course folder, with its token."""
    token = secrets.token_hex(16)
    command = [SCRIPTS / "jupyter", "server", "--allow-root", "--ip=127.0.0.1", "--port=0"]
    command += [f"--IdentityProvider.token={token}"]
    own = {f"JUPYTER_{name}_DIR": str(course / ".jupyter" / name) for name in ("CONFIG", "RUNTIME")}
    log = course / "jupyter.log"
    with (
        log.open("w", encoding="utf-8") as said,
        subprocess.Popen(
            command, cwd=course, env=active_environment() | own, stderr=said
        ) as server,
    ):
        try:
            while not (found := ADDRESS.search(log.read_text(encoding="utf-8"))):
                assert server.poll() is None, log.read_text(encoding="utf-8")
                time.sleep(0.1)
            yield found[0], f"?token={token}"
        finally:
            server.terminate()


def test_the_formgrader_lists_the_submissions_with_their_points(course):
    with jupyter(course) as (address, token), chromium() as browser:
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.set_default_timeout(PATIENCE)
        page.goto(f"{address}lab{token}")  # which gives the token to all other pages
        page.goto(f"{address}formgrader/manage_submissions/{ASSIGNMENT}")
        page.get_by_text("anna").first.wait_for()
        page.screenshot(path=course / "formgrader.png")
        rows = [row.inner_text().split("\t") for row in page.locator("tbody tr").all()]
    scores = {row[1].strip(): row[4].strip() for row in rows}
    right = FULL - BY_HAND
    assert scores == {"anna": f"{right} / {FULL}", "ben": f"{right - 1} / {FULL}"}
