"""The warm process: has the libraries loaded, and forks one child for each check.

It never imports the submission, and it ends whatever a child left behind.
"""

import gc
import importlib
import os
import signal
import socket
import sys
import time
from contextlib import suppress

import msgspec
import psutil
import pygame
import pymunk

from grader.protocol import Channel, ChannelClosed, ChildSetup, End, Ended, Open
from grader.worker.child import serve, tidy_environment
from grader.worker.confinement import prepare_server, readable

decoder = msgspec.msgpack.Decoder(Open | End)


def main(control_fd: int) -> None:
    layers = prepare_server(keep=control_fd)
    control = Channel(socket.socket(fileno=control_fd), eager=False)
    tidy_environment("")
    warm_up()
    gc.freeze()  # what is loaded stays shared with the children
    with suppress(ChannelClosed):
        control.send(layers)
        while True:
            match decoder.decode(control.receive()):
                case Open(setup):
                    fork(control, setup)
                case End(pid, gone):
                    control.send(end(pid, gone))
    end_strays()


def warm_up() -> None:
    """Use once what every child uses, so that none has to load it by itself."""
    pygame.init()
    pygame.display.set_mode((1, 1))
    pygame.font.Font(None, 26).render("0", True, "white")
    pygame.display.flip()
    pygame.quit()
    space = pymunk.Space()
    space.add(pymunk.Body(1, 1))
    space.step(0.01)


def fork(control: Channel, setup: ChildSetup) -> None:
    _, (descriptor,), _, _ = socket.recv_fds(control.sock, 1, 1)
    readable(tuple(setup.hidden))  # listed once here, known in every child
    for library in setup.loads:
        importlib.import_module(library)
    pid = os.fork()
    if pid:
        os.close(descriptor)
        return
    try:
        control.close()
        keep_only(descriptor)
        serve(Channel(socket.socket(fileno=descriptor)), setup)
    finally:
        os._exit(0)


def keep_only(descriptor: int) -> None:
    """Standard input, output and error lead nowhere; everything else but the channel is shut."""
    nowhere = os.open(os.devnull, os.O_RDWR)
    for standard in (0, 1, 2):
        os.dup2(nowhere, standard)
    os.closerange(3, descriptor)
    os.closerange(descriptor + 1, 256)


def end(pid: int, gone: bool) -> Ended:
    if gone:
        wait_for_exit(pid)
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(pid, signal.SIGKILL)
    with suppress(ProcessLookupError):
        os.kill(pid, signal.SIGKILL)
    try:
        _, status = os.waitpid(pid, 0)
    except ChildProcessError:
        status = 0
    strays = end_strays()
    if os.WIFSIGNALED(status):
        return Ended("signal", os.WTERMSIG(status), strays)
    return Ended("exit", os.waitstatus_to_exitcode(status), strays)


def wait_for_exit(pid: int) -> None:
    for _ in range(100):
        with suppress(ChildProcessError):
            if os.waitid(os.P_PID, pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None:
                time.sleep(0.002)
                continue
        return


def end_strays() -> int:
    """Kill every process that a child started and left behind; returns how many there were."""
    ended = set()
    while has_children():
        for stray in strays():
            with suppress(ProcessLookupError):
                os.kill(stray, signal.SIGKILL)
        with suppress(ChildProcessError):
            ended.add(os.wait()[0])
    return len(ended)


def strays() -> list[int]:
    """Whom to kill: all, where a namespace holds nobody else, or else all descendants."""
    if os.getpid() == 1:
        return [-1]
    return [process.pid for process in psutil.Process().children(recursive=True)]


def has_children() -> bool:
    """Whether anything is left: orphans come back to this process, which adopts them."""
    try:
        os.waitpid(-1, os.WNOHANG)
    except ChildProcessError:
        return False
    return True


if __name__ == "__main__":
    main(int(sys.argv[1]))
    os._exit(0)  # the judge waits for the end: nothing here needs to be put away
