"""Find piles: where passes over contacts would leave much, as much presses on little."""

from math import hypot, inf

from .body import Body
from .contact import RESTING_SPEED, Contact
from .detection import Detection
from .joint import Joint
from .network import HEAVY
from .pile import HARDEST, SOFTEST, Load, Pile
from .springs import Spring
from .unload import in_touch

TALL = 13.3  # weights of its effective mass; a contact that bears more carries a tower. Not whole,
# so that rounding does not decide between towers of equal balls
LEANING = 0.1  # a sine; a tower leans less
SUNK = 0.01  # in units of the world; a contact that gives way by less sinks too little to be seen
BEARING = 0.05  # weights of its effective mass; a contact with less bears nothing
TIED = 0.005  # of both radii; rods take over what a push out of more overlap leaves
MOST_ROWS = 128  # contacts and rods of a pile; a larger one is left to passes
WEDGED = 0.9  # cosine; a ball between faces that turn less is pressed as by a heavier one
PARALLEL = 1 - 1e-9  # cosine, of faces that are one
OPPOSITE = -0.5  # cosine; faces that turn further apart clamp what is between them


def find_piles(contacts: Detection, before: list[Pile], h: float, pace: float) -> list[Pile]:
    """Return the piles of a step with substeps of h seconds, and end those of the step before.

    In steps that vary, springs that are stiff at this pace (s) count in short ones too.
    """
    world, balls = contacts.world, contacts.balls
    gx, gy = world.g
    weight = hypot(gx, gy) * h  # px/s, of 1 kg in a substep
    tall = inf  # px/s, by mass; a contact that bears more is left to towers
    if weight and balls.contacts:
        sinks = (1 - balls.mass_scale) / balls.bias_rate  # px by px/s, if it is not
        tall = max(TALL * weight, SUNK * world.unit / sinks)
    is_heavy = is_tall = False  # whether masses differ much; whether there is any tower
    for c in contacts.touching:
        is_heavy = is_heavy or c.ratio > HEAVY
        if c.jn > tall * c.mn:
            is_upright = abs(c.nx * gy - c.ny * gx) * h < LEANING * weight
            is_tall = is_tall or (is_upright and c.a.touches <= 2 and c.b.touches <= 2)
    for pile in before:
        pile.end()
    tied = find_tied(contacts, h) if contacts.rods and contacts.landings.pairs else set()
    springs = contacts.springs.find_stiff(max(h, pace)) if contacts.springs else []
    piles = find_heavy(contacts, is_heavy, tied, springs)
    if is_tall:
        piles += find_towers(contacts.touching, piles, tall, weight, world.unit)
    return piles


def find_tied(contacts: Detection, h: float) -> set[Contact]:
    """Return the contacts that may work against rods: they land or overlap.

    Overlap that a load explains is left out: nothing works against it.
    """
    tied: set[Contact] = set()
    dt = h * contacts.world.substep_count
    for c in [pair.contact for pair in contacts.landings.pairs if pair.contact]:
        deep = TIED * (c.a.r + c.b.r) + c.gap - max(c.closing_speed(), 0.0) * dt  # px, below 0
        if deep < 0:
            deep += (contacts.balls if c.b.inv_mass else contacts.statics).borne(c)
        if deep < 0 or c in contacts.landings.speeds:
            tied.add(c)
    return tied


def find_heavy(
    contacts: Detection, is_heavy: bool, tied: set[Contact], springs: list[Spring]
) -> list[Pile]:
    """Return the piles where much presses on little, if there are any.

    is_heavy tells whether masses at any contact differ much; `tied` are contacts that may work
    against rods, and `springs` the stiff ones.
    """
    world, rods = contacts.world, contacts.rods
    pull = hypot(*world.g)
    loads = find_wedged(contacts.statics.contacts)  # kg, that press beside the bodies' own masses
    for body, (fx, fy, _) in world.forces.items() if pull else []:
        if hypot(fx, fy) > HEAVY * body.m * pull:
            loads[body] = hypot(fx, fy) / pull
    held = {body for spring in springs for body in (spring.end_a, spring.end_b) if body.inv_mass}
    pulled = {c for c in contacts.touching if c.a in held or c.b in held} if held else set()
    is_heavy = is_heavy or bool(loads or tied or pulled)
    frames = rods.frames if rods else []
    if not (is_heavy or any([frame.load > HEAVY * frame.lightest for frame in frames])):
        return []
    for frame in frames:
        loads.update(dict.fromkeys(frame.ends, frame.load))
    links: list[Joint] = [rod for frame in frames for rod in frame.rods]
    tied = {c for c in tied if c.a in loads or c.b in loads} | pulled
    return collect_piles(contacts.touching, [*links, *springs], loads, tied, world.unit)


