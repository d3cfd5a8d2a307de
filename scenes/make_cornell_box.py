#!/usr/bin/env python3
"""Writes cornell_box.gltf: an open box with a red and a green wall, two boxes in it, and a spot light at its ceiling.

Usage: make_cornell_box.py [--stdout]    (without it, writes cornell_box.gltf beside this file)
"""

import math
import sys

sys.dont_write_bytecode = True  # nothing is left beside the scenes
from gltf_document import Document, box, generate, turn, wall  # noqa: E402

LOW, HIGH = (-3.0, 0.0, -3.0), (3.0, 6.0, 3.0)
WALL_CELLS = 6
LIGHT, LIGHT_TARGET = (0.3, 5.7, 1.2), (0.1, 0.0, -0.3)
SPOT_DEGREES = 100.0
CAMERA, LOOK_AT = (0.0, 3.0, 10.6), (0.0, 2.9, 0.0)
VERTICAL_FOV = math.radians(46.0)


def cornell_box():
    document = Document("cornell box", "make_cornell_box.py")
    white, red, green = ("white", 0.74, 0.72, 0.68), ("red", 0.66, 0.07, 0.06), ("green", 0.13, 0.47, 0.11)
    colors = {(0, False): red, (0, True): green, (1, False): white, (1, True): white, (2, False): white}
    document.solid("room", [(wall(LOW, HIGH, axis, side, WALL_CELLS), color)
                            for (axis, side), color in colors.items()])

    # A gap below what stands on the floor: no two surfaces share a plane.
    up, ground = (0.0, 1.0, 0.0), 0.02
    document.solid("tall box", [(box(1.7, 3.5, 1.7), white)], (-1.0, ground, -1.1), turn(up, 18.0))
    document.solid("low box", [(box(1.6, 1.6, 1.6), white)], (1.1, ground, 0.8), turn(up, -17.0))

    document.light({"name": "spot", "type": "spot", "color": [1.0, 0.95, 0.86], "intensity": 200.0,
                    "spot": {"innerConeAngle": 0.0, "outerConeAngle": round(math.radians(SPOT_DEGREES / 2.0), 6)}},
                   LIGHT, LIGHT_TARGET)
    document.camera("view", VERTICAL_FOV, CAMERA, LOOK_AT)
    return document


generate(__file__, cornell_box(), sys.argv[1:], __doc__)
