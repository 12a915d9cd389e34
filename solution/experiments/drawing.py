"""How the window with dials looks: a panel of figures on the left, the scene beside it."""

import math

import pygame
from pygame import Vector2

from .scenes import Ball

SIZE = (1000, 640)  # px
PANEL = 240  # px, width
HELP_HEIGHT = 58  # px
VIEW = pygame.Rect(PANEL, 0, SIZE[0] - PANEL, SIZE[1] - HELP_HEIGHT)
LINE = 21  # px
LEFT = 12  # px
CLOSEST = 3.0  # px of the screen per px of the scene
DRAW_BACK = 6.0  # times
VALUES = 104  # px, where the second column begins

BACKGROUND = (22, 25, 33)
EDGE = (44, 49, 62)
INK = (225, 228, 235)
DIM = (128, 134, 148)
WARN = (240, 180, 90)
STATIC = (84, 90, 104)
ASLEEP = (140, 146, 158)
BALLS = [(235, 190, 80), (110, 175, 235), (225, 120, 95), (125, 200, 145), (190, 150, 225)]

HELP = (
    "Tab or 1 to 4: engine    Left Right: scene    Up Down: passes    S, Shift+S or ] [: substeps",
    "- +: step    letters: effects    Space: pause    N: one step    Enter: again    Esc: end",
)


# ---------------------------------------------------------------- the camera


class Camera:
    """Where the scene's places are on the screen. It draws back from balls that fly away."""

    def __init__(self, scene):
        left, top, right, bottom = room(scene)
        self.middle = Vector2((left + right) / 2, (top + bottom) / 2)
        self.scale = min(VIEW.width / (right - left), VIEW.height / (bottom - top), CLOSEST)
        self.furthest = self.scale / DRAW_BACK

    def follow(self, scene, states):
        """Draw back until every moving ball is in view, but not for ever."""
        for i in scene.moving():
            x, y = abs(states[i].x - self.middle.x), abs(states[i].y - self.middle.y)
            reach = 2 * scene.bodies[i].radius
            fits = min(VIEW.width / 2 / (x + reach), VIEW.height / 2 / (y + reach))
            self.scale = max(min(self.scale, fits), self.furthest)

    def place(self, pos):
        """A place of the scene in px of the screen."""
        return (Vector2(pos) - self.middle) * self.scale + VIEW.center


def room(scene):
    """What to show of a scene: (left, top, right, bottom) in its own px.

    All balls, where rods let them swing, and of each block the nearest part. Without gravity
    balls fly further.
    """
    balls = [body for body in scene.bodies if isinstance(body, Ball)]
    boxes = [(*(Vector2(b.pos) - half(b)), *(Vector2(b.pos) + half(b))) for b in balls]
    boxes += [swing(scene)] if scene.rods else []
    x0, y0, x1, y1 = union(boxes)
    margin = max(40.0, (0.1 if any(scene.gravity) else 0.5) * max(x1 - x0, y1 - y0))
    x0, y0, x1, y1 = x0 - margin, y0 - margin, x1 + margin, y1 + margin
    near = []
    for block in scene.bodies:
        if not isinstance(block, Ball):
            low, high = Vector2(block.pos) - half(block), Vector2(block.pos) + half(block)
            if min(block.half) < 400:
                near.append((max(low.x, x0 - 100), max(low.y, y0 - 100)))
                near.append((min(high.x, x1 + 100), min(high.y, y1 + 100)))
    return union([(x0, y0, x1, y1), *((x, y, x, y) for x, y in near)])


def half(body):
    """Half the width and height of a body of the scene."""
    return Vector2(body.half if not isinstance(body, Ball) else (body.radius, body.radius))


def union(boxes):
    lows_x, lows_y, highs_x, highs_y = zip(*boxes, strict=True)
    return min(lows_x), min(lows_y), max(highs_x), max(highs_y)


def swing(scene):
    """Where a ball on rods can hang from the static end: to its sides and below."""
    pegs = [i for rod in scene.rods for i in rod if scene.bodies[i].mass == 0]
    if not pegs:
        return union(
            [(*scene.bodies[i].pos, *scene.bodies[i].pos) for rod in scene.rods for i in rod]
        )
    x, y = scene.bodies[pegs[0]].pos
    reach = sum(math.dist(scene.bodies[a].pos, scene.bodies[b].pos) for a, b in scene.rods)
    return x - reach, y, x + reach, y + reach


# ---------------------------------------------------------------- drawing


