"""Define the messages between the judge and the worker's children.

Messages are plain data in MessagePack, decoded into the strict types below: a bool is never a
number, and unknown data is an error. Each message follows its length (4 bytes, big-endian).
"""

import select
import socket
import struct
import time
from contextlib import suppress
from typing import Annotated, Literal

import msgspec
from msgspec import Meta, Struct

MAX_MESSAGE = 1024 * 1024  # bytes; a longer one is refused unread; the usual size is up to 250 KB
MAX_UPLOAD = 20 * 1024**2  # bytes of a submission, and of one file in an archive
RUNAWAY = 2000  # steps in one frame after which a program is stopped
MAX_BODIES, MAX_TOUCHES, MAX_RODS = 80, 120, 20  # of one moment
HEADER = struct.Struct(">I")

# The environment of every child: no window, sets in the same order each time, English, one clock.
ENVIRONMENT = {
    "SDL_VIDEODRIVER": "dummy",
    "SDL_AUDIODRIVER": "dummy",
    "PYGAME_HIDE_SUPPORT_PROMPT": "1",
    "PYTHONHASHSEED": "0",
    "LANG": "C.UTF-8",
    "TZ": "UTC",
    "OPENBLAS_NUM_THREADS": "1",  # or numpy takes memory for each core
}

# ---------------------------------------------------------------- texts

# A message with a longer text is refused: texts are stored and shown several times. A child cuts
# its texts before it sends them.
MAX_NAME, MAX_TEXT = 200, 2000  # characters
MAX_PRINTED = 65 * 1024  # characters of one answer
MAX_LINES = 200  # printed by a program
MAX_OUTPUT = 64 * 1024  # bytes printed before an answer, and characters printed in a check
MAX_STEP_SIZES = 16  # reported by a play
MAX_PHOTOS, MAX_PHOTO = 5, 150 * 1024  # bytes of each; usually 15 KB
MAX_FRAMES = 12  # of a traceback
MAX_LINE = 16 * 1024 * 1024  # a line number: a file has no more bytes

Name = Annotated[str, Meta(max_length=MAX_NAME)]
Text = Annotated[str, Meta(max_length=MAX_TEXT)]
Printed = Annotated[str, Meta(max_length=MAX_PRINTED)]

# Limits of lists: the judge may take quadratic time. Each is at least four times what the solution
# sends.
MAX_PRESENT = 400  # bodies, shapes, rods or contacts at one moment; the scene has 49
MAX_STATES = 4000  # steps or frames of one request; a program has 600, and up to RUNAWAY more
MAX_ITEMS = 4000  # entries of a returned list; an integrator returns 1000 states

PRESENT, STATES = Meta(max_length=MAX_PRESENT), Meta(max_length=MAX_STATES)
ITEMS, NUMBERS = Meta(max_length=MAX_ITEMS), Meta(max_length=6 * MAX_PRESENT)
Row = Annotated[list[float], NUMBERS]  # six numbers for each body


def cut(text: str, most: int) -> str:
    """Cut a text to `most` characters, with … at its end; surrogates become their numbers."""
    text = text[: most + 1].encode(errors="backslashreplace").decode()
    return text if len(text) <= most else f"{text[: most - 1]}…"


# ---------------------------------------------------------------- values


class Vec(Struct, frozen=True, tag="vec"):
    """A pair of numbers: px, px/s, or any other pair, such as (x, v)."""

    x: float
    y: float

    def __iter__(self):  # type: ignore[no-untyped-def]
        return iter((self.x, self.y))


class Ref(Struct, frozen=True, tag="ref"):
    """An object in the child; `kind` is the name of its type."""

    id: int
    kind: Name = ""


class Items(Struct, frozen=True, tag="items"):
    items: "Annotated[list[Value], ITEMS]"


class BodyValue(Struct, frozen=True, tag="body"):
    """A body of the lesson's engine: px, px/s, rad, rad/s."""

    ref: int
    pos: Vec
    vel: Vec
    angle: float
    omega: float
    inv_mass: float
    inv_inertia: float
    radius: float  # px, 0 for a box


class ContactValue(Struct, frozen=True, tag="contact"):
    ref: int
    a: int  # the ref of body A
    b: int
    normal: Vec
    depth: float
    point: Vec
    jn: float
    jt: float


