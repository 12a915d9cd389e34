"""Name the effects that a scene needs and does not declare, or declares and does not use."""

from .body import Body
from .effect import WorldState
from .joint import Joint


def complaints(world: WorldState) -> list[str]:
    """Return one sentence for each effect that is missing, or declared and not used."""
    return [*missing(world), *unused(world)]


def missing(world: WorldState) -> list[str]:
    """Return a sentence for each effect that the scene calls for and does not declare.

    Friction and restitution that were given call for their effects, above 0 and where something
    can move. A static body calls for contacts unless a joint is tied to it: it is there to be
    touched. So do friction and restitution.
    """
    bodies = world.bodies if len(world.bodies) > len(world.statics) else []
    reasons: dict[str, str] = {}
    for body in bodies:
        if body.friction_given and body.mu > 0:
            reasons.setdefault("Friction", f"{body!r} was given a friction of {body.mu:g}")
        if body.restitution_given and body.e > 0:
            reasons.setdefault("Bounce", f"{body!r} was given a restitution of {body.e:g}")
        if body.is_static and not tied(body, world):
            reasons.setdefault("Contacts", f"{body!r} is static, and bodies would pass through it")
    if "Friction" in reasons or "Bounce" in reasons:
        reasons.setdefault("Contacts", "without contacts, friction and restitution do nothing")
    return [
        f"This scene calls for {name}(), which it does not declare: {reason}. "
        f"Declare it: World(effects=[..., {name}()])."
        for name, reason in reasons.items()
        if name not in world.effects
    ]


def tied(body: Body, world: WorldState) -> bool:
    """Return whether a rod or spring is tied to the body."""
    joints: list[Joint] = []
    for effect in world.effects.values():
        joints += getattr(effect, "joints", [])
    return any(body in (joint.a, joint.b) for joint in joints)


def unused(world: WorldState) -> list[str]:
    """Return a sentence for each declared effect that nothing in the scene has a use for."""
    return [
        f"This scene declares {name}(), but has no use for it. Leave it out, or add what it is for."
        for name, effect in world.effects.items()
        if not effect.is_used()
    ]
