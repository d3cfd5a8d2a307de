"""Rarer file formats of pictures, and the commands that read them all as a cookie."""
import struct
import zlib

import fields
import pictures
from fields import Blob, Group, Num, numbers, text
from flags import drawing, some
from judge import Case
from mutate import damage, few
from pictures import SIDE, pixels
from scenes import finish


def psd(random):
    packed = random.random() < 0.5
    planes = [row[c::3] for c in range(3) for row in pixels(3)]
    lines = [bytes([len(row) - 1]) + row for row in planes]
    body = [Group(numbers(">H", *map(len, lines))), Blob(b"".join(lines))] if packed else [Blob(b"".join(planes))]

    def sized(*items):
        return Group(list(items), lambda b, size: struct.pack(">I", size & 0xffffffff) + b)

    resource = Group([Blob(b"8BIM"), Num(">H", random.choice([1005, 1033, 1036, 1039, 1058])), Blob(b"\0\0"),
                      sized(Blob(bytes(16)))])
    layers = sized(sized(Num(">h", 1), *numbers(">I", 0, 0, SIDE, SIDE), Num(">H", 1), Num(">h", 0), Num(">I", 66),
                         Blob(b"8BIMnorm"),
                         *numbers("B", 255, 0, 0, 0), sized(Blob(bytes(12))), Num(">H", 0), Blob(bytes(64))))
    return Group([Blob(b"8BPS"), Num(">H", 1), Blob(bytes(6)), Num(">H", 3), *numbers(">I", SIDE, SIDE),
                  *numbers(">H", 8, 3),
                  sized(), sized(resource), layers if random.random() < 0.5 else sized(), Num(">H", int(packed)),
                  *body])


def ico(random):
    if random.random() < 0.5:
        inside = pictures.png(random).bytes()
    else:
        inside = struct.pack("<IiiHHIIiiII", 40, SIDE, 2 * SIDE, 1, 32, 0, 0, 0, 0, 0,
                             0) + b"".join(pixels(4)) + bytes(32)
    entry = Group([*numbers("B", SIDE, SIDE, 0, 0), *numbers("<H", 1, 32), *numbers("<I", len(inside), 22)])
    return Group([*numbers("<H", 0, 1, 1), entry, Blob(inside[:40]), Blob(inside[40:])])


