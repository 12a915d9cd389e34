"""Drive Debian's Firefox, without a window, by WebDriver BiDi."""

import itertools
import json
import re
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

LISTENS = re.compile(r"WebDriver BiDi listening on (ws://\S+)")
PATIENCE = 600  # s, enough for a busy machine
SETTINGS = {
    "browser.download.folderList": 2,  # the folder named below
    "browser.download.alwaysOpenPanel": False,
    "browser.shell.checkDefaultBrowser": False,
    "datareporting.policy.dataSubmissionEnabled": False,
    "network.proxy.no_proxies_on": "",
}


class Firefox:
    """One tab of a browser."""

    def __init__(self, socket: Any, downloads: Path) -> None:
        self.socket, self.downloads = socket, downloads
        self.numbers = itertools.count(1)
        self.send("session.new", capabilities={})
        self.tab = self.send("browsingContext.getTree")["contexts"][0]["context"]

    def send(self, method: str, **params: Any) -> Any:
        """Return the result of a command; skip events."""
        number = next(self.numbers)
        self.socket.send(json.dumps({"id": number, "method": method, "params": params}))
        while (answer := json.loads(self.socket.recv())).get("id") != number:
            pass
        assert answer["type"] == "success", f"{method}: {answer.get('message')}"
        return answer["result"]

    def open(self, address: str) -> None:
        self.send("browsingContext.navigate", context=self.tab, url=address, wait="complete")

    def run(self, script: str) -> Any:
        """Return the value of an expression, or of its promise, as JSON."""
        done = self.send(
            "script.evaluate",
            expression=f"(async () => JSON.stringify((await ({script})) ?? null))()",
            target={"context": self.tab},
            awaitPromise=True,
        )
        assert done["type"] == "success", done["exceptionDetails"]["text"]
        return json.loads(done["result"]["value"])

    def wait_until(self, script: str) -> None:
        """Wait until an expression is true; the page may load anew meanwhile."""
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            try:
                if self.run(script):
                    return
            except AssertionError as error:
                if "evaluate" not in str(error):
                    raise
            time.sleep(0.1)
        raise AssertionError(f"never true: {script}")

    def press(self, *keys: str, held: str = "") -> None:
        """Press and release keys in turn while another one is held."""
        acts = [{"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")]
        if held:
            acts = [
                {"type": "keyDown", "value": held},
                *acts,
                {"type": "keyUp", "value": held},
            ]
        source = {"type": "key", "id": "keys", "actions": acts}
        self.send("input.performActions", context=self.tab, actions=[source])

    def wait_for_download(self, name: str) -> Path:
        """Return a file that the page saves."""
        deadline = time.monotonic() + PATIENCE
        path = self.downloads / name
        while time.monotonic() < deadline:
            if path.is_file() and path.stat().st_size and not list(self.downloads.glob("*.part")):
                return path
            time.sleep(0.1)
        raise AssertionError(f"{name} was never saved")


@contextmanager
def firefox(folder: Path) -> Iterator[Firefox]:
    """Start it with a profile of its own in `folder`, and end it."""
    websocket = pytest.importorskip(
        "websocket", reason="needs websocket-client, of the extra `notebooks`"
    )
    program = shutil.which("firefox-esr") or shutil.which("firefox")
    if program is None:
        pytest.skip("needs Firefox on the PATH, to open a page as a person would")
    profile, downloads = folder / "profile", folder / "downloads"
    profile.mkdir(parents=True)
    downloads.mkdir()
    settings = {**SETTINGS, "browser.download.dir": str(downloads)}
    lines = [f"user_pref({json.dumps(n)}, {json.dumps(v)});\n" for n, v in settings.items()]
    (profile / "user.js").write_text("".join(lines), encoding="utf-8")
    command = [program, "--headless", "--remote-debugging-port", "0", "--profile", str(profile)]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr
        try:
            address = next(filter(None, map(LISTENS.search, process.stderr)))[1]
            socket = websocket.create_connection(
                f"{address}/session", timeout=PATIENCE, suppress_origin=True
            )
            yield Firefox(socket, downloads)
        finally:
            process.kill()
