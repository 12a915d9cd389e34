"""Run, check and pack the lab in a browser tab, for the page's worker.

Every function takes and returns what JSON holds, or bytes. `bridge` is the worker's own side:
draw(commands, width, height), rest(ms, until_event), events(), watch(seconds), printed(text), and
told(title of a check), which returns whether to stop.
"""

import io
import json
import os
import runpy
import shutil
import sys
import time
import traceback
import zipfile
from contextlib import ExitStack
from functools import cache, partial
from pathlib import Path, PurePosixPath

import pygame

LAB = Path("/lab")
HANDED_OUT = Path("/handed-out")
MOST_OUTPUT = 20_000  # characters that a program may print in a run
MOST_BYTES = 20_000_000  # bytes of a zip to bring in
COLUMNS = range(40, 81)
LACKED = {  # the page's message, by Python's message
    "named 'numpy'": "numpy is not in this page. Use Python's own numbers, or work on a computer.",
    "can't start new thread": "This page has no threads. Do without them, or work on a computer.",
}

bridge = None


def start(bridge_):
    """Set the bridge to the worker, and copy the lab as handed out."""
    global bridge
    bridge = bridge_
    shutil.copytree(LAB, HANDED_OUT, dirs_exist_ok=True)


def lay_out(files):
    """Make the lab's folder from the files handed out, and write these texts over them."""
    os.chdir("/")
    forget_last()
    shutil.rmtree(LAB)
    shutil.copytree(HANDED_OUT, LAB)
    for name, text in json.loads(files).items():
        path = LAB / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8", newline="\n")
    for name, module in [*sys.modules.items()]:
        if str(getattr(module, "__file__", None) or "").startswith(f"{LAB}/"):
            del sys.modules[name]
    sys.path_importer_cache.clear()


# ---------------------------------------------------------------- run


class Printed(io.TextIOBase):
    """Passes on a program's output, up to MOST_OUTPUT characters."""

    left = MOST_OUTPUT

    def writable(self):
        return True

    def write(self, text):
        if self.left > 0:
            bridge.printed(text[: self.left])
        self.left -= len(text)
        if self.left <= 0 < self.left + len(text):
            bridge.printed("\n… The rest is not shown.\n")
        return len(text)


def run(module):
    """Run a program with its window on the page until it ends; return its error, or ""."""
    before = sys.stdout, sys.stderr
    pygame.display.state.sink = show
    pygame.Clock.wait_hook = rest
    pygame.event.wait_hook = rest_until_event
    pygame.event.pump_hook = post_events
    sys.stdout = sys.stderr = Printed()
    os.chdir(LAB)
    sys.path.insert(0, str(LAB))
    try:
        runpy.run_module(module, run_name="__main__", alter_sys=True)
    except (SystemExit, KeyboardInterrupt):
        pass
    except BaseException as error:
        return describe(error)
    finally:
        sys.path.remove(str(LAB))
        sys.stdout, sys.stderr = before
        pygame.display.state.sink = pygame.Clock.wait_hook = None
        pygame.event.wait_hook = pygame.event.pump_hook = None
        pygame.quit()
    return ""


def show(surface):
    bridge.draw(json.dumps(surface.ops), *surface.size)


def rest(fps, last):
    """Rest until 1/fps seconds after `last`, and post new events."""
    left = last + 1 / fps - time.perf_counter() if fps else 0
    bridge.rest(max(left, 0) * 1000, False)
    post_events()


def rest_until_event():
    bridge.rest(100, True)  # ms; between two rests Python notices the button Stop
    post_events()


def post_events():
    for kind, a, b, c in json.loads(bridge.events()):
        pygame.event.post(pygame.event.Event(kind, name_values(kind, a, b, c)))


def name_values(kind, a, b, c):
    """Return the attributes of an event from the page's three numbers."""
    match kind:
        case pygame.KEYDOWN | pygame.KEYUP:
            return {"key": a, "mod": b, "unicode": chr(c) if c else ""}
        case pygame.MOUSEBUTTONDOWN | pygame.MOUSEBUTTONUP:
            return {"pos": (a, b), "button": c}
        case pygame.MOUSEMOTION:
            return {"pos": (a, b), "rel": (0, 0), "buttons": (c & 1, 0, 0)}
    return {}


def describe(error):
    """Return an error as Python prints it, without the frames outside of the lab."""
    while (trace := error.__traceback__) and not trace.tb_frame.f_code.co_filename.startswith(
        str(LAB)
    ):
        error.__traceback__ = trace.tb_next
        if trace.tb_next is None:
            break
    text = "".join(traceback.format_exception(error)).replace(f"{LAB}/", "")
    return "\n".join([text, *list_lacked(text)])


def list_lacked(text):
    """Return explanations of errors caused by features that the page lacks."""
    return [words for sign, words in LACKED.items() if sign in text]


# ---------------------------------------------------------------- check


class Stopped(BaseException):
    """Raised between two checks after the button Stop."""


last = ExitStack()  # of the last check, for replays of its failures
failed = {}  # by the ids of a TODO and a check: how to make its replay


