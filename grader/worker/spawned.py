"""Start a child as a new process where there is no fork: the same answers, only slower.

The first argument is the descriptor of its channel, the others name layers that are left out.
The first message on its channel is the ChildSetup that a forked child gets from the warm process.
"""

import socket
import sys

import msgspec

from grader.protocol import Channel, ChildSetup
from grader.worker.child import serve
from grader.worker.confinement import wipe_variables


def connect() -> Channel:
    """Return the channel the judge handed over: a descriptor, or on Windows a share on standard
    input.
    """
    if sys.platform == "win32":
        return Channel(socket.fromshare(sys.stdin.buffer.read()))
    return Channel(socket.socket(fileno=int(sys.argv[1])))


if __name__ == "__main__":
    wipe_variables()
    channel = connect()
    serve(channel, msgspec.msgpack.decode(channel.receive(), type=ChildSetup), sys.argv[2:])
