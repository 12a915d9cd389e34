"""Start the window, for python -m mini_engine."""

import pygame

from lab_runtime import frame_budget

from . import BonusWindow, advance


def run():
    """Run the lab scene in a window until it is closed."""
    window = BonusWindow()
    clock = pygame.time.Clock()
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


run()
