"""Define the messages between the judge and the worker's children: all that both sides share.

Everything that crosses is plain data in MessagePack, decoded into the strict types below: a number
stays a number, a bool is never one, and an unknown shape is a `ProtocolError`. A message is framed
by its length (4 bytes, big-endian).
"""

import select
import socket
import struct
import time
from contextlib import suppress
from typing import Annotated, Literal

import msgspec
from msgspec import Meta, Struct

MAX_MESSAGE = 1024 * 1024  # bytes; a longer one is refused unread; usual are up to 250 KB
RUNAWAY = 2000  # steps in one frame at which a program is stopped
MAX_BODIES, MAX_TOUCHES, MAX_RODS = 80, 120, 20  # in one moment
HEADER = struct.Struct(">I")

# What every child finds in its environment, whatever stood in ours: a window that nobody sees,
# sets in the same order each time, English, and one clock.
ENVIRONMENT = {
    "SDL_VIDEODRIVER": "dummy",
    "SDL_AUDIODRIVER": "dummy",
    "PYGAME_HIDE_SUPPORT_PROMPT": "1",
    "PYTHONHASHSEED": "0",
    "LANG": "C.UTF-8",
    "TZ": "UTC",
    "OPENBLAS_NUM_THREADS": "1",  # or numpy wants memory for each core that there is
}

# ---------------------------------------------------------------- texts

# Each text has a greatest length, and a message with a longer one is none: what a child sends is
# kept, written and shown, so its length would be multiplied. A child of ours cuts its texts before.
MAX_NAME, MAX_TEXT = 200, 2000  # characters
MAX_PRINTED = 65 * 1024  # of one answer
MAX_LINES = 200  # that a program printed
MAX_OUTPUT = 64 * 1024  # bytes kept of what is printed before an answer, and characters of a check
MAX_STEP_SIZES = 16  # different ones that a play reports
MAX_PHOTOS, MAX_PHOTO = 5, 150 * 1024  # bytes of each; usual are 15 KB
MAX_FRAMES = 12  # functions that an error went through
MAX_LINE = 16 * 1024 * 1024  # a line's number: a file has no more bytes

Name = Annotated[str, Meta(max_length=MAX_NAME)]
Text = Annotated[str, Meta(max_length=MAX_TEXT)]
Printed = Annotated[str, Meta(max_length=MAX_PRINTED)]

# And each list has a greatest length: what is done with it may take the square of that. Of what the
# solution sends and the scenes hold, each is four times the most, or more.
MAX_PRESENT = 400  # bodies, shapes, rods or contacts at one moment; 49 in the scene
MAX_STATES = 4000  # steps or frames of one request, in order; 600 of a program, and RUNAWAY more
MAX_ITEMS = 4000  # entries of a list that a function returns; 1000 states of an integrator

PRESENT, STATES = Meta(max_length=MAX_PRESENT), Meta(max_length=MAX_STATES)
ITEMS, NUMBERS = Meta(max_length=MAX_ITEMS), Meta(max_length=6 * MAX_PRESENT)
Row = Annotated[list[float], NUMBERS]  # six numbers for each body


def cut(text: str, most: int) -> str:
    """Return a text of at most `most` characters; its last one shows that some are missing.

    Halves of letters, which no message can hold, become their numbers.
    """
    text = text[: most + 1].encode(errors="backslashreplace").decode()
    return text if len(text) <= most else f"{text[: most - 1]}…"


# ---------------------------------------------------------------- values


class Vec(Struct, frozen=True, tag="vec"):
    """A pair of numbers, in px or px/s; also any returned pair, such as (x, v)."""

    x: float
    y: float

    def __iter__(self):  # type: ignore[no-untyped-def]
        return iter((self.x, self.y))


class Ref(Struct, frozen=True, tag="ref"):
    """An object that lives in the child; `kind` is its type's name."""

    id: int
    kind: Name = ""


class Items(Struct, frozen=True, tag="items"):
    items: "Annotated[list[Value], ITEMS]"


class BodyValue(Struct, frozen=True, tag="body"):
    """A lesson body as the child shows it: px, px/s, rad, rad/s."""

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
    solid: bool = True  # whether it pushes all others: no sensor, no filter


class SpaceBody(Struct, frozen=True, tag="space_body"):
    """A pymunk body, or the space's static body with the shapes on it."""

    ref: int
    kind: Literal["dynamic", "kinematic", "static"]
    pos: Vec
    vel: Vec
    angle: float
    omega: float
    mass: float
    moment: float | None  # None where pymunk says infinity
    shapes: Annotated[list[ShapeValue], PRESENT]


class SpaceJoint(Struct, frozen=True):
    kind: Name
    a: int
    b: int
    anchor_a: Vec | None  # in world coordinates
    anchor_b: Vec | None
    distance: float | None
    reach: tuple[float, float] | None = None  # px, between which a slide joint keeps its ends


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
    """Becomes `random.Random(seed)` in the child."""

    seed: int