def collect_piles(
    contacts: list[Contact],
    joints: list[Joint],
    loads: dict[Body, float],
    tied: set[Contact],
    unit: float,
) -> list[Pile]:
    """Return the piles in which a body, or a frame, is much heavier than a ball at its contact.

    loads are the masses (kg) that press where they are not the bodies' own, as in frames of rods.
    unit is that of the world.
    """
    ratios = [ratio_of(c, loads) if loads else c.ratio for c in contacts]
    firsts = find_firsts(contacts, ratios, tied, unit)
    if not firsts:
        return []
    count = len(contacts)
    ends = [(c.a, c.b) for c in contacts] + [(joint.end_a, joint.end_b) for joint in joints]
    beside: dict[Body, list[int]] = {}  # the indices of each ball
    for index, both in enumerate(ends):
        for body in both:
            if body.inv_mass:
                beside.setdefault(body, []).append(index)
    piles: list[Pile] = []
    seen: set[int] = set()
    for first in firsts:
        indices = indices_from(first, ends, beside, seen)
        if len(indices) > 1:
            rows = [Load(contacts[at], ratios[at]) for at in indices if at < count]
            held = [joints[at - count] for at in indices if at >= count]
            if not is_clamped(rows):
                piles.append(Pile(rows, held, unit, SOFTEST))
    return piles


def find_wedged(contacts: list[Contact]) -> dict[Body, float]:
    """Return the balls between faces that are nearly parallel, as in a narrow or a flat V.

    The impulse at each face grows as if the ball had the mass (kg) returned with it.
    """
    firsts: dict[Body, Contact] = {}
    wedged: dict[Body, float] = {}
    for c in contacts:
        first = firsts.setdefault(c.a, c)
        alike = abs(first.nx * c.nx + first.ny * c.ny)
        if WEDGED < alike < PARALLEL:
            wedged[c.a] = max(wedged.get(c.a, 0.0), c.a.m / (1 - alike))
    return wedged


def find_firsts(
    contacts: list[Contact], ratios: list[float], tied: set[Contact], unit: float
) -> list[int]:
    """Return the indices of contacts that make a pile: much presses there, and does not bounce."""
    firsts: list[int] = []
    for index, (c, ratio) in enumerate(zip(contacts, ratios, strict=True)):
        fast = RESTING_SPEED * unit if c.e else inf
        closing = c.closing_speed()
        if closing < fast and (c in tied or (ratio > HEAVY and closing > -fast)):
            firsts.append(index)
    return firsts


def find_towers(
    contacts: list[Contact], piles: list[Pile], tall: float, weight: float, unit: float
) -> list[Pile]:
    """Return the piles of balls in a row that bear much, besides these other piles.

    There each ball touches at most two others, and the row has no way round. A contact bears much
    if its impulse is more than `tall` (px/s) times its mass. weight is that of 1 kg in a substep.
    """
    beside: dict[Body, list[Contact]] = {}
    for c in contacts:
        if c.a.touches <= 2 and c.b.touches <= 2:
            for body in (c.a, c.b):
                if body.inv_mass:
                    beside.setdefault(body, []).append(c)
    towers: list[Pile] = []
    seen = {body for pile in piles for body in pile.bodies}
    for first, near in beside.items():
        if first not in seen and any([c.jn > tall * c.mn for c in near]):
            balls = in_touch([first], beside)
            rows = dict.fromkeys([c for ball in balls for c in beside[ball]])
            seen.update(balls)
            links = 2 * len([c for c in rows if c.b.inv_mass])
            is_row = links == sum([b.touches for b in balls]) and links < 2 * len(balls)
            if is_row and len(balls) <= MOST_ROWS and not any([b.joint_count for b in balls]):
                loads = [
                    Load(c, max(c.jn / (weight * c.mn), c.ratio))
                    for c in rows
                    if c.jn > BEARING * weight * c.mn
                ]
                if not is_clamped(loads):
                    towers.append(Pile(loads, [], unit, HARDEST))
    return towers


def is_clamped(loads: list[Load]) -> bool:
    """Return whether a kinematic body presses balls against another body that does not give way.

    Then no impulses can stop the balls: a solution of all at once would grow without end.
    """
    firm = [load.c for load in loads if not load.c.b.inv_mass]
    presses = [c for c in firm if c.b.is_kinematic]
    return any([p.nx * c.nx + p.ny * c.ny < OPPOSITE for p in presses for c in firm])


def ratio_of(c: Contact, loads: dict[Body, float]) -> float:
    """Return the ratio of the masses (kg) that press at a contact."""
    most = max(loads.get(c.a, 0.0), loads.get(c.b, 0.0))
    return max(c.ratio, most / min(c.a.m, c.b.m or c.a.m)) if most else c.ratio


def indices_from(
    first: int, ends: list[tuple[Body, Body]], beside: dict[Body, list[int]], seen: set[int]
) -> list[int]:
    """Return the indices of all that balls connect to the first one, and note them as seen.

    Return none if they are more than MOST_ROWS, or if one was seen before.
    """
    found: set[int] = set()
    new = {first}
    while new and len(found) <= MOST_ROWS and new.isdisjoint(seen):
        found |= new
        new = {at for index in new for body in ends[index] for at in beside.get(body, [])} - found
    seen.update(found)
    return [] if new or len(found) > MOST_ROWS else sorted(found)
