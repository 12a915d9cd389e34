"""Run a command where namespaces are forbidden, or the kernel has no Landlock, or both.

    python bare_container.py namespaces,landlock COMMAND ...

A seccomp(2) filter refuses system calls as a plain container and an old kernel do. With namespaces,
root keeps the capabilities that Docker allows.
"""

import ctypes
import errno
import os
import struct
import sys

PR_SET_SECCOMP, SECCOMP_MODE_FILTER, PR_CAPBSET_DROP, PR_SET_NO_NEW_PRIVS = 22, 2, 24, 38
LOAD, SAME, ANSWER = 0x20, 0x15, 0x06  # of the filter's machine: BPF_LD, BPF_JEQ, BPF_RET
ALLOW, REFUSE = 0x7FFF0000, 0x00050000  # SECCOMP_RET_ALLOW, SECCOMP_RET_ERRNO
REFUSED = {
    "landlock": dict.fromkeys((444, 445, 446), errno.ENOSYS),
    "namespaces": {{"x86_64": 272, "aarch64": 97}.get(os.uname().machine, -1): errno.EPERM},
}
LAST_CAPABILITY = 40
DOCKERS = {0, 1, 3, 4, 5, 6, 7, 8, 10, 13, 18, 27, 29, 31}  # see capabilities(7)


class Program(ctypes.Structure):
    _fields_ = [("length", ctypes.c_ushort), ("filter", ctypes.c_char_p)]


def instruction(code: int, value: int, otherwise: int = 0) -> bytes:
    """Return an instruction; `otherwise` is the number to skip if a comparison fails."""
    return struct.pack("HBBI", code, 0, otherwise, value)


def refuse(what: set[str]) -> None:
    libc = ctypes.CDLL(None, use_errno=True)
    text = instruction(LOAD, 0)  # the number of the call
    for each in sorted(what):
        for number, error in REFUSED[each].items():
            text += instruction(SAME, number, otherwise=1) + instruction(ANSWER, REFUSE | error)
    text += instruction(ANSWER, ALLOW)
    program = Program(len(text) // 8, text)
    if os.geteuid() != 0:
        libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    if libc.prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, ctypes.byref(program), 0, 0):
        raise OSError(ctypes.get_errno(), "the filter on system calls was not taken")
    if "namespaces" in what and os.geteuid() == 0:
        for capability in set(range(LAST_CAPABILITY + 1)) - DOCKERS:
            libc.prctl(PR_CAPBSET_DROP, capability, 0, 0, 0)


if __name__ == "__main__":
    refuse({each for each in sys.argv[1].split(",") if each})
    os.execv(sys.argv[2], sys.argv[2:])
