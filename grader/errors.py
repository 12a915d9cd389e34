"""End a command: the one exception that carries a sentence and an exit status."""


class Stop(Exception):
    """The end of a command; the message says what is wrong, with its value, and what to do."""

    status = 2  # the exit status of the command
    cannot = "go on"  # what it could not do, said before the message
