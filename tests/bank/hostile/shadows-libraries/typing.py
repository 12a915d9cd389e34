"""In the place of typing, wherever this folder comes first."""

import os

print("this is not typing")
os._exit(0)