class ShapeValue(Struct, frozen=True):
    kind: Name  # Circle, Segment or Poly
    radius: float
    box: tuple[float, float, float, float]  # left, bottom, right, top in px
    friction: float
    elasticity: float
    solid: bool = True  # pushes all others: no sensor, no filter


class SpaceBody(Struct, frozen=True, tag="space_body"):
    """A pymunk body with its shapes; the space's static body, too."""

    ref: int
    kind: Literal["dynamic", "kinematic", "static"]
    pos: Vec
    vel: Vec
    angle: float
    omega: float
    mass: float
    moment: float | None  # None: infinite
    shapes: Annotated[list[ShapeValue], PRESENT]


class SpaceJoint(Struct, frozen=True):
    kind: Name
    a: int
    b: int
    anchor_a: Vec | None  # in world coordinates
    anchor_b: Vec | None
    distance: float | None
    reach: tuple[float, float] | None = None  # px: shortest and longest, of a slide joint


class SpaceValue(Struct, frozen=True, tag="space"):
    ref: int
    gravity: Vec
    damping: float
    bodies: Annotated[list[SpaceBody], PRESENT]
    joints: Annotated[list[SpaceJoint], PRESENT]


Value = (
    None
    | bool
    | int
    | float
    | Text
    | Vec
    | Ref
    | Items
    | BodyValue
    | ContactValue
    | SpaceBody
    | SpaceValue
)


class Rng(Struct, frozen=True, tag="rng"):
    """An argument that becomes `random.Random(seed)` in the child."""

    seed: int


Argument = None | bool | int | float | str | Vec | Ref | Rng

# ---------------------------------------------------------------- judge to child


class Piece(Struct, frozen=True):
    """A function of the reference that replaces the submission's own."""

    target: str  # module:name or module:Class.method
    source: str
    imports: str
    parameters: list[str]
    names: list[str]  # the globals it reads, beyond its imports
    given: dict[str, str] = {}  # sources of given functions, for a submission without them
    asked: str = ""  # the function that the check is about, which is never replaced


class Import(Struct, frozen=True, tag="import"):
    module: str
    pieces: list[Piece] = []
    watched: bool = False  # store the state after the import, for Remembered
    deal: int = 0  # added to the seed of each random.Random, for other balls than usual


class Remembered(Struct, frozen=True, tag="remembered"):
    """Ask for the names in the submission whose data has changed since the import."""


class Call(Struct, frozen=True, tag="call"):
    """Call a target: module:name, or #id.method for an object of the child."""

    target: str
    args: list[Argument] = []
    kwargs: dict[str, Argument] = {}
    work: bool = False  # count the lines that run
    framed: bool = False  # report changes outside the call
    twice: bool = False  # call twice: the answer may depend on nothing but the arguments
    stepping: bool = False  # count the steps of the world in the arguments, without running them
    states: list[int] = []  # objects whose state after the call comes with the answer
    marks: dict[str, float] = {}  # fields to set in the returned contact afterwards
    ref: int = 0  # the number of the returned object from now on; 0: the child chooses it
    quiet: bool = False  # a setup: its answer is not needed


class Get(Struct, frozen=True, tag="get"):
    ref: int
    name: str = ""  # empty: the object itself


class Set(Struct, frozen=True, tag="set"):
    ref: int
    fields: dict[str, Argument]


class MakeBody(Struct, frozen=True, tag="make_body"):
    """Make a body of the lesson's engine with its shape, and set further fields."""

    ref: int  # its number from now on
    module: str
    shape: Literal["Circle", "Box"]
    size: float | Vec  # radius or half extents
    pos: Vec
    mass: float
    kwargs: dict[str, float] = {}
    fields: dict[str, Argument] = {}


class MakeWorld(Struct, frozen=True, tag="make_world"):
    """Make a world of the lesson's engine with bodies and joints.

    `bonus`: a BonusWorld, if the submission has that class.
    """

    ref: int  # its number from now on
    module: str
    gravity: Vec
    linear_damping: float
    angular_damping: float
    bodies: list[int] = []
    joints: list[int] = []
    bonus: bool = False


