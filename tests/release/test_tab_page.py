"""Use the browser page as a student would; test that it grades as the kit does."""

import gzip
import http.server
import io
import itertools
import json
import os
import random
import re
import shutil
import subprocess
import threading
import zipfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

import msgspec
import pytest
from command_line import start_grader
from firefox import Firefox, firefox
from msgspec.structs import replace
from page_readers import PATIENCE
from whole_bank import bank, member_named

from grader.bank.members import Member
from grader.errors import Stop
from grader.judge.course import FULL
from grader.judge.result import Result, TodoResult
from grader.judge.rubric import Rubric, drop_hidden
from grader.judge.task import KIT
from grader.release import students_copy, tab_page
from grader.release.build import Refused, make_command
from grader.release.handed_out import make_students_tree
from grader.release.leaks import Secret, find_leaks
from grader.release.recordings import Recordings
from grader.release.tab_page import (
    CACHE,
    add_tab,
    build_tab,
    fetch_parts,
    find_texts,
    list_missing_wheels,
    render,
)
from grader.source.regions import read_source, regions_in

SOAK = pytest.mark.soak
CFFI = CACHE / "cffi.zip"  # optional: a wheel of cffi for Pyodide, and pymunk is tried too
PYMUNK = ("7a", "7b", "7c", "7d", "B4")
MOST_LOADED = 9 * 10**6  # bytes, compressed as a server would
SAMPLE = 200  # members that the long run compares; `make test` has those of FEW
FEW = {"2-masses-forgotten": "2", "8a-explicit-euler-again": "8a"}
CONTROL = "\ue009"  # the key, to a browser
ENDLESS = "        while True:\n            pass\n"
ON_THE_PAGE = """
import fs from "fs";
const [site, folder] = process.argv.slice(2);
const { loadPyodide } = await import(`${site}/pyodide/pyodide.mjs`);
const env = { PYTHONHASHSEED: "0", HOME: "/tmp" };
const py = await loadPyodide({ indexURL: `${site}/pyodide/`, env });
const { unpack } = await import(`${site}/unpack.mjs`);
unpack(py, new Uint8Array(fs.readFileSync(`${site}/lab.zip`)));
const page = py.pyimport("page");
page.start({ watch() {}, told: () => false });
unpack(py, new Uint8Array(fs.readFileSync(`${site}/more.zip`)));
for (const name of fs.readdirSync(folder).sort()) {
  const { todos, files } = JSON.parse(fs.readFileSync(`${folder}/${name}`, "utf8"));
  page.lay_out(JSON.stringify(files));
  console.log(page.grade_as_json(JSON.stringify(todos)));
}
py.runPython("import grader.player.replay");  // which the page loads when a check has failed
process.exit(0);
"""
BY_PROCESSES = """
import json, shutil, sys
from pathlib import Path
from grader.judge.wall.children import start_worker
from grader.judge.grade import grade
from grader.judge.task import Options
from grader.report.files import as_json
folder, work, handed_out = map(Path, sys.argv[1:])
worker = start_worker()
for path in sorted(folder.iterdir()):
    member = json.loads(path.read_text())
    lab = work / path.stem / "lab"
    shutil.copytree(handed_out, lab)
    for name, text in member["files"].items():
        (lab / name).parent.mkdir(parents=True, exist_ok=True)
        (lab / name).write_text(text, encoding="utf-8", newline="\\n")
    result = grade(lab, Options(trusted=True, only=frozenset(member["todos"])), worker)
    print(as_json(result).decode().replace("\\n", ""))
worker.close()
"""


def need_parts() -> None:
    """Skip a test without the page's parts; CI fetches them."""
    try:
        if os.environ.get("CI"):
            fetch_parts()
    except Stop as error:
        pytest.skip(f"needs npm, pip and their registries: {error}")
    if not (CACHE / "node_modules").is_dir() or list_missing_wheels(CACHE / "wheels"):
        pytest.skip("needs build/tab-cache, which `make tab` fills with npm and pip")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory, expected_runs: bytes) -> Path:
    """Build the page without the recorded answers of wrong members."""
    need_parts()

    def record(name: str, make: Callable[[], bytes]) -> bytes:
        return expected_runs if name == "runs" else make()

    work = tmp_path_factory.mktemp("tab")
    return find_folder(build_tab(work, [], FULL, record, CFFI if CFFI.is_file() else None))


