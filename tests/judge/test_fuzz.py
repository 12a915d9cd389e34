"""Send spoilt messages to the judge: each ends in an answer or in words."""

import random
import socket
import struct
import threading
from collections import Counter
from contextlib import suppress
from itertools import count

import msgspec
import pytest
from one_worker import NoWorker

from grader.judge.failures import Broke, NotYet
from grader.judge.lab import Lab
from grader.judge.wall.children import Child
from grader.protocol import (
    Answered,
    BodyValue,
    Channel,
    ChannelClosed,
    ContactValue,
    Items,
    Missing,
    Played,
    Raised,
    Ready,
    Ref,
    Returned,
    Simulated,
    Vec,
)

VALUES = [
    None,
    1.5,
    "text",
    Vec(1.0, 2.0),
    Ref(3, "World"),
    Items([1.0, Vec(0.0, 1.0)]),
    Items([Vec(0.0, 1.0)] * 3),
    BodyValue(1, Vec(0, 0), Vec(0, 0), 0.0, 0.0, 1.0, 1.0, 10.0),
    ContactValue(1, 2, 3, Vec(0, 1), 0.5, Vec(0, 0), 0.0, 0.0),
]
REPLIES = [
    *(Returned(value) for value in VALUES),
    Raised("ValueError", "no", []),
    Missing("there is no World"),
    Simulated([[0.0] * 6] * 3, []),
    Played([1], [16.0], [1 / 120], "returned", ["Fixed steps: 1"], [], [], [], b""),
]
ODD = [
    *(None, True, False, 0, -1, 2**63, -(2**63), 2**64 - 1, 10**15),
    *(float("nan"), float("inf"), -float("inf"), 1e308, 5e-324, -0.0),
    *(
        "",
        "x" * 10_000,
        "\x1b[2J",
        "::error::",
        "\ud7ff",
        b"",
        b"\xff" * 50,
        [],
        [[]],
        {},
        {"type": "vec"},
    ),
]


def spoil(rng: random.Random, thing: object) -> object:
    """Replace, double or drop one part of a message."""
    if isinstance(thing, dict) and thing and rng.random() < 0.9:
        key = rng.choice(list(thing))
        if rng.random() < 0.15:
            return {name: value for name, value in thing.items() if name != key}
        return thing | {key: spoil(rng, thing[key])}
    if isinstance(thing, list) and thing and rng.random() < 0.9:
        at = rng.randrange(len(thing))
        if rng.random() < 0.3:
            return thing[:at] + thing[at + rng.randint(0, 1) :] * rng.randint(1, 3)
        return [*thing[:at], spoil(rng, thing[at]), *thing[at + 1 :]]
    return rng.choice(ODD)


def message(rng: random.Random, number: int) -> tuple[bytes, bool]:
    """Return bytes instead of a child's answer, and whether their frame is complete."""
    answered = Answered(number, rng.choice(REPLIES), rng.choice(["", "printed"]))
    body = msgspec.msgpack.encode(answered)
    kind = rng.choice(
        ["spoilt", "spoilt", "bits", "noise", "late", "cut", "sound", "twice", "long"]
    )
    if kind == "spoilt":
        plain = msgspec.msgpack.decode(body)
        for _ in range(rng.randint(1, 3)):
            plain = spoil(rng, plain)
        body = msgspec.msgpack.encode(plain)
    elif kind == "bits":
        bits = bytearray(body)
        for _ in range(rng.randint(1, 4)):
            bits[rng.randrange(len(bits))] ^= 1 << rng.randrange(8)
        body = bytes(bits)
    elif kind == "noise":
        body = rng.randbytes(rng.randint(0, 60))
    elif kind == "late":
        body = msgspec.msgpack.encode(Answered(number + rng.choice([-1, 1, 7]), answered.reply))
    framed = struct.pack(">I", len(body)) + body
    if kind == "cut":
        return framed[: rng.randrange(len(framed))], False
    if kind == "long":
        return struct.pack(">I", rng.choice([len(body) + 1, 2**23 + 1, 2**32 - 1])) + body, False
    return framed * (1 + (kind == "twice")), True


def misbehave(sock: socket.socket, rng: random.Random) -> None:
    """Answer the first question well, and the others with spoilt messages."""
    channel = Channel(sock)
    channel.send(Ready(1, []))
    with suppress(ChannelClosed, OSError):
        channel.receive()
        channel.send(Answered(1, Returned("")))
        for number in count(2):
            channel.receive()
            data, whole = message(rng, number)
            sock.sendall(data)
            if not whole:
                sock.shutdown(socket.SHUT_WR)


def ask(lab: Lab, rng: random.Random) -> None:
    """Ask one question in any of the ways that a check has."""
    thing = lab.thing(Ref(1))
    rng.choice(
        [
            lambda: lab.number(lab.call("f", 1.0), "f"),
            lambda: lab.pair(lab.call("f", (1.0, 2.0)), "f"),
            lambda: lab.items(lab.call("f"), "f"),
            lambda: lab.contact_or_none(lab.call("f")),
            lambda: lab.state(thing),
            lambda: lab.simulate(thing, [thing], 3),
            lambda: lab.play([16]),
            lambda: lab.circle((0.0, 0.0)),
            lambda: lab.space(lab.call("f")),
        ]
    )()


def survive(messages: int, seed: int) -> Counter[str]:
    """Send spoilt messages to a lab; count how its questions ended."""
    rng = random.Random(seed)
    ended: Counter[str] = Counter()
    while ended.total() < messages:
        ours, theirs = socket.socketpair()
        liar = threading.Thread(target=misbehave, args=(theirs, random.Random(rng.random())))
        liar.start()
        child = Child(Channel(ours), NoWorker(), 1)
        lab = Lab("mini_engine", lambda child=child: child, [])
        lab.probe()
        while not child.over:
            try:
                ask(lab, rng)
                ended["answered"] += 1
            except NotYet:
                ended["refused"] += 1
            except Broke as failure:
                ended["raised" if failure.raised else "ended the child"] += 1
        liar.join()
        theirs.close()
    return ended


@pytest.mark.parametrize("messages", [1_500, pytest.param(100_000, marks=pytest.mark.soak)])
def test_the_judge_survives_spoilt_messages(messages: int):
    ended = survive(messages, seed=1)
    print(f"{ended.total()} messages: {dict(ended)}")
    assert min(ended[how] for how in ("answered", "refused", "raised", "ended the child")) > 20
