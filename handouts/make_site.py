"""Build the handouts as web pages: build/handouts/students, and build/handouts/instructors.

    python handouts/make_site.py [--out DIR]

The pages for students are made from sources without the instructor's folder, so nothing of it can
be in them. Both open from a folder, without a server and without the internet. Needs zensical.
"""

import argparse
import importlib.util
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
BUILD = HERE.parent / "build" / "handouts"
OURS = HERE / "site"
SHIM = "https://unpkg.com/iframe-worker/shim"  # what the theme would fetch
INSTRUCTORS = "For instructors"  # the part of the menu that students do not get


def sources(folder, instructors):
    """Lay out what zensical needs: its settings, and the pages and figures."""
    pages = folder / "docs"
    pages.mkdir()
    for page in HERE.glob("*.md"):
        shutil.copyfile(page, pages / page.name)
    shutil.copytree(HERE / "figures", pages / "figures")
    shutil.copytree(OURS, pages / "site", ignore=shutil.ignore_patterns("*.yml"))
    if instructors:
        only_pages = shutil.ignore_patterns("*.py", "*.toml", "__pycache__")
        shutil.copytree(HERE / "instructor", pages / "instructor", ignore=only_pages)
    (folder / "mkdocs.yml").write_text(settings(instructors), encoding="utf-8")


def settings(instructors):
    """The text of mkdocs.yml; for students without the menu's last part."""
    text = (OURS / "mkdocs.yml").read_text(encoding="utf-8")
    before, found, _ = text.partition(f"  - {INSTRUCTORS}:\n")
    assert found, f"mkdocs.yml has no part of the menu named {INSTRUCTORS}"
    return text if instructors else before


def build(folder):
    """Run zensical there; a link that leads nowhere stops it."""
    command = [sys.executable, "-m", "zensical", "build", "--strict"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"The site could not be built:\n{done.stdout}{done.stderr}")
    return folder / "site"


def without_the_internet(site):
    """Put our own script in the place of the one that would be fetched."""
    for page in site.rglob("*.html"):
        up = "../" * (len(page.relative_to(site).parts) - 1)
        text = page.read_text(encoding="utf-8").replace(SHIM, f"{up}site/search-worker.js")
        page.write_text(text, encoding="utf-8", newline="\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=BUILD, metavar="DIR")
    out = parser.parse_args().out
    if importlib.util.find_spec("zensical") is None:
        sys.exit("The site needs zensical, which is not installed: python -m pip install zensical")
    for name in ("students", "instructors"):
        with tempfile.TemporaryDirectory() as folder:
            sources(Path(folder), instructors=name == "instructors")
            site = build(Path(folder))
            without_the_internet(site)
            shutil.rmtree(out / name, ignore_errors=True)
            shutil.copytree(site, out / name)
        print(f"For {name}: {out / name / 'index.html'}")


if __name__ == "__main__":
    main()
