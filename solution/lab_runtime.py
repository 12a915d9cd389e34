"""Count the frames that a lab program may run, and pause it. Nothing to do here.

For a person there is no limit of frames. A checker sets the environment variable LAB_FRAMES.
"""

import math
import os

import pygame

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


def pause(one_step, draw):
    """Hold the program still until Space is pressed again; each N calls one_step().

    draw() shows the scene. Closing the window ends the pause, and then the program.
    """
    while True:
        draw()
        event = pygame.event.wait()
        key = event.key if event.type == pygame.KEYDOWN else None
        if key == pygame.K_n:
            one_step()
        elif event.type == pygame.QUIT:
            pygame.event.post(event)  # the program's own loop reads it again
        if key == pygame.K_SPACE or event.type == pygame.QUIT:
            return
