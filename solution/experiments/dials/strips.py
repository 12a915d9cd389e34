"""Strips: a figure over the last seconds, for energy, rod error and overlap."""

import pygame

HEIGHT = 54  # px, of one strip
TEXT = 16  # px of it, for the words above the curve
SECONDS = 8.0  # that it shows
INK, DIM, LINE = (225, 228, 235), (150, 156, 170), (110, 175, 235)


def kinds(show):
    """Return each strip's name, unit, reading, and the least full scale."""
    kinds = [("energy", "%", lambda figures: figures.drift, 1.0)]
    if show.engine.scene.rods:
        kinds.append(("rod error", "px", lambda figures: figures.rod_error, 0.1))
    return [*kinds, ("overlap", "px", lambda figures: figures.overlap, 0.5)]


def room_for(show):
    """Return the height (px) of the strips of a show."""
    return HEIGHT * len(kinds(show))


def draw_strips(screen, font, show, area):
    """Draw the strips of a show in an area of the screen."""
    for number, (name, unit, read, least) in enumerate(kinds(show)):
        box = pygame.Rect(
            area.left + 6, area.top + HEIGHT * number + 4, area.width - 12, HEIGHT - 8
        )
        points = [(time, read(figures)) for time, figures in show.history]
        points = [(time, value) for time, value in points if value is not None]
        most = max([least, *(abs(value) for _, value in points)])
        below = pygame.Rect(box.left, box.top + TEXT, box.width, box.height - TEXT)
        for place in curve(points, show.time, most, below):
            pygame.draw.lines(screen, LINE, False, place, 2)
        now = f"{points[-1][1]:.2f} {unit}" if points else "n/a"
        screen.blit(font.render(f"{name}  {now}", True, INK), (box.left + 2, box.top - 2))
        scale = font.render(f"up to {most:.3g} {unit}", True, DIM)
        screen.blit(scale, (box.right - scale.get_width() - 2, box.top - 2))


def curve(points, now, most, box):
    """Return the curve in its box. Zero is at the bottom, or in the middle if some are below."""
    if len(points) < 2:
        return []
    below = any(value < 0 for _, value in points)
    zero, tall = (box.centery, box.height / 2) if below else (box.bottom, box.height)
    start = now - SECONDS
    shown = [(time, value) for time, value in points if time >= start]
    places = [
        (box.left + (time - start) / SECONDS * box.width, zero - value / most * tall)
        for time, value in shown
    ]
    return [places] if len(places) > 1 else []
