#!/usr/bin/env python3
"""Writes index_room.gltf: a closed room with a torus and other solids around a point light.

Usage: make_index_room.py [--stdout]    (without it, writes index_room.gltf beside this file)
"""

import math
import sys

sys.dont_write_bytecode = True  # nothing is left beside the scenes
from gltf_document import Document, Part, add, box, cross, generate, multiplied, scaled, turn, unit, wall  # noqa: E402

LIGHT = (0.0, 4.1, 0.0)
CAMERA = (4.5, 3.9, 4.6)
LOOK_AT = (-0.7, 1.25, -0.9)
VERTICAL_FOV = math.radians(62.0)
LOW, HIGH = (-5.0, 0.0, -5.0), (5.0, 6.0, 5.0)
WALL_CELLS = 8


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


def index_room():
    document = Document("index room", "make_index_room.py")
    plaster, clay, sage = ("plaster", 0.62, 0.60, 0.56), ("clay", 0.58, 0.46, 0.40), ("sage", 0.46, 0.54, 0.46)
    floor, ceiling = ("floor", 0.48, 0.45, 0.42), ("ceiling", 0.66, 0.66, 0.66)
    colors = {(0, False): clay, (0, True): sage, (1, False): floor, (1, True): ceiling,
              (2, False): plaster, (2, True): plaster}
    document.solid("room", [(wall(LOW, HIGH, axis, side, WALL_CELLS), color) for (axis, side), color in colors.items()])

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

    document.light({"name": "lamp", "type": "point", "color": [1.0, 0.96, 0.88], "intensity": 200.0}, LIGHT)
    document.camera("view", VERTICAL_FOV, CAMERA, LOOK_AT)
    return document


generate(__file__, index_room(), sys.argv[1:], __doc__)
