"""Start a child as a new process where there is no fork: same answers, but slower.

The first argument is the descriptor of its channel; the others name layers to leave out. The first
message on the channel is its ChildSetup.
"""

import socket
import sys

import msgspec

from grader.protocol import Channel, ChildSetup
from grader.worker.child import serve
from grader.worker.confinement import wipe_variables


def connect() -> Channel:
    """Return the judge's channel: a descriptor, or on Windows a share on standard input."""
    if sys.platform == "win32":
        return Channel(socket.fromshare(sys.stdin.buffer.read()))
    return Channel(socket.socket(fileno=int(sys.argv[1])))


if __name__ == "__main__":
    wipe_variables()
    channel = connect()
    serve(channel, msgspec.msgpack.decode(channel.receive(), type=ChildSetup), sys.argv[2:])