Argument = None | bool | int | float | str | Vec | Ref | Rng

# ---------------------------------------------------------------- judge to child


class Piece(Struct, frozen=True):
    """One function of the reference, to stand in for the submission's own."""

    target: str  # module:name or module:Class.method
    source: str
    imports: str
    parameters: list[str]
    names: list[str]  # the globals it reads, beyond its imports
    given: dict[str, str] = {}  # given functions that it calls, for a submission without them
    asked: str = ""  # what the check is about, which stays, also where it has this name, too


class Import(Struct, frozen=True, tag="import"):
    module: str
    pieces: list[Piece] = []
    watched: bool = False  # so that it can be asked what was kept since; see Remembered
    deal: int = 0  # added to the seed of each random.Random: other balls than usual


class Remembered(Struct, frozen=True, tag="remembered"):
    """Ask for the names in the submission that hold something else than after the import."""


class Call(Struct, frozen=True, tag="call"):
    """`target` is module:name, or #id.method for an object of the child."""

    target: str
    args: list[Argument] = []
    kwargs: dict[str, Argument] = {}
    work: bool = False  # count the lines of the submission that run meanwhile
    framed: bool = False  # tell what it changed of what is around it
    twice: bool = False  # ask again at once: an answer may hang on nothing but the arguments
    stepping: bool = False  # count the steps of the world that it is given; none of them is run
    states: list[int] = []  # the objects whose state afterwards comes with the answer


class Get(Struct, frozen=True, tag="get"):
    ref: int
    name: str = ""  # empty: the object itself


class Set(Struct, frozen=True, tag="set"):
    ref: int
    fields: dict[str, Argument]


class MakeBody(Struct, frozen=True, tag="make_body"):
    """A lesson body in one go: its shape, the Body around it, then further fields."""

    ref: int  # what it is to be called
    module: str
    shape: Literal["Circle", "Box"]
    size: float | Vec  # radius or half extents
    pos: Vec
    mass: float
    kwargs: dict[str, float] = {}
    fields: dict[str, Argument] = {}


class MakeWorld(Struct, frozen=True, tag="make_world"):
    """A lesson world with bodies added and joints appended.

    `bonus`: the world that the bonus tasks attach to, where the submission has one of its own.
    """

    ref: int  # what it is to be called
    module: str
    gravity: Vec
    linear_damping: float
    angular_damping: float
    bodies: list[int] = []
    joints: list[int] = []
    bonus: bool = False


class Simulate(Struct, frozen=True, tag="simulate"):
    """Call `step(dt)` on an object `steps` times; record the watched bodies each `every` steps."""

    ref: int
    dt: float
    steps: int
    watch: list[int]
    every: int = 1
    contacts: bool = False


class Integrate(Struct, frozen=True, tag="integrate"):
    """Call an integrator `steps` times, each time with the (x, v) that it answered last."""

    target: str  # module:name
    x: float
    v: float
    dt: float
    force: list[float]  # accel(x), a polynomial in x, lowest power first
    steps: int = 1
    twice: bool = False  # ask again at once, and look at what is around it
    places: bool = False  # answer with the places at which accel was asked


class Event(Struct, frozen=True):
    """An input of a person, after `frame` frames, at least one."""

    frame: int
    kind: Literal["click", "key"]
    pos: tuple[int, int] = (0, 0)
    button: int = 1  # of the mouse: 1 is the left one, 4 a turn of the wheel
    key: str = ""
    held: str = ""  # keys that are held meanwhile, such as "left shift" or "left shift+left ctrl"


class Play(Struct, frozen=True, tag="play"):
    """Run a program headless: one entry of `frames` per frame, its length in whole ms."""

    module: str
    frames: list[int]
    events: list[Event] = []
    physics: bool = True  # False: steps are counted and not run
    trail_every: int = 0  # record every moving body after each so many steps; 0 = never
    pictures: bool = False  # False: next to nothing is drawn
    photos: list[int] = []  # the frames at whose end the window is photographed
    step_ms: float = 0.0  # how long each step takes on the scripted clock


Setup = Set | MakeBody | MakeWorld  # what needs no answer of its own
Request = (
    Import | Remembered | Call | Get | Set | MakeBody | MakeWorld | Simulate | Integrate | Play
)


class Record(Struct, frozen=True, tag="record"):
    """Answer a request and record the bodies meanwhile: for replays, once marks are decided."""

    request: Request
    most: int  # moments; of more steps or frames only some are taken
    cut: bool = False  # a new scene: what was made before is not shown any more


# ---------------------------------------------------------------- child to judge


