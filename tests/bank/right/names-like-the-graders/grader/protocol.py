"""Not the grader's."""


class Channel:
    def __init__(self, sock):
        raise RuntimeError("this is not the grader's channel")
