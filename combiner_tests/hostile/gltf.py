"""glTF: a text with data in addresses or in a .bin file, and GLB."""
import base64
import functools
import struct

import fields
import json_tree
import seeds
from fields import Blob, Group, Num
from flags import scene_command
from judge import Case
from json_tree import Number, Object
from mutate import INTEGERS, damage, few, name
from scenes import bytes_or, finish

FLOATS = [float("nan"), float("inf"), -1e38, 1e-45, 3.4e38, 0.0]
EXTENSIONS = ["KHR_lights_punctual", "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization",
              "KHR_texture_transform", "EXT_mesh_gpu_instancing", "KHR_materials_unlit", "a"]


def split_glb(data):
    """The text and the binary chunk of a GLB file."""
    length, = struct.unpack_from("<I", data, 12)
    return data[20:20 + length], data[28 + length:]


@functools.lru_cache(maxsize=None)
def starts():
    """Texts with their single buffer's bytes, as far as version 2 files are at hand; in order of their names."""
    found = []
    paths = [seeds.ROOT / "scenes" / "cornell_box.gltf", *seeds.models((".gltf", ".glb"))]
    texts = [(path.read_bytes(), path.parent) for path in paths] * 3 + [(d, None) for d in seeds.corpus_with("scene",
                                                                                                             b"{")]
    for data, folder in texts:
        try:
            text, binary = split_glb(data) if data.startswith(b"glTF") else (data, b"")
            tree = json_tree.parse(text.decode())
            buffers = tree.get("buffers") or []
            uri = buffers[0].get("uri") if buffers else None
            if uri and uri.startswith("data:"):
                binary = base64.b64decode(uri.partition(",")[2])
            elif uri and folder:
                binary = (folder / uri).read_bytes()
        except (ValueError, AttributeError, OSError, struct.error, TypeError):
            continue
        if len(binary) <= seeds.LARGEST:
            found.append((text, binary))
    return found


def damage_buffer(random, binary):
    """Floats and indices within the buffer."""
    data = bytearray(binary)
    if len(data) < 4:
        return binary
    for _ in range(random.choice([1, 3, 30])):
        at = random.randrange(len(data) // 4) * 4
        if random.random() < 0.5:
            struct.pack_into("<f", data, at, random.choice(FLOATS))
        else:
            struct.pack_into("<H", data, at, random.choice(INTEGERS) & 0xffff)
    return bytes(data)


def objects(tree, key):
    """The objects of an array that may by now be something else."""
    found = tree.get(key)
    return [item for item in found if isinstance(item, Object)] if isinstance(found, list) else []


def cross_reference(random, tree):
    """Changes that only make sense in glTF: cycles, shared children, accessors that overlap, extensions."""
    kind = random.randrange(6)
    nodes, accessors = objects(tree, "nodes"), objects(tree, "accessors")
    if kind == 0 and nodes:
        count = random.choice([1, 2, 50])
        random.choice(nodes).set("children", [Number(str(random.randrange(len(nodes)))) for _ in range(count)])
    elif kind == 1 and accessors:
        accessor = random.choice(accessors)
        accessor.set("count", Number(str(random.choice(INTEGERS))))
        accessor.set("sparse", json_tree.parse('{"count":%d,"indices":{"bufferView":0,"componentType":5123},'
                                               '"values":{"bufferView":0}}' % random.choice(INTEGERS)))
    elif kind == 2:
        tree.set("extensionsRequired", [random.choice(EXTENSIONS) for _ in range(random.choice([1, 2]))])
    elif kind == 3 and nodes:
        node = random.choice(nodes)
        node.set("matrix", [Number(random.choice(["0", "1", "1e30", "-1e38", "nan",
                                                  "1e-30"])) for _ in range(random.choice([15, 16]))])
    elif kind == 4:
        for view in objects(tree, "bufferViews"):
            view.set("byteStride", Number(str(random.choice([0, 1, 4, 12, 252, 255, 2**31, 2**32]))))
    elif accessors:
        random.choice(accessors).set("type", random.choice(["SCALAR", "VEC2", "VEC3", "VEC4", "MAT4", "a",
                                                            name(random)]))


def change_tree(random, text):
    tree = json_tree.parse(text.decode())
    for _ in range(few(random)):
        if isinstance(tree, Object) and random.random() < 0.15:
            cross_reference(random, tree)
        else:
            json_tree.mutate(random, tree)
    return json_tree.encode(tree)


def start(random):
    text, binary = random.choice(starts())
    if random.random() < 0.3:
        binary = damage_buffer(random, binary)
    return text, binary


def with_address(text, address):
    """The text with another address of its first buffer; the text as it is where it has none."""
    tree = json_tree.parse(text.decode())
    buffers = tree.get("buffers")
    if isinstance(buffers, list) and buffers and isinstance(buffers[0], Object):
        if address is None:
            buffers[0].pairs = [p for p in buffers[0].pairs if p[0] != "uri"]
        else:
            buffers[0].set("uri", address)
    return json_tree.encode(tree)


def gltf(random, _context):
    text, binary = start(random)
    files = {}
    if random.random() < 0.5:
        encoded = base64.b64encode(binary).decode()
        if random.random() < 0.1:
            encoded = damage(random, encoded.encode()).decode("latin-1")
        text = with_address(text, "data:application/octet-stream;base64," + encoded)
    else:
        text = with_address(text, "a.bin")
        files["a.bin"] = bytes_or(random, binary, lambda d: d) if random.random() < 0.2 else binary
    files["a.gltf"] = bytes_or(random, text, lambda d: change_tree(random, d))
    return finish(random, Case(scene_command(random, "a.gltf"), files))


def piece(kind, data, fill):
    """A chunk of a GLB file."""
    data += fill * (-len(data) % 4)
    return Group([Group([Blob(kind), Blob(data)], lambda body, size: Num("<I", size - 4).bytes() + body)])


def glb(random, _context):
    text, binary = start(random)
    text = with_address(text, None)
    if random.random() < 0.6:
        text = bytes_or(random, text, lambda d: change_tree(random, d))
    body = Group([piece(b"JSON", text, b" "), piece(b"BIN\0", binary, b"\0")],
                 lambda b, size: b"glTF" + struct.pack("<II", 2, (size + 12) & 0xffffffff) + b)
    tree = Group([body])
    if random.random() < 0.5:
        for _ in range(few(random)):
            fields.mutate(random, tree)
    data = tree.bytes()
    if random.random() < 0.2:
        data = damage(random, data)
    return finish(random, Case(scene_command(random, "a.glb"), {"a.glb": data}))
