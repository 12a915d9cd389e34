"""The world of the bonus tasks: a World with more in some of its stages. Nothing to do here."""

from contextlib import contextmanager

from pygame import Vector2

from ..body import Body
from ..world import World
from .broad_phase import near_pairs
from .sleeping import update_sleep


class BonusWorld(World):
    """A world in which springs pull, bodies may sleep, and a grid may find the pairs.

    What is not asked for changes nothing. Each body is given here what the bonus tasks remember
    of it.
    """

    def __init__(self, gravity=(0, 980), linear_damping=0.05, angular_damping=0.3):
        super().__init__(gravity, linear_damping, angular_damping)
        self.springs = []
        self.sleeping = False  # whether bodies at rest may sleep
        self.grid = False  # whether a grid finds the pairs to look at

    def add(self, body):
        """Add a body, awake, and return it."""
        super().add(body)
        body.before = Vector2(body.pos), body.angle  # where it was before the latest step
        body.asleep = False
        body.still_for = 0.0  # s at rest
        body.support = []  # what a sleeper lies on
        return body

    def moving_bodies(self):
        """The bodies that are neither static nor asleep."""
        return [body for body in self.bodies if not (body.asleep or body.is_static)]

    def apply_forces(self, dt):
        """The springs are forces as well. They see the velocities from before this step."""
        with sleepers_held(self.springs):
            for spring in self.springs:
                spring.apply(dt)
        super().apply_forces(dt)

    def pairs(self):
        """Return the pairs to check: all, or with the grid on only near ones."""
        if not self.moving_bodies():
            return []
        return near_pairs(self.bodies) if self.grid else super().pairs()

    def solve(self, dt):
        """Let bodies sleep or wake, then solve: a sleeper is as hard to move as a static body."""
        if self.sleeping and update_sleep(self, dt):
            self.contacts = self.find_contacts()
        with sleepers_held(self.contacts + self.joints):
            super().solve(dt)

    def move(self, dt):
        """Remember where each body was, then move."""
        for body in self.bodies:
            body.before = Vector2(body.pos), body.angle
        super().move(dt)


@contextmanager
def sleepers_held(links):
    """While this lasts, static bodies stand in for the sleepers at the ends of links.

    A link is a contact, a rod or a spring: anything that pushes its two ends, a and b.
    """
    ends = [(link, link.a, link.b) for link in links]
    for link, a, b in ends:
        link.a, link.b = stand_in(a), stand_in(b)
    try:
        yield
    finally:
        for link, a, b in ends:
            link.a, link.b = a, b


def stand_in(body):
    """Return a static body with a sleeper's place and surface; a body that is awake as it is."""
    if not getattr(body, "asleep", False):  # an end need not be in the world
        return body
    return Body(body.shape, body.pos, 0, body.restitution, body.friction)


def with_bonus(world):
    """A BonusWorld with all that is in a world."""
    more = BonusWorld(world.gravity, world.linear_damping, world.angular_damping)
    for body in world.bodies:
        more.add(body)
    more.joints = world.joints
    more.iterations = world.iterations
    return more
