"""Learning systems, a file each; `SYSTEMS` has all of this folder, in the order of their ranks."""

import importlib
import pkgutil

from grader.intake.lms import Lms

for each in pkgutil.iter_modules(__path__):
    importlib.import_module(f"{__name__}.{each.name}")

# The first that recognises a name or a gradebook decides.
SYSTEMS = tuple(sorted((kind() for kind in Lms.__subclasses__()), key=lambda each: each.rank))
BY_NAME: dict[str, Lms] = {each.name: each for each in SYSTEMS}
