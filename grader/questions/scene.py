"""Make the lab scene of a program, for questions and for films."""

from dataclasses import dataclass, field

from grader.judge.decode import Thing
from grader.judge.lab import Lab
from grader.protocol import BodyValue, Rng
from grader.questions.program import CannotAsk

BOB = 24.0  # px, the radius of the one ball that hangs on a rod
LEAST_MASS, MOST_MASS = 0.1, 100.0  # kg
SEEDS = range(100, 1000)


@dataclass
class Scene:
    """The lab scene as the program makes it for a seed of its balls."""

    lab: Lab
    seed: int
    world: Thing = field(init=False)
    bodies: list[tuple[Thing, BodyValue]] = field(init=False)

    def __post_init__(self) -> None:
        self.world = self.lab.thing(self.lab.call("make_world", Rng(self.seed)))
        found = self.lab.items(self.lab.get(self.world, "bodies"), "the bodies of the scene")
        states = [self.lab.body(each) for each in found]
        self.bodies = [(Thing(each.ref), each) for each in states]

    def find_ball(self, number: int) -> tuple[Thing, BodyValue]:
        """Return a ball by its number, from 1 on, in the order in which the scene adds them."""
        balls = [each for each in self.bodies if each[1].inv_mass and each[1].radius != BOB]
        if not 0 < number <= len(balls):
            raise CannotAsk(f"the scene has {len(balls)} balls")
        thing, state = balls[number - 1]
        if not (LEAST_MASS < 1 / state.inv_mass < MOST_MASS and 1 < state.radius < BOB):
            raise CannotAsk(f"ball {number} has no mass or radius of the lab scene")
        return thing, state

    def find_box(self, place: tuple[float, float]) -> tuple[Thing, BodyValue]:
        here = [each for each in self.bodies if (each[1].pos.x, each[1].pos.y) == place]
        if not here:
            raise CannotAsk(f"the scene has no box at {place}")
        return here[0]

    def read_number(self, thing: Thing, name: str) -> float:
        return self.lab.number(self.lab.get(thing, name), f"its {name}")

    @property
    def intro(self) -> str:
        return f"Your lab scene is made by `make_world(random.Random({self.seed}))`."