class Simulate(Struct, frozen=True, tag="simulate"):
    """Call `step(dt)` of an object `steps` times; record the watched bodies every `every` steps."""

    ref: int
    dt: float
    steps: int
    watch: list[int]
    every: int = 1
    contacts: bool = False


class Integrate(Struct, frozen=True, tag="integrate"):
    """Call an integrator `steps` times, each time with its last (x, v)."""

    target: str  # module:name
    x: float
    v: float
    dt: float
    force: list[float]  # accel(x), a polynomial in x, lowest power first
    steps: int = 1
    twice: bool = False  # call twice, and report changes outside the call
    places: bool = False  # answer with the positions at which accel was called


class Event(Struct, frozen=True):
    """An input of a person after `frame` frames, at least 1."""

    frame: int
    kind: Literal["click", "key"]
    pos: tuple[int, int] = (0, 0)
    button: int = 1  # of the mouse: 1 is left, 4 turns the wheel
    key: str = ""
    held: str = ""  # keys that are down, such as "left shift+left ctrl"


class Play(Struct, frozen=True, tag="play"):
    """Run a program without a window; `frames` has the length of each frame in whole ms."""

    module: str
    frames: list[int]
    events: list[Event] = []
    physics: bool = True  # False: count steps without running them
    trail_every: int = 0  # steps between two records of all moving bodies; 0: never
    pictures: bool = False  # False: draw one pixel only
    photos: list[int] = []  # frames at whose end the window is photographed
    step_ms: float = 0.0  # duration of each step on the scripted clock


Setup = Set | MakeBody | MakeWorld | Call  # requests that need no answer of their own
Request = (
    Import | Remembered | Call | Get | Set | MakeBody | MakeWorld | Simulate | Integrate | Play
)


class Record(Struct, frozen=True, tag="record"):
    """Answer a request and record the bodies meanwhile, for a replay."""

    request: Request
    most: int  # moments; of more steps or frames only some are recorded
    cut: bool = False  # begin a new scene, which does not show earlier objects


# ---------------------------------------------------------------- child to judge


class Change(Struct, frozen=True, array_like=True):
    """A change by a call. `ref`: an object's ref, a negated argument number, or 0: a constant."""

    ref: int
    name: Name


class Returned(Struct, frozen=True, tag="returned"):
    value: Value
    lines: int = 0  # that ran; one that ran twice counts twice
    changed: Annotated[list[Change], ITEMS] = []
    again: Value = None  # the second answer
    steps: int = 0  # of worlds
    dts: Annotated[list[float], STATES] = []  # their different sizes
    states: Annotated[list[Value], ITEMS] = []  # None for an object that cannot be described


class CodeLine(Struct, frozen=True):
    file: Text
    line: Annotated[int, Meta(ge=0, le=MAX_LINE)]
    function: Name
    text: Text


class Raised(Struct, frozen=True, tag="raised"):
    error: Name
    message: Text
    frames: Annotated[list[CodeLine], Meta(max_length=MAX_FRAMES)]  # the student's, outermost first


class Missing(Struct, frozen=True, tag="missing"):
    """A name or file of the lab sheet is missing or has another type."""

    what: Text


class ContactRow(Struct, frozen=True, array_like=True):
    """A contact in short: its point, the unit normal from A to B, the overlap, the impulses."""

    x: float
    y: float
    nx: float
    ny: float
    depth: float  # px
    jn: float  # kg px/s
    jt: float
    limit: float  # of jt: sqrt(mu_a mu_b) * jn
    a: int  # the ref of body A
    b: int


class Simulated(Struct, frozen=True, tag="simulated"):
    frames: Annotated[list[Row], STATES]  # x, y, vx, vy, angle, omega of each watched body
    contacts: Annotated[list[Annotated[list[ContactRow], PRESENT]], STATES] = []


class Photo(Struct, frozen=True, array_like=True):
    """The window at the end of a frame."""

    frame: int
    width: int  # px
    height: int  # px
    colours: Annotated[bytes, Meta(max_length=MAX_PHOTO)]  # RGB row by row, compressed by zlib


