"""Stand in for psutil in a browser tab, where there are no processes."""

STATUS_SLEEPING, STATUS_STOPPED, STATUS_TRACING_STOP = "sleeping", "stopped", "tracing-stop"


class Error(Exception):
    """Any error of psutil."""


class NoSuchProcess(Error):
    """Raised for every process."""


class Process:
    def __init__(self, pid=None):
        raise NoSuchProcess(pid)
