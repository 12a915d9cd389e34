"""All rows of the leaderboard, by their subjects."""

from . import bounces, fast, frames, hits, rest, rolling, ties

SUBJECTS = {
    "bouncing": bounces.make_rows,
    "collisions": hits.make_hit_rows,
    "several at once": hits.make_many_rows,
    "rolling and sliding": rolling.make_rows,
    "pendulums": ties.make_pendulum_rows,
    "rods and chains": ties.make_rod_rows,
    "springs": ties.make_spring_rows,
    "piles at rest": rest.make_pile_rows,
    "sleep": rest.make_sleep_rows,
    "bad starts": rest.make_start_rows,
    "fast balls": fast.make_rows,
}


def make_rows():
    """Return {subject: rows}."""
    rows = {subject: list(make()) for subject, make in SUBJECTS.items()}
    every = [row for some in rows.values() for row in some]
    return rows | {"other units, turned": list(frames.make_rows(every))}


def list_rows():
    return [row for some in make_rows().values() for row in some]
