"""Test messages: strictly typed data arrives as it was sent, all else is an error."""

import socket

import msgspec
import pytest

from grader.protocol import (
    MAX_MESSAGE,
    Answered,
    BodyValue,
    Channel,
    ChannelClosed,
    ChannelTimeout,
    ProtocolError,
    Returned,
    Vec,
)

decoder = msgspec.msgpack.Decoder(Answered)


@pytest.fixture
def ends():
    ours, theirs = socket.socketpair()
    yield Channel(ours), Channel(theirs)
    ours.close()
    theirs.close()


def test_a_message_arrives_as_it_was_sent(ends):
    ours, theirs = ends
    theirs.send(Answered(7, Returned(Vec(0.1, -2.5)), "printed"))
    assert decoder.decode(ours.receive(1)) == Answered(7, Returned(Vec(0.1, -2.5)), "printed")


def test_a_message_that_does_not_arrive_is_an_error(ends):
    ours, theirs = ends
    with pytest.raises(ChannelTimeout):
        ours.receive(0.01)
    theirs.sock.sendall(b"\x00\x00\x00\x10abc")
    theirs.close()
    with pytest.raises(ChannelClosed):
        ours.receive(1)


def test_a_message_too_long_is_neither_sent_nor_read(ends):
    ours, theirs = ends
    with pytest.raises(ProtocolError):
        ours.send("x" * (MAX_MESSAGE + 1))
    theirs.sock.sendall((MAX_MESSAGE + 1).to_bytes(4, "big"))
    assert ours.complete(0)
    with pytest.raises(ProtocolError):
        ours.receive(1)


def test_sending_does_not_wait_for_the_reader(ends):
    ours, theirs = ends
    ours.post("x" * (MAX_MESSAGE // 2))
    assert not ours.flush(0.01)
    assert not theirs.complete(0) and not ours.flush(0.01), "only what was read makes room"
    while not ours.flush(0):
        theirs.complete(0)
    assert theirs.complete(1) and len(theirs.receive(0)) > MAX_MESSAGE // 2


def test_half_an_answer_is_none_yet(ends):
    ours, theirs = ends
    theirs.sock.sendall(b"\x00\x00")
    assert not ours.complete(0.01)
    theirs.sock.sendall(b"\x00\x03ab")
    assert ours.wait(0) and not ours.complete(0.01)
    theirs.sock.sendall(b"c")
    assert ours.complete(0) and ours.receive(0) == b"abc"


BODY = BodyValue(1, Vec(0, 0), Vec(0, 0), 0.0, 0.0, 1.0, 1.0, 10.0)


@pytest.mark.parametrize(
    ("field", "value"),
    [("angle", True), ("angle", "0.5"), ("angle", None), ("angle", [1.0]), ("ref", 1.5)],
)
def test_no_bool_text_or_list_passes_for_a_number(field: str, value: object):
    raw = msgspec.msgpack.decode(msgspec.msgpack.encode(Answered(1, Returned(BODY))))
    raw["reply"]["value"][field] = value
    with pytest.raises(msgspec.ValidationError):
        decoder.decode(msgspec.msgpack.encode(raw))
