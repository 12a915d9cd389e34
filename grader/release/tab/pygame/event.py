"""Events: a queue that the page and programs post to."""

from . import constants as c
from .errors import error
from .naming import Named, full_name
from .state import State, need_window

pump_hook = None  # the page's: called by get, poll, peek and pump; posts new events
wait_hook = None  # the page's: called while wait has no event; rests a frame and posts new events
MOST = 65_535  # events in the queue

queue = []
MODIFIERS = {
    c.K_LSHIFT: c.KMOD_LSHIFT, c.K_RSHIFT: c.KMOD_RSHIFT, c.K_LCTRL: c.KMOD_LCTRL,
    c.K_RCTRL: c.KMOD_RCTRL, c.K_LALT: c.KMOD_LALT, c.K_RALT: c.KMOD_RALT,
    c.K_LGUI: c.KMOD_LGUI, c.K_RGUI: c.KMOD_RGUI,
}  # fmt: skip


class Event(metaclass=Named):
    """One event: its type, and attributes by name."""

    def __init__(self, type, dict=(), **more):
        if not isinstance(type, int):
            raise TypeError(f"{full_name(type)!r} object cannot be interpreted as an integer")
        values = {**(dict or {}), **more}
        if "type" in values:
            raise ValueError("redundant type field in event dict")
        self.__dict__.update(values)
        self.__dict__["type"] = type

    def __eq__(self, other):
        return isinstance(other, Event) and vars(self) == vars(other)

    __hash__ = None

    def __repr__(self):
        return f"<Event({vars(self)})>"


def pump():
    """Let the page post new events."""
    need_window()
    if pump_hook:
        pump_hook()


def post(event):
    """Add an event to the queue; return whether there was room.

    While the page shows a program, events say which keys and buttons are down, and where the mouse
    is.
    """
    if not isinstance(event, Event):
        raise TypeError("argument must be an Event object")
    need_window()
    if State.sink:
        update_state(event)
    if len(queue) >= MOST:
        return False
    queue.append(event)
    return True


def update_state(event):
    """Update the state of keys and mouse from an event."""
    values = vars(event)
    match event.type:
        case c.KEYDOWN | c.KEYUP:
            key, down = values.get("key"), event.type == c.KEYDOWN
            (State.keys.add if down else State.keys.discard)(key)
            bit = MODIFIERS.get(key, 0)
            State.mods = State.mods & ~bit | (bit if down else 0)
            State.mods = values.get("mod", State.mods)
            values.setdefault("mod", State.mods)
            values.setdefault("unicode", "")
        case c.MOUSEBUTTONDOWN | c.MOUSEBUTTONUP:
            down = event.type == c.MOUSEBUTTONDOWN
            (State.buttons.add if down else State.buttons.discard)(values.get("button"))
    if "pos" in values:
        values["pos"] = tuple(map(int, values["pos"]))
        State.mouse = values["pos"]


def make_filter(types):
    """Return a test for events of these types; None stands for all."""
    if types is None:
        return lambda event: True
    types = {types} if isinstance(types, int) else set(types)
    return lambda event: event.type in types


def get(eventtype=None, pump=True):
    """Remove and return the events in the queue, or those of these types."""
    need_window()
    if pump and pump_hook:
        pump_hook()
    found = list(filter(make_filter(eventtype), queue))
    clear(eventtype)
    return found


def poll():
    """Remove and return the next event, or one of type NOEVENT."""
    need_window()
    if pump_hook:
        pump_hook()
    return queue.pop(0) if queue else Event(c.NOEVENT)


def wait(timeout=0):
    """Wait for an event, at most `timeout` ms unless that is 0; remove and return it."""
    from .time import get_ticks

    need_window()
    began = get_ticks()
    while not queue:
        if timeout and get_ticks() - began >= timeout:
            return Event(c.NOEVENT)
        if wait_hook:
            wait_hook()
        elif not timeout:
            raise error("no event can come while this program waits")
    return queue.pop(0)


def peek(eventtype=None, pump=True):
    """Return whether there are events, or events of these types."""
    need_window()
    if pump and pump_hook:
        pump_hook()
    return any(map(make_filter(eventtype), queue))


def clear(eventtype=None, pump=True):
    """Remove all events, or those of these types."""
    need_window()
    is_wanted = make_filter(eventtype)
    queue[:] = [event for event in queue if not is_wanted(event)]
