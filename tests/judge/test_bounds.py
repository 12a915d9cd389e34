"""Limit the memory that a submission costs the judge, by children, answers, sources and results.

Thresholds are far above the needs of honest work, and far below what hurts.
"""

import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import msgspec
import pytest
from one_worker import NoWorker
from whole_bank import bank

from grader.bank.verify import shared_worker
from grader.judge.explain.names import LONGEST, MOST, Names
from grader.judge.result import MAX_JSON, CheckResult, Result, TodoResult, Where
from grader.judge.submission import Submission, find_todos
from grader.judge.task import KIT, Options, shipped_reference
from grader.judge.wall.children import Child, ChildEnded
from grader.player.graded import grade_with_replays
from grader.protocol import (
    MAX_ITEMS,
    MAX_MESSAGE,
    MAX_PRESENT,
    MAX_STATES,
    Answered,
    BodyValue,
    Channel,
    ChildSetup,
    CodeLine,
    Items,
    Limits,
    Played,
    Raised,
    Ready,
    Remembered,
    Returned,
    Simulated,
    Vec,
    cut,
)
from grader.source import definitions
from grader.source.definitions import MAX_READ, MAX_TRIED, Program
from grader.source.regions import MAX_SHAPE, MAX_SOURCE, parse, shape_of

LINUX = pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells the most memory")

# ---------------------------------------------------------------- answers


def types_in(kind: object, seen: set[object]) -> Iterator[msgspec.inspect.Type]:
    """Yield all types that a type of message is made of."""
    if not isinstance(kind, msgspec.inspect.Type) or getattr(kind, "cls", None) in seen:
        return
    yield kind
    if isinstance(kind, msgspec.inspect.StructType):
        seen.add(kind.cls)
    inner = [getattr(kind, name, None) for name in ("item_type", "key_type", "value_type")]
    inner += getattr(kind, "types", ()) or ()
    inner += getattr(kind, "item_types", ()) or ()
    inner += [field.type for field in getattr(kind, "fields", ())]
    for each in inner:
        yield from types_in(each, seen)


MANY = (
    msgspec.inspect.StrType,
    msgspec.inspect.BytesType,
    msgspec.inspect.ListType,
    msgspec.inspect.DictType,
)


@pytest.mark.parametrize("message", [Answered, Ready])
@pytest.mark.parametrize("kind", MANY)
def test_every_text_and_list_that_a_child_sends_has_a_greatest_length(message: type, kind: type):
    found = list(types_in(msgspec.inspect.type_info(message), set()))
    unbounded = (msgspec.inspect.AnyType, msgspec.inspect.SetType, msgspec.inspect.VarTupleType)
    assert found and not any(isinstance(each, unbounded) for each in found)
    assert all(each.max_length for each in found if isinstance(each, kind))


def played(**fields: object) -> Played:
    return msgspec.structs.replace(Played([1], [0.0], [], "returned", [], [], []), **fields)


BODY = BodyValue(1, Vec(0, 0), Vec(0, 0), 0.0, 0.0, 1.0, 1.0, 10.0)
OVERLONG = [
    Returned(Items([0] * (MAX_ITEMS + 1))),
    Returned(Items([Items([None] * (MAX_ITEMS + 1))])),
    Simulated([[]] * (MAX_STATES + 1)),
    Simulated([[0] * (6 * MAX_PRESENT + 1)]),
    played(trail=[[0] * 6 * 40_000]),
    played(trail=[[]] * (MAX_STATES + 1)),
    played(bodies=[BODY] * (MAX_PRESENT + 1)),
    played(steps=[0] * (MAX_STATES + 1)),
    Raised("ValueError", "", [CodeLine("a.py", 10**17, "f", "")]),
    Raised("ValueError", "", [CodeLine("a.py", -1, "f", "")]),
]


@pytest.mark.parametrize("reply", OVERLONG)
def test_a_list_too_long_is_no_answer(reply: object):
    ours, theirs = socket.socketpair()
    channel = Channel(theirs)

    def lie() -> None:
        channel.send(Ready(1, []))
        channel.receive()
        channel.send(Answered(1, reply))

    liar = threading.Thread(target=lie)
    liar.start()
    child = Child(Channel(ours), NoWorker(), 1)
    with pytest.raises(ChildEnded, match="what it sent is not an answer"):
        child.ask(Remembered())
    liar.join()
    theirs.close()


def test_a_text_that_is_cut_says_so():
    assert cut("abc", 3) == "abc" and cut("abcd", 3) == "ab…"


