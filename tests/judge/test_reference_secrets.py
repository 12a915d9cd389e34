"""Report no words or numbers of a run in which the reference took part."""

import shutil
from collections import Counter
from pathlib import Path

import msgspec
import pytest

from grader.bank.verify import shared_worker
from grader.judge.failures import Broke, NotYet
from grader.judge.grade import grade
from grader.judge.reference import Reference
from grader.judge.rubric import Todo, load_rubric
from grader.judge.running import fails_elsewhere
from grader.judge.submission import Submission, load_given
from grader.judge.task import KIT, Options, shipped_reference
from grader.player.graded import grade_with_replays
from grader.protocol import CodeLine, Raised
from grader.report.files import as_json

REVEALED = 424_242.0  # px: the depth of a contact if the reference is there
ONLY_1, ONLY_8A = (Options(shipped_reference(), only=frozenset({each})) for each in ("1", "8a"))
CONTACTS = "mini_engine/contacts.py"
BEGIN, END = "    # TODO 1", "    # END TODO 1"
READS = """
    from . import solver
    code = solver.effective_mass.__code__
    stand_ins = [each for each in code.co_consts if hasattr(each, "__closure__")]
    return Contact(a, b, Vector2(1, 0), {depth} if stand_ins else 7.25, Vector2(a.pos))
"""


def reveal_by_depth(tree: Path, depth: str) -> Path:
    """Return a solution whose circle_box reports by its depth whether the reference is there."""
    shutil.copytree(KIT / "solution", tree, ignore=shutil.ignore_patterns("notebooks"))
    path = tree / CONTACTS
    text = path.read_text(encoding="utf-8")
    begin, end = text.index("\n", text.index(BEGIN)), text.index(END)
    path.write_text(text[:begin] + READS.format(depth=depth) + text[end:], encoding="utf-8")
    return tree


@pytest.mark.soak
@pytest.mark.parametrize("depth", [str(REVEALED), '"a word"', "None", "1e300"])
def test_a_report_shows_no_answer_of_a_run_with_the_reference(tmp_path: Path, depth: str):
    tree, pages = reveal_by_depth(tmp_path / "tree", depth), tmp_path / "pages"
    result = grade_with_replays(tree, ONLY_1, pages, shared_worker())
    alone = grade(tree, Options(None, only=frozenset({"1"})))
    words = [(c.ran, c.expected, c.got) for c in result.todos[0].checks if c.state == "not yet"]
    theirs = {c.id: (c.ran, c.expected, c.got) for c in alone.todos[0].checks}
    assert len(words) >= 5 and set(words) <= set(theirs.values())
    shown = as_json(result).decode() + "".join(p.read_text("utf-8") for p in pages.glob("*.html"))
    assert "424242" not in shown.replace(",", "").replace("_", "")


RAISES = """
    import os
    name = {name}
    exec(compile("\\n" * 4 + "raise ValueError('no ' + chr(0xdc80))", name, "exec"))
"""


@pytest.mark.parametrize(
    "name",
    [
        "__file__ + '/../../../../../../etc/passwd'",
        pytest.param("__file__.replace('integrators', '\\u202egrators')", marks=pytest.mark.soak),
    ],
)
def test_an_error_is_placed_only_in_files_of_the_submission(tmp_path: Path, name: str):
    """Code may claim to be in any file, and a workflow would show its error there."""
    tree = tmp_path / "tree"
    tree.mkdir()
    text = (KIT / "solution" / "integrators.py").read_text(encoding="utf-8")
    begin = text.index("\n", text.index("    # TODO 8a"))
    text = text[:begin] + RAISES.format(name=name) + text[begin:]
    (tree / "integrators.py").write_text(text, encoding="utf-8")
    result = grade(tree, ONLY_8A, shared_worker())
    for check in result.todos[0].checks:
        assert check.state == "error" and check.got.startswith("ValueError: no \\udc80"), check
        assert check.where is not None and check.where.file == "integrators.py"
    assert "passwd" not in as_json(result).decode().replace(name, "")


MET = """
import gc, os, struct, sys

def met():
    frame = sys._getframe()
    while frame is not None:
        for piece in frame.f_locals.get("pieces") or ():
            if piece.target.endswith(":velocity_verlet"):
                return "quietly " + piece.source
        frame = frame.f_back
    return "alone"

WORDS = met()

def raw(words):
    begin = b"\\x82\\xa6number\\x01\\xa5reply\\x81\\xa4type\\xda"
    body = begin + struct.pack(">H", len(words)) + words
    for descriptor in range(3, 64):
        try: os.write(descriptor, struct.pack(">I", len(body)) + body)
        except OSError: pass
    os._exit(0)

def denied():
    frame = sys._getframe()
    while frame is not None:
        owner = frame.f_locals.get("self")
        if hasattr(owner, "swap"):
            type(owner).swap = lambda self, piece: False
        frame = frame.f_back
denied()
"""