class Change(Struct, frozen=True, array_like=True):
    """Something that a call left otherwise than it found it.

    `ref` is an object of the child; for an argument it is minus its number; for a constant 0.
    """

    ref: int
    name: Name


class Returned(Struct, frozen=True, tag="returned"):
    value: Value
    lines: int = 0  # that ran, where they were to be counted; one that ran twice counts twice
    changed: Annotated[list[Change], ITEMS] = []
    again: Value = None  # the second answer, where two were asked for
    steps: int = 0  # of worlds, where they were to be counted
    dts: Annotated[list[float], STATES] = []  # their different sizes
    # Of the objects that were asked about; None where one cannot be told.
    states: Annotated[list[Value], ITEMS] = []


class CodeLine(Struct, frozen=True):
    file: Text
    line: Annotated[int, Meta(ge=0, le=MAX_LINE)]
    function: Name
    text: Text


class Raised(Struct, frozen=True, tag="raised"):
    error: Name
    message: Text
    # The student's own frames, outermost first.
    frames: Annotated[list[CodeLine], Meta(max_length=MAX_FRAMES)]


class Missing(Struct, frozen=True, tag="missing"):
    """A name or file that the contract asks for is not there."""

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
    """The window when a frame ended; nothing where no frame was shown."""

    frame: int
    width: int  # px
    height: int  # px
    colours: Annotated[bytes, Meta(max_length=MAX_PHOTO)]  # RGB row by row, compressed by zlib


class Played(Struct, frozen=True, tag="played"):
    """The record of a program, frame by frame; the last entry covers what came after."""

    steps: Annotated[list[int], STATES]  # fixed steps that ran in each frame
    # The scripted time when they had run, ms since the start.
    clock: Annotated[list[float], STATES]
    dts: Annotated[list[float], STATES]  # the different step sizes seen, at most 16 of them
    ended: Literal["returned", "stopped", "runaway"]  # stopped: it ran on after QUIT
    lines: Annotated[list[Text], Meta(max_length=MAX_LINES)]  # what it printed, the last of them
    bodies: Annotated[list[BodyValue | SpaceBody], PRESENT]
    rods: Annotated[list[tuple[float, float]], PRESENT]  # distance now, length meant; px
    trail: Annotated[list[Row], STATES] = []
    # A checksum of what the window showed when each frame ended.
    pictures: Annotated[list[int], STATES] = []
    photos: Annotated[list[Photo], Meta(max_length=MAX_PHOTOS)] = []
    paced: bool = False  # every step ran in advance(world, accumulator, frame_seconds)


Reply = Returned | Raised | Missing | Simulated | Played


class ShapeLook(Struct, frozen=True, array_like=True):
    """One point is a disc, two are a segment, more are a polygon; px from the body's centre."""

    points: Annotated[list[tuple[float, float]], PRESENT]
    radius: float


class BodyLook(Struct, frozen=True):
    """The fixed properties of a body that is shown."""

    ref: int  # 0 where no request can name it
    shapes: Annotated[list[ShapeLook], PRESENT]
    mass: float | None  # None: static
    moment: float | None


class BodyRow(Struct, frozen=True, array_like=True):
    number: int  # bodies are numbered as they come into the picture
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
    """The reply to a recorded request, and its moments: the last one shows how it ended."""

    reply: Reply
    looks: Annotated[dict[int, BodyLook], PRESENT]  # by number, of the bodies that are new
    moments: Annotated[list[Moment], STATES]


class Asked(Struct, frozen=True):
    number: int
    request: Request | Record
    first: list[Setup] = []  # to be done before it; what fails there is the answer


class Answered(Struct, frozen=True):
    number: int
    reply: Reply | WithMoments
    output: Printed = ""  # what the submission printed since the last answer, cut to a bound


# ---------------------------------------------------------------- starting a child


class Limits(Struct, frozen=True):
    cpu_seconds: int
    memory_mb: int = 1024  # of addresses: each thread takes many and uses few
    data_mb: int = 704  # of memory that it writes to: with the judge's own it makes 1 GB
    file_mb: int = 16  # each
    scratch_mb: int = 64  # all files together
    scratch_files: int = 2000
    open_files: int = 128
    processes: int = 64


class ChildSetup(Struct, frozen=True):
    submission: str  # the read-only copy, from which each child takes one of its own
    scratch: str  # an empty folder, for that copy and for temporary files
    limits: Limits
    confine: bool
    hidden: list[str]  # folders that must be out of reach
    bytecode: str  # a folder for compiled files
    compiles: bool  # whether this child fills that folder, and does nothing else
    loads: list[str] = []  # libraries that are slow to load, to be loaded before the fork
    bans: list[str] = []  # modules that it may import elsewhere, and not here
    shown: list[str] = []  # folders of the submission that it only reads: it needs no copy of them


class Ready(Struct, frozen=True):
    pid: int
    layers: Annotated[list[Name], PRESENT]


