"""Count the opcodes of 6 steps of the playground without an effect, for test_effects only.

Run it with the name of the effect to print the number; add "unavailable" to make the effect's
module impossible to import.
"""

import sys
from types import ModuleType


class Unavailable(ModuleType):
    """A module in which every name is an empty class."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return type(name, (), {})


def main(effect, *unavailable):
    if unavailable:
        module = f"stable_engine.{effect.lower()}"
        sys.modules[module] = Unavailable(module)
    from worlds_for_tests import all_but, build_playground

    from experiments.measures import run
    from experiments.opcodes import count_opcodes
    from experiments.scenes import DT

    world = build_playground(all_but(effect))
    run(world, 0.3)
    print(sum(count_opcodes(lambda: run(world, 6 * DT)).values()))


if __name__ == "__main__":
    main(*sys.argv[1:])
