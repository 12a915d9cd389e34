"""Stand in for Canvas on this machine: refuse requests as its documentation says."""

import json
import re
import threading
from contextlib import suppress
from email import message_from_bytes
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import parse_qs, urlsplit

TOKEN = "11~secret-token"
PAGE = 2  # submissions per page, at any requested number
HERE = "/api/v1/courses/7/assignments/9"
GRADE = re.compile(r"-?\d+(\.\d+)?%?|[A-F][+-]?|pass|fail|complete|incomplete")
FIELDS = {"submission[posted_grade]", "comment[text_comment]", "comment[file_ids][]"}
FORBIDDEN = {"status": "unauthorized", "errors": [{"message": "user not authorized"}]}


class Canvas(ThreadingHTTPServer):
    """An assignment with students; `troubles` answer the next requests, by method."""

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), Handler)
        self.begin([])
        threading.Thread(target=self.serve_forever, args=(0.01,), daemon=True).start()

    def begin(self, users: list[int]) -> None:
        """Begin an assignment that nothing was sent to yet."""
        self.users = {user: {"entered_score": None, "submission_comments": []} for user in users}
        self.files: dict[int, dict[str, object]] = {}
        self.points, self.kind, self.deducted = 10.0, "points", None
        self.troubles: list[
            tuple[str, int | str]
        ] = []  # a status, or the point where the connection is cut
        self.graded: list[int] = []  # students, in the order of requests

    @property
    def base(self) -> str:
        return f"http://127.0.0.1:{self.server_port}"


class Handler(BaseHTTPRequestHandler):
    server: Canvas

    def log_message(self, *_: object) -> None:
        pass

    def answer(self, status: int, content: object, **headers: str) -> None:
        body = json.dumps(content).encode()
        self.send_response(status)
        headers |= {"Content-Length": str(len(body)), "Content-Type": "application/json"}
        for name, value in headers.items():
            self.send_header(name.replace("_", "-"), value)
        self.end_headers()
        self.wfile.write(body)

    def handle_any(self) -> None:
        body = self.rfile.read(int(self.headers.get("Content-Length") or 0))
        url = urlsplit(self.path)
        trouble = next((each for each in self.server.troubles if each[0] == self.command), None)
        if trouble:
            self.server.troubles.remove(trouble)
        if url.path.startswith("/upload/"):
            return self.take_file(int(url.path.rpartition("/")[2]), body)
        if url.path.startswith("/done/"):  # the third step
            file = self.server.files[int(url.path.rpartition("/")[2])]
            file["whole"] = "content" in file
            return self.answer(200, {"id": file["id"], "url": self.path})
        if self.headers.get("Authorization") != f"Bearer {TOKEN}":
            header = 'Bearer realm="canvas-lms"'
            words = {"errors": [{"message": "Invalid access token."}]}
            return self.answer(401, words, WWW_Authenticate=header)
        if trouble and isinstance(trouble[1], int):
            return self.answer(trouble[1], {"errors": [{"message": "no"}]})
        if trouble and trouble[1] == "throttled":
            return self.answer(403, "403 Forbidden (Rate Limit Exceeded)")
        if trouble and trouble[1] == "lost before":
            return self.close()
        if not url.path.startswith(HERE):
            return self.answer(404, {"errors": [{"message": "The resource does not exist."}]})
        rest = url.path.removeprefix(HERE).strip("/").split("/")
        if len(rest) > 1 and int(rest[1]) not in self.server.users:
            return self.answer(403, FORBIDDEN)
        form = parse_qs(body.decode(), strict_parsing=True) if body else {}
        match self.command, rest:
            case "GET", [""]:
                kind = {"points_possible": self.server.points, "grading_type": self.server.kind}
                self.answer(200, {"id": 9, "course_id": 7, **kind})
            case "GET", ["submissions"]:
                self.list_submissions(parse_qs(url.query))
            case "POST", ["submissions", _, "comments", "files"]:
                self.announce(form)
            case "PUT", ["submissions", user]:
                self.grade(int(user), form, trouble)
            case _:
                self.answer(404, {"errors": [{"message": "The resource does not exist."}]})

    do_GET = do_POST = do_PUT = handle_any  # noqa: N815

    def close(self) -> None:
        self.close_connection = True
        with suppress(OSError):
            self.connection.shutdown(2)

    def list_submissions(self, query: dict[str, list[str]]) -> None:
        at, users = int(query.get("page", ["1"])[0]), sorted(self.server.users.items())
        listed = [{"user_id": user, "assignment_id": 9, **each} for user, each in users]
        if "submission_comments" not in query.get("include[]", []):
            listed = [each | {"submission_comments": None} for each in listed]
        link = f"{self.server.base}{HERE}/submissions?include[]=submission_comments&page="
        links = [f'<{link}{at}>; rel="current"']
        links += [f'<{link}{at + 1}>; rel="next"'] if at * PAGE < len(listed) else []
        self.answer(200, listed[(at - 1) * PAGE : at * PAGE], Link=",".join(links))

    def announce(self, form: dict[str, list[str]]) -> None:
        """Take the first step of an upload."""
        if not {"name", "size"} <= form.keys():
            return self.answer(400, {"message": "name and size are missing"})
        id = 500 + len(self.server.files)
        self.server.files[id] = {"id": id, "name": form["name"][0], "size": int(form["size"][0])}
        url = f"{self.server.base}/upload/{id}"
        self.answer(200, {"upload_url": url, "upload_params": {"key": f"k{id}"}})

    def take_file(self, id: int, body: bytes) -> None:
        """Take the second step: the parameters, and the file as the last one, without the token."""
        head = f"Content-Type: {self.headers['Content-Type']}\r\n\r\n".encode()
        parts = message_from_bytes(head + body).get_payload()
        fields = [each.get_param("name", header="content-disposition") for each in parts]
        content = parts[-1].get_payload(decode=True)
        file = self.server.files[id]
        right = fields == ["key", "file"] and len(content) == file["size"]
        if not right or "Authorization" in self.headers:
            return self.answer(400, {"message": "no such upload"})
        file["content"] = content
        self.answer(303, {}, Location=f"{self.server.base}/done/{id}")

    def grade(self, user: int, form: dict[str, list[str]], trouble: object) -> None:
        there, grade = self.server.users[user], form.get("submission[posted_grade]", [""])[0]
        ids = [int(each) for each in form.get("comment[file_ids][]", [])]
        if not form.keys() <= FIELDS | {"prefer_points_over_scheme"} or not GRADE.fullmatch(grade):
            return self.answer(400, {"error": f"invalid grade {grade!r}"})
        if not all(self.server.files.get(each, {}).get("whole") for each in ids):
            return self.answer(403, FORBIDDEN)
        files = [{"id": each, "display_name": self.server.files[each]["name"]} for each in ids]
        text = form.get("comment[text_comment]", [""])[0]
        there["submission_comments"].append({"comment": text, "attachments": files})
        there["entered_score"] = float(grade)
        self.server.graded.append(user)
        if trouble and trouble[1] == "lost after":
            return self.close()
        taken = {"points_deducted": self.server.deducted}
        self.answer(200, {"user_id": user, "assignment_id": 9, **there, **taken})
