"""Draw the window with dials: a panel on the left, the scene in each engine beside it.

Each key also has a button: while it draws, a picture notes the key of each area.
"""

import math
import time
from collections import namedtuple

import pygame
from pygame import Vector2

from ..scenes import Ball
from .show import LOOK_FOR
from .strips import draw_strips, room_for

SIZE = (1160, 720)  # px
PANEL = 260  # px, width
HELP_HEIGHT = 88  # px
VIEW = pygame.Rect(PANEL, 0, SIZE[0] - PANEL, SIZE[1] - HELP_HEIGHT)
LINE = 21  # px
LEFT = 12  # px
CLOSEST = 3.0  # px of the screen per px of the scene
DRAW_BACK = 6.0  # times
VALUES = 104  # px, where the second column begins
SIGN = 19  # px, of a button with one sign
NORMAL = 16.0  # px of the screen: the arrow of a contact, with no impulse at all
PUSH = 30.0  # px of the screen more: that of the largest impulse in view

BACKGROUND = (22, 25, 33)
EDGE = (44, 49, 62)
INK = (225, 228, 235)
DIM = (128, 134, 148)
WARN = (240, 180, 90)
STATIC = (84, 90, 104)
ASLEEP = (140, 146, 158)
BALLS = [(235, 190, 80), (110, 175, 235), (225, 120, 95), (125, 200, 145), (190, 150, 225)]

BUTTON = (58, 65, 82)
TOUCH = (250, 130, 120)

HELP = (
    "Mouse: pick up, throw, drop a ball    Tab or 1 to 4: engine    Left Right: scene    "
    "Up Down: passes    S, Shift+S or ] [: substeps",
    "- +: step    , .: slow motion    letters: effects    V: beside    X: contacts    T: strips    "
    "Space N Enter 0    Esc: end",
)
BUTTONS = (  # below the scene: words and key
    ("Pause", pygame.K_SPACE),
    ("One step", pygame.K_n),
    ("Again", pygame.K_RETURN),
    ("Beside", pygame.K_v),
    ("Contacts", pygame.K_x),
    ("Strips", pygame.K_t),
    ("Reset dials", pygame.K_0),
)
DIAL_KEYS = {  # the keys that turn a dial down and up
    "scene": (pygame.K_LEFT, pygame.K_RIGHT),
    "engine": (None, pygame.K_TAB),
    "passes": (pygame.K_DOWN, pygame.K_UP),
    "substeps": (pygame.K_LEFTBRACKET, pygame.K_RIGHTBRACKET),
    "step": (pygame.K_MINUS, pygame.K_EQUALS),
    "motion": (pygame.K_COMMA, pygame.K_PERIOD),
}

Side = namedtuple("Side", "show engine view camera")  # one of the engines side by side


# ---------------------------------------------------------------- the camera


class Camera:
    """Where the scene's places are on the screen. It draws back from balls that fly away."""

    def __init__(self, scene, view=VIEW):
        left, top, right, bottom = room(scene)
        self.view = view
        self.middle = Vector2((left + right) / 2, (top + bottom) / 2)
        self.scale = min(view.width / (right - left), view.height / (bottom - top), CLOSEST)
        self.furthest = self.scale / DRAW_BACK

    def follow(self, scene, states):
        """Draw back until every moving ball is in view, but not for ever."""
        for i in scene.moving():
            x, y = abs(states[i].x - self.middle.x), abs(states[i].y - self.middle.y)
            reach = 2 * scene.bodies[i].radius
            fits = min(self.view.width / 2 / (x + reach), self.view.height / 2 / (y + reach))
            self.scale = max(min(self.scale, fits), self.furthest)

    def place(self, pos):
        """Convert a position in the scene to px of the screen."""
        return (Vector2(pos) - self.middle) * self.scale + self.view.center

    def scene_place(self, pos):
        """Convert a position on the screen to a position in the scene."""
        return (Vector2(pos) - self.view.center) / self.scale + self.middle