def find_folder(built: Path) -> Path:
    (folder,) = (path for path in built.iterdir() if path.is_dir())
    return folder


# ---------------------------------------------------------------- in a browser


class Silent(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_: object) -> None:
        """Say nothing."""


@contextmanager
def serve(site: Path) -> Iterator[str]:
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), partial(Silent, directory=site))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()
    server.server_close()


@pytest.fixture(scope="module")
def address(site: Path) -> Iterator[str]:
    with serve(site) as opened:
        yield opened


class Tab:
    """The page in a browser, with its errors and requests to other hosts."""

    def __init__(self, browser: Any, address: str) -> None:
        self.context = browser.new_context(accept_downloads=True, bypass_csp=True)
        self.context.set_default_timeout(PATIENCE)
        self.page = self.context.new_page()
        self.complaints: list[str] = []
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.note(request.url, address))
        self.page.goto(address)
        self.wait_until_shown()

    def note(self, url: str, address: str) -> None:
        if not url.startswith((address, "data:", f"blob:{address}")):
            self.complaints.append(url)

    def wait_until_shown(self) -> None:
        self.page.wait_for_selector("body[data-shown]")

    def do(self, button: str) -> str:
        """Press a button, wait for its end, and return the page's status."""
        self.page.click(f"#{button}")
        return self.wait()

    def wait(self) -> str:
        self.page.wait_for_selector("#run:enabled")
        return self.page.inner_text("#status")

    def choose(self, todo: str) -> None:
        self.page.select_option("#todo", todo)

    def type_file(self, text: str) -> None:
        """Replace the file in the editor by keyboard."""
        self.page.click("#editor .cm-content")
        self.page.keyboard.press("Control+a")
        self.page.keyboard.insert_text(text)

    def shown(self) -> str:
        self.page.get_by_text("Whole file").click()
        return self.page.inner_text("#editor .cm-content")

    def download(self, button: str, target: Path) -> Path:
        with self.page.expect_download() as waiting:
            self.page.click(f"#{button}")
        waiting.value.save_as(target)
        self.wait()
        return target


@pytest.fixture
def tab(browser: Any, address: str) -> Iterator[Tab]:
    opened = Tab(browser, address)
    yield opened
    assert opened.complaints == []
    opened.context.close()


def list_tasks(has_pymunk: bool) -> dict[str, str]:
    """Return the file of each task that the page can check."""
    files = {
        region.id: path.relative_to(KIT / "starter").as_posix()
        for path in sorted((KIT / "starter").rglob("*.py"))
        for region in regions_in(read_source(path))
    }
    return {id: name for id, name in files.items() if has_pymunk or id not in PYMUNK}


def list_passed(zipped: Path) -> set[str]:
    """Grade a submission as an instructor; return the TODOs that pass."""
    out = zipped.with_suffix(".json")
    start_grader("grade", zipped, "--json", out)
    result = msgspec.json.decode(out.read_bytes(), type=Result)
    return {todo.id for todo in result.todos if todo.state == "passed"}


@SOAK
def test_the_whole_lab_is_done_on_the_page(tab: Tab, tmp_path: Path):
    files = list_tasks(CFFI.is_file())
    for id, name in files.items():
        tab.choose(id)
        tab.type_file(read_source(KIT / "solution" / name))
    assert "Checked." in tab.do("check-all")
    states = tab.page.eval_on_selector("#todo", "each => [...each.options].map(o => o.text)")
    unfinished = [each for each in states if not each.endswith("(passed)")]
    assert [each.split(":")[0] for each in unfinished] == (
        [] if CFFI.is_file() else [f"TODO {id}" for id in PYMUNK]
    )
    zipped = tab.download("hand-in", tmp_path / "hand-in.zip")
    assert list_passed(zipped) >= set(files)


