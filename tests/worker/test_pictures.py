"""What the window shows, frame by frame: asked for, it is seen; else next to nothing is drawn."""

from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest
from one_worker import opened

from grader.judge.lab import Lab

SHOWN = (1, 1, 2, 3, 3, 3)  # the picture of each frame
PROGRAM = f"""
import pygame

def main():
    pygame.init()
    screen, clock = pygame.display.set_mode((50, 50)), pygame.time.Clock()
    pictures, running = list({SHOWN}), True
    while running:
        clock.tick(60)
        running = not pygame.event.get(pygame.QUIT)
        screen.fill("black")
        screen.set_at((40, 40), (80 * pictures.pop(0), 0, 0)) if pictures else None
        pygame.display.flip()
    pygame.quit()
"""


@pytest.fixture
def lab(tmp_path: Path) -> Iterator[Lab]:
    (tmp_path / "pymunk_scene.py").write_text(PROGRAM, encoding="utf-8")
    with opened(tmp_path) as children, Lab("pymunk_scene", lambda: children(5), []).opened() as lab:
        yield lab


def test_a_picture_is_the_same_only_where_the_window_is(lab: Lab):
    played = lab.play([17] * (1 + len(SHOWN)), pictures=True)
    empty, *pictures = played.pictures  # the first frame ends before anything is drawn
    assert empty not in pictures
    same = [one == other for one, other in pairwise(pictures)]
    assert same == [one == other for one, other in pairwise(SHOWN)]


def test_pictures_that_nobody_asked_for_are_not_taken(lab: Lab):
    assert lab.play([17] * 3).pictures == []