def test_no_more_than_one_process_of_a_submission_is_open(tmp_path: Path, monkeypatch):
    """So its memory is at most that of one process: RLIMIT_AS plus the scratch folder in memory."""
    member = next(each for each in bank() if each.todos == {"8a"} and each.kind == "wrong")
    tree = tmp_path / "tree"
    member.build(tree)
    worker, counts = shared_worker(), [0]
    usual_open, usual_end = worker.open, worker.end

    def open_child(setup: ChildSetup) -> Child:
        counts.append(counts[-1] + 1)
        return usual_open(setup)

    def end_child(child: Child, gone: bool) -> int | None:
        counts.append(counts[-1] - 1)
        return usual_end(child, gone)

    monkeypatch.setattr(worker, "open", open_child)
    monkeypatch.setattr(worker, "end", end_child)
    options = Options(shipped_reference(), only=frozenset({"8a"}))
    replays = tmp_path / "replays"
    result = grade_with_replays(tree, options, replays, worker)
    assert result.points < result.max_points and any(replays.iterdir())
    assert (max(counts), counts[-1]) == (1, 0)
    assert Limits(cpu_seconds=10).memory_mb + Limits(cpu_seconds=10).scratch_mb <= 1100


# ---------------------------------------------------------------- sources

LONG = "0;" * (MAX_SOURCE // 2)


def test_a_text_longer_than_a_program_is_not_parsed():
    assert parse(LONG) is not None
    assert parse(LONG + "0") is None
    assert shape_of("0;" * MAX_SHAPE) == ("0;" * MAX_SHAPE)


def program_of(**files: str) -> Program:
    return Program({Path(f"{name}.py"): text for name, text in files.items()})


CIRCLES = {
    "stars": {f"m{n}": f"from m{n + 1} import *\nfrom m{n + 2} import *\n" for n in range(200)},
    "names": {"m0": "f = f0\n" + "".join(f"f{n} = f{n + 1}\n" for n in range(5000))},
    "modules": {f"m{n}": f"from m{n + 1} import f" for n in range(400)},
    "classes": {"m0": "".join(f"class C{n}(C{n + 1}): pass\n" for n in range(3000)) + "f = C0.f"},
    "elif": {"m0": "if a: pass\n" + "elif a: pass\n" * 1200},
    "own bases": {"m0": "class A: pass\nif 0:\n    class A(A.a, A.b): pass"},
    "own bases elsewhere": {
        "m0": "from m1 import A",
        "m1": "from m0 import A as B\nclass A(B.a, B.b): pass",
    },
    "long names": {
        "m0": f"from m1 import A\nf = {'f' * 60_000}",
        "m1": f"class A(A.{'a' * 60_000})",
    },
    "bindings": {"m0": "import m1 as A\n" + "def A(): pass\n" * 5000 + "class A(A.a, A.b): pass"},
    "dots": {"m0": f"import {'.'.join('a' * 60_000)}"},
    "number": {"m0": f"a[0x{'f' * 50_000}] = f"},
    "operators": {"m0": f"{'-' * 900}a.b = f\na{'.b' * 900} = f\nclass A(a{'.b' * 900}): pass"},
}


@pytest.mark.parametrize(
    "name",
    [pytest.param(each, marks=() if n % 3 else pytest.mark.soak) for n, each in enumerate(CIRCLES)],
)
def test_following_a_name_is_limited(name: str):
    """Each of these once took hours or gigabytes, or ended the judge."""
    program = program_of(**CIRCLES[name])
    for path in ("f", "World.f", "A.f"):
        found = program.definition("m0", path)
        assert found is None or found.function is None
        assert len(program.found) <= 10_000
        assert program.tried <= 2 * MAX_TRIED


def test_files_are_read_up_to_a_sum(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(definitions, "MAX_READ", 30)
    program = program_of(a="from b import f", b="from c import f", c="def f(): pass  # far")
    assert program.definition("a", "f") is not None
    assert program.unread == [Path("c.py")]
    assert program.read <= 30


def test_a_file_that_is_too_long_is_named(tmp_path: Path):
    (tmp_path / "integrators.py").write_text("#" * (MAX_SOURCE + 1), encoding="utf-8")
    submission = Submission("x", tmp_path)
    find_todos(submission)
    (said,) = submission.unread
    assert said.startswith("integrators.py has 129 KB and was not read")


def test_similar_names_are_looked_for_among_some_of_them(tmp_path: Path):
    """A submission may have a million functions, or names of a million letters."""
    package = tmp_path / "mini_engine"
    package.mkdir()
    long = f"def {'effective_mass' * (LONGEST // 10)}(): pass\n"
    (package / "solver.py").write_text(long, encoding="utf-8")
    assert Names(Submission("theirs", tmp_path)).changed("mini_engine") == {}
    many = "".join(f"def effective_mas{number}(): pass\n" for number in range(MOST + 100))
    (package / "solver.py").write_text(many, encoding="utf-8")
    names = Names(Submission("theirs", tmp_path))
    assert len(names.of("mini_engine")) == MOST
    assert "renamed?" in names.changed("mini_engine")["effective_mass"]


# ---------------------------------------------------------------- results


@pytest.mark.parametrize("letter", ["x", "\x01", "\U0001f600", '"'])
def test_a_result_is_never_longer_than_a_megabyte(letter: str):
    words = letter * 10**5
    check = CheckResult("c", "A check", "unit", "not yet", 0, 1, words, words, words, words)
    there = msgspec.structs.replace(check, where=Where(letter * 4000, 1))
    todos = [TodoResult("1", "One", "not yet", 0, 60, None, [check, there] * 60)] * 2
    result = Result(1, "n" * 255, 0, 120, 0, [], todos).in_bounds()
    assert len(msgspec.json.encode(result)) <= MAX_JSON


def test_a_result_of_usual_length_stays_as_it_is():
    check = CheckResult("c", "A check", "unit", "not yet", 0, 1, "x" * 2000, where=Where("a.py", 1))
    result = Result(1, "n", 0, 1, 0, [], [TodoResult("1", "One", "not yet", 0, 1, None, [check])])
    assert result.in_bounds() == result


# ---------------------------------------------------------------- the judge's own process

MEASURE = """
import resource, sys
import msgspec
from pathlib import Path
from grader.bank.verify import shared_worker
from grader.judge.grade import grade
from grader.judge.task import Options, shipped_reference
from grader.judge.result import MAX_JSON
only = frozenset(sys.argv[1].split(","))
for tree in map(Path, sys.argv[2:]):
    result = grade(tree, Options(shipped_reference(), only=only, trusted=True), shared_worker())
    assert len(msgspec.json.encode(result)) <= MAX_JSON
    used = resource.getrusage(resource.RUSAGE_SELF)
    print(used.ru_maxrss // 1024, used.ru_utime + used.ru_stime)
"""


def cost(todos: str, *trees: Path) -> list[tuple[int, float]]:
    """Return the most memory of the judge (MB) after each of these grades, and its seconds."""
    command = [sys.executable, "-c", MEASURE, todos, *map(str, trees)]
    told = subprocess.run(command, capture_output=True, text=True, check=True, cwd=KIT)
    lines = [line.split() for line in told.stdout.splitlines()]
    return [(int(memory), float(seconds)) for memory, seconds in lines]


def tree_with(folder: Path, files: dict[str, str]) -> Path:
    folder.mkdir()
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


@pytest.mark.soak
@LINUX
def test_sources_cost_the_judge_little(tmp_path: Path):
    """Six megabytes at once, many files of what may be parsed, and f-strings that parse slowly."""
    solved = (KIT / "solution" / "integrators.py").read_text(encoding="utf-8")
    inside = "0;" * (MAX_SOURCE // 2 - 50)
    fields = f'f"{"{0}" * (MAX_SOURCE // 3 - 50)}"'
    all_of = "".join(f"import part{number}\n" for number in range(100))
    trees = [
        tree_with(tmp_path / "plain", {"integrators.py": solved}),
        tree_with(tmp_path / "large", {"integrators.py": solved, "notes.py": "0;" * 3 * 10**6}),
        tree_with(
            tmp_path / "many",
            {"integrators.py": f"{solved}\nif 0:\n    from part0 import *\n" + all_of}
            | {f"part{number}.py": inside for number in range(100)},
        ),
        tree_with(
            tmp_path / "slow",
            {"integrators.py": solved.replace("import", f"{all_of}import", 1)}
            | {f"part{number}.py": fields for number in range(100)},
        ),
    ]
    (plain, before), *others = cost("8a", *trees)
    for memory, seconds in others:
        assert memory - plain < 300
        assert seconds - before < 30
        before = seconds


@pytest.mark.soak
@LINUX
def test_answers_cost_the_judge_little(tmp_path: Path):
    names = {
        *("sends-a-million-lists", "sends-long-words", "answers-by-the-megabyte"),
        *("names-things-by-the-megabyte", "raises-megabytes", "floods-the-output"),
    }
    trees = [tmp_path / "0-solution"]
    tree_with(trees[0], {"integrators.py": (KIT / "solution" / "integrators.py").read_text()})
    for member in bank():
        if member.name in names:
            names.remove(member.name)
            member.build(tmp_path / member.name)
            trees.append(tmp_path / member.name)
    assert not names
    (plain, before), *others = cost("8a,8b", *trees)
    for memory, seconds in others:
        assert memory - plain < 400
        assert seconds - before < 30
        before = seconds


def test_the_bounds_are_what_the_page_says():
    page = (KIT / "handouts" / "instructor" / "security.md").read_text(encoding="utf-8")
    assert f"a message of {MAX_MESSAGE >> 20} MB and" in page
    assert f"at one moment at most {MAX_PRESENT} bodies" in page
    assert f"at most {MAX_STATES:,} steps or frames, and at most {MAX_ITEMS:,} entries" in page
    assert f"at most {MAX_TRIED:,} of its bindings" in page
    assert f"{MAX_SOURCE >> 10} KB" in page and f"{MAX_READ >> 20} MB of sources" in page
