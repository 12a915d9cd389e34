"""There is always time for one more frame."""


def frame_budget():
    return True
