#!/usr/bin/env python3
"""Makes the textures of the effects: PNG files of small sizes, with Python's standard library alone.

    make_textures.py            writes them beside this script, into textures/
    make_textures.py --check    exits with 1 if a file is not what would be written
"""
import math
import struct
import sys
import zlib
from pathlib import Path

FOLDER = Path(__file__).resolve().parent / "textures"


def png(width, height, channels, texel):
    """The bytes of a PNG file whose samples are texel(x, y): one number or a tuple of numbers from 0 to 1."""
    rows = bytearray()
    for y in range(height):
        rows.append(0)
        for x in range(width):
            value = texel(x, y)
            for v in value if isinstance(value, tuple) else (value,):
                rows.append(math.floor(min(max(v, 0.0), 1.0) * 255 + 0.5))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(rows), 9))
            + chunk(b"IEND", b""))


def noise(x, y, cells, size):
    """Smooth noise from 0 to 1 that repeats after `size` texels and has `cells` cells on them."""
    def corner(i, j):
        n = (i % cells) * 374761393 + (j % cells) * 668265263 + cells * 1442695041
        n = ((n ^ (n >> 13)) * 1274126177) & 0xFFFFFFFF
        return (n ^ (n >> 16)) / 0xFFFFFFFF
    u, v = x * cells / size, y * cells / size
    i, j = math.floor(u), math.floor(v)
    s, t = u - i, v - j
    s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)
    top = corner(i, j) * (1 - s) + corner(i + 1, j) * s
    bottom = corner(i, j + 1) * (1 - s) + corner(i + 1, j + 1) * s
    return top * (1 - t) + bottom * t


def stone(x, y):
    return sum(noise(x, y, 4 << o, 128) / (2 << o) for o in range(4))


def brick_place(x, y):
    """The brick of a texel: its row, its number in the row, and the distance to the nearest joint, in texels."""
    row, v = divmod(y, 16)
    number, u = divmod((x + (16 if row % 2 else 0)) % 128, 32)
    return row, number, min(u, 31 - u, v, 15 - v)


def bricks(x, y):
    _, _, inside = brick_place(x, y)
    return min(inside / 3.0, 1.0) * 0.7 + 0.25 * stone(x, y)


def brick_color(x, y):
    row, number, inside = brick_place(x, y)
    if inside < 1:
        return (0.62, 0.6, 0.56)
    tone = 0.75 + 0.25 * noise(row * 29 + number * 53, row * 7, 16, 128) + 0.15 * (stone(x, y) - 0.5)
    return (0.66 * tone, 0.3 * tone, 0.22 * tone)


def rivets(x, y):
    u, v = x % 32 - 15.5, y % 32 - 15.5
    return math.sqrt(max(0.0, 1.0 - (u * u + v * v) / 64.0)) * 0.8 + 0.1


def gloss(x, y):
    return (0.55, 0.57, 0.6, 1.0 if math.hypot(x % 32 - 15.5, y % 32 - 15.5) < 9 else 0.35)


def detail(x, y):
    return 0.5 + 0.5 * (stone(x, y) - 0.5)


def light_map(x, y):
    lamp = max(0.0, 1.0 - math.hypot(x - 20, y - 12) / 44.0)
    return (0.25 + 0.6 * lamp, 0.25 + 0.5 * lamp, 0.3 + 0.3 * lamp)


def photograph(x, y):
    """A landscape at sunset, 256 x 256, that stands for a photograph."""
    s, t = x / 256, y / 256
    sky = (0.2 + 0.7 * t, 0.3 + 0.35 * t, 0.75 - 0.25 * t)
    if math.hypot(s - 0.68, t - 0.42) < 0.09:
        return (1.0, 0.93, 0.7)
    ridges = ((0.55, 4, (0.42, 0.36, 0.5)), (0.68, 6, (0.25, 0.3, 0.3)), (0.82, 9, (0.2, 0.35, 0.15)))
    for height, cells, color in reversed(ridges):
        if t > height + 0.16 * (noise(x, 17 * cells, cells, 256) - 0.5) + 0.04 * (noise(x, 91, 32, 256) - 0.5):
            return tuple(c * (0.7 + 0.6 * stone(x % 128, y % 128)) for c in color)
    return sky


