"""Run one child: confine it, import the submission, answer requests until the judge hangs up.

Each request has a number and gets exactly one answer. An exception of the submission is an answer
too, so this loop ends only with the channel or the process.
"""

import inspect
import os
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
    BodyValue,
    Call,
    Channel,
    ChannelClosed,
    ChildSetup,
    ContactValue,
    Get,
    Import,
    Integrate,
    MakeBody,
    MakeWorld,
    Missing,
    Play,
    ProtocolError,
    Ready,
    Record,
    Ref,
    Remembered,
    Reply,
    Request,
    Returned,
    Set,
    Simulate,
    SpaceBody,
    SpaceValue,
    cut,
)
from grader.worker.confinement import confine
from grader.worker.copies import compile_all, copy_submission
from grader.worker.filter import refuse_system_calls
from grader.worker.frame import Frame
from grader.worker.lines import LineCounter
from grader.worker.memory import Memory
from grader.worker.play import call_stepping, play, simulate
from grader.worker.scripted import shift_seeds
from grader.worker.session import Session
from grader.worker.subject import Subject, refs_in
from grader.worker.values import ContractError, describe

pygame.sysfont.initsysfonts = lambda: None  # this would start fc-list; the default font is enough

OBJECTS = (Ref, BodyValue, ContactValue, SpaceValue, SpaceBody)

decoder = msgspec.msgpack.Decoder(list[Asked])


def serve(channel: Channel, setup: ChildSetup, without: Collection[str] = ()) -> None:
    """Answer until the judge closes the channel; `without` names layers to leave out.

    The child gives up its rights before it imports the submission, whose top level would
    otherwise run with them.
    """
    name = Path(setup.submission).name
    layers, setup = confine(setup, without)
    tidy_environment(setup.scratch)
    folder = Path(setup.scratch, name)
    files = copy_submission(setup, str(folder))
    sys.dont_write_bytecode = True
    if setup.confine and "system-calls" not in without:
        layers += refuse_system_calls()  # last: the layers above need some of these calls
    channel.send(Ready(os.getpid(), layers))
    if setup.compiles:
        compile_all(setup)
        return  # this child never runs a line of the submission
    os.chdir(folder)  # the folder in which a program is started
    session = Session(folder, files, setup.bans)
    with suppress(ChannelClosed):
        while True:
            for asked in decoder.decode(channel.receive()):
                send(channel, answer(session, asked))


def answer(session: Session, asked: Asked) -> Answered:
    """Return the one answer to a request, with what the submission printed."""
    request, recorder = asked.request, session.recorder
    if isinstance(request, Record):
        recorder.start(request)
        reply = recorder.finish(attempt(session, [*asked.first, request.request]))
        return Answered(asked.number, reply, session.output.take())
    return Answered(asked.number, attempt(session, [*asked.first, request]), session.output.take())


def attempt(session: Session, requests: list[Request]) -> Reply:
    """Return the answer to the last of these requests, or to the first that fails.

    Catches BaseException: a submission may call sys.exit() or raise KeyboardInterrupt anywhere.
    """
    try:
        return [perform(session, request) for request in requests][-1]
    except ContractError as error:
        return Missing(cut(str(error), MAX_TEXT))
    except BaseException as error:
        return session.subject.raised(error)


def send(channel: Channel, answered: Answered) -> None:
    """Send an answer, or the reason why it cannot be sent: too long, or a number too large."""
    try:
        channel.send(answered)
    except (ProtocolError, OverflowError, ValueError) as error:
        channel.send(Answered(answered.number, Missing(f"the answer cannot be sent: {error}")))


def perform(session: Session, request: Request) -> Reply:
    """Perform a request. Raises ContractError, and any exception of the submission."""
    subject = session.subject
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
        case MakeBody(ref):
            return Returned(subject.number(ref, subject.make_body(request)))
        case MakeWorld(ref):
            return Returned(subject.number(ref, subject.make_world(request)))
        case Simulate():
            return simulate(subject, session.recorder, request)
        case Integrate(twice=True):
            frame = Frame(subject, (), [])
            answers, again = subject.integrate(request), subject.integrate(request)
            return Returned(answers, changed=frame.changes(), again=again)
        case Integrate():
            return Returned(subject.integrate(request))
        case Play():
            return play(session, request)


def call(subject: Subject, request: Call) -> Returned:
    """Call a function or method of the submission, and observe the requested values."""
    function = subject.find(request.target)
    args = trim_arguments(function, [subject.decode(each) for each in request.args])
    kwargs = {name: subject.decode(each) for name, each in request.kwargs.items()}
    if request.work:
        with LineCounter() as counter:
            result = function(*args, **kwargs)
            if hasattr(type(result), "__next__"):  # a generator has done nothing yet
                result = list(result)
        return Returned(subject.encode(result), counter.answer())
    refs = [*refs_in(request), *request.states]
    frame = Frame(subject, refs, args) if request.framed else None
    if request.stepping:
        returned = call_stepping(subject, args[0], lambda: function(*args, **kwargs))
    else:
        result = function(*args, **kwargs)
        if request.ref and not isinstance(subject.number(request.ref, result), OBJECTS):
            raise ContractError(f"{request.target.rpartition(':')[2]} returned {describe(result)}")
        returned = Returned(subject.encode(result))
        if request.twice:
            again = subject.encode(function(*args, **kwargs))
            returned = msgspec.structs.replace(returned, again=again)
        if isinstance(returned.value, ContactValue):
            for name, value in request.marks.items():
                setattr(result, name, value)
    changed = frame.changes() if frame else []
    states = [subject.state(ref) for ref in request.states]
    return msgspec.structs.replace(returned, changed=changed, states=states)


def trim_arguments(function: Any, args: list[Any]) -> list[Any]:
    """Return as many arguments as a function takes: it may omit an unused dt."""
    code = getattr(function, "__code__", None)
    if code is None or code.co_flags & inspect.CO_VARARGS:
        return args
    return args[: code.co_argcount - hasattr(function, "__self__")]


def tidy_environment(scratch: str) -> None:
    """Set an environment that says nothing about the machine, and enter an empty folder."""
    windows = ("SYSTEMROOT", "PATH") if os.name == "nt" else ()  # to find Python's libraries
    wanted = {"PATH": os.defpath}
    wanted |= {name: os.environ[name] for name in windows if name in os.environ}
    wanted |= ENVIRONMENT | dict.fromkeys(("HOME", "TMPDIR", "TEMP", "TMP"), scratch)
    for name in set(os.environ) - set(wanted):
        del os.environ[name]
    os.environ.update(wanted)
    tempfile.tempdir = scratch
    with suppress(OSError):
        os.chdir(scratch)