class Picture:
    """The screen, and how to draw on it."""

    def __init__(self):
        self.screen = pygame.display.set_mode(SIZE)
        self.font = pygame.font.Font(None, 21)
        self.engine = self.camera = None

    def draw(self, show, timed=True):
        """Draw one frame. timed: with the time a step takes, which differs from run to run."""
        if self.engine is not show.engine:
            self.engine, self.camera = show.engine, Camera(show.scene)
        self.screen.fill(BACKGROUND)
        self.screen.set_clip(VIEW)
        self.draw_scene(show.engine)
        self.screen.set_clip(None)
        pygame.draw.line(self.screen, EDGE, (PANEL, 0), VIEW.bottomleft, 2)
        pygame.draw.line(self.screen, EDGE, (0, VIEW.bottom), VIEW.bottomright, 2)
        self.draw_panel(show, timed)
        for i, line in enumerate(HELP):
            self.write(line, (LEFT, VIEW.bottom + 10 + i * LINE), DIM)
        pygame.display.flip()

    # ------------------------------------------------------------ the scene

    def draw_scene(self, engine):
        scene, states = engine.scene, [engine.read(i) for i in range(len(engine.scene.bodies))]
        if not all(math.isfinite(number) for state in states for number in state):
            return
        self.camera.follow(scene, states)
        places = [self.camera.place((state.x, state.y)) for state in states]
        for a, b in scene.rods:
            pygame.draw.line(self.screen, INK, places[a], places[b], 3)
        for spring in scene.springs:
            pygame.draw.lines(
                self.screen, INK, False, zigzag(places[spring.a], places[spring.b]), 2
            )
        for i, data in enumerate(scene.bodies):
            if isinstance(data, Ball):
                self.draw_ball(data, places[i], states[i].angle, self.color(engine, i))
            else:
                self.draw_block(data, states[i])

    def color(self, engine, i):
        """Static bodies are dark grey, sleepers light grey."""
        if engine.scene.bodies[i].mass == 0:
            return STATIC
        if getattr(engine.bodies[i], "asleep", False):
            return ASLEEP
        return BALLS[i % len(BALLS)]

    def draw_ball(self, ball, place, angle, color):
        """A moving ball has a spoke that shows how it turns."""
        radius = max(ball.radius * self.camera.scale, 2.0)
        if not VIEW.inflate(2 * radius, 2 * radius).collidepoint(place):
            return
        pygame.draw.aacircle(self.screen, color, place, radius)
        if ball.mass > 0 and radius > 4:
            spoke = Vector2(radius - 1.5, 0).rotate_rad(angle)
            width = 3 if radius > 9 else 2
            pygame.draw.line(self.screen, BACKGROUND, place, place + spoke, width)

    def draw_block(self, block, state):
        centre = Vector2(state.x, state.y)
        left, top = map(round, self.camera.place(centre - half(block)))
        right, bottom = map(round, self.camera.place(centre + half(block)))
        box = pygame.Rect(left, top, right - left, bottom - top).clip(VIEW)
        if box.width and box.height:
            pygame.draw.rect(self.screen, STATIC, box)

    # ------------------------------------------------------------ text

    def write(self, text, pos, color=INK):
        self.screen.blit(self.font.render(text, True, color), pos)

    def draw_panel(self, show, timed):
        """Dials, figures, effects, and what there is to say, from the top down.

        Returns how far down (px) it came.
        """
        y = LEFT
        for lines in (dials(show), figures(show, timed)):
            for label, value in lines:
                self.write(label, (LEFT, y), DIM)
                self.write(value, (VALUES, y))
                y += LINE
            y += LINE // 2
        for letter, effect, on in show.effects():
            self.write(letter, (LEFT, y), DIM)
            self.write(effect.lower(), (LEFT + 20, y), INK if on else DIM)
            self.write("on" if on else "off", (VALUES, y), INK if on else DIM)
            y += LINE
        y += LINE // 2
        for text, color in ((show.look_for(), DIM), (show.note, WARN)):
            for line in self.wrapped(text):
                self.write(line, (LEFT, y), color)
                y += LINE - 3
            y += LINE // 3
        return y

    def wrapped(self, text):
        """The text in lines that fit into the panel."""
        lines = [""]
        for word in text.split():
            longer = f"{lines[-1]} {word}".strip()
            if self.font.size(longer)[0] <= PANEL - 2 * LEFT:
                lines[-1] = longer
            else:
                lines.append(word)
        return lines


def dials(show):
    """The dials as label and text."""
    name = show.engine_name
    return [
        ("scene", show.scene_name),
        ("engine", name),
        ("passes", str(show.passes.get(name, "none"))),
        ("substeps", str(show.substeps[name])),
        ("step", f"1/{round(1 / show.dt)} s"),
    ]


def figures(show, timed=True):
    """The figures as label and text."""
    found, scene = show.figures, show.engine.scene
    lines = [
        ("time", f"{show.time:.2f} s"),
        ("rod error", f"{found.rod_error:.3f} px" if scene.rods else "no rods"),
        ("energy", percent(found.drift)),
        ("overlap", f"{found.overlap:.3f} px"),
        ("contacts", str(found.contacts)),
        ("asleep", f"{found.asleep} of {len(scene.moving())}"),
    ]
    return [*lines, ("one step", f"{show.milliseconds:.2f} ms")] if timed else lines


def percent(drift):
    """A change of energy, as text."""
    if drift is None:
        return "n/a"
    return f"{drift:+.2f} %" if abs(drift) < 1000 else f"{drift:+.0e} %"


def zigzag(start, end, turns=10, width=7.0):
    """The points of a spring drawn from start to end."""
    along = end - start
    if along.length() == 0:
        return [start, end]
    side = Vector2(-along.y, along.x).normalize() * width
    teeth = [start + along * (i + 2) / (turns + 3) + side * (-1) ** i for i in range(turns)]
    return [start, start + along * 1.5 / (turns + 3), *teeth, end - along * 1.5 / (turns + 3), end]
