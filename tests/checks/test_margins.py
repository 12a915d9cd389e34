"""Test that scenes of the whole program pass with other balls and times."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from one_worker import child_opener

from grader.bank.members import lay_over
from grader.checks.whole import checks
from grader.judge.lab import Lab
from grader.judge.task import KIT

LESSON = KIT / "tests" / "bank" / "right" / "lesson-as-printed"
SCENES: dict[str, list[Callable[[Lab], None]]] = {
    "mini_engine": [
        checks.the_rod_swings_alike_at_any_frame_rate,
        checks.balls_bounce_come_to_rest_and_roll,
        checks.the_picture_shows_where_the_balls_are,
        checks.clicks_drop_balls_and_r_resets,
    ],
    "pymunk_scene": [
        checks.the_pymunk_stack_stands_and_its_rod_holds,
        checks.the_pymunk_stack_falls_when_it_is_knocked_over,
        checks.clicks_b_and_r_work_in_pymunk,
    ],
}
SEEDS, TIMES = (1, 7, 30, 46, 99), (0.9, 1.0, 1.1)
CASES = [
    (module, scene, seed, times)
    for module, scenes in SCENES.items()
    for scene in scenes
    for seed in SEEDS
    for times in TIMES
]
FEW = CASES[4::23]  # another scene, seed and time each


def name_value(value: Any) -> str:
    return getattr(value, "__name__", str(value))


@pytest.mark.parametrize(
    ("module", "scene", "seed", "times"),
    [pytest.param(*case, marks=[] if case in FEW else pytest.mark.soak) for case in CASES],
    ids=name_value,
)
def test_a_scene_holds_with_other_balls_and_at_other_times(
    module: str, scene: Callable[[Lab], None], seed: int, times: float, tmp_path: Path
):
    """Run a scene of the lesson's program with other balls and another length."""
    folder = tmp_path / "lesson"
    lay_over(LESSON, folder)
    for path in folder.glob("*.py"):
        text = path.read_text(encoding="utf-8").replace("Random(12)", f"Random({seed})")
        path.write_text(text, encoding="utf-8")
    real, photographed = checks.run, [round(times * each) for each in checks.PHOTOGRAPHED]

    def run(lab: Lab, seconds: float, *rest: Any, **more: Any) -> Any:
        return real(lab, times * seconds, *rest, **more)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(checks, "SEED", seed)
        patch.setattr(checks, "run", run)
        patch.setattr(checks, "PHOTOGRAPHED", photographed)
        with (
            child_opener(folder) as children,
            Lab(module, lambda: children(20), []).opened() as lab,
        ):
            scene(lab)
