"""In the place of msgspec, wherever this folder comes first."""

import os

print("this is not msgspec")
os._exit(0)
