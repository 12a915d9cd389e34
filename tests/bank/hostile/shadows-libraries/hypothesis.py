"""In the place of hypothesis, wherever this folder comes first."""

import os

print("this is not hypothesis")
os._exit(0)