@SOAK
def test_a_task_is_typed_run_and_checked(tab: Tab):
    tab.choose("5")
    assert tab.do("check").startswith("TODO 5: not started, 0 of")
    tab.page.click("text=keep_vel = 0.99")
    for line, rate in (("keep_vel", "linear"), ("keep_omega", "angular")):
        tab.page.keyboard.press("Home")
        tab.page.keyboard.press("Shift+End")
        tab.page.keyboard.type(f"{line} = math.exp(-self.{rate}_damping)")
        tab.page.keyboard.press("ArrowDown")
    assert tab.do("check").startswith("TODO 5: not yet")
    found = tab.page.inner_text("#found")
    for word in ("We ran", "Expected", "Got", "Meaning"):
        assert word in found
    tab.page.wait_for_selector("#replay:not([hidden])")
    replay = tab.page.frame_locator("#player")
    assert "ball" in replay.locator("#parting").inner_text()
    assert "Replay of TODO 5" in tab.page.get_attribute("#player", "title")
    tab.page.focus("#replays")
    tab.page.keyboard.press("Tab")
    tab.page.keyboard.press("Tab")
    tab.page.keyboard.press("ArrowRight")
    assert "moment" in replay.locator("#position").inner_text()
    assert tab.page.evaluate("document.activeElement.id") == "player"
    tab.page.click("#run")
    tab.page.wait_for_function("document.querySelector('#window').width === 900")
    tab.page.get_by_text("Pause or go on").click()
    tab.page.get_by_text("One step").click()
    assert "has ended" in tab.do("stop")
    assert "Fixed steps: " in tab.page.inner_text("#printed")


@SOAK
def test_other_files_and_the_lesson_are_at_hand(tab: Tab):
    tab.choose("1")
    assert tab.page.input_value("#file") == "mini_engine/contacts.py"
    tab.page.select_option("#file", "mini_engine/body.py")
    assert "class Body" in tab.page.inner_text("#editor .cm-content")
    tab.page.click("#editor .cm-content")
    tab.page.keyboard.press("Control+Home")
    tab.page.keyboard.type("# mine\n")
    tab.choose("2")
    tab.page.select_option("#file", "mini_engine/body.py")
    assert "# mine" in tab.page.inner_text("#editor .cm-content")
    tab.choose("1")
    with tab.context.expect_page() as opening:
        tab.page.click("#text a[href='lesson.html#contacts']")
    assert opening.value.locator("#contacts").is_visible()


@SOAK
def test_letters_of_a_program_have_buttons(tab: Tab):
    shown = "[...document.querySelectorAll('[data-letter]:not([hidden])')].map(b => b.dataset.key)"
    for todo, letters in (("5", ""), ("B1", "sgk"), ("B4", "b")):
        tab.choose(todo)
        assert "".join(tab.page.evaluate(shown)) == letters


@SOAK
def test_endless_loops_end(tab: Tab):
    tab.choose("5")
    text = read_source(KIT / "starter" / "mini_engine" / "world.py")
    tab.type_file(text.replace("        keep_vel = 0.99\n", ENDLESS))
    tab.do("check")
    assert "seems not to" in tab.page.inner_text("#found")
    tab.page.click("#run")
    tab.page.wait_for_selector("#stop:enabled")
    assert tab.do("stop") == "The program has ended."
    assert tab.page.evaluate("document.body.dataset.boots") == "1"


@SOAK
def test_the_page_is_for_everybody(tab: Tab):
    axe = pytest.importorskip("axe_playwright_python", reason="needs axe, of the extra `dev`")
    rules = Path(axe.__file__).with_name("axe.min.js").read_text(encoding="utf-8")
    tab.do("check")
    tab.page.evaluate(rules)
    for scheme in ("light", "dark"):
        tab.page.emulate_media(color_scheme=scheme)
        for width in (390, 1280):
            tab.page.set_viewport_size({"width": width, "height": 800})
            found = tab.page.evaluate("axe.run()")["violations"]
            serious = [each["help"] for each in found if each["impact"] in ("serious", "critical")]
            assert serious == [], (scheme, width)
            assert tab.page.evaluate("document.documentElement.scrollWidth") <= width


