"""Writes answers to questions that nobody asked into every open descriptor."""

import os
import struct

try:
    from grader.protocol import Answered, Returned, Vec
    from msgspec import msgpack

    FORGED = [msgpack.encode(Answered(n, Returned(Vec(100.0, 0.0)))) for n in range(1, 50)]
except ImportError:
    FORGED = []
FORGED += [b"passed", b"{\"points\": 100}", b"\x00" * 64, b"\xff" * 64]


def forge():
    for descriptor in range(256):
        for body in FORGED:
            try:
                os.write(descriptor, struct.pack(">I", len(body)) + body)
            except OSError:
                break


def explicit_euler(x, v, dt, accel):
    return x, v


def semi_implicit_euler(x, v, dt, accel):
    forge()
    return x, v


def velocity_verlet(x, v, dt, accel):
    for descriptor in range(3, 256):
        try:
            os.write(descriptor, b"\xff\xff\xff\xff")
        except OSError:
            pass
    return x, v


def rk4(x, v, dt, accel):
    for descriptor in range(3, 256):
        try:
            os.write(descriptor, struct.pack(">I", 1000) + b"only half of")
            os.close(descriptor)
        except OSError:
            pass
    return x, v
