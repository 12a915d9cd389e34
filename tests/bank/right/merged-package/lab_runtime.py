"""How many frames a lab program may run. Nothing to do here.

For a person there is no limit. A checker sets the environment variable LAB_FRAMES.
"""

import math
import os

frames_left = None  # None: LAB_FRAMES has not been read yet


def frame_budget():
    """True while there is a frame left to run. Raises ValueError when LAB_FRAMES is no count."""
    global frames_left
    if frames_left is None:
        frames_left = read_lab_frames()
    frames_left -= 1
    return frames_left >= 0


def read_lab_frames():
    """The number of frames in LAB_FRAMES, or infinity when it is not set."""
    text = os.environ.get("LAB_FRAMES", "")
    if text == "":
        return math.inf
    if not text.isdecimal():
        raise ValueError(f"LAB_FRAMES is {text!r}, but it must be a whole number of frames.")
    return int(text)
