"""The window."""

import random

import pygame
from pygame import Vector2

from lab_runtime import frame_budget

from .geometry import Circle
from .scene import ball, make_world
from .settings import HEIGHT, MAX_BALLS, WIDTH
from .timing import advance


class Renderer:
    BACKGROUND = (22, 25, 33)
    INK = (225, 228, 235)

    def __init__(self):
        self.screen = pygame.display.set_mode((WIDTH, HEIGHT))
        self.font = pygame.font.Font(None, 26)

    def render(self, world):
        self.screen.fill(self.BACKGROUND)
        for joint in world.joints:
            pygame.draw.line(self.screen, self.INK, joint.a.pos, joint.b.pos, 3)
        for body in world.bodies:
            if isinstance(body.shape, Circle):
                self.render_circle(body)
            else:
                self.render_box(body)
        text = f"moving bodies: {len(world.dynamic_bodies)}    contacts: {len(world.contacts)}"
        self.screen.blit(self.font.render(text, True, self.INK), (12, 10))
        pygame.display.flip()

    def render_circle(self, body):
        pygame.draw.circle(self.screen, body.color, body.pos, body.shape.radius)
        if not body.is_static:
            spoke = Vector2(body.shape.radius - 2, 0).rotate_rad(body.angle)
            pygame.draw.line(self.screen, self.BACKGROUND, body.pos, body.pos + spoke, 3)

    def render_box(self, body):
        half = body.shape.half
        pygame.draw.rect(self.screen, body.color, pygame.Rect(body.pos - half, half * 2))


class GameApplication:
    SEED = 12

    def __init__(self):
        pygame.init()
        pygame.display.set_caption("Mini engine")
        self.renderer = Renderer()
        self.clock = pygame.time.Clock()
        self.accumulator = 0.0
        self.total_steps = 0
        self.running = True
        self.reset()

    def reset(self):
        self.rng = random.Random(self.SEED)
        self.world = make_world(self.rng)

    def drop(self, pos):
        if len(self.world.dynamic_bodies) < MAX_BALLS:
            self.world.add(ball(self.rng, pos))

    def handle_events(self):
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                self.running = False
            elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
                self.drop(event.pos)
            elif event.type == pygame.KEYDOWN and event.key == pygame.K_r:
                self.reset()

    def run(self):
        while self.running and frame_budget():
            frame_seconds = self.clock.tick(60) / 1000
            self.handle_events()
            self.accumulator, steps = advance(self.world, self.accumulator, frame_seconds)
            self.total_steps += steps
            self.renderer.render(self.world)
        pygame.quit()
        self.report()

    def report(self):
        rod = self.world.joints[0]
        error = abs((rod.b.pos - rod.a.pos).length() - rod.length)
        print(f"Fixed steps: {self.total_steps}")
        print(f"Pendulum length error: {error:.2f} px")


def main():
    GameApplication().run()