def cookie(x, y):
    r = math.hypot(x - 63.5, y - 63.5) / 64.0
    bars = 0.15 if abs(x - 63.5) < 3 or abs(y - 63.5) < 3 else 1.0
    ring = max(0.0, min(1.0, (0.92 - r) * 12))
    return (ring * bars, ring * bars * 0.95, ring * bars * 0.8)


# The axes s, t and outward of the faces +X, -X, +Y, -Y, +Z, -Z of a cube map.
FACES = {
    "px": ((0, 0, -1), (0, -1, 0), (1, 0, 0)), "nx": ((0, 0, 1), (0, -1, 0), (-1, 0, 0)),
    "py": ((1, 0, 0), (0, 0, 1), (0, 1, 0)), "ny": ((1, 0, 0), (0, 0, -1), (0, -1, 0)),
    "pz": ((1, 0, 0), (0, -1, 0), (0, 0, 1)), "nz": ((-1, 0, 0), (0, -1, 0), (0, 0, -1)),
}


def sky(face, x, y):
    """The sky in the direction of a texel of 64 x 64: blue above, earth below, and a sun."""
    s, t, out = FACES[face]
    u, v = (x + 0.5) / 32 - 1, (y + 0.5) / 32 - 1
    direction = [out[i] + u * s[i] + v * t[i] for i in range(3)]
    length = math.sqrt(sum(d * d for d in direction))
    dx, dy, dz = (d / length for d in direction)
    if -0.5 * dx + 0.6 * dy + 0.62 * dz > 0.985:
        return (1.0, 1.0, 0.9)
    if dy > 0:
        return (0.75 - 0.6 * dy, 0.85 - 0.5 * dy, 0.95 - 0.2 * dy)
    return (0.42 + 0.25 * dy, 0.36 + 0.22 * dy, 0.28 + 0.18 * dy)


def packed(x, y):
    """Two pictures of sixteen levels in one byte: the photograph's brightness in the high nibble, bricks in the low."""
    red, green, blue = photograph(2 * x, 2 * y)
    high = min(15, math.floor((0.3 * red + 0.59 * green + 0.11 * blue) * 16))
    low = min(15, math.floor(bricks(x, y) * 16))
    return (16 * high + low) / 255


def waves(x, y):
    """Waves of six directions that repeat after 128 texels."""
    u, v = 2 * math.pi * x / 128, 2 * math.pi * y / 128
    sums = ((1, 2, 0.0, 3), (2, 1, 1.7, 3), (-3, 2, 0.4, 2), (4, 3, 2.9, 1.5), (-5, 5, 4.1, 1), (7, -2, 5.2, 0.8))
    return 0.5 + sum(a * math.sin(i * u + j * v + phase) for i, j, phase, a in sums) / 24


def plasma(x, y):
    """Two smooth fields: alpha, which repeats the palette, and red, which picks the palette's row."""
    u, v = 2 * math.pi * x / 256, 2 * math.pi * y / 256
    first = math.sin(u + 1.5 * math.sin(v)) + math.sin(2 * v - math.cos(u)) + math.sin(u + v + math.sin(2 * u - v))
    second = math.sin(v - u + 0.8 * math.sin(2 * v))
    return (0.5 + 0.45 * second, 0.0, 0.0, 0.5 + first / 6.4)


def palette(x, y):
    """Embers in the first row, sea in the last, and what lies between; bands of sixteen along each row."""
    s, t = x / 255, y / 31
    ember = (min(1.0, 2.2 * s), max(0.0, 1.7 * s - 0.5), max(0.0, 3 * s - 2.2))
    sea = (max(0.0, 2 * s - 1.1), 0.15 + 0.8 * s * s, 0.3 + 0.65 * math.sqrt(s))
    band = 1.0 if x % 16 > 1 else 0.55
    return tuple(band * ((1 - t) * a + t * b) for a, b in zip(ember, sea))


