"""OBJ with its material library, OFF, PLY in its three forms, 3DS."""
import struct

import fields
import large
import seeds
import text_lines
from fields import Blob, Group, Num
from flags import scene_command
from judge import PIPE, Case
from mutate import damage, few

OBJ_WORDS = ["v", "vt", "vn", "vp", "f", "fo", "l", "p", "o", "g", "s", "mg", "usemtl", "mtllib", "usemap", "maplib",
             "cstype", "deg", "curv", "curv2", "surf", "parm", "trim", "hole", "end", "call", "csh", "lod", "bevel",
             "newmtl", "#", "\\"]
MTL_WORDS = ["newmtl", "Kd", "Ka", "Ks", "Ke", "Tf", "Ns", "Ni", "d", "Tr", "illum", "map_Kd", "map_Ka", "map_Ks",
             "map_Bump", "bump", "map_d", "refl", "disp", "decal", "norm", "-bm", "-clamp", "-o", "-s", "-type",
             "spectral", "Pr", "Pm", "aniso"]
OFF_WORDS = ["OFF", "COFF", "NOFF", "STOFF", "4OFF", "nOFF", "BINARY", "#", "3 0 1 2"]
PLY_WORDS = ["ply", "format", "ascii", "binary_little_endian", "binary_big_endian", "1.0", "comment", "obj_info",
             "element", "vertex", "face", "tristrips", "edge", "material", "property", "list", "char", "uchar", "short",
             "ushort", "int", "uint", "float", "double", "int8", "uint64", "float64", "x", "y", "z", "nx", "red", "s",
             "vertex_indices", "vertex_index", "end_header"]


def finish(random, case):
    """What every scene may get: links to the tree's scenes, a FIFO and a folder to be named by mistake."""
    case.files["scenes"] = seeds.ROOT / "scenes"
    if any(b"pipe" in data for data in case.files.values() if isinstance(data, bytes)):
        case.files["pipe"] = PIPE
    if random.random() < 0.02:
        odd = random.choice(["a\x1b[31mb", "a\nb", "-a", "a b", "\u00e4", "a%20b", "n" * 200, "a\u0085b", "{}"])
        old = next((word for word in case.command if word in case.files), None)
        if old is None:  # six pictures in one word
            return case
        new = odd + old[old.rindex("."):]
        new = "./" + new if new.startswith("-") else new
        case.files[new.removeprefix("./")] = case.files.pop(old)
        case.command = [new if word == old else word for word in case.command]
    return case


def bytes_or(random, data, change):
    """Mostly a change of structure, sometimes of bytes, rarely none at all."""
    choice = random.random()
    if choice < 0.03:
        return data
    if choice < 0.80:
        return change(data)
    for _ in range(few(random)):
        data = damage(random, data)
    return data


def obj(random, _context):
    chosen = random.randrange(2 + len(seeds.models((".obj",))))
    library = seeds.LIBRARY.encode()
    if chosen < 2:
        data = seeds.CUBE.encode()
    else:
        path = seeds.models((".obj",))[chosen - 2]
        data = path.read_bytes()
        if path.with_suffix(".mtl").is_file():
            library = path.with_suffix(".mtl").read_bytes()
            data = data.replace(path.with_suffix(".mtl").name.encode(), b"a.mtl")
    both = random.random()
    if both < 0.7:
        data = bytes_or(random, data, lambda d: text_lines.mutate(random, d, OBJ_WORDS, few(random)))
    if both > 0.5:
        library = bytes_or(random, library, lambda d: text_lines.mutate(random, d, MTL_WORDS, few(random)))
    return finish(random, Case(scene_command(random, "a.obj"), {"a.obj": data, "a.mtl": library}))


def off(random, _context):
    models = [m.read_bytes() for m in seeds.models((".off",))]
    data = random.choice([seeds.OFF.encode()] * 4 + models + seeds.corpus_with("scene", b"OFF"))
    data = bytes_or(random, data, lambda d: text_lines.mutate(random, d, OFF_WORDS, few(random)))
    return finish(random, Case(scene_command(random, "a.off"), {"a.off": data}))


def binary_ply(order):
    """The pyramid as a tree: header lines, and then numbers."""
    form = "binary_little_endian" if order == "<" else "binary_big_endian"
    header = seeds.PLY[:seeds.PLY.index("end_header")].replace("ascii", form) + "end_header\n"
    items = [Blob(header.encode())]
    vertices = [Group(fields.numbers(order + "f", *map(float, row.split()[:3])) + [Num("B", 7)])
                for row in seeds.PLY.split("end_header\n")[1].splitlines()[:5]]
    faces = [Group([Num("B", row[0])] + fields.numbers(order + "i", *row[1:]))
             for row in ([4, 0, 3, 2, 1], [3, 0, 1, 4], [3, 1, 2, 4], [3, 2, 3, 4], [3, 3, 0, 4])]
    return Group(items + [Group(vertices), Group(faces)])


