"""Molecules: frames of rods that stiff springs tie, to each other or to other balls."""

from .body import Body
from .frame import TURNED, Frame
from .joint import Joint
from .network import Network, bodies_of, connect
from .springs import Spring, Springs, any_stiff

PASSES = 2  # of solving rods and springs together, as lengths are not quite linear in the speeds


class Molecule:
    """Rods and stiff springs that balls connect, solved together before each frame is.

    One after the other, rods would drive the ends of a spring apart once it is solved: the energy
    of its stretch would come from nothing.
    """

    def __init__(self, network: Network[Joint], frame_of: dict[Body, Frame]) -> None:
        self.network = network
        self.springs = [row for row in network.rows if isinstance(row, Spring)]
        balls = [body for body in bodies_of(network.rows) if body in frame_of]
        self.frames = list(dict.fromkeys([frame_of[ball] for ball in balls]))

    def solve(self, h: float, bias: float) -> None:
        """Change velocities as its rods and springs need together in a move of h seconds.

        `bias` is the share of a length error that rods correct per second. Where rods turn far in
        the move, change nothing: what they need is no linear function of the speeds.
        """
        for _ in range(PASSES):
            turned = min([frame.look_ahead(h, bias)[1] for frame in self.frames])
            if turned < TURNED:
                return
            for frame in self.frames:
                if frame.has_loop and not frame.is_uneven:  # taut rods may call for any impulse
                    frame.soften()
            for spring in self.springs:
                spring.aim()
            self.network.solve()
            for spring in self.springs:
                spring.take(spring.rhs)
            for frame in self.frames:
                frame.take()


def find_molecules(
    frames: list[Frame], frame_of: dict[Body, Frame], springs: Springs, h: float
) -> list[Molecule]:
    """Return the molecules in substeps of h seconds."""
    stiff: list[Joint] = []
    for network in springs.networks:
        if any_stiff(network.rows, h):
            stiff += network.rows
    if not stiff:
        return []
    rods: list[Joint] = [rod for frame in frames for rod in frame.rods]
    molecules = [Molecule(network, frame_of) for network in connect([*rods, *stiff])]
    return [one for one in molecules if one.springs and one.frames]
