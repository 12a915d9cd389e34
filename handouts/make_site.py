"""Build the handouts as web pages: build/handouts/students, and build/handouts/instructors.

    python handouts/make_site.py [--out DIR] [--course FILE]

The pages for students are made from sources without the instructor's folder, so nothing of it can
be in them. They cover what the course has; those for instructors cover all. Both open from a
folder, without a server and without the internet. Needs zensical.
"""

import argparse
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from make_hints import page as hints_page

from grader.judge.course import FULL, WrongCourse, read_course
from grader.release.formulas import typeset
from grader.release.handouts import make_handouts
from grader.release.pages import lay_out_touch

HERE = Path(__file__).resolve().parent
BUILD = HERE.parent / "build" / "handouts"
OURS = HERE / "site"
BOX = '<input type="checkbox" disabled'  # of a list to be ticked
SHIM = "https://unpkg.com/iframe-worker/shim"  # what the theme would fetch
INSTRUCTORS = "For instructors"  # the part of the menu that students do not get


def sources(folder, instructors, course):
    """Lay out what zensical needs: its settings, and the pages and figures."""
    pages = folder / "docs"
    pages.mkdir()
    texts = make_handouts(HERE, course)
    texts["hints.md"] = hints_page(course)
    for name, text in texts.items():
        (pages / name).write_text(typeset(text), encoding="utf-8")
    shutil.copytree(HERE / "figures", pages / "figures")
    lay_out_touch(HERE, pages)
    shutil.copytree(OURS, pages / "site", ignore=shutil.ignore_patterns("*.yml"))
    if instructors:
        only_pages = shutil.ignore_patterns("*.py", "__pycache__")
        shutil.copytree(HERE / "instructor", pages / "instructor", ignore=only_pages)
    there = {page.relative_to(pages).as_posix() for page in pages.rglob("*.md")}
    (folder / "mkdocs.yml").write_text(settings(instructors, there), encoding="utf-8")


def settings(instructors, there):
    """Return mkdocs.yml with the pages that exist; without its last part for students."""
    text = (OURS / "mkdocs.yml").read_text(encoding="utf-8")
    before, found, _ = text.partition(f"  - {INSTRUCTORS}:\n")
    assert found, f"mkdocs.yml has no part of the menu named {INSTRUCTORS}"
    lines = (text if instructors else before).splitlines(keepends=True)
    pages = [re.search(r": (\S+\.md)$", line) for line in lines]
    kept = [line for line, page in zip(lines, pages, strict=True) if not page or page[1] in there]
    return "".join(kept)


def build(folder):
    """Run zensical in `folder`; exit if a link is broken."""
    command = [sys.executable, "-m", "zensical", "build", "--strict"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"The site could not be built:\n{done.stdout}{done.stderr}")
    return folder / "site"


def without_the_internet(site):
    """Replace the script that pages would fetch by our own."""
    for page in site.rglob("*.html"):
        up = "../" * (len(page.relative_to(site).parts) - 1)
        text = page.read_text(encoding="utf-8").replace(SHIM, f"{up}site/search-worker.js")
        text = text.replace(BOX, f'{BOX} aria-label="to be ticked on paper"')
        page.write_text(text, encoding="utf-8", newline="\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=BUILD, metavar="DIR")
    own = os.environ.get("COURSE_FILE")
    parser.add_argument("--course", type=Path, default=own, metavar="FILE")
    options = parser.parse_args()
    out = options.out
    try:
        course = read_course(options.course)
    except WrongCourse as error:
        sys.exit(str(error))
    if importlib.util.find_spec("zensical") is None:
        sys.exit("The site needs zensical, which is not installed: python -m pip install zensical")
    for name in ("students", "instructors"):
        with tempfile.TemporaryDirectory() as folder:
            everything = name == "instructors"
            sources(Path(folder), everything, FULL if everything else course)
            site = build(Path(folder))
            without_the_internet(site)
            shutil.rmtree(out / name, ignore_errors=True)
            shutil.copytree(site, out / name)
        print(f"For {name}: {out / name / 'index.html'}")


if __name__ == "__main__":
    main()