@SOAK
def test_work_is_kept_offline_too_and_carried_over(
    tab: Tab, browser: Any, address: str, tmp_path: Path
):
    tab.choose("8a")
    name = "integrators.py"
    tab.type_file(read_source(KIT / "starter" / name).replace("DT = ", "# mine\nDT = "))
    carried = tab.download("export", tmp_path / "lab.zip")
    tab.context.set_offline(True)
    tab.page.reload()
    tab.wait_until_shown()
    assert "# mine" in tab.shown()
    assert tab.page.input_value("#todo") == "8a"
    other = Tab(browser, address)
    other.wait()
    other.page.set_input_files("#chosen", carried)
    other.page.wait_for_function(
        "document.querySelector('#status').textContent.startsWith('Read ')"
    )
    other.choose("8a")
    assert "# mine" in other.shown()
    other.context.close()


# ---------------------------------------------------------------- in Firefox


class FirefoxTab:
    """The page in Firefox, used as in Chromium."""

    def __init__(self, browser: Firefox, address: str) -> None:
        self.browser = browser
        browser.open(address)
        self.wait()

    def do(self, button: str) -> str:
        self.browser.run(f"document.querySelector('#{button}').click()")
        return self.wait()

    def wait(self) -> str:
        shown = "document.body.dataset.shown !== undefined"
        self.browser.wait_until(f"{shown} && !document.querySelector('#run').disabled")
        return self.text("status")

    def text(self, name: str) -> str:
        return self.browser.run(f"document.querySelector('#{name}').innerText")

    def choose(self, todo: str) -> None:
        select = "document.querySelector('#todo')"
        self.browser.run(f"{select}.value = '{todo}'")
        self.browser.run(f"{select}.dispatchEvent(new Event('change'))")

    def type_file(self, text: str) -> None:
        self.browser.run("document.querySelector('#editor .cm-content').focus()")
        self.browser.press("a", held=CONTROL)
        self.browser.run(f"document.execCommand('insertText', false, {json.dumps(text)})")


@SOAK
def test_the_lab_is_done_in_firefox_and_kept_offline(site: Path, tmp_path: Path):
    files = list_tasks(CFFI.is_file())
    with firefox(tmp_path / "firefox") as browser:
        with serve(site) as opened:
            tab = FirefoxTab(browser, opened)
            for id, name in files.items():
                tab.choose(id)
                tab.type_file(read_source(KIT / "solution" / name))
            assert "Checked." in tab.do("check-all")
            browser.run("document.querySelector('#hand-in').click()")
            zipped = browser.wait_for_download("hand-in.zip")
            assert list_passed(zipped) >= set(files)
            tab.wait()
        browser.send("browsingContext.reload", context=browser.tab, wait="none")
        tab.wait()  # although the server has stopped
        tab.choose("5")
        assert tab.do("check").startswith("TODO 5: passed")


# ---------------------------------------------------------------- content


def write_members(members: Iterable[tuple[Member, list[str]]], folder: Path) -> list[str]:
    """Write these members' files and the TODOs to check; return their names."""
    names = []
    (folder / "asked").mkdir(parents=True)
    for number, (member, todos) in enumerate(members):
        tree = folder / "trees" / str(number)
        member.build(tree)
        texts = {p.relative_to(tree).as_posix(): read_source(p) for p in tree.rglob("*.py")}
        asked = json.dumps({"todos": todos, "files": texts})
        (folder / "asked" / f"{number:04}.json").write_text(asked, encoding="utf-8")
        names.append(f"{member.kind}/{member.name}")
    return names


def grade_on_the_page(site: Path, folder: Path) -> list[Result]:
    node = shutil.which("node")
    if node is None:
        pytest.skip("needs Node.js, to run Python as the page does")
    script = folder / "page.mjs"
    script.write_text(ON_THE_PAGE, encoding="utf-8")
    return read_results([node, str(script), str(site), str(folder / "asked")], folder)