def material(x, y):
    """A lacquer: its colour by N . L along the row, turning from red to violet, and a gloss by N . H up the column."""
    light, half = x / 63, y / 63
    base = (0.1 + 0.62 * light, 0.02 + 0.12 * light * light, 0.16 + 0.2 * light * (1 - light))
    ring = math.exp(-((half - 0.82) / 0.05) ** 2)
    gloss = half ** 24 * min(1.0, 3 * light)
    return tuple(min(1.0, b + 0.25 * ring * light * c + gloss) for b, c in zip(base, (1.0, 0.6, 0.3)))


def ball_place(x, y):
    u, v = (x - 63.5) / 60.0, (y - 63.5) / 60.0
    return u, v, math.sqrt(max(0.0, 1.0 - u * u - v * v))


def ball_height(x, y):
    return ball_place(x, y)[2]


def ball(x, y):
    """A lit ball, white, with its outline in alpha."""
    u, v, w = ball_place(x, y)
    light = max(0.0, -0.45 * u - 0.55 * v + 0.7 * w)
    shine = 0.35 * max(0.0, -0.24 * u - 0.3 * v + 0.92 * w) ** 40
    tone = min(1.0, 0.22 + 0.62 * light + shine)
    return (tone, tone, tone, 1.0 if w > 0.0 else 0.0)


def keyed_ball(x, y):
    """The ball with 32 texels a side, on the colour of a key."""
    *tone, inside = ball(4 * x + 1.5, 4 * y + 1.5)
    return tuple(tone) if inside else (1.0, 0.0, 1.0)


def light_from(face, x, y):
    """The light that a surface receives whose normal points to a texel of 16 x 16: sky, earth and sun, spread out."""
    s, t, out = FACES[face]
    u, v = (x + 0.5) / 8 - 1, (y + 0.5) / 8 - 1
    direction = [out[i] + u * s[i] + v * t[i] for i in range(3)]
    length = math.sqrt(sum(d * d for d in direction))
    dx, dy, dz = (d / length for d in direction)
    sun, up = max(0.0, -0.5 * dx + 0.6 * dy + 0.62 * dz), 0.5 + 0.5 * dy
    return (0.2 + 0.25 * up + 0.55 * sun, 0.18 + 0.32 * up + 0.5 * sun, 0.15 + 0.5 * up + 0.35 * sun)


TEXTURES = {
    "bricks_height.png": lambda: png(128, 128, 1, bricks),
    "bricks.png": lambda: png(128, 128, 3, brick_color),
    "rivets_height.png": lambda: png(128, 128, 1, rivets),
    "rivets.png": lambda: png(128, 128, 4, gloss),
    "stone_height.png": lambda: png(128, 128, 1, stone),
    "detail.png": lambda: png(128, 128, 1, detail),
    "light_map.png": lambda: png(64, 64, 3, light_map),
    "photograph.png": lambda: png(256, 256, 3, photograph),
    "packed.png": lambda: png(128, 128, 1, packed),
    "cookie.png": lambda: png(128, 128, 3, cookie),
    "waves_height.png": lambda: png(128, 128, 1, waves),
    "plasma.png": lambda: png(256, 256, 4, plasma),
    "palette.png": lambda: png(256, 32, 3, palette),
    "material.png": lambda: png(64, 64, 3, material),
    "ball_height.png": lambda: png(128, 128, 1, ball_height),
    "ball.png": lambda: png(128, 128, 4, ball),
    "keyed_ball.png": lambda: png(32, 32, 3, keyed_ball),
    **{f"light_{face}.png": (lambda face=face: png(16, 16, 3, lambda x, y: light_from(face, x, y))) for face in FACES},
    **{f"sky_{face}.png": (lambda face=face: png(64, 64, 3, lambda x, y: sky(face, x, y))) for face in FACES},
}


def main():
    if "--check" in sys.argv[1:]:
        wrong = [name for name, make in TEXTURES.items() if (FOLDER / name).read_bytes() != make()]
        for name in wrong:
            print(f"{FOLDER / name}: is not what make_textures.py writes", file=sys.stderr)
        return 1 if wrong else 0
    FOLDER.mkdir(exist_ok=True)
    for name, make in TEXTURES.items():
        (FOLDER / name).write_bytes(make())
    return 0


if __name__ == "__main__":
    sys.exit(main())
