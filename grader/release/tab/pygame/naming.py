"""Give a class written in Python the names that one written in C has in messages."""

FULL_NAME = type.__dict__["__name__"]


def full_name(value):
    """Return the name of a value's type for messages."""
    return FULL_NAME.__get__(type(value))


class Named(type):
    """The type of classes that messages name in full.

    Python puts `type.__name__` into "unsupported operand type(s) for +: 'float' and …". For a class
    in C, this is "pygame.math.Vector2" there, though `Vector2.__name__` is "Vector2".
    """

    __name__ = property(lambda cls: cls.__qualname__)

    def __new__(meta, name, bases, names):
        names.setdefault("__getattr__", refuse_attribute)
        made = super().__new__(meta, name, bases, names)
        if made.__module__.startswith("pygame."):
            FULL_NAME.__set__(made, f"{made.__module__}.{name}")
        return made

    def __getattr__(cls, name):
        refuse(FULL_NAME.__get__(cls), name)


def refuse_attribute(value, name):
    """Raise AttributeError for an attribute that this page's pygame lacks."""
    where = "in the pygame of this page"
    raise AttributeError(f"{full_name(value)!r} object has no attribute {name!r} {where}")


def refuse(module, name):
    """Raise AttributeError for a name that this page's pygame lacks."""
    if name.startswith("__"):
        raise AttributeError(f"module {module!r} has no attribute {name!r}")
    raise AttributeError(explain(f"{module}.{name}"))


def explain(name):
    """Return the sentence about a name that this page's pygame lacks."""
    return (
        f"{name} is not part of the pygame of this page; "
        "draw with what the lab uses, or run the program on a computer with pygame-ce"
    )
