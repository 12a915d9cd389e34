"""Imports of modules that pygame-ce has and this one has not."""

import sys

from .naming import explain


class MissingModules:
    """Stands after all that finds modules, and says of pygame's own that they are not here."""

    def find_spec(self, name, path, target=None):
        """Find nothing; raise ModuleNotFoundError for a module of pygame."""
        if name.startswith("pygame."):
            raise ModuleNotFoundError(explain(name))


def install():
    """Explain missing modules from now on."""
    sys.meta_path[:] = [
        *(f for f in sys.meta_path if type(f) is not MissingModules),
        MissingModules(),
    ]
