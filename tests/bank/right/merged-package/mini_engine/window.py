import random
from time import perf_counter as now

import pygame as pg
from lab_runtime import frame_budget

from . import engine as e

START = 12


class Window:
    def __init__(self):
        pg.init()
        self.screen = pg.display.set_mode((e.WIDTH, e.HEIGHT))
        self.font = pg.font.Font(None, 28)
        self.steps = 0
        self.restart()

    def restart(self):
        self.rng = random.Random(START)
        self.world = e.make_world(self.rng)

    def handle(self, event):
        if event.type == pg.MOUSEBUTTONDOWN and event.button == 1:
            if len(self.world.dynamic()) < e.MAX_BALLS:
                self.world.add(e.ball(self.rng, event.pos))
        elif event.type == pg.KEYDOWN and event.key == pg.K_r:
            self.restart()
        return event.type != pg.QUIT

    def draw(self):
        self.screen.fill("gray10")
        for j in self.world.joints:
            pg.draw.line(self.screen, "white", j.a.pos, j.b.pos, 2)
        for b in self.world.bodies:
            if isinstance(b.shape, e.Box):
                pg.draw.rect(self.screen, b.color, pg.Rect(b.pos - b.shape.half, 2 * b.shape.half))
                continue
            pg.draw.circle(self.screen, b.color, b.pos, b.shape.radius)
            if b.inv_mass:
                spoke = e.V(b.shape.radius, 0).rotate_rad(b.angle)
                pg.draw.line(self.screen, "gray10", b.pos, b.pos + spoke, 3)
        text = f"{len(self.world.dynamic())} moving, {len(self.world.contacts)} contacts"
        self.screen.blit(self.font.render(text, True, "white"), (8, 8))
        pg.display.flip()

    def run(self):
        owed, before, alive = 0, now(), True
        while alive and frame_budget():
            alive = all([self.handle(event) for event in pg.event.get()])
            owed += min(now() - before, e.MAX_STEPS * e.STEP)
            before = now()
            while owed >= e.STEP:
                self.world.step(e.STEP)
                owed -= e.STEP
                self.steps += 1
            self.draw()
        rod = self.world.joints[0]
        print("Steps:", self.steps)
        print(f"Pendulum length error: {abs((rod.a.pos - rod.b.pos).length() - rod.length):.2f} px")
        pg.quit()


def main():
    Window().run()
