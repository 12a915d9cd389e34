"""Define the exception that ends a command, and word other exceptions."""


class Stop(Exception):
    """The end of a command; the message says what is wrong, with its value, and what to do."""

    status = 2  # the exit status of the command
    cannot = "go on"  # words for the message: it cannot ...


def say_error(error: BaseException) -> str:
    """Return an error's words without the paths of this machine."""
    return (isinstance(error, OSError) and error.strerror) or str(error)
