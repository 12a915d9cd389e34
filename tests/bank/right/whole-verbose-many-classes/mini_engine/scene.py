"""The lab scene."""

from .dynamics.body import Body
from .dynamics.constraint import DistanceJoint
from .geometry import Box, Circle
from .world import World


class SceneBuilder:
    GREY = (84, 90, 104)

    def __init__(self, rng):
        self.rng = rng
        self.world = World()

    def add_box(self, center, half):
        return self.world.add(Body(Box(half), center, color=self.GREY))

    def add_peg(self, center, radius=8):
        return self.world.add(Body(Circle(radius), center, color=self.GREY))

    def add_ground(self):
        self.add_box((450, 580), (450, 20))
        self.add_box((-20, 300), (20, 300))
        self.add_box((920, 300), (20, 300))
        self.add_box((200, 260), (150, 10))

    def add_pegs(self):
        for i in range(5):
            self.add_peg((375 + 60 * i, 400))

    def add_pendulum(self):
        anchor = self.add_peg((700, 90), 6)
        bob = Body(Circle(24), (840, 90), mass=6, restitution=0.2, color=(235, 190, 80))
        self.world.add(bob)
        self.world.joints.append(DistanceJoint(anchor, bob))

    def add_balls(self):
        for i in range(8):
            self.world.add(ball(self.rng, (120 + 70 * i, 60 + 40 * (i % 3))))

    def build(self):
        self.add_ground()
        self.add_pegs()
        self.add_pendulum()
        self.add_balls()
        return self.world


def ball(rng, pos):
    radius = rng.randint(10, 22)
    color = (rng.randint(90, 240), rng.randint(90, 240), rng.randint(90, 240))
    return Body(Circle(radius), pos, mass=radius**2 / 100, restitution=0.4, friction=0.6, color=color)


def make_world(rng):
    return SceneBuilder(rng).build()
