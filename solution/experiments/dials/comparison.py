"""One to three engines side by side, with the same scene, the same hand and the same dials."""

import pygame

from ..engines import ENGINES
from .hand import Hand, new_ball
from .show import Show

MOST = 3
OF_ONE = {pygame.K_TAB, pygame.K_1, pygame.K_2, pygame.K_3, pygame.K_4}  # keys for the first engine


class Comparison:
    """The shows of a scene; the panel describes the first."""

    def __init__(self, scene="lab", engine="stable"):
        self.shows = [Show(scene, engine)]
        self.hand = Hand()
        self.shows[0].hand = self.hand
        self.contacts = self.strips = False  # whether they are drawn

    @property
    def first(self):
        return self.shows[0]

    def advance(self, seconds):
        for show in self.shows:
            show.advance(seconds)

    def press(self, key, shift=False):
        """Press a key in every engine that is shown."""
        if key == pygame.K_v:
            self.put_beside()
        elif key == pygame.K_x:
            self.contacts = not self.contacts
        elif key == pygame.K_t:
            self.strips = not self.strips
        elif key in OF_ONE:
            self.first.press(key, shift)
            self.begin_together()
        else:
            for show in self.shows:
                show.press(key, shift)

    def put_beside(self):
        """Show one more engine, up to three; then the first one alone again."""
        shown = [show.engine_name for show in self.shows]
        others = [name for name in ENGINES if name not in shown]
        if len(self.shows) == MOST or not others:
            self.shows = self.shows[:1]
            return
        first = self.first
        show = Show(first.scene_name, others[0])
        show.dt, show.rate, show.paused, show.hand = first.dt, first.rate, first.paused, self.hand
        show.chosen = first.chosen
        self.shows.append(show)
        self.begin_together()

    def begin_together(self):
        """Start the scene again, in a different engine in each show."""
        if len(self.shows) == 1:
            return
        shown = [self.first.engine_name]
        for show in self.shows[1:]:
            if show.engine_name in shown:
                show.engine_name = next(name for name in ENGINES if name not in shown)
            shown.append(show.engine_name)
        self.hand.let_go()
        for show in self.shows:
            show.start()

    def take(self, show, at):
        """Pick up the ball at a position in one of the shows, or drop a new one."""
        if not self.hand.take(show.engine, at):
            for each in self.shows:
                each.drop(new_ball(at))
