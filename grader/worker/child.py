"""Run one child: confine it, import the submission, answer requests until the judge hangs up.

Each request has a number and gets exactly one answer. An exception of the submission is an answer
as well, so this loop ends only with the channel or the process.
"""

import inspect
import os
import py_compile
import sys
import tempfile
from collections.abc import Collection
from contextlib import suppress
from pathlib import Path
from typing import Any

import msgspec
import pygame.sysfont

from grader.protocol import (
    ENVIRONMENT,
    MAX_TEXT,
    Answered,
    Asked,
    Call,
    Channel,
    ChannelClosed,
    ChildSetup,
    Get,
    Import,
    Integrate,
    Limits,
    MakeBody,
    MakeWorld,
    Missing,
    Play,
    ProtocolError,
    Ready,
    Record,
    Remembered,
    Reply,
    Request,
    Returned,
    Set,
    Simulate,
    WithMoments,
    cut,
)
from grader.worker.confinement import confine
from grader.worker.filter import refuse_system_calls
from grader.worker.frame import Frame
from grader.worker.imports import ImportRule
from grader.worker.lines import LineCounter
from grader.worker.memory import Memory
from grader.worker.output import Output
from grader.worker.play import call_stepping, play, simulate
from grader.worker.recorder import Recorder
from grader.worker.scripted import ScriptedClock, shift_seeds
from grader.worker.subject import ContractError, Subject, refs_in

pygame.sysfont.initsysfonts = lambda: None  # it would start fc-list; the default font serves

decoder = msgspec.msgpack.Decoder(Asked)


def serve(channel: Channel, setup: ChildSetup, without: Collection[str] = ()) -> None:
    """Answer until the judge closes the channel. Whatever the submission raises is an answer.

    Rights are given up and clocks replaced before the submission is imported: later, its top level
    would have run with the grader's rights and kept the real clock. `without` names layers that are
    left out, to see what the others hold.
    """
    name = Path(setup.submission).name
    layers, setup = confine(setup, without)
    tidy_environment(setup.scratch)
    folder = Path(setup.scratch, name)
    files = own_copy(setup.submission, str(folder), setup)
    sys.dont_write_bytecode = True
    if setup.confine and "system-calls" not in without:
        layers += refuse_system_calls()  # last: what came before needs some of them
    channel.send(Ready(os.getpid(), layers))
    if setup.compiles:
        compile_all(Path(setup.submission), Path(setup.bytecode), setup.limits)
        return  # it has never seen a line of the submission run, and never will
    os.chdir(folder)  # as a program is started: in the folder it is in
    output, clock = Output(), ScriptedClock()
    output.install()
    clock.install()
    ImportRule(files, setup.bans).install()
    subject = Subject(folder)
    recorder = Recorder(subject)
    while True:
        try:
            asked = decoder.decode(channel.receive())
        except ChannelClosed:
            return
        send(channel, answer_asked(subject, clock, output, recorder, asked))


def answer_asked(
    subject: Subject, clock: ScriptedClock, output: Output, recorder: Recorder, asked: Asked
) -> Answered:
    """Return the one answer to a request, with what the submission printed."""
    reply: Reply | WithMoments
    match asked.request:
        case Record(request) as recording:
            recorder.start(recording)
            requests = [*asked.first, request]
            reply = recorder.finish(attempt(subject, clock, output, recorder, requests))
        case request:
            requests = [*asked.first, request]
            reply = attempt(subject, clock, output, recorder, requests)
    return Answered(asked.number, reply, output.take())


def attempt(
    subject: Subject,
    clock: ScriptedClock,
    output: Output,
    recorder: Recorder,
    requests: list[Request],
) -> Reply:
    """Return the answer to the last of these requests, or what came instead of one.

    BaseException, because a submission may call sys.exit() or raise KeyboardInterrupt anywhere.
    """
    try:
        return [answer(subject, clock, output, recorder, request) for request in requests][-1]
    except ContractError as error:
        return Missing(cut(str(error), MAX_TEXT))
    except BaseException as error:
        return subject.raised(error)


def send(channel: Channel, answered: Answered) -> None:
    """Send an answer, or say why it cannot be sent: too long, or with a number too large for it."""
    try:
        channel.send(answered)
    except (ProtocolError, OverflowError, ValueError) as error:
        channel.send(Answered(answered.number, Missing(f"the answer cannot be sent: {error}")))


def answer(
    subject: Subject, clock: ScriptedClock, output: Output, recorder: Recorder, request: Request
) -> Reply:
    """Do what a request asks; raises ContractError and whatever the submission raises."""
    match request:
        case Import(module, pieces, watched, deal):
            if deal:
                shift_seeds(deal)
            subject.load(module, pieces)
            subject.memory = Memory(str(subject.folder)) if watched else None
            return Returned(None)
        case Remembered():
            names = subject.memory.changed() if subject.memory else []
            return Returned(cut(",".join(names), MAX_TEXT))
        case Call():
            return call(subject, request)
        case Get(ref, name):
            thing = subject.find(f"#{ref}.{name}") if name else subject.objects[ref]
            return Returned(subject.encode(thing))
        case Set(ref, fields):
            for name, each in fields.items():
                setattr(subject.objects[ref], name, subject.decode(each))
            return Returned(None)
        case MakeBody():
            return Returned(subject.encode(subject.called(request.ref, subject.make_body(request))))
        case MakeWorld():
            return Returned(
                subject.encode(subject.called(request.ref, subject.make_world(request)))
            )
        case Simulate():
            return simulate(subject, recorder, request)
        case Integrate(twice=True):
            frame = Frame(subject, (), [])
            answers = subject.integrate(request)
            again = subject.integrate(request)
            return Returned(answers, changed=frame.changes(), again=again)
        case Integrate():
            return Returned(subject.integrate(request))
        case Play():
            return play(subject, clock, output, recorder, request)