def grade_by_processes(site: Path, folder: Path) -> list[Result]:
    """Grade the same members in processes, with the sources of the page's grader."""
    kit, lab = site.parents[1] / "copy", folder / "lab"
    for name, content in make_students_tree(KIT, FULL).items():
        (lab / name).parent.mkdir(parents=True, exist_ok=True)
        (lab / name).write_bytes(content)
    words = ["", str(folder / "asked"), str(folder / "copies"), str(lab)]
    code = f"sys.argv = {words!r}; exec({BY_PROCESSES!r})"
    return read_results(make_command(kit, code), kit)


def read_results(command: list[str], folder: Path) -> list[Result]:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert not done.returncode, done.stderr[-3000:]
    return [msgspec.json.decode(line, type=Result) for line in done.stdout.splitlines()]


def assert_same(site: Path, folder: Path, names: list[str]) -> None:
    """Compare both results, except the isolation and Python's words for errors."""
    pairs = zip(
        names, grade_on_the_page(site, folder), grade_by_processes(site, folder), strict=True
    )
    for name, here, there in pairs:
        for one, other in zip(here.todos, there.todos, strict=True):
            assert without_errors(one) == without_errors(other), name
        assert (here.points, here.max_points) == (there.points, there.max_points), name


def without_errors(todo: TodoResult) -> TodoResult:
    """Return a result without words that depend on the version of Python.

    Versions differ in their words for errors and in how they count lines of a comprehension.
    """
    checks = [
        replace(each, got="", meaning="")
        if each.state == "error"
        else replace(each, got=re.sub(r"[\d.]+ times as many lines", "times", each.got))
        for each in todo.checks
    ]
    return replace(todo, checks=checks)


@SOAK
def test_members_get_the_same_on_the_page(site: Path, tmp_path: Path):
    own = [each for each in bank() if each.kind != "hostile" and each.form == "package"]
    random.Random(1).shuffle(own)
    fit = (each for each in own if not needs_more(each, tmp_path / "needs" / each.name))
    chosen = [*itertools.islice(fit, SAMPLE)]
    ids = sorted(list_tasks(CFFI.is_file()))
    turns = zip(chosen, itertools.cycle(ids), strict=False)
    members = [(m, sorted(m.todos & {*ids}) or [turn]) for m, turn in turns]
    assert_same(site, tmp_path, write_members(members, tmp_path))


def needs_more(member: Member, tree: Path) -> bool:
    """Return whether a member needs numpy or threads, which the page lacks."""
    member.build(tree)
    texts = [read_source(path) for path in tree.rglob("*.py")]
    return any(re.search("import numpy|import (_thread|threading)", text) for text in texts)


def test_a_few_members_get_the_same_without_pymunk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    need_parts()
    asked = [each for each in FULL.rubric.todos if each.id in FEW.values()]
    monkeypatch.setattr(tab_page, "look_for_own_leaks", lambda *_: None)
    record_all = students_copy.record_answers
    monkeypatch.setattr(
        students_copy,
        "record_answers",
        lambda wrong, _: record_all(wrong, drop_hidden(Rubric(asked))),
    )

    def record(name: str, make: Callable[[], bytes]) -> bytes:
        return b"{}" if name == "runs" else make()

    site = find_folder(build_tab(tmp_path / "site", [], FULL, record))
    members = [(member_named(name), [todo]) for name, todo in FEW.items()]
    assert_same(site, tmp_path, write_members(members, tmp_path))


@SOAK
def test_no_file_of_the_page_gives_the_solution_away(site: Path, secrets: list[Secret]):
    for packed in ("lab.zip", "more.zip"):
        assert not [name for name in list_unpacked(site / packed) if "mistakes" in name]
    found = find_leaks(site, secrets)
    assert {each.file for each in found if not each.file.startswith(tab_page.PUBLISHED)} == set()


@SOAK
def test_what_a_browser_loads_is_nine_megabytes_at_most(site: Path):
    files = [path.read_bytes() for path in site.rglob("*") if path.is_file()]
    assert sum(len(gzip.compress(each, 9)) for each in files) <= MOST_LOADED
    assert f"{MOST_LOADED // 10**6} MB" in (site / "README.md").read_text(encoding="utf-8")