class Played(Struct, frozen=True, tag="played"):
    """The record of a program by frame; the last entry covers the time after all frames."""

    steps: Annotated[list[int], STATES]  # that ran in each frame
    clock: Annotated[list[float], STATES]  # scripted ms since the start, at the end of each frame
    dts: Annotated[list[float], STATES]  # different step sizes, at most MAX_STEP_SIZES
    ended: Literal["returned", "stopped", "runaway"]  # stopped: it ran on after QUIT
    lines: Annotated[list[Text], Meta(max_length=MAX_LINES)]  # the last lines that it printed
    bodies: Annotated[list[BodyValue | SpaceBody], PRESENT]
    rods: Annotated[list[tuple[float, float]], PRESENT]  # present and intended length, px
    trail: Annotated[list[Row], STATES] = []
    pictures: Annotated[list[int], STATES] = []  # checksums of the window at the end of each frame
    photos: Annotated[list[Photo], Meta(max_length=MAX_PHOTOS)] = []
    paced: bool = False  # every step ran in advance(world, accumulator, frame_seconds)


Reply = Returned | Raised | Missing | Simulated | Played


class ShapeLook(Struct, frozen=True, array_like=True):
    """A disc (one point), a segment (two) or a polygon (more); px from the body's centre."""

    points: Annotated[list[tuple[float, float]], PRESENT]
    radius: float


class BodyLook(Struct, frozen=True):
    """The fixed properties of a body in a replay."""

    ref: int  # 0: no request can name it
    shapes: Annotated[list[ShapeLook], PRESENT]
    mass: float | None  # None: static
    moment: float | None


class BodyRow(Struct, frozen=True, array_like=True):
    number: int  # bodies are numbered in the order of their first moments
    x: float
    y: float
    vx: float
    vy: float
    angle: float
    omega: float


class Moment(Struct, frozen=True, array_like=True):
    """One recorded state of the bodies."""

    time: float  # s, since the request began
    steps: int  # that have run since then
    bodies: Annotated[list[BodyRow], PRESENT]
    touches: Annotated[list[ContactRow], PRESENT]
    rods: Annotated[list[tuple[float, float, float, float]], PRESENT]  # from x, y to x, y


class WithMoments(Struct, frozen=True, tag="with-moments"):
    """The reply to a recorded request, and its moments; the last shows the end."""

    reply: Reply
    looks: Annotated[dict[int, BodyLook], PRESENT]  # of new bodies, by number
    moments: Annotated[list[Moment], STATES]


class Asked(Struct, frozen=True):
    """A question; a message holds one or more, and each gets an answer of its own."""

    number: int
    request: Request | Record
    first: list[Setup] = []  # performed before it; a failure there is the answer


class Answered(Struct, frozen=True):
    number: int
    reply: Reply | WithMoments
    output: Printed = ""  # printed since the last answer


# ---------------------------------------------------------------- starting a child


class Limits(Struct, frozen=True):
    cpu_seconds: int
    memory_mb: int = 1024  # of addresses: each thread reserves many and uses few
    data_mb: int = 704  # of memory written to: 1 GB with the judge's own
    file_mb: int = 16  # each
    scratch_mb: int = 64  # all files together
    scratch_files: int = 2000
    open_files: int = 128
    processes: int = 64


class ChildSetup(Struct, frozen=True):
    submission: str  # a read-only folder, which each child copies
    scratch: str  # an empty folder for that copy and for temporary files
    limits: Limits
    confine: bool
    hidden: list[str]  # folders that must be out of reach
    bytecode: str  # a folder for compiled files
    compiles: bool  # this child fills that folder, and does nothing else
    loads: list[str] = []  # slow libraries to load before the fork
    bans: list[str] = []  # allowed modules that this check forbids
    shown: list[str] = []  # folders of the submission that the child only reads, without a copy
    programs: list[str] = []  # to compile, with the files that they name; empty for all files


class Ready(Struct, frozen=True):
    pid: int
    layers: Annotated[list[Name], PRESENT]


class Open(Struct, frozen=True, tag="open"):
    """Fork a child; the file descriptor of its channel follows."""

    setup: ChildSetup


class End(Struct, frozen=True, tag="end"):
    pid: int
    gone: bool  # the channel broke: wait for the child's own exit status


class Ended(Struct, frozen=True):
    status: int  # the exit status; a signal is negative
    cpu: float  # s of processor time used


# ---------------------------------------------------------------- the wire


