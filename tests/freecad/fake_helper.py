"""A program in place of mashape-cad, which does what its argument says: newer, dies, deaf, many."""

import base64
import json
import struct
import sys
import time
import zlib

behaviour = sys.argv[1]


def say(**message):
    """One line."""
    print(json.dumps(message), flush=True)


def picture(number):
    """A PNG of 256 by 256 dots, no two alike."""

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    side = 256
    rows = b"".join(b"\0" + bytes((x * y * number) % 251 for x in range(side)) for y in range(side))
    header = struct.pack(">IIBBBBB", side, side, 8, 0, 0, 0, 0)
    png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    return base64.b64encode(png).decode()


say(message_type="hello", protocol=2 if behaviour == "newer" else 1, version="9.9", program="fake", pid=0)
pictures = [picture(number) for number in range(1, 6)] if behaviour == "many" else []
for line in sys.stdin:
    request = json.loads(line)
    if behaviour == "dies":
        print("last words", file=sys.stderr, flush=True)
        sys.exit(5)
    if behaviour == "deaf":
        time.sleep(1000)
    if behaviour == "many" and request["request"] == "search":
        for rank in range(1, 201):
            about = {"rank": rank, "path": f"/parts/{rank}.step", "score": 100 - rank / 2, "size_mm": [10.0, 20.0]}
            say(message_type="match", id=request["id"], thumbnail=pictures[rank % 5], **about)
        say(message_type="summary", id=request["id"], matches=200, parts=200, seconds=0.1)