def ply(random, _context):
    kind = random.random()
    if kind < 0.5:
        models = [m.read_bytes() for m in seeds.models((".ply",))]
        data = random.choice([seeds.PLY.encode()] * 3 + models + seeds.corpus_with("scene", b"ply"))
        if b"format ascii" in data:
            data = bytes_or(random, data, lambda d: text_lines.mutate(random, d, PLY_WORDS, few(random)))
        else:  # the header's lines, and the body as it is
            head, end, body = data.partition(b"end_header\n")
            data = bytes_or(random, head + end, lambda d: text_lines.mutate(random, d, PLY_WORDS, few(random))) + body
    else:
        tree = binary_ply(random.choice("<>"))
        header = tree.items[0]
        for _ in range(few(random)):
            if random.random() < 0.5:
                header.data = text_lines.mutate(random, header.data, PLY_WORDS, 1)
            else:
                fields.mutate(random, tree)
        data = tree.bytes()
    return finish(random, Case(scene_command(random, "a.ply"), {"a.ply": data}))


# Chunks of 3DS that hold chunks, with the bytes before them.
WITHIN = {0x4D4D: 0, 0x3D3D: 0, 0x4100: 0, 0xAFFF: 0, 0xB000: 0, 0xB002: 0, 0xA010: 0, 0xA020: 0, 0xA030: 0, 0xA040: 0,
          0xA200: 0, 0xA204: 0, 0xA210: 0, 0x4600: 12, 0x4700: 32, 0xB001: 0, 0xB003: 0, 0xB004: 0, 0xB005: 0, 0xB006: 0,
          0xB007: 0}
CHUNKS = sorted(WITHIN) + [0x0002, 0x3D3E, 0x0100, 0x4000, 0x4110, 0x4120, 0x4130, 0x4140, 0x4150, 0x4160, 0x4165,
                           0xA000, 0xA041, 0xA050, 0xA081, 0xA100, 0xA300, 0xA351, 0xA353, 0x0010, 0x0011, 0x0030,
                           0x0031, 0xB008, 0xB009, 0xB00A, 0xB010, 0xB011, 0xB013, 0xB014, 0xB015, 0xB020, 0xB021,
                           0xB022, 0xB030, 0x2100, 0x1200, 0x4610, 0x4620]


def chunk_body(ident, data, depth):
    """The content of a chunk as items: what is known of its layout, and the chunks within."""
    if ident == 0x4000:
        end = data.find(b"\0") + 1
        return [Blob(data[:end]), *chunks(data[end:], depth)]
    if ident in (0x4110, 0x4120, 0x4140, 0x4150) and len(data) >= 2:
        count, = struct.unpack_from("<H", data)
        size = {0x4110: 12, 0x4120: 8, 0x4140: 8, 0x4150: 4}[ident]
        form = "<f" if ident in (0x4110, 0x4140) else "<H"
        step = struct.calcsize(form)
        body = data[2:2 + count * size]
        body = body[:len(body) // step * step]
        values = [Num(form, v[0]) for v in struct.iter_unpack(form, body)]
        return [Num("<H", count), Group(values), *chunks(data[2 + len(body):], depth)]
    if ident == 0xB010 and b"\0" in data:
        end = data.find(b"\0") + 1
        rest = data[end:end + 6]
        return [Blob(data[:end]), *(Num("<H", v[0]) for v in struct.iter_unpack("<H", rest[:len(rest) // 2 * 2])),
                Blob(data[end + len(rest) // 2 * 2:])]
    if ident in WITHIN:
        return [Blob(data[:WITHIN[ident]]), *chunks(data[WITHIN[ident]:], depth)]
    if 2 <= len(data) <= 32 and len(data) % 2 == 0:
        return fields.numbers("<H", *(v[0] for v in struct.iter_unpack("<H", data)))
    return [Blob(data)]


def chunks(data, depth=0):
    """Consecutive chunks as groups that write their ident and length."""
    found = []
    while len(data) >= 6 and depth < 20:
        ident, size = struct.unpack_from("<HI", data)
        if size < 6 or size > len(data):
            break
        found.append(chunk(Num("<H", ident), chunk_body(ident, data[6:size], depth + 1)))
        data = data[size:]
    return found + ([Blob(data)] if data else [])


def chunk(ident, items):
    return Group([Group([ident]), Group(items, lambda body, size: Num("<I", size + 6).bytes() + body)])


def three_ds(random, _context):
    starts = [path.read_bytes() for path in seeds.models((".3ds",))] + [large.instances_3ds(2, 3)["a.3ds"]]
    tree = Group(chunks(random.choice(starts)))

    def change(_):
        for _ in range(few(random)):
            if random.random() < 0.15:
                idents = [i for i, k in fields.nodes(tree) if isinstance(i[k], Num) and len(i) == 1]
                if idents:
                    random.choice(idents)[0].value = random.choice(CHUNKS)
            else:
                fields.mutate(random, tree)
        return tree.bytes()

    return finish(random, Case(scene_command(random, "a.3ds"), {"a.3ds": bytes_or(random, tree.bytes(), change)}))
