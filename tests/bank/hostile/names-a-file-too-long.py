"""An error from a file whose name is longer than any file's may be."""

# TODO 8a: semi-implicit Euler
import os
exec(compile("1 / 0", os.path.join(os.path.dirname(__file__), "a" * 300 + ".py"), "exec"))
# END TODO 8a
