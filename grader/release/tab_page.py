"""Build the lab as a page for a browser tab: a folder of static files, and a zip of it.

The page needs no server and no installation: Python runs in it as WebAssembly. Its sources are in
`tab/`; parts downloaded once, by hash, are kept in `build/tab-cache`.
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

import jinja2
import markupsafe

from grader.bank.store import hash_contents, hash_lines
from grader.errors import Stop
from grader.judge.course import FULL, Course
from grader.judge.task import KIT
from grader.player.page import list_sources, read_player
from grader.release.build import (
    NAME,
    Refused,
    build_wrong_members,
    hash_folders,
    list_files,
    move_into,
    sha256,
    write_right_runs,
    write_zip,
)
from grader.release.handed_out import make_students_tree
from grader.release.handouts import find_sections, make_handouts
from grader.release.leaks import Secret, find_leaks, find_secrets
from grader.release.pages import (
    SITE_ONLY,
    find_figures,
    make_scrollable,
    mend_links,
    parse_page,
    render_page,
    write_files,
)
from grader.release.recordings import Record, Recordings
from grader.release.students_copy import Tree, write_copy
from grader.report.files import put_in
from grader.source.regions import regions_in

PARTS = Path(__file__).with_name("tab")
CACHE = KIT / "build" / "tab-cache"
PYODIDE = ("pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm")
STDLIB = "python_stdlib.zip"
LOCK = "pyodide-lock.json"
PLATFORMS = ("pyemscripten_2026_0_wasm32", "any")
PYTHON = "3.14"
AS_THEY_ARE = ("README.md", "style.css", "worker.js", "shared.js", "unpack.mjs")
TEXTS = (".py", ".md")  # editable files
UNUSED = re.compile(  # unused parts of wheels; pymunk loads only the compiled part of cffi
    r"/tests?/|/testing/|pymunk/examples/|\.dist-info/(?!METADATA)|\.(pyi|c|h|pyc)$|"
    r"/cffi/|/hypothesis/extra/"
)
PREDICTION = re.compile(
    r"^\*\*Predict\.\*\*.*?^</details>\n", re.M | re.S
)  # parts of films, which are not played here
TYPED = (  # commands of the lab sheet, and the page's buttons for them
    (re.compile(r"`make check TODO=\w+`"), "**Check**"),
    (re.compile(r"`make hint TODO=\w+`, or \[the hints\]\([^)]*\)"), "Press **Hint**"),
    (re.compile(r"`python \w+\.py` prints"), "**Run** prints"),
)
LATER = ("figures/", "lesson.html", "more.zip")  # loaded after the page is shown
UNSERVED = ("index.html", "README.md")  # the page itself, and a file for whoever serves it
COMPILED_HERE = (".so", ".pyd", ".c", ".pyi")  # not for the page's Python
FOR_CHECKS = ("kit/grader/checks/expected_runs.json", "kit/grader/checks/recorded.json")
NOT_RUN = (  # handed-out files that no button runs
    *("accuracy.py", "experiments/", "stable_engine/"),
    *("notebooks/", "handouts/", "requirements.txt"),
)
WITHOUT_USE = re.compile(  # need a network, a process or a terminal
    r"(_pyrepl|curses|dbm|ensurepip|http|idlelib|multiprocessing|pydoc_data|sqlite3|tkinter|"
    r"turtledemo|venv|wsgiref|xml|xmlrpc)/|(_pyio|bdb|cProfile|doctest|ftplib|imaplib|"
    r"mailbox|netrc|pdb|pickletools|poplib|profile|pstats|pydoc|smtplib|socketserver|turtle|"
    r"webbrowser)\.py$"
)
SOLID = "all.zip"  # archives in one piece, which makes them a third smaller
PUBLISHED = tuple(f"{each}/site/" for each in ("lab.zip", f"lab.zip/{SOLID}", f"more.zip/{SOLID}"))
LESSON = "lesson.md"
ZIP = f"{NAME}-tab.zip"
WITHOUT_PYMUNK = "This page was made without pymunk: do TODO 7 and B4 on a computer with Python."


def make_tab(
    out: Path, course: Course, cffi: Path | None, record: Record | None = None
) -> list[Path]:
    """Build the page of a course into `out`, unless it is recorded; return folder and zip."""
    fetch_parts()
    if cffi is not None:
        check_cffi(cffi)
    record = record or Recordings(course)
    with tempfile.TemporaryDirectory(prefix="tab-") as folder:
        work = Path(folder)

        def build() -> bytes:
            wrong = build_wrong_members(work / "wrong", course)
            return (build_tab(work, wrong, course, record, cffi) / ZIP).read_bytes()

        (work / ZIP).write_bytes(record(f"page of {hash_sources(cffi)}", build))
        shutil.unpack_archive(work / ZIP, work / "unpacked")
        (site,) = (work / "unpacked").iterdir()
        return [move_into(each, out) for each in (site, work / ZIP)]


def hash_sources(cffi: Path | None) -> str:
    """Hash everything that a page is made of."""
    folders = [KIT / name for name in ("grader", "handouts", "solution", "starter")]
    rows = [row for each in folders for row in hash_contents(each, "__pycache__", "build")]
    files = [KIT / "requirements.txt", *([cffi] if cffi else [])]
    return hash_lines([*rows, *(row for each in files for row in hash_contents(each))])


def add_tab(out: Path, course: Course = FULL, cffi: Path | None = None) -> list[str]:
    """Build the page with a release; return lines on the result or the reason of a failure."""
    try:
        fetch_parts()
    except Stop as error:
        why = str(error).partition("\n")[0].rstrip(":")
        return [f"skipped the page for a browser: {why}"]
    return [f"made {path}" for path in make_tab(out, course, cffi)]


def build_tab(
    work: Path,
    wrong: Iterable[Tree],
    course: Course,
    record: Record,
    cffi: Path | None = None,
) -> Path:
    """Build the page below `work`; return the folder that holds it and its zip.

    `cffi`, a wheel or a zip, is what pymunk needs; without it the page has no pymunk.
    """
    copy, built = work / "copy", work / "built"
    site = built / f"{NAME}-tab"
    site.mkdir(parents=True)

    def skip_practice(name: str, make: Callable[[], bytes]) -> bytes:
        return b"{}" if name == "practice" else record(name, make)

    write_copy(copy, wrong, course, skip_practice)
    write_right_runs(copy, course, record)
    files = {
        n: each for n, each in make_students_tree(KIT, course).items() if not n.startswith(NOT_RUN)
    }
    sources = work / "sources"
    sources.mkdir()
    write_lab(sources / "lab.zip", copy, files, cffi)
    secrets = find_secrets(KIT, course)
    look_for_own_leaks(sources, secrets)  # hashes of what the page has compiled
    write_sheet(site, copy, files, course, cffi is not None)
    pyodide = CACHE / "node_modules" / "pyodide"
    (site / "pyodide").mkdir()
    for name in PYODIDE:
        shutil.copyfile(pyodide / name, site / "pyodide" / name)
    lock = json.loads((pyodide / LOCK).read_bytes())
    lock["packages"] = {}  # the page loads none of Pyodide's distribution
    (site / "pyodide" / LOCK).write_text(json.dumps(lock), encoding="utf-8")
    shutil.copyfile(pyodide / STDLIB, sources / STDLIB)
    write_compiled(sources, site, pyodide)
    for name in AS_THEY_ARE:
        shutil.copyfile(PARTS / "page" / name, site / name)
    write_index(site)
    bundle_scripts(site)
    write_service_worker(site)
    look_for_own_leaks(site, secrets)
    write_zip(site, built / ZIP, site.name)
    return built


def look_for_own_leaks(folder: Path, secrets: list[Secret]) -> None:
    """Raise Refused if a file of our own gives the solution away."""
    found = find_leaks(folder, secrets)
    own = [str(each) for each in found if not each.file.startswith(PUBLISHED)]
    if own:
        raise Refused("\n".join(["the page would give the solution away:", *own]))


# ---------------------------------------------------------------- what is fetched


def fetch_parts() -> None:
    """Fetch Pyodide, the editor and the wheels with npm and pip, unless they are cached."""
    CACHE.mkdir(parents=True, exist_ok=True)
    if not (CACHE / "node_modules").is_dir():
        for name in ("package.json", "package-lock.json"):
            shutil.copyfile(PARTS / name, CACHE / name)
        patience = ["--fetch-timeout=30000", "--fetch-retries=1"]  # ms
        run_tool(["npm", "ci", "--no-audit", "--no-fund", *patience], CACHE)
    if list_missing_wheels(CACHE / "wheels"):
        where = [word for each in PLATFORMS for word in ("--platform", each)]
        what = ["--require-hashes", "--requirement", str(PARTS / "wheels.txt")]
        kind = ["--no-deps", "--only-binary=:all:", "--python-version", PYTHON, *where]
        pip = [sys.executable, "-m", "pip", "download", "--quiet", "--retries", "1"]
        pip += ["--dest", "wheels"]
        run_tool([*pip, *kind, *what], CACHE)
    if missing := list_missing_wheels(CACHE / "wheels"):
        raise Stop(f"{CACHE / 'wheels'} lacks {', '.join(missing)}: delete it and try again")


def list_missing_wheels(folder: Path) -> list[str]:
    """Return the wheels of the list that the folder lacks."""
    here = {sha256(path.read_bytes()) for path in find_wheels(folder)}
    return [name for name, digest in read_wheels() if digest not in here]


def find_wheels(folder: Path) -> list[Path]:
    """Return the listed wheels in the folder, identified by their hashes."""
    wanted = {digest for _, digest in read_wheels()}
    return [path for path in sorted(folder.glob("*.whl")) if sha256(path.read_bytes()) in wanted]


def read_wheels() -> list[tuple[str, str]]:
    text = (PARTS / "wheels.txt").read_text(encoding="utf-8")
    return re.findall(r"^(\S+) --hash=sha256:(\w+)$", text, re.M)


def check_cffi(path: Path) -> None:
    """Compare a wheel of cffi with the hash that Pyodide's lock file has of it."""
    packages = json.loads((CACHE / "node_modules" / "pyodide" / LOCK).read_bytes())["packages"]
    wheel = packages["cffi"]
    if sha256(path.read_bytes()) != wheel["sha256"]:
        raise Stop(f"{path} is not {wheel['file_name']} of Pyodide's distribution: fetch it there")


