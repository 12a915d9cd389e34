"""Serve the page of a review on this machine alone."""

from collections.abc import Iterator
from contextlib import contextmanager
from http.cookies import CookieError, SimpleCookie
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Lock
from urllib.parse import parse_qsl, urlsplit

from grader.classroom.folder import ClassFolder
from grader.classroom.review import Request, Response, Review, name_cookie, refuse, respond
from grader.intake.listing import open_class

LONGEST_FORM = 100_000  # bytes
PATIENCE = 60  # s that a connection may be silent


class ReviewServer(ThreadingHTTPServer):
    """A server on a free port of this machine alone; it answers one request at a time."""

    daemon_threads = True

    def __init__(self, review: Review) -> None:
        super().__init__(("127.0.0.1", 0), Handler)
        self.review, self.lock = review, Lock()
        review.host = f"127.0.0.1:{self.server_port}"

    @property
    def address(self) -> str:
        return f"http://{self.review.host}/?token={self.review.token}"


class Handler(BaseHTTPRequestHandler):
    server: ReviewServer
    timeout = PATIENCE
    server_version, sys_version = "review", ""

    def do_GET(self) -> None:
        self.answer({})

    def do_POST(self) -> None:
        length = self.headers.get("Content-Length", "")
        if not length.isdecimal() or int(length) > LONGEST_FORM:
            self.send(refuse(413, "The form is too long."))
            return
        self.answer(read_pairs(self.rfile.read(int(length)).decode("utf-8", "replace")))

    def answer(self, form: dict[str, str]) -> None:
        parts = urlsplit(self.path)
        request = Request(
            self.command,
            parts.path,
            read_pairs(parts.query),
            form,
            self.headers.get("Host", ""),
            self.headers.get("Origin", ""),
            self.read_cookie(),
        )
        with self.server.lock:
            response = respond(self.server.review, request)
        self.send(response)

    def read_cookie(self) -> str:
        try:
            cookies = SimpleCookie(self.headers.get("Cookie", ""))
        except CookieError:
            return ""
        found = cookies.get(name_cookie(self.server.review))
        return found.value if found else ""

    def send(self, response: Response) -> None:
        body = response.body.encode("utf-8")
        self.send_response(response.status)
        for name, value in response.headers.items():
            self.send_header(name, value)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, format: str, *args: object) -> None:
        """Log nothing: an address holds the token."""


def read_pairs(text: str) -> dict[str, str]:
    return dict(parse_qsl(text, keep_blank_values=True, max_num_fields=100))


@contextmanager
def open_review(known: ClassFolder) -> Iterator[ReviewServer]:
    """Read the submitted class, and listen; raises Stop if it is not graded yet."""
    known.find_results()
    people = known.list_people()
    people.chosen = []
    with (
        open_class(known.find_submissions(), people) as intake,
        ReviewServer(Review(known, intake, people)) as server,
    ):
        yield server
