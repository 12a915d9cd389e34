"""Test that the broad phase finds the same contacts as all pairs, after any motion."""

import random
from itertools import combinations

import pytest

from stable_engine import Body, Bounce, Box, Circle, Contacts, World
from stable_engine.broad_phase import BroadPhase

MARGIN = 0.5
DT, STEPS = 1 / 120, 12


def crowd(count, seed):
    """Make a world of random balls and boxes, some with the same left or top edge."""
    rng, world = random.Random(seed), World()
    for _ in range(count):
        at = rng.randrange(-200, 200, 20), rng.randrange(-200, 200, 20)
        shape = Circle(rng.choice((5, 10))) if rng.random() < 0.8 else Box((10, 5))
        world.add(Body(shape, at, 1.0 if isinstance(shape, Circle) else 0.0))
    return world, rng


def are_near(a, b):
    """Return whether two boxes are within the margin, the low end of one being moved out."""
    sides = ((a.x, a.hx, b.x, b.hx), (a.y, a.hy, b.y, b.hy))
    return all(abs(p - q) < reach + other + MARGIN for p, reach, q, other in sides)


def by_looking(world):
    pairs = [(a, b) for a, b in combinations(world.bodies, 2) if are_near(a, b)]
    return {frozenset((a.id, b.id)) for a, b in pairs if not (a.idle and b.idle)}


def renew(phase):
    phase.renew((0.0, 0.0), set(), DT, 0.0, MARGIN)
    return [(pair.a.id, pair.b.id) for pair in phase.pairs]


@pytest.mark.parametrize("speed", [0, 5, 400])
@pytest.mark.parametrize("seed", range(5))
def test_every_near_pair_is_on_the_list_once_while_bodies_move(seed, speed):
    world, rng = crowd(40, seed)
    phase = BroadPhase()
    phase.take(world.bodies)
    renewals = 0
    for stretch in (1, 3, 0.2, 1):  # wide, then tall: the sweep changes its axis
        for body in world.awake:
            body.x, body.y = body.x * stretch, body.y + rng.uniform(-9, 9)
            phase.is_stale = True  # as after Body.pos is set
            body.vx, body.vy = rng.uniform(-speed, speed), rng.uniform(-speed, speed)
        for _ in range(STEPS):
            phase.find_leavers(DT)
            renewals += phase.is_stale
            if phase.is_stale or phase.leavers:
                found = renew(phase)
            assert all(a > b for a, b in found)
            assert {frozenset(pair) for pair in found} >= by_looking(world)
            assert len(set(found)) == len(found)
            for body in world.awake:
                body.x, body.y = body.x + body.vx * DT, body.y + body.vy * DT
    assert renewals <= 4 * STEPS / 2  # and the list lasts


def test_the_order_of_a_sweep_does_not_depend_on_where_bodies_were_before():
    world, rng = crowd(40, 9)
    old, new = BroadPhase(), BroadPhase()
    old.take(world.bodies)
    for _ in range(5):
        for body in world.awake:
            body.x = round(body.x + rng.uniform(-9, 9))
            body.y = round(body.y * 1.5 + rng.uniform(-9, 9))  # clearly taller than wide
        new.take(world.bodies)
        old.is_stale = True
        assert renew(old) == renew(new)


def test_sleeping_bodies_form_no_pairs():
    world, _ = crowd(30, 3)
    awake = [body for body in world.awake if body.x < 0]
    for body in world.awake:
        body.idle = body not in awake
    phase = BroadPhase()
    phase.take(world.bodies)
    found = renew(phase)
    asleep = {body.id for body in world.bodies if body.idle}
    assert {frozenset(pair) for pair in found} >= by_looking(world)
    assert not any(set(pair) <= asleep for pair in found)


def set_velocity(ball):
    ball.vel += (0, 3000)


def press(ball):
    ball.apply_force((0, 3000 / DT))


@pytest.mark.parametrize("gravity", [0, 980])
@pytest.mark.parametrize("push", [set_velocity, press])
def test_a_pair_that_flies_past_is_skipped_until_one_of_the_two_is_pushed(push, gravity):
    hits = []
    contacts = Contacts(on_hit=lambda *hit: hits.append(hit))
    world = World((0, gravity), effects=[contacts])
    low, high = (world.add(Body(Circle(10), (0, y), 1.0)) for y in (0, 100))
    for ball in (low, high):
        ball.vel = (3000, 0)
    for _ in range(20):
        world.step(DT)
    assert contacts.broad_phase.is_quiet
    push(low)
    for _ in range(STEPS):
        world.step(DT)
    assert [(a, b) for a, b, _ in hits] == [(high, low)]


def hits_of_a_swarm(gravity, seed):
    """Return who hits whom, in order, in a sparse swarm without walls."""
    rng, hits = random.Random(seed), []
    contacts = Contacts(on_hit=lambda a, b, speed: hits.append((a.id, b.id, speed)))
    world = World((0, gravity), effects=[contacts, Bounce()])
    for i in range(49):
        place = 150 * (i % 7) + rng.uniform(-60, 60), 150 * (i // 7) + rng.uniform(-60, 60)
        ball = world.add(Body(Circle(rng.uniform(5, 15)), place, 1.0, restitution=0.9))
        ball.vel = (rng.uniform(-150, 150), rng.uniform(-150, 150))
    skipped = 0
    for _ in range(240):
        world.step(DT)
        skipped += contacts.broad_phase.is_quiet
    return hits, skipped


@pytest.mark.parametrize("gravity", [0, 980])
@pytest.mark.parametrize("seed", range(4))
def test_pairs_that_are_skipped_hit_nobody(gravity, seed, monkeypatch):
    hits, skipped = hits_of_a_swarm(gravity, seed)
    monkeypatch.setattr(BroadPhase, "skip_pairs", lambda *_: None)
    all_hits, _ = hits_of_a_swarm(gravity, seed)
    assert len(hits) > 1
    assert skipped > 40
    assert [hit[:2] for hit in hits] == [hit[:2] for hit in all_hits]
    assert [hit[2] for hit in hits] == pytest.approx([hit[2] for hit in all_hits], rel=1e-6)


@pytest.mark.parametrize("seed", range(4))
def test_balls_in_a_row_never_swap_as_one_bounces_off_a_wall(seed):
    """They may pass each other in a step after which no pair comes nearer."""
    rng = random.Random(seed)
    for _ in range(100):
        world = World((0, 0), rng.choice((1, 4)), [Contacts(), Bounce()])
        world.add(Body(Box((20, 100)), (rng.uniform(40, 90), 0), restitution=1))
        heavy, light = (Body(Circle(3), (x, 0), m, 1.0) for x, m in ((0, 50), (9, 1)))
        world.add(heavy).vel = (rng.uniform(0, 60), 0)
        world.add(light).vel = (rng.uniform(300, 1600), 0)
        for _ in range(12):
            world.step(1 / 60)
            assert heavy.x < light.x