def run_tool(command: list[str], folder: Path) -> None:
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    except FileNotFoundError:
        raise Stop(f"the page needs {command[0]}: install Node.js, which brings it") from None
    if done.returncode:
        raise Stop(f"{' '.join(command[:4])} failed:\n{done.stdout}{done.stderr}")


# ---------------------------------------------------------------- what is written


def write_lab(target: Path, copy: Path, files: Mapping[str, bytes], cffi: Path | None) -> None:
    """Write the page's Python: wheels, grader, stand-ins and the starter."""
    with zipfile.ZipFile(target, "w") as archive:
        wheels = [
            each for each in find_wheels(CACHE / "wheels") if cffi or each.stem[:6] != "pymunk"
        ]
        for path in [*wheels, *([cffi] if cffi else [])]:
            for name, content in read_archive(path).items():
                if not UNUSED.search(f"/{name}"):
                    put_in(archive, f"site/{name}", content)
        stand_ins = ["python"] if cffi else ["python", "without_cffi"]
        for folder in stand_ins:
            put_tree(archive, "shims", PARTS / folder)
        put_tree(archive, "shims/pygame", PARTS / "pygame")
        for package in (jinja2, markupsafe):  # as installed here, by their hashes
            put_tree(archive, f"site/{package.__name__}", Path(package.__path__[0]))
        put_tree(archive, "kit/grader", copy / "grader")
        for name, content in sorted(files.items()):
            put_in(archive, f"lab/{name}", content)


