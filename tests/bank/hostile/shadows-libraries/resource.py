"""In the place of resource, wherever this folder comes first."""

import os

print("this is not resource")
os._exit(0)