def call(subject: Subject, request: Call) -> Returned:
    """Call a function or method of the submission, and count its work meanwhile if asked to."""
    function = subject.find(request.target)
    args = as_many_as_taken(function, [subject.decode(each) for each in request.args])
    kwargs = {name: subject.decode(each) for name, each in request.kwargs.items()}
    if not request.work:
        looked_at = [*refs_in(request), *request.states]
        frame = Frame(subject, looked_at, args) if request.framed else None
        if request.stepping:
            returned = call_stepping(subject, args[0], lambda: function(*args, **kwargs))
        else:
            returned = Returned(subject.encode(function(*args, **kwargs)))
            if request.twice:
                again = subject.encode(function(*args, **kwargs))
                returned = msgspec.structs.replace(returned, again=again)
        changed = frame.changes() if frame else []
        states = [subject.state(ref) for ref in request.states]
        return msgspec.structs.replace(returned, changed=changed, states=states)
    with LineCounter() as counter:
        result = function(*args, **kwargs)
        if hasattr(type(result), "__next__"):  # a generator has done nothing yet
            result = list(result)
    return Returned(subject.encode(result), counter.answer())


def as_many_as_taken(function: Any, args: list[Any]) -> list[Any]:
    """Return as many arguments as a function takes: one that has no use for dt need not name it."""
    code = getattr(function, "__code__", None)
    if code is None or code.co_flags & inspect.CO_VARARGS:
        return args
    return args[: code.co_argcount - hasattr(function, "__self__")]


OLD_FILE = os.O_RDONLY | getattr(os, "O_BINARY", 0)
NEW_FILE = os.O_WRONLY | os.O_CREAT | os.O_TRUNC | getattr(os, "O_BINARY", 0)


def own_copy(submission: str, folder: str, setup: ChildSetup) -> list[str]:
    """Return the submission once more, for this child alone, and the names of its files.

    It may write there, and it ends with it. Files keep their times, by which Python knows whether
    what was compiled before is still good. What is only to be read is a link to where it is now.

    By the system's own calls: every child does this for every file, and needs the time for little
    else. Each reads it anew: what the process that forks them had read of one submission, a child
    of the next one would find in its memory.
    """
    found: list[str] = []
    waiting = [""]
    while waiting:
        inside = waiting.pop()
        own = not inside.startswith(tuple(f"{each}/" for each in setup.shown))
        here, target = os.path.join(submission, inside), os.path.join(folder, inside)
        if own:
            make_folder(target, os.path.join(setup.bytecode, inside))
        with os.scandir(here) as entries:
            for entry in sorted(entries, key=lambda each: each.name):
                name = inside + entry.name
                if entry.is_dir(follow_symlinks=False):
                    waiting.append(f"{name}/")
                    continue
                found.append(name)
                if own:
                    with suppress(OSError):  # more than a child may have: to be missed
                        copy(entry, os.path.join(folder, name))
    for name in setup.shown:
        os.symlink(os.path.join(submission, name), os.path.join(folder, name))
    return found


def make_folder(target: str, compiled: str) -> None:
    """Make a folder of a child's copy, and in it a link to its compiled files."""
    with suppress(OSError):  # more than a child may have, or Windows may not allow links
        os.mkdir(target)
        if os.path.isdir(compiled):
            os.symlink(compiled, os.path.join(target, "__pycache__"), target_is_directory=True)


def copy(entry: "os.DirEntry[str]", target: str) -> None:
    about = entry.stat(follow_symlinks=False)
    source = os.open(entry.path, OLD_FILE)
    try:
        data = os.read(source, about.st_size)
    finally:
        os.close(source)
    descriptor = os.open(target, NEW_FILE, 0o666)
    try:
        os.write(descriptor, data)
    finally:
        os.close(descriptor)
    os.utime(target, ns=(about.st_mtime_ns, about.st_mtime_ns))


def compile_all(submission: Path, bytecode: Path, limits: Limits) -> None:
    """Fill the folder of compiled files, which all other children only read.

    No line of the submission runs here. What cannot be compiled is left for the child that imports
    it, to say why; what lies deep is left when the folder is full or the time is over.
    """
    size = 0
    sources = sorted(submission.rglob("*.py"), key=lambda path: (len(path.parts), path))
    for source in sources[: limits.scratch_files]:
        inside = source.relative_to(submission)
        target = bytecode / inside.parent / f"{source.stem}.{sys.implementation.cache_tag}.pyc"
        with suppress(py_compile.PyCompileError, OSError, ValueError, MemoryError):
            py_compile.compile(str(source), str(target), str(source), doraise=True)
            size += target.stat().st_size
        if size > limits.scratch_mb * 1024 * 1024:
            return


def tidy_environment(scratch: str) -> None:
    """Set an environment that says nothing about the machine, and enter an empty folder."""
    windows = ("SYSTEMROOT", "PATH") if os.name == "nt" else ()  # it finds its libraries by them
    wanted = {"PATH": os.defpath}
    wanted |= {name: os.environ[name] for name in windows if name in os.environ}
    wanted |= ENVIRONMENT | dict.fromkeys(("HOME", "TMPDIR", "TEMP", "TMP"), scratch)
    for name in set(os.environ) - set(wanted):
        del os.environ[name]
    for name in wanted:
        if os.environ.get(name) != wanted[name]:
            os.environ[name] = wanted[name]
    tempfile.tempdir = scratch
    with suppress(OSError):
        os.chdir(scratch)