def read_archive(path: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(path) as archive:
        names = [each for each in sorted(archive.namelist()) if not each.endswith("/")]
        return {name: archive.read(name) for name in names}


def put_tree(archive: zipfile.ZipFile, place: str, folder: Path) -> None:
    for name, path in list_files(folder):
        if "__pycache__" not in path.parts and path.suffix not in COMPILED_HERE:
            put_in(archive, f"{place}/{name}", path.read_bytes())


def write_compiled(sources: Path, site: Path, pyodide: Path) -> None:
    """Write the page's archives from `sources`: compiled modules, and the rest apart."""
    words = [str(PARTS / "compile.mjs"), str(pyodide), str(PARTS / "compile.py"), str(sources)]
    run_tool(["node", *words], sources)
    lab, compiled, stdlib, booted, loaded = (
        read_archive(sources / f"{name}.zip")
        for name in ("lab", "lab.pyc", "python_stdlib", "booted.pyc", "loaded.pyc")
    )
    first = {n: each for n, each in lab.items() if not is_for_later(n)} | compiled
    first |= {f"stdlib/{name}": each for name, each in loaded.items()}
    done = {name.removesuffix("c") for name in compiled}
    later = {name: each for name, each in lab.items() if name not in first and name not in done}
    done = {name.removesuffix("c") for name in (*booted, *loaded)}
    later |= {
        f"stdlib/{name}": each
        for name, each in stdlib.items()
        if name not in done and not WITHOUT_USE.match(name)
    }
    write_archive(site / "pyodide" / STDLIB, booted)
    for name, files in (("lab.zip", first), ("more.zip", later)):
        write_archive(sources / SOLID, files, zipfile.ZIP_STORED)
        solid = {SOLID: (sources / SOLID).read_bytes()}
        write_archive(site / name, solid, zipfile.ZIP_LZMA)
    (sources / SOLID).unlink()


Files = dict[str, bytes]


def write_archive(target: Path, files: Files, method: int = zipfile.ZIP_DEFLATED) -> None:
    with zipfile.ZipFile(target, "w") as archive:
        for name, content in sorted(files.items()):
            put_in(archive, name, content, method=method)


def is_for_later(name: str) -> bool:
    """Return whether the page loads this file after it is shown."""
    ours = not name.startswith("lab/")
    return (ours and name.endswith(".py")) or name in FOR_CHECKS


def write_sheet(
    site: Path, copy: Path, files: Mapping[str, bytes], course: Course, has_pymunk: bool
) -> None:
    """Write each TODO's text, file, program and hints, and the lesson, for the page."""
    handouts = make_handouts(KIT / "handouts", course)
    sections = find_texts(handouts)
    places = find_places(files)
    todos = [
        {
            "id": todo.id,
            "title": todo.title,
            "file": places[todo.id],
            "program": places[todo.id].partition("/")[0].removesuffix(".py"),
            "text": render(sections.get(todo.id, "")),
            "hints": todo.hints,
        }
        for todo in course.rubric.todos
        if todo.id in places
    ]
    note = "" if has_pymunk else WITHOUT_PYMUNK
    texts = {name: each.decode() for name, each in files.items() if name.endswith(TEXTS)}
    shown = {"title": course.title, "note": note, "todos": todos, "files": texts}
    sheet = json.dumps(shown, ensure_ascii=False)
    (site / "lab.json").write_text(sheet, encoding="utf-8", newline="\n")
    write_files(KIT / "handouts", site, {LESSON: SITE_ONLY.sub("", handouts[LESSON])})
    (site / "figures").mkdir()
    for figure in find_figures("".join(sections.values())):
        shutil.copyfile(KIT / "handouts" / figure, site / figure)


def find_texts(handouts: Mapping[str, str]) -> dict[str, str]:
    """Return the handouts' text of each TODO, without its films."""
    return {id: PREDICTION.sub("", text) for id, text in find_sections(handouts).items()}


def find_places(files: Mapping[str, bytes]) -> dict[str, str]:
    """Return the file that has the region of each TODO."""
    texts = {name: each.decode() for name, each in files.items() if name.endswith(".py")}
    return {region.id: name for name, text in texts.items() for region in regions_in(text)}


def render(text: str) -> str:
    """Return a section of the lab sheet as HTML, with the page's buttons for commands."""
    for command, button in TYPED:
        text = command.sub(button, text)
    tokens = parse_page(text)
    for token in tokens:
        mend_links(token.children or [], [LESSON])
    html = make_scrollable(render_page(tokens))
    return html.replace('<a href="lesson.html', '<a target="_blank" href="lesson.html')


def write_index(site: Path) -> None:
    """Write the page itself, and allow the replay player in its frame."""
    text = (PARTS / "page" / "index.html").read_text(encoding="utf-8")
    allowed = list_sources([read_player()])
    text = text.replace("script-src 'self'", f"script-src 'self' {allowed}")
    (site / "index.html").write_text(text, encoding="utf-8", newline="\n")


def bundle_scripts(site: Path) -> None:
    """Bundle the page's scripts and the editor into one file."""
    sources = CACHE / "page"  # beside node_modules, where esbuild looks for the editor
    shutil.rmtree(sources, ignore_errors=True)
    shutil.copytree(PARTS / "page", sources)
    esbuild = CACHE / "node_modules" / "esbuild" / "bin" / "esbuild"
    options = ["--bundle", "--minify", "--format=esm", "--log-level=warning"]
    run_tool([str(esbuild), "page/app.js", *options, f"--outfile={site / 'app.js'}"], CACHE)


def write_service_worker(site: Path) -> None:
    """Write the service worker with the names of all files and a version of their content."""
    text = (PARTS / "page" / "sw.js").read_text(encoding="utf-8")
    names = ["./", *(name for name, _ in list_files(site) if name not in UNSERVED)]
    later = [each for each in names if each.startswith(LATER)]
    first = [each for each in names if each not in later]
    text = text.replace("FIRST = []", f"FIRST = {json.dumps(first)}")
    text = text.replace("LATER = []", f"LATER = {json.dumps(later)}")
    text = text.replace("-VERSION", f"-{hash_folders([site], text)[:16]}")
    (site / "sw.js").write_text(text, encoding="utf-8", newline="\n")
