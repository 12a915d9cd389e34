"""The exception that pygame raises."""


class error(RuntimeError):  # noqa: N801 (its name in pygame)
    """Raised if pygame cannot do what a program asks for."""


error.__module__ = "pygame"
