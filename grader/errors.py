"""End a command by an exception with a sentence and an exit status; put others into words."""


class Stop(Exception):
    """The end of a command; the message says what is wrong, with its value, and what to do."""

    status = 2  # the exit status of the command
    cannot = "go on"  # what it could not do, said before the message


def say_error(error: BaseException) -> str:
    """Return an error's words without the paths of this machine, which its reader need not know."""
    return (isinstance(error, OSError) and error.strerror) or str(error)
