#!/usr/bin/env python3
"""Writes the test cubes cookies/labels.dds (24-bit RGB) and cookies/labels_dxt1.dds (DXT1), the same texels in both.

Usage: make_cookie_cube.py [--stdout NAME]    (with it, prints the file of that name instead)

Each face has a colour of its own, its name, an arrow that points to t = 0, and a square in the corner s = t = 0. A cube
map is seen from inside, where s grows to the left of who has t = 0 above: so names are stored in mirror writing, and
can be read on the walls around the light.
"""

import pathlib
import struct
import sys

SIZE = 64
SCALE = 4  # texels a side of one dot of the letters

# Red, green, blue as 5, 6 and 5 bits, which DXT1 stores exactly. What is drawn has one sixth of full intensity.
INK = (5, 10, 5)
GROUNDS = {"+X": (2, 0, 0), "-X": (0, 4, 2), "+Y": (0, 4, 0), "-Y": (2, 0, 2), "+Z": (0, 0, 2), "-Z": (2, 4, 0)}

LETTERS = {
    "+": ("     ", "  #  ", "  #  ", "#####", "  #  ", "  #  ", "     "),
    "-": ("     ", "     ", "     ", "#####", "     ", "     ", "     "),
    "X": ("#   #", " # # ", "  #  ", "  #  ", "  #  ", " # # ", "#   #"),
    "Y": ("#   #", " # # ", "  #  ", "  #  ", "  #  ", "  #  ", "  #  "),
    "Z": ("#####", "   # ", "  #  ", "  #  ", "  #  ", " #   ", "#####"),
}
ARROW = ("     #     ", "    ###    ", "   #####   ", "  #######  ")


def face(name):
    """Rows of booleans, True for ink, from t = 0 on."""
    rows = [[False] * SIZE for _ in range(SIZE)]

    def draw(dots, left, top, scale):
        for y, line in enumerate(dots):
            for x, dot in enumerate(line):
                for dy in range(scale):
                    for dx in range(scale):
                        rows[top + y * scale + dy][left + x * scale + dx] |= dot == "#"

    draw(ARROW, SIZE // 2 - 2 * len(ARROW[0]) // 2, 8, 2)
    draw(LETTERS[name[0]], 10, 24, SCALE)
    draw(LETTERS[name[1]], 34, 24, SCALE)
    draw(("#",), SIZE - 8, 0, 8)
    return [row[::-1] for row in rows]


def word(color):
    red, green, blue = color
    return red << 11 | green << 5 | blue


def bytes_of(color):
    red, green, blue = color
    return bytes((red << 3 | red >> 2, green << 2 | green >> 4, blue << 3 | blue >> 2))


def header(flags, pitch, pixel_format):
    caps, caps2 = 0x1008, 0xFE00  # complex, texture; a cube map with all faces
    return (b"DDS " + struct.pack("<7I", 124, 0x1007 | flags, SIZE, SIZE, pitch, 0, 0) + bytes(44) + pixel_format
            + struct.pack("<5I", caps, caps2, 0, 0, 0))


def uncompressed():
    out = header(0x8, 3 * SIZE, struct.pack("<2I4s5I", 32, 0x40, bytes(4), 24, 0xFF0000, 0xFF00, 0xFF, 0))
    for name, ground in GROUNDS.items():
        ink, paper = bytes_of(INK)[::-1], bytes_of(ground)[::-1]
        out += b"".join(ink if dot else paper for row in face(name) for dot in row)
    return out


def dxt1():
    out = header(0x80000, SIZE * SIZE // 2, struct.pack("<2I4s5I", 32, 0x4, b"DXT1", 0, 0, 0, 0, 0))
    for name, ground in GROUNDS.items():
        rows = face(name)
        for top in range(0, SIZE, 4):
            for left in range(0, SIZE, 4):
                codes = 0
                for i in range(16):
                    codes |= (0 if rows[top + i // 4][left + i % 4] else 1) << (2 * i)
                out += struct.pack("<2HI", word(INK), word(ground), codes)
    return out


FILES = {"labels.dds": uncompressed, "labels_dxt1.dds": dxt1}

if sys.argv[1:2] == ["--stdout"] and len(sys.argv) == 3 and sys.argv[2] in FILES:
    sys.stdout.buffer.write(FILES[sys.argv[2]]())
elif len(sys.argv) == 1:
    for file_name, make in FILES.items():
        (pathlib.Path(__file__).parent / "cookies" / file_name).write_bytes(make())
else:
    sys.exit(__doc__)