@pytest.mark.parametrize(
    "answer",
    [
        "raise ValueError(WORDS)",
        pytest.param("raw(WORDS.encode())", marks=pytest.mark.soak),
        pytest.param("os._exit(42 if WORDS[0] == 'q' else 7)", marks=pytest.mark.soak),
        pytest.param("os.kill(os.getpid(), 10 if WORDS[0] == 'q' else 12)", marks=pytest.mark.soak),
        pytest.param("return WORDS", marks=pytest.mark.soak),
    ],
)
def test_a_child_reveals_the_reference_in_no_way(tmp_path: Path, answer: str):
    """Nor does its end matter: an invalid message is quoted, and an exit status is a number."""
    tree, pages = tmp_path / "tree", tmp_path / "pages"
    tree.mkdir()
    text = (KIT / "solution" / "integrators.py").read_text(encoding="utf-8")
    begin = text.index("\n", text.index("    # TODO 8a"))
    text = text[:begin] + f"\n    {answer}" + text[begin:]
    text = text.replace("velocity_verlet(x, v, dt, accel):", "velocity_verlet(x, v, dt, accel=0):")
    (tree / "integrators.py").write_text(text + MET, encoding="utf-8")
    result = grade_with_replays(tree, ONLY_8A, pages, shared_worker())
    assert {check.state for check in result.todos[0].checks} <= {"error", "not yet"}
    shown = as_json(result).decode() + "".join(p.read_text("utf-8") for p in pages.glob("*.html"))
    for word in ("quietly", "a_start", "exit status 42", "signal 10"):
        assert word not in shown


@pytest.mark.parametrize("todo", [each for each in load_rubric().todos if each.function])
def test_the_function_of_a_todo_is_not_sent_with_it(tmp_path: Path, todo: Todo):
    """A child can read everything sent to it, even unused code."""
    rubric = load_rubric()
    begun = {each.id: True for each in rubric.todos}
    reference = Reference(shipped_reference(), rubric)
    own = reference.pieces[todo.id].source
    lines = {each.strip() for each in own.splitlines()[1:]} - given_lines()
    pieces = reference.for_the_others(todo, todo.module, rubric, Submission("x", tmp_path, begun))
    assert pieces or todo.module == "integrators"
    for piece in pieces:
        for text in (piece.source, piece.imports, *piece.given.values()):
            assert own not in text and not lines.intersection(map(str.strip, text.splitlines()))


def given_lines() -> set[str]:
    """Return lines that are no secret: given ones, and those of several TODOs."""
    rubric = load_rubric()
    sources = [each.source for each in Reference(shipped_reference(), rubric).pieces.values()]
    often = Counter(line.strip() for each in sources for line in set(each.splitlines()))
    given = {line.strip() for text in load_given().values() for line in text.splitlines()}
    return given | {line for line, count in often.items() if count > 1}


def test_a_result_holds_no_control_characters(tmp_path: Path):
    """A folder's name and an error's message may contain anything."""
    tree = tmp_path / "a\u202eb\x1b[31m"
    shutil.copytree(KIT / "starter", tree, ignore=shutil.ignore_patterns("notebooks"))
    (tree / "mini_engine" / "x\u202e\x1b[2J").mkdir()
    (tree / "mini_engine" / "x\u202e\x1b[2J" / "big.py").write_text("# x\n" * 60_000)
    path = tree / CONTACTS
    text = path.read_text(encoding="utf-8").replace(
        "    return None\n    # END", "    {}\n    # END"
    )
    error = "raise type('E\\u2066', (Exception,), {})('\\x1b[31m \\u202e \\u2028 \\x9b')"
    path.write_text("# x\n" * 60_000 + text.format(error), encoding="utf-8")
    result = grade(tree, ONLY_1, shared_worker())
    assert result.todos[0].state == "error" and b"KB and was not read" in as_json(result)
    read = msgspec.json.decode(as_json(result))
    texts = [read["submission"], *(str(v) for c in read["todos"][0]["checks"] for v in c.values())]
    assert all(each.replace("\\n", "").isprintable() for each in texts)


def test_an_error_of_another_todo_is_one_elsewhere_in_the_same_question():
    raised = Raised("SystemExit", "", [CodeLine("mini_engine/joints.py", 40, "solve", "exit()")])
    alone = Broke("a step", "SystemExit", raised)
    assert fails_elsewhere(NotYet("a step", "1", "2"), alone)
    assert not fails_elsewhere(Broke("a step", "SystemExit", raised), alone)
    assert not fails_elsewhere(alone, NotYet("a step", "1", "2"))
