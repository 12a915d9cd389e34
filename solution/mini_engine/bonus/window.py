"""The window with the bonus tasks."""

import pygame

from ..body import Body
from ..constants import HEIGHT, STEP, WIDTH
from ..game_loop import Window
from ..game_loop import main as run
from ..scenes import GREY
from ..shapes import Circle
from .broad_phase import CELL
from .sleeping import wake
from .springs import SpringJoint
from .world import with_bonus

FAINT = (44, 49, 61)
SLEEPER = (120, 120, 120)
BONUS_KEYS = (pygame.K_s, pygame.K_g, pygame.K_k)
BONUS_HELP = "bonus:  Shift+click: a heavy ball    S: sleep    G: grid    K: a spring"


def between(body, share):
    """Where to draw a body, (place, angle): so much of its way through the latest step.

    share is from 0, where it was before that step (body.before), to 1, where it is now. The body
    itself stays as it is.
    """
    # TODO B5: draw between steps
    pos, angle = body.before
    return pos + (body.pos - pos) * share, angle + (body.angle - angle) * share
    # END TODO B5


def heaviness():
    """Return how many times as heavy the next ball is: 10 while Shift is held, else 1."""
    # TODO B6: heavier balls with Shift
    return 10 if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1
    # END TODO B6


class BonusWindow(Window):
    """The lab scene with sleepers, a grid, springs and heavy balls, drawn between steps."""

    shows_keys = False  # the keys of the bonus tasks, once one of them was used

    def reset(self):
        """Begin anew, with all bonus tasks switched off."""
        super().reset()
        self.world = with_bonus(self.world)

    def press(self, key):
        """Also switch sleep or the grid on or off, or add a spring."""
        super().press(key)
        if key == pygame.K_s:
            self.world.sleeping = not self.world.sleeping
            for body in self.sleepers():
                wake(body)
        elif key == pygame.K_g:
            self.world.grid = not self.world.grid
        elif key == pygame.K_k:
            add_spring(self.world)
        self.shows_keys = self.shows_keys or key in BONUS_KEYS

    def sleepers(self):
        """The bodies that are asleep."""
        return [body for body in self.world.bodies if body.asleep]

    def drop_ball(self, pos):
        """Drop a ball that is as heavy as asked for."""
        ball = super().drop_ball(pos)
        if ball is not None:
            times = heaviness()
            ball.inv_mass /= times
            ball.inv_inertia /= times
        return ball

    def place(self, body):
        """Return where to draw a body: between its last two steps, by the accumulator's time."""
        return between(body, self.accumulator / STEP)

    def draw_scene(self):
        """Draw the cells and the springs below all else."""
        if self.world.grid:
            self.draw_cells()
        for spring in self.world.springs:
            self.draw_line(spring, 1)
        super().draw_scene()

    def draw_cells(self):
        """Draw the cells of the grid."""
        for x in range(0, WIDTH, CELL):
            pygame.draw.line(self.screen, FAINT, (x, 0), (x, HEIGHT))
        for y in range(0, HEIGHT, CELL):
            pygame.draw.line(self.screen, FAINT, (0, y), (WIDTH, y))

    def draw_body(self, body, color):
        """Draw sleepers in grey."""
        super().draw_body(body, SLEEPER if body.asleep else color)

    def texts(self):
        """Add how many are asleep, and the keys of the bonus tasks."""
        asleep = f"asleep: {len(self.sleepers())}" if self.world.sleeping else ""
        keys = BONUS_HELP if self.shows_keys else ""
        return [*super().texts(), ((310, 10), asleep), ((12, HEIGHT - 20), keys)]


def add_spring(world):
    """Add a ball on a spring, drawn out to the side at first."""
    hook = world.add(Body(Circle(6), (600, 60), color=GREY))
    bob = world.add(Body(Circle(16), (640, 180), mass=2, color=(120, 200, 170)))
    world.springs.append(SpringJoint(hook, bob, stiffness=80, damping=0.4, length=80))


def main():
    """Run the lab scene with the bonus tasks, until the window is closed."""
    run(BonusWindow)
