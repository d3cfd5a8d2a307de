#!/usr/bin/env python3
"""Writes index_room.gltf: a closed room with a torus and other solids around a point light.

Usage: make_index_room.py [--stdout]    (without it, writes index_room.gltf beside this file)

The output is the same text on every machine: coordinates are rounded to six decimals before they become single
precision, so that the last bits of sine and cosine do not matter.
"""

import base64
import json
import math
import pathlib
import re
import struct
import sys

LIGHT = (0.0, 4.1, 0.0)
CAMERA = (4.5, 3.9, 4.6)
LOOK_AT = (-0.7, 1.25, -0.9)
VERTICAL_FOV = math.radians(62.0)
LOW, HIGH = (-5.0, 0.0, -5.0), (5.0, 6.0, 5.0)
WALL_CELLS = 8


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


def wall(axis, side):
    """One inner side of the room: a grid whose front faces inward."""
    part = Part()
    u, v = (axis + 1) % 3, (axis + 2) % 3
    normal = [0.0, 0.0, 0.0]
    normal[axis] = -1.0 if side else 1.0
    index = {}
    for i in range(WALL_CELLS + 1):
        for j in range(WALL_CELLS + 1):
            position = [0.0, 0.0, 0.0]
            position[axis] = HIGH[axis] if side else LOW[axis]
            position[u] = LOW[u] + (HIGH[u] - LOW[u]) * i / WALL_CELLS
            position[v] = LOW[v] + (HIGH[v] - LOW[v]) * j / WALL_CELLS
            index[i, j] = part.vertex(tuple(position), tuple(normal))
    for i in range(WALL_CELLS):
        for j in range(WALL_CELLS):
            a, b, c, d = index[i, j], index[i + 1, j], index[i + 1, j + 1], index[i, j + 1]
            part.triangles += [(a, c, b), (a, d, c)] if side else [(a, b, c), (a, c, d)]
    return part


def torus(ring, tube, around, across):
    """Around the z axis."""
    part = Part()
    for i in range(around):
        a = 2.0 * math.pi * i / around
        out = (math.cos(a), math.sin(a), 0.0)
        for j in range(across):
            b = 2.0 * math.pi * j / across
            normal = add(scaled(out, math.cos(b)), (0.0, 0.0, math.sin(b)))
            part.vertex(add(scaled(out, ring), scaled(normal, tube)), normal)
    for i in range(around):
        for j in range(across):
            a, b = i * across + j, (i + 1) % around * across + j
            c, d = (i + 1) % around * across + (j + 1) % across, i * across + (j + 1) % across
            part.triangles += [(a, b, c), (a, c, d)]
    return part


