"""Programs that show a title first, and computers on which a step takes its time."""

from pathlib import Path

import pytest
from one_worker import opened

from grader.bank.members import lay_over
from grader.checks.pacing import STEP_TAKES, frames_at, pace
from grader.judge.grade import KIT
from grader.judge.lab import STEP, Lab
from grader.protocol import Event, Played

LESSON = KIT / "tests" / "bank" / "right" / "lesson-as-printed"
START = "    clock = pygame.time.Clock()\n"
POLLS = """
    clock = pygame.time.Clock()
    while not pygame.event.get(pygame.KEYDOWN):
        clock.tick(60)
        if pygame.event.peek(pygame.QUIT):
            return
"""
WAITS = """
    pygame.display.flip()
    while (event := pygame.event.wait()).type != pygame.MOUSEBUTTONDOWN:
        if event.type == pygame.QUIT:
            return
    clock = pygame.time.Clock()
"""
SHORT_OF_TIME = """
        began = time.perf_counter()
        while accumulator >= STEP and time.perf_counter() - began < 0.002:
"""


def play(folder: Path, changes: dict[str, str], events: list[Event]) -> Played:
    lay_over(LESSON, folder)
    program = folder / "mini_engine.py"
    text = program.read_text(encoding="utf-8")
    for old, new in changes.items():
        text = text.replace(old, new)
    program.write_text(text, encoding="utf-8")
    with opened(folder) as children, Lab("mini_engine", lambda: children(5), []).opened() as lab:
        return lab.play([17] * 60, events, physics=False, trail_every=1)


@pytest.mark.parametrize("title", [POLLS, WAITS])
def test_a_title_is_opened_and_does_not_count(title: str, tmp_path: Path):
    click = [Event(20, "click", (450, 300))]
    plain = play(tmp_path / "plain", {}, click)
    titled = play(tmp_path / "titled", {START: title}, click)
    assert len(titled.steps) == len(plain.steps)
    assert abs(sum(titled.steps) - sum(plain.steps)) <= 8  # one frame, cut
    assert titled.trail[-1] == plain.trail[-1]


def test_a_program_that_never_steps_is_not_opened_for_ever(tmp_path: Path):
    played = play(tmp_path / "none", {"world.step(STEP)": "pass"}, [])
    assert played.ended == "returned" and not any(played.steps)


def test_a_loop_that_stops_when_steps_are_slow_is_behind(tmp_path: Path):
    lay_over(LESSON, tmp_path / "short")
    program = tmp_path / "short" / "mini_engine.py"
    text = program.read_text(encoding="utf-8")
    text = text.replace("import math\n", "import math\nimport time\n")
    text = text.replace("        while accumulator >= STEP:\n", SHORT_OF_TIME)
    program.write_text(text, encoding="utf-8")
    frames = frames_at(60, 1.0)
    with opened(program.parent) as children:
        for takes, share in ((0.0, 1.0), (STEP_TAKES, 0.5)):
            with Lab("mini_engine", lambda: children(5), []).opened() as lab:
                steps = sum(pace(lab, frames, takes).steps)
            assert steps == pytest.approx(share / STEP, abs=3)