class ProtocolError(Exception):
    """The other side sent something that is no message."""


# The errors of decoding; msgspec raises UnicodeDecodeError for a text that is not UTF-8.
NOT_A_MESSAGE = (ProtocolError, msgspec.DecodeError, UnicodeDecodeError, RecursionError)


class ChannelClosed(Exception):
    """The other side is gone."""


class ChannelTimeout(Exception):
    """No answer in time."""


AT_ONCE = getattr(socket, "MSG_DONTWAIT", 0)  # do not block; not on Windows


def pack_message(message: object) -> bytes:
    """Encode a message, with its length first."""
    body = msgspec.msgpack.encode(message)
    if len(body) > MAX_MESSAGE:
        raise ProtocolError(f"a message of {len(body)} bytes is longer than {MAX_MESSAGE}")
    return HEADER.pack(len(body)) + body


class Channel:
    """Sends and receives messages over a connected socket.

    An `eager` channel reads ahead, which would lose file descriptors. `send` and `receive` block;
    `flush`, `complete` and `wait` take the seconds that they may wait.
    """

    def __init__(self, sock: socket.socket, eager: bool = True) -> None:
        self.sock = sock
        self.eager = eager
        self.unread = bytearray()  # received by the channel, not by its user
        self.unsent = b""  # posted, not sent yet

    def send(self, message: object) -> None:
        try:
            self.sock.sendall(pack_message(message))
        except OSError as error:
            raise ChannelClosed(str(error)) from error

    def post(self, message: object) -> None:
        """Prepare a message for `flush` to send."""
        self.unsent = pack_message(message)

    def flush(self, seconds: float) -> bool:
        """Send the posted message for up to `seconds`; return whether all of it is sent."""
        deadline = time.monotonic() + seconds
        try:
            while self.unsent:
                with suppress(BlockingIOError):
                    self.unsent = self.unsent[self.sock.send(self.unsent, AT_ONCE) :]
                    continue
                left = deadline - time.monotonic()
                if left <= 0 or not select.select([], [self.sock], [], left)[1]:
                    return False
        except OSError as error:
            raise ChannelClosed(str(error)) from error
        return True

    def complete(self, seconds: float | None = None) -> bool:
        """Wait up to `seconds` for all of a message; return whether it is there.

        The header suffices for one too long: `receive` refuses it.
        """
        deadline = None if seconds is None else time.monotonic() + seconds
        while (missing := self._end - len(self.unread)) > 0:
            left = None if deadline is None else max(0.0, deadline - time.monotonic())
            if not self._take(1 << 16 if self.eager else missing, left):
                return False
        return True

    @property
    def _end(self) -> int:
        """Return the end of the first message, or of its header if the rest must not be read."""
        if len(self.unread) < HEADER.size:
            return HEADER.size
        (length,) = HEADER.unpack_from(self.unread)
        return HEADER.size + (length if length <= MAX_MESSAGE else 0)

    def receive(self, timeout: float | None = None) -> bytes:
        """Return the body of the next message, which must be complete within `timeout` seconds."""
        if not self.complete(timeout):
            raise ChannelTimeout
        (length,) = HEADER.unpack_from(self.unread)
        if length > MAX_MESSAGE:
            raise ProtocolError(f"a message of {length} bytes is longer than {MAX_MESSAGE}")
        body = bytes(self.unread[HEADER.size : self._end])
        del self.unread[: self._end]
        return body

    def wait(self, seconds: float) -> bool:
        """Wait up to `seconds` for anything to read; for eager channels only."""
        return bool(self.unread) or self._take(1 << 16, seconds)

    def close(self) -> None:
        self.sock.close()

    def _take(self, most: int, seconds: float | None) -> bool:
        """Read what is there; return whether anything came within `seconds`."""
        if seconds is not None and not select.select([self.sock], [], [], seconds)[0]:
            return False
        try:
            chunk = self.sock.recv(most)
        except OSError as error:
            raise ChannelClosed(str(error)) from error
        if not chunk:
            raise ChannelClosed("end of stream")
        self.unread += chunk
        return True


class InnerChannel(Channel):
    """A channel to a child without a process, which answers in this interpreter."""

    cpu: float  # s of a usual processor that the child used
    status: int  # the exit status that a process would have
