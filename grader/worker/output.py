"""Keep the end of what a submission prints, up to a bound; count and drop the rest.

An endless loop of print() must fill neither the memory nor the report.
"""

import io
import sys

from grader.protocol import MAX_OUTPUT


class Output(io.RawIOBase):
    """Takes the place of standard output and standard error alike.

    The real ones lead to /dev/null here. What is kept is text from an untrusted source: the judge
    escapes it wherever it is shown.
    """

    def __init__(self) -> None:
        self.kept = bytearray()
        self.dropped = 0

    def install(self) -> None:
        """Replace sys.stdout and sys.stderr; what cannot be encoded becomes a question mark."""
        self.text = io.TextIOWrapper(
            self,  # type: ignore[type-var]
            encoding="utf-8",
            errors="replace",
            newline="",
            write_through=True,
        )
        sys.stdout = sys.stderr = self.text

    def writable(self) -> bool:
        """Return True, as io.TextIOWrapper demands."""
        return True

    def write(self, data: bytes) -> int:  # type: ignore[override]
        """Keep the last MAX_OUTPUT bytes of all that has come since the last answer."""
        self.kept += bytes(data[-MAX_OUTPUT:])
        excess = max(0, len(self.kept) - MAX_OUTPUT)
        del self.kept[:excess]
        self.dropped += excess + max(0, len(data) - MAX_OUTPUT)
        return len(data)

    def so_far(self) -> str:
        """Return the text that is kept, and stays so."""
        return self.kept.decode("utf-8", "replace")

    def take(self) -> str:
        """Return the text for an answer, with a note on what was dropped; begins anew."""
        text = self.so_far()
        if self.dropped:
            text = f"{self.dropped} bytes and then …\n{text}"
        self.kept.clear()
        self.dropped = 0
        return text
