"""The exception that pygame raises."""


class error(RuntimeError):  # noqa: N801 (its name in pygame)
    """Raised where pygame cannot do what it is asked for."""


error.__module__ = "pygame"
