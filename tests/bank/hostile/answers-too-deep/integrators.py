"""Answers, while it is being imported, with a list in a list in a list ..."""

import os
import struct

DEEP = b"\x82\xa4type\xa5items\xa5items\x91" * 100_000 + b"\xc0"
BODY = b"\x82\xa6number\x01\xa5reply\x82\xa4type\xa8returned\xa5value" + DEEP

for descriptor in range(3, 256):
    try:
        message = struct.pack(">I", len(BODY)) + BODY
        while message:
            message = message[os.write(descriptor, message) :]
    except OSError:
        pass
os._exit(0)