def grade_lab(only):
    """Grade these TODOs of the lab, or all; keep what a replay of a failure needs."""
    from grader.judge.grade import grading
    from grader.judge.task import Options
    from grader.judge.wall.inline import InlineWorker
    from grader.worker.tab import TabChannel

    def connect(setup):
        return TabChannel(setup, bridge.watch, measure_pace())

    def tell(check):
        if bridge.told(check.title):
            raise Stopped

    options = Options(trusted=True, mends=True, only=frozenset(only), progress=tell)
    forget_last()
    run = last.enter_context(grading(LAB, options, InlineWorker(connect)))
    result = run.run()
    for todo in result.todos:
        for each in todo.checks:
            if each.failed and (key := (todo.id, each.id)) in run.failing:
                failed[key] = partial(make_replay, run, todo, each, run.failing[key])
    return result


def forget_last():
    failed.clear()
    last.close()


def check(only, columns):
    """Check these TODOs, or all.

    Return the screen's lines with their styles, the states, and which checks a replay may show.
    """
    from rich.console import Console

    from grader.cli.restore import list_notes
    from grader.report.screen import Screen

    result = grade_lab(json.loads(only))
    console = Console(file=io.StringIO(), width=min(max(columns, COLUMNS[0]), COLUMNS[-1]))
    notes = [note.partition(" Undo it:")[0] for note in list_notes(LAB, result)]
    notes += list_lacked("\n".join(each.got for todo in result.todos for each in todo.checks))
    screen = Screen(console, None, 200, tasks={})  # no commands, which cannot be typed here
    lines = screen.lay_out(result, (), notes)
    todos = [[each.id, each.state, each.points, each.max_points] for each in result.todos]
    titles = {(t.id, c.id): f"TODO {t.id}: {c.title}" for t in result.todos for c in t.checks}
    replays = [[*key, titles[key]] for key in failed]
    return json.dumps({"lines": lines, "todos": todos, "replays": replays})


def replay(todo, check):
    """Return the replay page of a failed check, or "" if there is none."""
    return failed[todo, check]() if (todo, check) in failed else ""


def make_replay(run, todo, check, failing):
    from grader.player.replay import Replays

    try:
        replays = Replays(LAB, run.sandbox.open_child, None)
        made = replays.make_files(todo, check, failing)
    except Exception:  # any error of the submission
        return ""
    return made[0] if made else ""


def warm():
    """Load the modules of the first check in advance."""
    import hypothesis  # noqa: F401
    import rich.console  # noqa: F401

    import grader.cli.restore
    import grader.judge.grade
    import grader.report.screen
    import grader.worker.tab  # noqa: F401
    from grader.judge.course import FULL
    from grader.judge.jobs import load_checks

    for todo in FULL.rubric.todos:
        load_checks(todo)
    measure_pace()


def grade_as_json(only):
    """Grade and return the whole result as JSON, for tests."""
    import msgspec

    return msgspec.json.encode(grade_lab(json.loads(only))).decode()


@cache
def measure_pace():
    """Return how much slower this machine is than a usual one, from 1 to 2."""
    began = time.perf_counter()
    total = 0
    for number in range(300_000):
        total += number * number % 7
    return min(max((time.perf_counter() - began) / USUAL, 1.0), 2.0)


USUAL = 0.05  # s that the loop of measure_pace takes on a usual processor


# ---------------------------------------------------------------- keep


def hand_in():
    """Pack the work to hand in; return the zip and a text about it."""
    from grader.cli.hand_in import list_warnings, pack_tree, write_receipt
    from grader.judge.course import read_course

    packed, names = pack_tree(LAB, read_course(None), Path("/tmp/hand-in.zip"))
    said = [f"hand-in.zip holds {', '.join(names)}.", *list_warnings(LAB, names)]
    return [packed.read_bytes(), "\n".join([*said, write_receipt(packed)])]


def export():
    """Return the lab's folder as a zip."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(LAB.rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                archive.write(path, f"physics-engine/{path.relative_to(LAB)}")
    return packed.getvalue()


def bring_in(data, name):
    """Return the texts of a zip, or of one file, by their names in the lab."""
    if not name.endswith(".zip"):
        return json.dumps({place_of(name): bytes(data).decode("utf-8-sig")})
    with zipfile.ZipFile(io.BytesIO(bytes(data))) as archive:
        entries = [each for each in archive.infolist() if is_text(each.filename)]
        if sum(each.file_size for each in entries) > MOST_BYTES:
            raise ValueError(f"{name} holds more than {MOST_BYTES // 1_000_000} MB")
        names = [PurePosixPath(each.filename) for each in entries]
        tops = {each.parts[0] for each in names}
        has_folder = len(tops) == 1 and not (HANDED_OUT / min(tops)).exists()
        texts = {
            str(PurePosixPath(*each.parts[has_folder:])): archive.read(entry).decode("utf-8-sig")
            for each, entry in zip(names, entries, strict=True)
        }
    return json.dumps(texts)


def is_text(name):
    """Return whether an entry of a zip is a text file inside the lab."""
    path = PurePosixPath(name)
    return (
        path.suffix in (".py", ".md", ".ipynb")
        and not path.is_absolute()
        and ".." not in path.parts
    )


def place_of(name):
    """Return the path of a file in the lab by its name; new files lie at the top."""
    found = [path for path in HANDED_OUT.rglob(name)]
    return str(found[0].relative_to(HANDED_OUT)) if found else name
