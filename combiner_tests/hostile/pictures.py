"""Pictures of 8 by 8 pixels as trees of fields, one function for each file format."""
import struct
import zlib

from fields import Blob, Group, Num, numbers, text

SIDE = 8


def pixels(channels):
    """Rows of bytes, with runs for what packs them."""
    return [bytes((x // 3 * 40 + y * 8 + c * 60) % 256 for x in range(SIDE) for c in range(channels))
            for y in range(SIDE)]


def png(random):
    def chunk(kind, *items):
        return Group([Group([Blob(kind), *items], lambda body, size: struct.pack(">I", (size - 4) & 0xffffffff) + body
                            + struct.pack(">I", zlib.crc32(body)))])

    kind, channels = random.choice([(0, 1), (2, 3), (3, 1), (4, 2), (6, 4)])
    rows = zlib.compress(b"".join(bytes([random.randrange(5)]) + row for row in pixels(channels)))
    head = chunk(b"IHDR", *numbers(">I", SIDE, SIDE), *numbers("B", 8, kind, 0, 0, random.choice([0, 0, 0, 1])))
    extra = [chunk(b"gAMA", Num(">I", 45455)), chunk(b"iCCP", text("a\0\0"), Blob(zlib.compress(b"a" * 200))),
             chunk(b"tEXt", text("Title\0a picture")), chunk(b"tRNS", Blob(bytes(6))),
             chunk(b"eXIf", Blob(b"MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x01\0\0\0\0\0\0")),
             chunk(b"zTXt", text("a\0\0"), Blob(zlib.compress(b"a" * 100)))]
    palette = [chunk(b"PLTE", Blob(bytes(range(256)) * 3))] if kind == 3 else []
    return Group([Blob(b"\x89PNG\r\n\x1a\n"), head, *palette, *random.sample(extra, 2), chunk(b"IDAT", Blob(rows)),
                  chunk(b"IEND")])


def bmp(random):
    bits, compression = random.choice([(24, 0), (32, 0), (8, 0), (4, 0), (8, 1), (16, 3), (1, 0)])
    palette = [Blob(bytes(range(256)) * 4)] if bits <= 8 else []
    size = (SIDE * bits + 31) // 32 * 4
    rows = b"".join(row[:size].ljust(size, b"\0") for row in pixels(4))
    if compression == 1:
        rows = b"".join(b"\x08" + bytes([y]) + b"\0\0" for y in range(SIDE)) + b"\0\x01"
    start = 54 + (1024 if palette else 0)
    return Group([Blob(b"BM"), *numbers("<I", start + len(rows), 0, start), *numbers("<I", 40),
                  *numbers("<i", SIDE, SIDE),
                  *numbers("<H", 1, bits), *numbers("<I", compression, len(rows)), *numbers("<i", 2835, 2835),
                  *numbers("<I", 256 if palette else 0, 0), *palette, Blob(rows)])


def packed_rows(rows):
    """Runs as TGA and its like write them: a count with the high bit, then the pixel."""
    return b"".join(b"\x82" + row[0:3] + b"\x82" + row[9:12] + b"\x01" + row[18:24] for row in rows)


def tga(random):
    kind = random.choice([1, 2, 3, 9, 10, 11])
    channels = {1: 1, 2: 3, 3: 1, 9: 1, 10: 3, 11: 1}[kind]
    mapped = kind in (1, 9)
    if kind == 10:
        rows = packed_rows(pixels(3))
    elif kind > 8:
        rows = b"".join(b"\x87" + row[:1] for row in pixels(1))
    else:
        rows = b"".join(pixels(channels))
    palette = [Blob(bytes(range(256)) * 3)] if mapped else []
    footer = [Group([*numbers("<I", 0, 0), Blob(b"TRUEVISION-XFILE.\0")])]
    return Group([Num("B", 3), Num("B", int(mapped)), Num("B", kind), *numbers("<H", 0, 256 if mapped else 0),
                  Num("B", 24 if mapped else 0),
                  *numbers("<H", 0, 0, SIDE, SIDE), Num("B", 8 * channels), Num("B", random.choice([0, 0x20])),
                  text("abc"), *palette,
                  Blob(rows), *footer])


def sgi(random):
    channels, packed = random.choice([1, 3, 4]), random.random() < 0.7
    head = [*numbers(">H", 474), *numbers("B", int(packed), random.choice([1, 1, 2])),
            *numbers(">H", 3, SIDE, SIDE, channels),
            *numbers(">I", 0, 255, 0), text("name", 80), Num(">I", 0), Blob(bytes(404))]
    rows = [row[c::channels] for c in range(channels) for row in pixels(channels)]
    if not packed:
        return Group(head + [Blob(b"".join(rows))])
    lines = [bytes([3, row[0], 0x85]) + row[3:] + b"\0" for row in rows]
    starts = [512 + 8 * len(lines) + sum(map(len, lines[:k])) for k in range(len(lines))]
    return Group(head + [Group(numbers(">I", *starts)), Group(numbers(">I", *map(len, lines))),
                         Group([Blob(line) for line in lines])])


def tiff(random):
    order = random.choice("<>")
    channels, compression = random.choice([1, 3, 4]), random.choice([1, 1, 5, 8, 32773])
    data = b"".join(pixels(channels))
    if compression == 8:
        data = zlib.compress(data)
    elif compression == 32773:
        data = b"".join(bytes([len(row) - 1]) + row for row in pixels(channels))
    tags = {256: SIDE, 257: SIDE, 258: 8, 259: compression, 262: 1 if channels == 1 else 2, 273: 8, 277: channels,
            278: SIDE,
            279: len(data), 284: 1}
    if random.random() < 0.2:
        tags.update({322: 16, 323: 16, 324: 8, 325: len(data)})
    if random.random() < 0.3:
        tags.update({305: 0x41414100, 34675: 8, 700: 8, 34665: 8, 317: 2, 338: 1, 339: 3})
    entries = [Group([*numbers(order + "H", tag, 4), *numbers(order + "I", 1, value)]) for tag,
               value in sorted(tags.items())]
    return Group([Blob(b"II*\0" if order == "<" else b"MM\0*"), Num(order + "I", 8 + len(data)), Blob(data),
                  Num(order + "H", len(entries)), Group(entries), Num(order + "I", random.choice([0, 0, 8]))])


def dds(random):
    kind = random.choice(["cube", "flat", "DXT1", "DXT5", "mips"])
    cube = kind in ("cube", "mips")
    levels = 4 if kind == "mips" else 1
    code = kind.encode() if kind.startswith("DXT") else bytes(4)
    size = sum((SIDE >> k)**2 * 4 for k in range(levels)) * (6 if cube else 1)
    if kind.startswith("DXT"):
        size = (SIDE // 4)**2 * (8 if kind == "DXT1" else 16)
    layout = [*numbers("<I", 32, 4 if kind.startswith("DXT") else 0x41), Blob(code),
              *numbers("<I", 32, 0xff0000, 0xff00, 0xff, 0xff000000)]
    return Group([Blob(b"DDS "), *numbers("<I", 124, 0x100f | (0x20000 if levels > 1 else 0), SIDE, SIDE, SIDE * 4, 0,
                                          levels),
                  Blob(bytes(44)), *layout, *numbers("<I", 0x1008 if cube else 0x1000, 0xfe00 if cube else 0, 0, 0, 0),
                  Blob(bytes(k * 7 % 256 for k in range(size)))])


def hdr(random):
    rows = b"".join(bytes([2, 2, 0, SIDE]) + b"".join(bytes([0x80 | SIDE,
                                                             40 * c + y]) for c in range(4)) for y in range(SIDE))
    if random.random() < 0.5:
        rows = b"".join(pixels(4))
    return Group([text("#?RADIANCE\n"), text("FORMAT=32-bit_rle_rgbe\n"), text("EXPOSURE=1.0\n"), text("\n"),
                  text(f"-Y {SIDE} +X {SIDE}\n"),
                  Blob(rows)])


def pnm(random):
    kind = random.choice(["P1", "P2", "P3", "P4", "P5", "P6", "PF", "Pf"])
    rows = b"".join(pixels(3))
    if kind in ("P2", "P3", "P1"):
        rows = " ".join(str(b % 2 if kind == "P1" else b) for b in rows).encode()
    elif kind in ("PF", "Pf"):
        rows = struct.pack("<192f", *(b / 255 for b in rows))
    limit = [] if kind in ("P1", "P4") else [text("-1.0\n" if kind in ("PF",
                                                                       "Pf") else random.choice(["255\n", "65535\n"]))]
    return Group([text(kind + "\n"), text("# a comment\n"), text(f"{SIDE} "), text(f"{SIDE}\n"), *limit, Blob(rows)])


def exr(random):
    def attribute(name, kind, *items):
        return Group([text(name + "\0"), text(kind + "\0"), Group(list(items), lambda body,
                                                                  size: struct.pack("<I", size & 0xffffffff) + body)])

    compression = random.choice([0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9])
    tiled = random.random() < 0.2
    half = random.choice([1, 1, 2, 0])
    names = random.choice(["BGR", "ABGR", "Y"])
    channel_list = [Group([text(n + "\0"), Num("<I", half), *numbers("B", 0, 0, 0, 0),
                           *numbers("<I", 1, 1)]) for n in names]
    head = [attribute("channels", "chlist", *channel_list, Num("B", 0)),
            attribute("compression", "compression", Num("B", compression)),
            attribute("dataWindow", "box2i", *numbers("<i", 0, 0, SIDE - 1, SIDE - 1)),
            attribute("displayWindow", "box2i", *numbers("<i", 0, 0, SIDE - 1, SIDE - 1)),
            attribute("lineOrder", "lineOrder", Num("B", 0)), attribute("pixelAspectRatio", "float", Num("<f", 1.0)),
            attribute("screenWindowCenter", "v2f", *numbers("<f", 0, 0)),
            attribute("screenWindowWidth", "float", Num("<f", 1.0)),
            attribute("comments", "string", text("abc")), attribute("preview", "preview", *numbers("<I", 1, 1),
                                                                    Blob(bytes(4)))]
    if tiled:
        head.append(attribute("tiles", "tiledesc", *numbers("<I", 8, 8), Num("B", random.choice([0, 1, 2]))))
    row = (b"\0\x3c" if half == 1 else b"\0\0\x80\x3f") * (SIDE * len(names))
    lines = [Group([Num("<i", y), Group([Blob(row)], lambda body,
                                        size: struct.pack("<I", size & 0xffffffff) + body)]) for y in range(SIDE)]
    start = 8 + len(Group(head).bytes()) + 1 + 8 * SIDE
    offsets = numbers("<Q", *(start + y * (8 + len(row)) for y in range(SIDE)))
    return Group([Num("<I", 20000630), Num("<I", 2 | (0x200 if tiled else 0)), Group(head), Num("B", 0), Group(offsets),
                  Group(lines)])


def jpeg(random):
    def segment(marker, *items):
        return Group([Blob(bytes([0xff, marker])), Group(list(items), lambda body,
                                                         size: struct.pack(">H", (size + 2) & 0xffff) + body)])

    count = random.choice([1, 3])
    parts = [Group([Num("B", c + 1), Num("B", 0x11), Num("B", 0)]) for c in range(count)]
    tables = [segment(0xc4, Num("B", kind), Blob(bytes([1]) + bytes(15)), Num("B", 0)) for kind in (0x00, 0x10)]
    scan = [Group([Num("B", c + 1), Num("B", 0)]) for c in range(count)]
    return Group([Blob(b"\xff\xd8"), segment(0xe0, text("JFIF\0"), *numbers("B", 1, 1, 0), *numbers(">H", 1, 1),
                                             *numbers("B", 0, 0)),
                  segment(0xe1, text("Exif\0\0"),
                          Blob(b"II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x01" + bytes(7))),
                  segment(0xe2, text("ICC_PROFILE\0"), *numbers("B", 1, 1), Blob(bytes(128))),
                  segment(0xdb, Num("B", 0), Blob(bytes([16] * 64))),
                  segment(random.choice([0xc0, 0xc0, 0xc2]), Num("B", 8), *numbers(">H", SIDE, SIDE), Num("B", count),
                          *parts),
                  *tables, segment(0xda, Num("B", count), *scan, *numbers("B", 0, 63, 0)), Blob(b"\x00" * count),
                  Blob(b"\xff\xd9")])


def gif(random):
    codes, bits = [], 0
    for k, byte in enumerate(b"".join(pixels(1))):
        codes += [4] if k % 2 == 0 else []
        codes.append(byte % 4)
    packed = 0
    for code in [*codes, 5]:
        packed |= code << bits
        bits += 3
    data = packed.to_bytes((bits + 7) // 8, "little")
    frame = [Blob(b","), *numbers("<H", 0, 0, SIDE, SIDE), Num("B", random.choice([0, 0x40])), Num("B", 2),
             Group([Blob(data)], lambda body, size: bytes([size & 0xff]) + body), Num("B", 0)]
    control = [Blob(b"!\xf9\x04"), Num("B", 1), Num("<H", 10), Num("B", 0), Num("B", 0)]
    return Group([Blob(b"GIF89a"), *numbers("<H", SIDE, SIDE), *numbers("B", 0x81, 0, 0), Blob(bytes(range(12))),
                  *[Group(control + frame) for _ in range(random.choice([1, 2]))], Blob(b";")])