def fits(random):
    bits = random.choice([8, 16, -32])
    cards = ["SIMPLE  =                    T", f"BITPIX  = {bits:20d}", "NAXIS   =                    2",
             f"NAXIS1  = {SIDE:20d}",
             f"NAXIS2  = {SIDE:20d}", "COMMENT a picture", "END"]
    head = Group([text(card.ljust(80)) for card in cards] + [text(" " * (2880 - 80 * len(cards)))])
    return Group([head, Blob((b"".join(pixels(1)) * 8)[:SIDE * SIDE * abs(bits) // 8].ljust(2880, b"\0"))])


def dpx(random):
    order = random.choice("<>")
    file_part = [Num(order + "I", 0x53445058), Num(order + "I", 2048), text("V1.0", 8), Num(order + "I", 2048 + 192),
                 *numbers(order + "I", 1, 1664, 384, 0),
                 text("a.dpx", 100), text("", 24), text("", 100), text("", 200), text("", 200),
                 Num(order + "I", 0xffffffff), Blob(bytes(104))]
    image = [*numbers(order + "H", 0, 1), *numbers(order + "I", SIDE, SIDE),
             Group([*numbers(order + "I", 0, 0, 0, 255, 0), *numbers("B", 50, 1, 1, random.choice([8, 10, 12, 16])),
                    *numbers(order + "H", 0, random.choice([0, 1])), *numbers(order + "I", 2048, 0, 0), text("", 32)])]
    used = len(Group(file_part + image).bytes())
    return Group([*file_part, *image, Blob(bytes(2048 - used)), Blob(b"".join(pixels(3)))])


def cineon(random):
    order = random.choice("<>")
    head = [Num(order + "I", 0x802A5FD7), *numbers(order + "I", 2048, 1024, 1024, 0, 2048 + 192), text("V4.5", 8),
            text("a.cin", 100), text("", 12), text("", 12),
            Blob(bytes(36)), *numbers("B", 0, 3, 0, 0), *[Group([*numbers("B", 0, 0, 8, 0),
                                                                 *numbers(order + "I", SIDE, SIDE),
                                                                 *numbers(order + "f", 0, 0, 255, 2)])
                                                           for _ in range(3)]]
    used = len(Group(head).bytes())
    return Group([*head, Blob(bytes(2048 - used)), Blob(b"".join(pixels(3)))])


def zfile(random):
    order = random.choice("<>")
    head = struct.pack(order + "Ihh", 0x2f0867ab, SIDE, SIDE)
    body = [Num(order + "I", 0x2f0867ab), *numbers(order + "h", SIDE, SIDE), *numbers(order + "f", *[1.0] * 32),
            Blob(bytes(4 * SIDE * SIDE))]
    return Group([Blob(zlib.compress(head + Group(body[3:]).bytes()))]) if random.random() < 0.3 else Group(body)


def iff(random):
    def form(ident, *items):
        return Group([Blob(ident), Group(list(items), lambda b,
                                         size: struct.pack(">I", size & 0xffffffff) + b + bytes(-len(b) % 4))])

    packed = random.choice([0, 1])
    tile = b"".join(pixels(4)) if not packed else (b"\x3f" + b"".join(pixels(1))) * 4
    head = form(b"TBHD", *numbers(">I", SIDE, SIDE), *numbers(">H", 1, 1), Num(">I", 3), *numbers(">H", 0, 1),
                Num(">I", packed), *numbers(">I", 0, 0))
    part = form(b"RGBA", *numbers(">H", 0, 0, SIDE - 1, SIDE - 1), Blob(tile))
    return Group([form(b"FOR4", Blob(b"CIMG"), head, form(b"AUTH", text("abcd")), form(b"FOR4", Blob(b"TBMP"), part))])


def softimage(random):
    kind = random.choice([0, 1, 2])
    begin = {0: b"", 1: b"\x07", 2: b"\x80\0\x08"}[kind]  # a run of eight pixels
    rows = b"".join(begin + (row[:3] if kind else row) for row in pixels(3))
    return Group([Num(">I", 0x5380F634), Num(">f", 3.71), text("", 80), text("PICT"), *numbers(">H", SIDE, SIDE),
                  Num(">f", 1.0), *numbers(">H", 3, 0),
                  Group(numbers("B", 0, 8, kind, 0xE0)), Blob(rows)])


def rla(_random):
    lines = [b"".join(struct.pack(">H", 2) + bytes([SIDE - 1, 9]) for _ in range(3)) for _ in range(SIDE)]
    head = [*numbers(">h", 0, SIDE - 1, 0, SIDE - 1, 0, SIDE - 1, 0, SIDE - 1), *numbers(">h", 0, 0, 3, 0, 0, -2),
            text("2.2", 16), text("", 96), Num(">I", 1),
            text("a.rla", 128), text("", 128), text("", 180), text("rgb", 78), *numbers(">h", 8, 0, 0, 0, 0),
            Blob(bytes(68)), Num(">I", 0)]
    starts = [740 + 4 * SIDE + k * len(lines[0]) for k in range(SIDE)]
    return Group([*head, Group(numbers(">I", *starts)), Group([Blob(line) for line in lines])])


def webp(random):
    def chunk(kind, *items):
        return Group([Blob(kind), Group(list(items), lambda b,
                                        size: struct.pack("<I", size & 0xffffffff) + b + bytes(len(b) % 2))])

    lossless = (SIDE - 1) | (SIDE - 1) << 14
    one_colour = sum(1 << 3 + 4 * code for code in range(5))  # no transforms; five codes of one symbol each
    body = chunk(b"VP8L", Num("B", 0x2f), Num("<I", lossless), Blob(one_colour.to_bytes(4, "little")))
    extended = chunk(b"VP8X", Num("<I", random.choice([0, 2, 0x10])), Blob(bytes([SIDE - 1, 0, 0, SIDE - 1, 0, 0])))
    return Group([Blob(b"RIFF"), Group([Blob(b"WEBP"), *([extended] if random.random() < 0.5 else []), body], lambda b,
                                       size: struct.pack("<I", size & 0xffffffff) + b)])


FORMATS = {"png": pictures.png, "bmp": pictures.bmp, "tga": pictures.tga, "sgi": pictures.sgi, "tif": pictures.tiff,
           "dds": pictures.dds,
           "hdr": pictures.hdr, "ppm": pictures.pnm, "exr": pictures.exr, "jpg": pictures.jpeg, "gif": pictures.gif,
           "psd": psd, "ico": ico,
           "fits": fits, "dpx": dpx, "cin": cineon, "zfile": zfile, "iff": iff, "pic": softimage, "rla": rla,
           "webp": webp}
COMMON = ["png", "exr", "sgi", "dds", "tif", "tga"]  # tried more often


def picture(random, _context):
    kind = random.choice(COMMON) if random.random() < 0.5 else random.choice(sorted(FORMATS))
    tree = FORMATS[kind](random)
    choice = random.random()
    if choice < 0.7:
        for _ in range(few(random)):
            fields.mutate(random, tree)
    data = tree.bytes()
    if choice > 0.65:
        for _ in range(few(random)):
            data = damage(random, data)
    file = "c." + (kind if random.random() < 0.95 else random.choice(sorted(FORMATS)))
    cube = kind == "dds" and random.random() < 0.7
    cookie = file if cube else ",".join([file] * 6)
    scene = "scenes/cornell_box.gltf" if random.random() < 0.5 else "scenes/index_room.gltf"
    command = ["render", scene, "-o", "out", *drawing(random, cookie), *some(random, 0.2, "--json")]
    return finish(random, Case(command, {file: data}))
