"""Runs a command as in a container that forbids namespaces, on a kernel without Landlock.

    python bare_container.py COMMAND ...

A filter on system calls, as of seccomp(2), refuses them as such a container and such a kernel do.
"""

import ctypes
import errno
import os
import struct
import sys

PR_SET_SECCOMP, SECCOMP_MODE_FILTER = 22, 2
LOAD, SAME, ANSWER = 0x20, 0x15, 0x06  # of the filter's machine: BPF_LD, BPF_JEQ, BPF_RET
ALLOW, REFUSE = 0x7FFF0000, 0x00050000  # SECCOMP_RET_ALLOW, SECCOMP_RET_ERRNO
LANDLOCK = (444, 445, 446)
UNSHARE = {"x86_64": 272, "aarch64": 97}


class Program(ctypes.Structure):
    _fields_ = [("length", ctypes.c_ushort), ("filter", ctypes.c_char_p)]


def instruction(code: int, value: int, otherwise: int = 0) -> bytes:
    """One of the filter; `otherwise` is how many to leave out where a comparison fails."""
    return struct.pack("HBBI", code, 0, otherwise, value)


def refuse() -> None:
    answers = dict.fromkeys(LANDLOCK, errno.ENOSYS) | {UNSHARE[os.uname().machine]: errno.EPERM}
    text = instruction(LOAD, 0)  # the number of the call
    for number, error in answers.items():
        text += instruction(SAME, number, otherwise=1) + instruction(ANSWER, REFUSE | error)
    text += instruction(ANSWER, ALLOW)
    libc = ctypes.CDLL(None, use_errno=True)
    program = Program(len(text) // 8, text)
    if libc.prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, ctypes.byref(program), 0, 0):
        raise OSError(ctypes.get_errno(), "the filter on system calls was not taken")


if __name__ == "__main__":
    refuse()
    os.execv(sys.argv[1], sys.argv[1:])
