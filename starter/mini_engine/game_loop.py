"""The window: time, events, drawing."""

import random

import pygame
from pygame import Vector2

from lab_runtime import frame_budget, pause

from .constants import HEIGHT, MAX_BALLS, MAX_STEPS, STEP, WIDTH
from .scenes import ball, make_world
from .shapes import Box

MAX_FRAME = MAX_STEPS * STEP  # s, the most time one frame may add
BACKGROUND = (22, 25, 33)
INK = (225, 228, 235)
HELP = "click: drop a ball    R: reset    Space: pause, then N: one step"


def advance(world, accumulator, frame_seconds):
    """Run the fixed steps that one frame of frame_seconds owes.

    accumulator holds the seconds not simulated yet. One frame adds MAX_FRAME at most, so that a
    slow frame cannot make the next one slower still. Returns (accumulator, steps run).
    """
    # TODO 6: run whole steps from the accumulator
    # One step per frame: the faster the computer draws, the faster the balls fall.
    world.step(STEP)
    steps = 1
    # END TODO 6
    return accumulator, steps


class Window:
    """The lab scene on the screen: what clicks and keys do to it, and how it is drawn."""

    def __init__(self):
        pygame.init()
        pygame.display.set_caption("Mini engine")
        self.screen = pygame.display.set_mode((WIDTH, HEIGHT))
        self.font = pygame.font.Font(None, 26)
        self.accumulator = 0.0  # s
        self.reset()

    def reset(self):
        """Begin the lab scene anew."""
        self.rng = random.Random(12)
        self.world = make_world(self.rng)

    def press(self, key):
        """Do what a key is for."""
        if key == pygame.K_r:
            self.reset()
        elif key == pygame.K_SPACE:
            pause(lambda: self.world.step(STEP), self.draw)

    def drop_ball(self, pos):
        """Drop a ball at pos and return it; None where MAX_BALLS bodies can move already."""
        if sum(not body.is_static for body in self.world.bodies) >= MAX_BALLS:
            return None
        return self.world.add(ball(self.rng, pos))

    def draw(self):
        """Show the scene and the lines of text."""
        self.screen.fill(BACKGROUND)
        self.draw_scene()
        for pos, text in self.texts():
            self.screen.blit(self.font.render(text, True, INK), pos)
        pygame.display.flip()

    def draw_scene(self):
        """Draw the rods and the bodies."""
        for joint in self.world.joints:
            self.draw_line(joint, 3)
        for body in self.world.bodies:
            self.draw_body(body, body.color)

    def draw_line(self, joint, width):
        """Draw a line between the two ends of a joint."""
        pygame.draw.line(self.screen, INK, self.place(joint.a)[0], self.place(joint.b)[0], width)

    def draw_body(self, body, color):
        """Draw a box, or a circle; one that can move has a spoke."""
        pos, angle = self.place(body)
        pos = Vector2(pos[0], min(pos[1], pos[1] % HEIGHT))  # what falls out comes in at the top
        if isinstance(body.shape, Box):
            pygame.draw.rect(self.screen, color, (pos - body.shape.half, body.shape.half * 2))
            return
        pygame.draw.aacircle(self.screen, color, pos, body.shape.radius)
        if not body.is_static:
            spoke = Vector2(body.shape.radius - 2, 0).rotate_rad(angle)
            pygame.draw.line(self.screen, BACKGROUND, pos, pos + spoke, 3)

    def place(self, body):
        """Where to draw a body, (place, angle)."""
        return body.pos, body.angle

    def texts(self):
        """The lines of text, each as (place, text)."""
        world = self.world
        status = f"moving bodies: {len(world.moving_bodies())}    contacts: {len(world.contacts)}"
        rod = f"rod error: {self.rod_error():.2f} px"
        return [((12, 10), status), ((12, 34), rod), ((12, HEIGHT - 38), HELP)]

    def rod_error(self):
        """Return how far the rods are from their lengths, in px."""
        return sum(abs((rod.b.pos - rod.a.pos).length() - rod.length) for rod in self.world.joints)


def main(kind=Window):
    """Run the lab scene in a window of this kind, until it is closed."""
    window, clock = kind(), pygame.time.Clock()
    total_steps, running = 0, True
    while running and frame_budget():
        frame_seconds = clock.tick(60) / 1000
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                running = False
            elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
                window.drop_ball(event.pos)
            elif event.type == pygame.KEYDOWN:
                window.press(event.key)
        window.accumulator, steps = advance(window.world, window.accumulator, frame_seconds)
        total_steps += steps
        window.draw()
    pygame.quit()
    print(f"Fixed steps: {total_steps}")
    print(f"Pendulum length error: {window.rod_error():.2f} px")
