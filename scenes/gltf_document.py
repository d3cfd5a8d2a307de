"""What the scenes' generators share: vectors, parts of solids, and a self-contained glTF file.

A generator's output is the same text on every machine: coordinates are rounded to six decimals before they become
single precision, so that the last bits of sine and cosine do not matter.
"""

import base64
import json
import math
import pathlib
import re
import struct
import sys


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def scaled(a, factor):
    return tuple(x * factor for x in a)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return scaled(a, 1.0 / math.sqrt(sum(x * x for x in a)))


class Part:
    """Triangles of one colour: positions, normals, and corners counter-clockwise from the front."""

    def __init__(self):
        self.positions = []
        self.normals = []
        self.triangles = []

    def vertex(self, position, normal):
        self.positions.append(position)
        self.normals.append(unit(normal))
        return len(self.positions) - 1

    def flat(self, *corners):
        """A flat convex polygon with vertices of its own."""
        normal = cross(add(corners[1], scaled(corners[0], -1.0)), add(corners[2], scaled(corners[0], -1.0)))
        first = [self.vertex(corner, normal) for corner in corners]
        self.triangles += [(first[0], first[i], first[i + 1]) for i in range(1, len(first) - 1)]


def wall(low, high, axis, side, cells):
    """One inner side of a room: a grid whose front faces inward. Side 0 is at low[axis], side 1 at high[axis]."""
    part = Part()
    u, v = (axis + 1) % 3, (axis + 2) % 3
    normal = [0.0, 0.0, 0.0]
    normal[axis] = -1.0 if side else 1.0
    index = {}
    for i in range(cells + 1):
        for j in range(cells + 1):
            position = [0.0, 0.0, 0.0]
            position[axis] = high[axis] if side else low[axis]
            position[u] = low[u] + (high[u] - low[u]) * i / cells
            position[v] = low[v] + (high[v] - low[v]) * j / cells
            index[i, j] = part.vertex(tuple(position), tuple(normal))
    for i in range(cells):
        for j in range(cells):
            a, b, c, d = index[i, j], index[i + 1, j], index[i + 1, j + 1], index[i, j + 1]
            part.triangles += [(a, c, b), (a, d, c)] if side else [(a, b, c), (a, c, d)]
    return part


def box(width, height, depth):
    """Standing on y = 0."""
    part = Part()
    x, z = width / 2.0, depth / 2.0
    low = [(-x, 0.0, z), (x, 0.0, z), (x, 0.0, -z), (-x, 0.0, -z)]
    high = [(px, height, pz) for px, _, pz in low]
    for i in range(4):
        part.flat(low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i])
    part.flat(*high)
    part.flat(*reversed(low))
    return part


def turn(axis, degrees):
    """A quaternion as glTF writes it."""
    half = math.radians(degrees) / 2.0
    return [x * math.sin(half) for x in unit(axis)] + [math.cos(half)]


def multiplied(p, q):
    """The turn q followed by the turn p."""
    vector = add(add(scaled(q[:3], p[3]), scaled(p[:3], q[3])), cross(p[:3], q[:3]))
    return list(vector) + [p[3] * q[3] - sum(x * y for x, y in zip(p[:3], q[:3]))]


def looking(position, target):
    """The turn of a camera, which looks along its -z, with y up."""
    ahead = add(target, scaled(position, -1.0))
    yaw = math.degrees(math.atan2(-ahead[0], -ahead[2]))
    pitch = math.degrees(math.atan2(ahead[1], math.hypot(ahead[0], ahead[2])))
    return multiplied(turn((0.0, 1.0, 0.0), yaw), turn((1.0, 0.0, 0.0), pitch))


def rounded(values):
    return [round(x, 6) + 0.0 for x in values]


