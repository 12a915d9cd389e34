"""In the place of random, wherever this folder comes first."""

import os

print("this is not random")
os._exit(0)
