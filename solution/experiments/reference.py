"""The motion of balls on rods and springs by Newton's law, without contacts, in TINY steps."""

import math

import numpy as np

from .scenes import DT


def reference(scene, seconds, parts=8):
    """Yield the positions of all bodies after each step, by Runge and Kutta in TINY steps."""
    accelerate, h = Accelerations(scene), DT / parts
    now = np.zeros((2, len(scene.bodies), 2))  # positions, then velocities
    now[0] = [body.pos for body in scene.bodies]
    for i in scene.moving():
        now[1, i] = scene.bodies[i].vel

    def change(at):
        return np.array([at[1], accelerate(*at)])

    for _ in range(round(seconds / DT)):
        for _ in range(parts):
            first = change(now)
            second = change(now + h / 2 * first)
            third = change(now + h / 2 * second)
            fourth = change(now + h * third)
            now = now + h / 6 * (first + 2 * second + 2 * third + fourth)
        yield now[0]


class Accelerations:
    """The accelerations of bodies on springs and rods, whose pulls solve a linear system."""

    def __init__(self, scene):
        self.scene = scene
        self.mass = np.zeros((len(scene.bodies), 1))
        self.inverse = np.zeros_like(self.mass)  # 1/kg, 0 for a body that cannot move
        for i in scene.moving():
            self.mass[i] = scene.bodies[i].mass
            self.inverse[i] = 1 / scene.bodies[i].mass

    def __call__(self, now, vel):
        push = self.mass * np.array(self.scene.gravity, float)
        for s in self.scene.springs:
            apart, speed = now[s.b] - now[s.a], vel[s.b] - vel[s.a]
            length = math.hypot(*apart) or 1.0
            way = apart / length
            pull = (s.stiffness * (length - s.length) + s.damping * (speed @ way)) * way
            push[s.a] += pull
            push[s.b] -= pull
        rods = self.scene.rods
        if not rods:
            return push * self.inverse
        rows, wanted = np.zeros((len(rods), len(now), 2)), np.zeros(len(rods))
        for k, (a, b) in enumerate(rods):
            apart, speed = now[b] - now[a], vel[b] - vel[a]
            rows[k, a], rows[k, b] = -apart, apart
            wanted[k] = -(speed @ speed)
        flat, shares = rows.reshape(len(rods), -1), (rows * self.inverse).reshape(len(rods), -1)
        wanted -= shares @ push.ravel()
        pulls = np.linalg.lstsq(flat @ shares.T, wanted, rcond=None)[0]
        return (push + (flat.T @ pulls).reshape(-1, 2)) * self.inverse
