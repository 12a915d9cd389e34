"""Run the warm process: a fork server that has the libraries loaded and forks a child per check.

It never imports the submission, so one check leaves nothing behind for the next. It is the parent
of all children and ends every process that they leave running. The judge sends it Open and End
through `control`; requests go to each child over a socket of its own. For checks side by side, the
process that has loaded forks several such servers, each with its own channel.
"""

import ctypes
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
from grader.worker.confinement import isolate_server, prepare, wipe_variables, write
from grader.worker.imports import hide_modules, unhidden_modules

YOUNG = 10_000  # new objects before a child collects garbage; most children end earlier
MOST_DESCRIPTORS = 4096  # more than this process ever opens; some machines allow a billion

decoder = msgspec.msgpack.Decoder(Open | End)


def main(descriptors: list[int], without: list[str]) -> None:
    """Load what children need, and serve the judge on each of these control channels.

    `without` names layers to leave out, here and in the children.
    """
    wipe_variables()
    tidy_environment("")
    warm_up()
    hide_modules()
    gc.freeze()  # what is loaded stays shared with the children
    if len(descriptors) == 1:
        serve_judge(descriptors[0], without)
        return
    for descriptor in descriptors:
        if not os.fork():
            for other in set(descriptors) - {descriptor}:
                os.close(other)
            serve_judge(descriptor, without)
            return
    for descriptor in descriptors:
        os.close(descriptor)
    wait_for_children()


def wait_for_children() -> None:
    """Wait until all children have ended, also those that ended before."""
    with suppress(ChildProcessError):
        while True:
            os.wait()


def serve_judge(control_fd: int, without: list[str]) -> None:
    """Fork and end children, until the judge closes this control channel.

    The first message has the number of this process and names the layers of isolation around all
    children.
    """
    pid = os.getpid()
    layers = isolate_server(control_fd, without)
    control = Channel(socket.socket(fileno=control_fd), eager=False)
    with suppress(ChannelClosed):
        control.send((pid, layers))
        while True:
            match decoder.decode(control.receive()):
                case Open(setup):
                    fork(control, setup, without)
                case End(pid, gone):
                    control.send(end(pid, gone))
    end_strays()


def warm_up() -> None:
    """Use everything once that children use, so that no child has to load it.

    SDL looks for joysticks in each frame. A child may not ask the kernel for them, so SDL would
    load libudev in every frame (0.1 ms) unless it is loaded already.
    """
    with suppress(OSError):  # not on every machine; then SDL does not find it either
        ctypes.CDLL("libudev.so.1")
    pygame.init()
    pygame.display.set_mode((1, 1))
    pygame.font.Font(None, 26).render("0", True, "white")
    pygame.display.flip()
    pygame.quit()
    space = pymunk.Space()
    space.add(pymunk.Body(1, 1))
    space.step(0.01)


def fork(control: Channel, setup: ChildSetup, without: list[str]) -> None:
    """Fork a child; the file descriptor of its channel follows the message.

    The child never returns from here: it must not run the server's loop.
    """
    _, (descriptor,), _, _ = socket.recv_fds(control.sock, 1, 1)
    prepare(setup, without)
    for library in setup.loads:
        importlib.import_module(library)
        gc.freeze()
    reset_numbers()
    pid = os.fork()
    if pid:
        os.close(descriptor)
        return
    try:
        gc.set_threshold(YOUNG)
        control.close()
        close_other_descriptors(descriptor)
        serve(Channel(socket.socket(fileno=descriptor)), setup, without)
    finally:
        os._exit(0)


def reset_numbers() -> None:
    """Give the next child the lowest free number in our PID namespace.

    Threads are numbered too: a child's number would tell how many threads the last child started.
    """
    if os.getpid() == 1:
        with suppress(OSError):
            write("/proc/sys/kernel/ns_last_pid", "1")


def close_other_descriptors(descriptor: int) -> None:
    """Close every inherited descriptor but the child's channel.

    A submission could command the server through the control socket. Standard input, output and
    error lead to /dev/null, so that the C library cannot write to the judge's terminal either.
    """
    null = os.open(os.devnull, os.O_RDWR)
    for standard in (0, 1, 2):
        os.dup2(null, standard)
    os.closerange(3, descriptor)
    os.closerange(descriptor + 1, MOST_DESCRIPTORS)


def end(pid: int, gone: bool) -> Ended:
    """End a child and all that it started; return its exit status.

    Its process group is killed first; end_strays finds the other processes. With `gone` the child
    is ending already, and gets a moment to do so: students are told its exit status or signal.
    """
    if gone:
        wait_for_exit(pid)
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(pid, signal.SIGKILL)
    with suppress(ProcessLookupError):
        os.kill(pid, signal.SIGKILL)
    status, cpu = 0, 0.0
    with suppress(ChildProcessError):
        _, status, used = os.wait4(pid, 0)
        cpu = used.ru_utime + used.ru_stime
    end_strays()
    return Ended(os.waitstatus_to_exitcode(status), cpu)


def wait_for_exit(pid: int) -> None:
    """Wait about 0.2 s for a process to end; leave its status to be read."""
    for _ in range(100):
        with suppress(ChildProcessError):
            if os.waitid(os.P_PID, pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None:
                time.sleep(0.002)
                continue
        return


def end_strays() -> None:
    """Kill every process that a child started and left behind."""
    while has_children():
        for stray in stray_pids():
            with suppress(ProcessLookupError):
                os.kill(stray, signal.SIGKILL)
        with suppress(ChildProcessError):
            os.wait()


def stray_pids() -> list[int]:
    """Return the processes to kill: all (-1) in a PID namespace of ours, else all descendants."""
    if os.getpid() == 1:
        return [-1]
    with unhidden_modules():
        return [process.pid for process in psutil.Process().children(recursive=True)]


def has_children() -> bool:
    """Return whether any process is left; orphans become our children (see isolate_server)."""
    try:
        os.waitpid(-1, os.WNOHANG)
    except ChildProcessError:
        return False
    return True


if __name__ == "__main__":
    main([int(each) for each in sys.argv[1].split(",")], sys.argv[2:])
    os._exit(0)  # the judge waits for the end: skip Python's clean-up