@SOAK
def test_what_is_loaded_is_compiled_and_the_search_has_read_its_source(site: Path):
    compiled = {name for name in list_unpacked(site / "lab.zip") if name.endswith(".pyc")}
    sources = site.parents[1] / "sources"
    with zipfile.ZipFile(sources / "lab.zip") as archive:
        searched = {f"{name}c" for name in archive.namelist()}
    with zipfile.ZipFile(sources / tab_page.STDLIB) as archive:
        searched |= {f"stdlib/{name}c" for name in archive.namelist()}
    assert compiled and compiled <= searched
    assert not compiled & {f"{name}c" for name in list_unpacked(site / "more.zip")}


def list_unpacked(packed: Path) -> list[str]:
    """Return the names in one of the page's archives."""
    with zipfile.ZipFile(packed) as outer:
        inner = io.BytesIO(outer.read(tab_page.SOLID))
    with zipfile.ZipFile(inner) as archive:
        return archive.namelist()


def test_a_release_says_why_it_has_no_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(tab_page, "CACHE", tmp_path / "cache")
    monkeypatch.setenv("PATH", str(tmp_path))
    (note,) = add_tab(tmp_path / "out")
    assert note.startswith("skipped the page for a browser: the page needs npm")
    npm = tmp_path / "npm"
    npm.write_text("#!/bin/sh\nexit 1\n")
    npm.chmod(0o755)
    (note,) = add_tab(tmp_path / "out")
    assert note == "skipped the page for a browser: npm ci --no-audit --no-fund failed"


def test_the_same_page_is_built_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    built: list[Path] = []

    def build(work: Path, *_: object) -> Path:
        built.append(work)
        with zipfile.ZipFile(work / "made", "w") as archive:
            archive.writestr("physics-engine-tab/index.html", "the page")
        (work / "built").mkdir()
        return (work / "made").rename(work / "built" / tab_page.ZIP).parent

    monkeypatch.setattr(tab_page, "fetch_parts", lambda: None)
    monkeypatch.setattr(tab_page, "check_cffi", lambda _: None)
    monkeypatch.setattr(tab_page, "build_tab", build)
    (tmp_path / "cffi.whl").write_text("a wheel")
    for cffi, times in ((None, 1), (None, 1), (tmp_path / "cffi.whl", 2), (None, 2)):
        record = Recordings(FULL, tmp_path / "recorded")
        folder, packed = tab_page.make_tab(tmp_path / "out", FULL, cffi, record)
        assert (folder / "index.html").read_text() == "the page" and zipfile.is_zipfile(packed)
        assert len(built) == times


def test_a_leak_stops_the_build(tmp_path: Path, secrets: list[Secret]):
    shutil.copyfile(KIT / "solution" / "mini_engine" / "contacts.py", tmp_path / "lab.py")
    with pytest.raises(Refused, match=r"lab\.py, line \d+, gives away TODO 1"):
        tab_page.look_for_own_leaks(tmp_path, secrets)


def test_sections_ask_for_no_film_that_the_page_does_not_play():
    sheet = (KIT / "handouts" / "lab-sheet.md").read_text(encoding="utf-8")
    sections = find_texts({"lab-sheet.md": sheet})
    assert len(sections) > 10 and all("**What.**" in text for text in sections.values())
    assert not [id for id, text in sections.items() if "Predict" in text or "predict" in text]


def test_bonus_tasks_have_their_texts_too():
    bonus = (KIT / "handouts" / "bonus.md").read_text(encoding="utf-8")
    texts = find_texts({"bonus.md": bonus})
    assert [*texts] == ["B1", "B2", "B3", "B4", "B5", "B6"] and all(texts.values())


def test_a_section_names_the_buttons_of_the_page():
    says = "- [ ] `make check TODO=4` says so.\n- [ ] `python integrators.py` prints 4.\n"
    sheet = f"# Sheet\n\n## TODO 4: Friction\n\n{says}\n## After\n"
    html = render(find_texts({"lab-sheet.md": sheet})["4"])
    assert "<strong>Check</strong> says so" in html and "<strong>Run</strong> prints 4" in html
    assert not re.search("make|After", html)
