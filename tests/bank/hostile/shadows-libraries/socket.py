"""In the place of socket, wherever this folder comes first."""

import os

print("this is not socket")
os._exit(0)