class Document:
    def __init__(self, scene, generator):
        self.data = bytearray()
        self.gltf = {
            "asset": {"version": "2.0", "generator": generator, "copyright": "the ninebit authors, MIT"},
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": {"lights": []}},
            "scene": 0, "scenes": [{"name": scene, "nodes": []}],
            "nodes": [], "meshes": [], "cameras": [], "materials": [], "accessors": [], "bufferViews": [],
            "buffers": []}

    def store(self, fmt, rows, target, accessor):
        view = {"buffer": 0, "byteOffset": len(self.data), "target": target}
        for row in rows:
            self.data += struct.pack("<" + fmt * len(row), *row)
        view["byteLength"] = len(self.data) - view["byteOffset"]
        self.data += b"\0" * (-len(self.data) % 4)
        self.gltf["bufferViews"].append(view)
        self.gltf["accessors"].append({"bufferView": len(self.gltf["bufferViews"]) - 1, **accessor})
        return len(self.gltf["accessors"]) - 1

    def primitive(self, part, color):
        positions = [rounded(p) for p in part.positions]
        span = {"min": [min(p[k] for p in positions) for k in range(3)],
                "max": [max(p[k] for p in positions) for k in range(3)]}
        for values in span.values():
            values[:] = struct.unpack("<3f", struct.pack("<3f", *values))
        name = color[0]
        names = [m["name"] for m in self.gltf["materials"]]
        if name not in names:
            self.gltf["materials"].append({"name": name, "pbrMetallicRoughness": {
                "baseColorFactor": list(color[1:]) + [1.0], "metallicFactor": 0.0, "roughnessFactor": 0.9}})
            names.append(name)
        return {
            "attributes": {
                "POSITION": self.store("f", positions, 34962, {
                    "componentType": 5126, "count": len(positions), "type": "VEC3", **span}),
                "NORMAL": self.store("f", [rounded(n) for n in part.normals], 34962, {
                    "componentType": 5126, "count": len(positions), "type": "VEC3"})},
            "indices": self.store("H", part.triangles, 34963, {
                "componentType": 5123, "count": 3 * len(part.triangles), "type": "SCALAR"}),
            "material": names.index(name)}

    def node(self, node):
        self.gltf["nodes"].append(node)
        self.gltf["scenes"][0]["nodes"].append(len(self.gltf["nodes"]) - 1)

    def solid(self, name, parts, at=(0.0, 0.0, 0.0), rotation=None):
        self.gltf["meshes"].append({"name": name, "primitives": [self.primitive(p, color) for p, color in parts]})
        node = {"name": name, "mesh": len(self.gltf["meshes"]) - 1, "translation": list(at)}
        if rotation:
            node["rotation"] = rounded(rotation)
        self.node(node)

    def light(self, light, at, target=None):
        """A light of KHR_lights_punctual; one with a target shines there."""
        lights = self.gltf["extensions"]["KHR_lights_punctual"]["lights"]
        lights.append(light)
        node = {"name": light["name"], "translation": list(at)}
        if target:
            node["rotation"] = rounded(looking(at, target))
        self.node({**node, "extensions": {"KHR_lights_punctual": {"light": len(lights) - 1}}})

    def camera(self, name, vertical_fov, at, target):
        self.gltf["cameras"].append({"name": name, "type": "perspective", "perspective": {
            "yfov": round(vertical_fov, 6), "aspectRatio": 1.333333, "znear": 0.05, "zfar": 50.0}})
        self.node({"name": name, "camera": len(self.gltf["cameras"]) - 1, "translation": list(at),
                   "rotation": rounded(looking(at, target))})

    def text(self):
        self.gltf["buffers"] = [{"byteLength": len(self.data), "uri": "data:application/octet-stream;base64," +
                                 base64.b64encode(self.data).decode("ascii")}]
        text = json.dumps(self.gltf, indent=2)
        # Lists of numbers on one line each.
        return re.sub(r"\[\s+([-+.\de,\s]+?)\s+\]", lambda m: "[" + re.sub(r"\s+", " ", m[1]) + "]", text) + "\n"


def generate(script, document, arguments, usage):
    """Writes the document beside its script, with the scene's name, or prints it with --stdout."""
    if arguments not in ([], ["--stdout"]):
        sys.exit(usage)
    if arguments:
        sys.stdout.write(document.text())
        return
    name = pathlib.Path(script).stem.removeprefix("make_") + ".gltf"
    target = pathlib.Path(script).resolve().parent / name
    target.write_text(document.text(), encoding="ascii", newline="\n")
    print(target)
