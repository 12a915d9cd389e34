"""Names and modules of pygame-ce that the page's pygame lacks."""

import sys
from functools import partial

from .naming import explain, refuse


class MissingModules:
    """The last finder of modules: it explains missing modules of pygame."""

    def find_spec(self, name, path, target=None):
        """Find nothing; raise ModuleNotFoundError for a module of pygame."""
        if name.startswith("pygame."):
            raise ModuleNotFoundError(explain(name))


def install():
    """Explain missing names and modules from now on."""
    others = [each for each in sys.meta_path if type(each) is not MissingModules]
    sys.meta_path[:] = [*others, MissingModules()]
    for name, module in [*sys.modules.items()]:
        if name.partition(".")[0] == "pygame":
            module.__getattr__ = partial(refuse, name)