class Open(Struct, frozen=True, tag="open"):
    """Fork a child; the file descriptor of its channel follows."""

    setup: ChildSetup


class End(Struct, frozen=True, tag="end"):
    pid: int
    gone: bool  # the channel broke: let it finish dying, so that its own exit status is seen


class Ended(Struct, frozen=True):
    status: int  # the exit status; a signal is negative
    cpu: float  # s of processor time used


# ---------------------------------------------------------------- the wire


class ProtocolError(Exception):
    """The other side sent something that is not a message of ours."""


# What decoding can raise: text that is not UTF-8 is no DecodeError to msgspec.
NOT_A_MESSAGE = (ProtocolError, msgspec.DecodeError, UnicodeDecodeError, RecursionError)


class ChannelClosed(Exception):
    """The other side is gone."""


class ChannelTimeout(Exception):
    """No answer in time."""


AT_ONCE = getattr(socket, "MSG_DONTWAIT", 0)  # as much as there is room for; not on Windows


def packed(message: object) -> bytes:
    """Return a message as it is sent, its length first."""
    body = msgspec.msgpack.encode(message)
    if len(body) > MAX_MESSAGE:
        raise ProtocolError(f"a message of {len(body)} bytes is longer than {MAX_MESSAGE}")
    return HEADER.pack(len(body)) + body


class Channel:
    """Send and receive framed messages over a connected socket.

    `eager` reads ahead; leave it off where file descriptors travel. `send` and `receive` block;
    `post`, `gone` and `complete` do not wait longer than told.
    """

    def __init__(self, sock: socket.socket, eager: bool = True) -> None:
        self.sock = sock
        self.eager = eager
        self.ahead = bytearray()  # read already, not asked for yet
        self.behind = b""  # posted, not sent yet

    def send(self, message: object) -> None:
        try:
            self.sock.sendall(packed(message))
        except OSError as error:
            raise ChannelClosed(str(error)) from error

    def post(self, message: object) -> None:
        """Have a message ready, to be sent by `gone`."""
        self.behind = packed(message)

    def gone(self, seconds: float) -> bool:
        """Send what was posted, for `seconds` at most; return whether all of it is sent."""
        deadline = time.monotonic() + seconds
        try:
            while self.behind:
                with suppress(BlockingIOError):
                    self.behind = self.behind[self.sock.send(self.behind, AT_ONCE) :]
                    continue
                left = deadline - time.monotonic()
                if left <= 0 or not select.select([], [self.sock], [], left)[1]:
                    return False
        except OSError as error:
            raise ChannelClosed(str(error)) from error
        return True

    def complete(self, seconds: float | None = None) -> bool:
        """Return whether all of a message is there, after `seconds` at the latest.

        Stop waiting once it is too long: `receive` refuses it.
        """
        deadline = None if seconds is None else time.monotonic() + seconds
        while (missing := self._end - len(self.ahead)) > 0:
            left = None if deadline is None else max(0.0, deadline - time.monotonic())
            if not self._take(1 << 16 if self.eager else missing, left):
                return False
        return True

    @property
    def _end(self) -> int:
        """Return where the first message ends; or its header, while that is missing or says too
        much.
        """
        if len(self.ahead) < HEADER.size:
            return HEADER.size
        (length,) = HEADER.unpack_from(self.ahead)
        return HEADER.size + (length if length <= MAX_MESSAGE else 0)

    def receive(self, timeout: float | None = None) -> bytes:
        """Return the body of the next message; `timeout` in seconds is for the whole of it."""
        if not self.complete(timeout):
            raise ChannelTimeout
        (length,) = HEADER.unpack_from(self.ahead)
        if length > MAX_MESSAGE:
            raise ProtocolError(f"a message of {length} bytes is longer than {MAX_MESSAGE}")
        body = bytes(self.ahead[HEADER.size : self._end])
        del self.ahead[: self._end]
        return body

    def wait(self, seconds: float) -> bool:
        """Return whether there is something to read, after `seconds` at the latest.

        For eager channels only: what is there is taken in at once.
        """
        return bool(self.ahead) or self._take(1 << 16, seconds)

    def close(self) -> None:
        self.sock.close()

    def _take(self, most: int, seconds: float | None) -> bool:
        """Take in what is there; return whether anything came within `seconds`."""
        if seconds is not None and not select.select([self.sock], [], [], seconds)[0]:
            return False
        try:
            chunk = self.sock.recv(most)
        except OSError as error:
            raise ChannelClosed(str(error)) from error
        if not chunk:
            raise ChannelClosed("end of stream")
        self.ahead += chunk
        return True


class InnerChannel(Channel):
    """A channel to a child that has no process: it answers on this side of the channel."""

    cpu: float  # s of a usual processor that the child used
    status: int  # the exit status of a process in its place