def room(scene):
    """Return the part of a scene to show: (left, top, right, bottom) in its own px.

    It has all balls, their swings on rods, and the nearest part of each block. Without gravity it
    is larger, as balls fly further.
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
    """Return half the width and height of a body of the scene."""
    return Vector2(body.half if not isinstance(body, Ball) else (body.radius, body.radius))


def union(boxes):
    lows_x, lows_y, highs_x, highs_y = zip(*boxes, strict=True)
    return min(lows_x), min(lows_y), max(highs_x), max(highs_y)


def swing(scene):
    """Return the box in which a ball on rods can swing, beside and below the static end."""
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
        self.sides = []
        self.buttons = []  # (place, key)
        self.drawn = time.perf_counter()
        self.frame = 1 / 60  # s, from one frame to the next, smoothed

    @property
    def camera(self):
        """Return the camera of the first engine."""
        return self.sides[0].camera

    def draw(self, show, timed=True, beside=(), contacts=False, strips=False):
        """Draw one frame: a show, with other engines beside it.

        timed adds the times of steps, which differ from run to run.
        """
        before, self.drawn = self.drawn, time.perf_counter()
        self.frame += 0.05 * (self.drawn - before - self.frame)
        self.look_at([show, *beside], room_for(show) if strips else 0)
        self.buttons = []
        self.screen.fill(BACKGROUND)
        for side in self.sides:
            self.screen.set_clip(side.view)
            self.draw_scene(side, contacts)
            if beside:
                self.draw_name(side)
            self.screen.set_clip(None)
            if strips:
                below = pygame.Rect(side.view.bottomleft, (side.view.width, room_for(show)))
                draw_strips(self.screen, self.font, side.show, below)
            low = (side.view.left, VIEW.bottom)
            pygame.draw.line(self.screen, EDGE, side.view.topleft, low, 2)
        pygame.draw.line(self.screen, EDGE, (0, VIEW.bottom), VIEW.bottomright, 2)
        self.draw_panel(show, timed)
        self.draw_buttons(show, len(beside) > 0, contacts, strips)
        for i, line in enumerate(HELP):
            self.write(line, (LEFT, VIEW.bottom + 40 + i * LINE), DIM)
        pygame.display.flip()

    def look_at(self, shows, below):
        """Divide the view among the engines; give a new or resized one a camera."""
        wide = VIEW.width // len(shows)
        sides = []
        for number, show in enumerate(shows):
            view = pygame.Rect(VIEW.left + number * wide, VIEW.top, wide, VIEW.height - below)
            old = self.sides[number] if number < len(self.sides) else None
            if old is not None and (old.engine, old.view) == (show.engine, view):
                sides.append(old._replace(show=show))
            else:
                sides.append(Side(show, show.engine, view, Camera(show.scene, view)))
        self.sides = sides

    def side_at(self, pos):
        """Return the engine whose view contains this position of the screen, or None."""
        return next((side for side in self.sides if side.view.collidepoint(pos)), None)

    def key_at(self, pos):
        """Return the key of the button at this position, or None."""
        return next((key for place, key in self.buttons if place.collidepoint(pos)), None)

    # ------------------------------------------------------------ the scene

    def draw_scene(self, side, contacts):
        engine, camera = side.show.engine, side.camera
        scene, states = engine.scene, [engine.read(i) for i in range(len(engine.scene.bodies))]
        if not all(math.isfinite(number) for state in states for number in state):
            return
        camera.follow(scene, states)
        places = [camera.place((state.x, state.y)) for state in states]
        for a, b in scene.rods:
            pygame.draw.line(self.screen, INK, places[a], places[b], 3)
        for spring in scene.springs:
            pygame.draw.lines(
                self.screen, INK, False, zigzag(places[spring.a], places[spring.b]), 2
            )
        for i, data in enumerate(scene.bodies):
            if isinstance(data, Ball):
                self.draw_ball(data, places[i], states[i].angle, self.color(engine, i), camera)
            else:
                self.draw_block(data, states[i], camera)
        if contacts:
            self.draw_contacts(engine.touches(), camera)
        hand = side.show.hand
        if hand is not None and hand.held is not None:
            pygame.draw.line(self.screen, WARN, places[hand.held], camera.place(hand.at), 2)

    def draw_contacts(self, touches, camera):
        """Draw points and normals; the longer the arrow, the larger the impulse."""
        largest = max((touch.impulse or 0.0 for touch in touches), default=0.0)
        for x, y, nx, ny, impulse in touches:
            place, normal = camera.place((x, y)), Vector2(nx, ny)
            arm = normal * (NORMAL + (PUSH * impulse / largest if impulse and largest else 0.0)) / 2
            pygame.draw.line(self.screen, TOUCH, place - arm, place + arm, 2)
            pygame.draw.circle(self.screen, TOUCH, place, 3)

    def draw_name(self, side):
        """Write the engine's name above its view, with the figures that engines differ in most."""
        show = side.show
        found = show.figures
        words = f"{show.engine_name}   overlap {found.overlap:.2f} px"
        if show.engine.scene.rods:
            words += f"   rod {found.rod_error:.2f} px"
        self.write(words, (side.view.left + 8, 8))
        if show.failed:
            self.write(show.note[:60], (side.view.left + 8, 8 + LINE), WARN)

    def color(self, engine, i):
        """Return a body's colour: dark grey if static, light grey if asleep."""
        if engine.scene.bodies[i].mass == 0:
            return STATIC
        if getattr(engine.bodies[i], "asleep", False):
            return ASLEEP
        return BALLS[i % len(BALLS)]

    def draw_ball(self, ball, place, angle, color, camera):
        """Draw a ball; a moving one has a spoke that shows how it turns."""
        radius = max(ball.radius * camera.scale, 2.0)
        if not VIEW.inflate(2 * radius, 2 * radius).collidepoint(place):
            return
        pygame.draw.aacircle(self.screen, color, place, radius)
        if ball.mass > 0 and radius > 4:
            spoke = Vector2(radius - 1.5, 0).rotate_rad(angle)
            width = 3 if radius > 9 else 2
            pygame.draw.line(self.screen, BACKGROUND, place, place + spoke, width)

    def draw_block(self, block, state, camera):
        centre = Vector2(state.x, state.y)
        left, top = map(round, camera.place(centre - half(block)))
        right, bottom = map(round, camera.place(centre + half(block)))
        box = pygame.Rect(left, top, right - left, bottom - top).clip(camera.view)
        if box.width and box.height:
            pygame.draw.rect(self.screen, STATIC, box)

    # ------------------------------------------------------------ text and buttons

    def write(self, text, pos, color=INK):
        self.screen.blit(self.font.render(text, True, color), pos)

    def draw_panel(self, show, timed):
        """Draw dials, figures, effects and notes, from the top down.

        Return the lower end (px).
        """
        y = LEFT
        rate = [("frames", f"{1 / self.frame:.0f} per second")] if timed else []
        for lines in (dials(show), [*figures(show, timed), *rate]):
            for label, value in lines:
                self.write(label, (LEFT, y), DIM)
                self.write(value, (VALUES, y))
                self.signs(label, y)
                y += LINE
            y += LINE // 2
        for letter, effect, on in show.effects():
            self.write(letter, (LEFT, y), DIM)
            self.write(effect.lower(), (LEFT + 20, y), INK if on else DIM)
            self.write("on" if on else "off", (VALUES, y), INK if on else DIM)
            self.buttons.append((pygame.Rect(LEFT, y - 3, VALUES + 20, LINE), ord(letter.lower())))
            y += LINE
        y += LINE // 2
        for text, color in ((LOOK_FOR[show.scene_name], DIM), (show.note, WARN)):
            for line in self.wrapped(text):
                self.write(line, (LEFT, y), color)
                y += LINE - 3
            y += LINE // 3
        return y

    def signs(self, label, y):
        """Draw the two buttons beside a dial that turn it down and up."""
        for number, key in enumerate(DIAL_KEYS.get(label, ())):
            if key is not None:
                place = pygame.Rect(PANEL - 56 + number * (SIGN + 5), y - 3, SIGN, SIGN)
                self.button(place, "-+"[number] if label != "scene" else "<>"[number], key)

    def draw_buttons(self, show, beside, contacts, strips):
        """Draw a row of buttons below the scene; a button is lit while its state is on."""
        lit = {pygame.K_SPACE: show.paused, pygame.K_v: beside}
        lit |= {pygame.K_x: contacts, pygame.K_t: strips}
        x = LEFT
        for words, key in BUTTONS:
            place = pygame.Rect(x, VIEW.bottom + 8, self.font.size(words)[0] + 20, 25)
            self.button(place, words, key, lit.get(key, False))
            x = place.right + 8

    def button(self, place, words, key, lit=False):
        pygame.draw.rect(self.screen, WARN if lit else BUTTON, place, border_radius=4)
        text = self.font.render(words, True, BACKGROUND if lit else INK)
        self.screen.blit(text, text.get_rect(center=place.center))
        self.buttons.append((place, key))

    def wrapped(self, text):
        """Split the text into lines that fit the panel."""
        lines = [""]
        for word in text.split():
            longer = f"{lines[-1]} {word}".strip()
            if self.font.size(longer)[0] <= PANEL - 2 * LEFT:
                lines[-1] = longer
            else:
                lines.append(word)
        return lines


def dials(show):
    """Return the dials as label and text."""
    name = show.engine_name
    return [
        ("scene", show.scene_name),
        ("engine", name),
        ("passes", str(show.passes.get(name, "none"))),
        ("substeps", str(show.substeps[name])),
        ("step", f"1/{round(1 / show.dt)} s"),
        ("motion", "real time" if show.rate == 1 else f"{show.rate:g} x"),
    ]


def figures(show, timed=True):
    """Return the figures as label and text."""
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
    """Return a change of energy, as text."""
    if drift is None:
        return "n/a"
    return f"{drift:+.2f} %" if abs(drift) < 1000 else f"{drift:+.0e} %"


def zigzag(start, end, turns=10, width=7.0):
    """Return the points of a spring drawn from start to end."""
    along = end - start
    if along.length() == 0:
        return [start, end]
    side = Vector2(-along.y, along.x).normalize() * width
    teeth = [start + along * (i + 2) / (turns + 3) + side * (-1) ** i for i in range(turns)]
    return [start, start + along * 1.5 / (turns + 3), *teeth, end - along * 1.5 / (turns + 3), end]
