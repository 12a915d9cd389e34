"""An exception with a message of ten megabytes, and one that prints itself."""

# TODO 8a: semi-implicit Euler
raise ValueError("<b>no</b>\n" * 10**6)
# END TODO 8a

# TODO 8b: velocity Verlet
class Loud(Exception):
    def __str__(self):
        return "x" * 10**7

    __repr__ = __str__


Loud.__name__ = Loud.__qualname__ = "\x1b[2J" + "L" * 10**6
raise Loud from Loud()
# END TODO 8b