def sphere(radius, subdivisions):
    """An icosahedron, each triangle cut in four again and again."""
    g = (1.0 + math.sqrt(5.0)) / 2.0
    points = [unit(p) for p in [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g),
                                (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]]
    faces = [(a, b, c) for a in range(12) for b in range(a + 1, 12) for c in range(b + 1, 12)
             if all(abs(math.dist(points[p], points[q]) - 2.0 / math.hypot(1.0, g)) < 1e-9
                    for p, q in [(a, b), (b, c), (c, a)])]
    for k, (a, b, c) in enumerate(faces):
        n = cross(add(points[b], scaled(points[a], -1.0)), add(points[c], scaled(points[a], -1.0)))
        if sum(x * y for x, y in zip(n, points[a])) < 0.0:
            faces[k] = (a, c, b)
    for _ in range(subdivisions):
        middle = {}

        def between(a, b):
            key = (min(a, b), max(a, b))
            if key not in middle:
                points.append(unit(add(points[a], points[b])))
                middle[key] = len(points) - 1
            return middle[key]

        finer = []
        for a, b, c in faces:
            ab, bc, ca = between(a, b), between(b, c), between(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = finer
    part = Part()
    for point in points:
        part.vertex(scaled(point, radius), point)
    part.triangles = faces
    return part


def circle(radius, height, corners):
    return [(radius * math.cos(2.0 * math.pi * i / corners), height, -radius * math.sin(2.0 * math.pi * i / corners))
            for i in range(corners)]


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


def cylinder(radius, height, corners):
    """Standing on y = 0, with smooth sides."""
    part = Part()
    low, high = circle(radius, 0.0, corners), circle(radius, height, corners)
    for point in low + high:
        part.vertex(point, (point[0], 0.0, point[2]))
    for i in range(corners):
        j = (i + 1) % corners
        part.triangles += [(i, j, corners + j), (i, corners + j, corners + i)]
    part.flat(*high)
    part.flat(*reversed(low))
    return part


def cone(radius, height, corners):
    """Standing on y = 0; with four corners a pyramid."""
    part = Part()
    low = circle(radius, 0.0, corners)
    for i in range(corners):
        part.flat(low[i], low[(i + 1) % corners], (0.0, height, 0.0))
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
    def __init__(self):
        self.data = bytearray()
        self.gltf = {
            "asset": {"version": "2.0", "generator": "make_index_room.py", "copyright": "the ninebit authors, MIT"},
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": {"lights": []}},
            "scene": 0, "scenes": [{"name": "index room", "nodes": []}],
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

    def text(self):
        self.gltf["buffers"] = [{"byteLength": len(self.data), "uri": "data:application/octet-stream;base64," +
                                 base64.b64encode(self.data).decode("ascii")}]
        text = json.dumps(self.gltf, indent=2)
        # Lists of numbers on one line each.
        return re.sub(r"\[\s+([-+.\de,\s]+?)\s+\]", lambda m: "[" + re.sub(r"\s+", " ", m[1]) + "]", text) + "\n"


def index_room():
    document = Document()
    plaster, clay, sage = ("plaster", 0.62, 0.60, 0.56), ("clay", 0.58, 0.46, 0.40), ("sage", 0.46, 0.54, 0.46)
    floor, ceiling = ("floor", 0.48, 0.45, 0.42), ("ceiling", 0.66, 0.66, 0.66)
    colors = {(0, False): clay, (0, True): sage, (1, False): floor, (1, True): ceiling,
              (2, False): plaster, (2, True): plaster}
    document.solid("room", [(wall(axis, side), color) for (axis, side), color in colors.items()])

    y_axis, x_axis = (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)
    document.solid("torus", [(torus(1.05, 0.36, 30, 14), ("torus red", 0.86, 0.18, 0.13))], (-0.9, 1.75, -1.2),
                   multiplied(turn(y_axis, 38.0), turn(x_axis, 25.0)))
    # A gap below what stands on the floor: no two surfaces share a plane.
    ground = 0.02
    document.solid("cube", [(box(1.3, 1.3, 1.3), ("cube blue", 0.13, 0.32, 0.82))], (2.2, ground, -2.3),
                   turn(y_axis, 27.0))
    document.solid("sphere", [(sphere(0.75, 2), ("sphere gold", 0.93, 0.70, 0.14))], (1.5, 0.85, 1.1))
    document.solid("cone", [(cone(0.8, 1.9, 24), ("cone green", 0.15, 0.62, 0.25))], (-2.7, ground, 1.9))
    document.solid("cylinder", [(cylinder(0.55, 2.1, 24), ("cylinder violet", 0.52, 0.22, 0.72))],
                   (-3.7, ground, -1.0))
    document.solid("pyramid", [(cone(0.8, 1.1, 4), ("pyramid orange", 0.95, 0.45, 0.10))], (-0.6, ground, 2.2),
                   turn(y_axis, 12.0))
    document.solid("pillar", [(box(0.6, 2.6, 0.6), ("pillar teal", 0.10, 0.58, 0.60))], (0.7, ground, -3.4),
                   turn(y_axis, -18.0))

    document.gltf["extensions"]["KHR_lights_punctual"]["lights"].append(
        {"name": "lamp", "type": "point", "color": [1.0, 0.96, 0.88], "intensity": 200.0})
    document.node({"name": "lamp", "translation": list(LIGHT), "extensions": {"KHR_lights_punctual": {"light": 0}}})
    document.gltf["cameras"].append({"name": "view", "type": "perspective", "perspective": {
        "yfov": round(VERTICAL_FOV, 6), "aspectRatio": 1.333333, "znear": 0.05, "zfar": 50.0}})
    document.node({"name": "view", "camera": 0, "translation": list(CAMERA),
                   "rotation": rounded(looking(CAMERA, LOOK_AT))})
    return document.text()


def main(arguments):
    if arguments not in ([], ["--stdout"]):
        sys.exit(__doc__)
    if arguments:
        sys.stdout.write(index_room())
        return
    target = pathlib.Path(__file__).resolve().parent / "index_room.gltf"
    target.write_text(index_room(), encoding="ascii", newline="\n")
    print(target)


main(sys.argv[1:])
