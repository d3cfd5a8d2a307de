"""The room of a glTF file as the lines of text that index_cube_2000 reads (scene.h), with the light of `ninebit render`.

Only what the files of scenes/ use: nodes with a translation and a rotation, one camera, one point light, 32-bit floats
and 16-bit indices in one buffer inside the file.
"""
import base64
import json
import math
import struct

AMBIENT, DIFFUSE, DIFFUSE_IN_SHADOW = 0.22, 0.78, 0.25  # src/frame/shading.cpp
NEAR, FAR = 0.25, 25.0  # the room's diagonal is 15.4; the nearest wall is 0.4 from the camera


def turned(v, q):
    """The vector v turned by the quaternion q."""
    x, y, z, w = q
    cross = lambda a, b: [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    t = [2.0 * c for c in cross([x, y, z], v)]
    u = cross([x, y, z], t)
    return [v[i] + w * t[i] + u[i] for i in range(3)]


class Gltf:
    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            self.d = json.load(file)
        self.bytes = base64.b64decode(self.d["buffers"][0]["uri"].split(",", 1)[1])

    def accessor(self, number):
        a = self.d["accessors"][number]
        view = self.d["bufferViews"][a["bufferView"]]
        size = {"SCALAR": 1, "VEC3": 3}[a["type"]]
        letter = {5126: "f", 5123: "H", 5125: "I"}[a["componentType"]]
        start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
        values = struct.unpack_from(f"<{size * a['count']}{letter}", self.bytes, start)
        return values if size == 1 else [values[i:i + 3] for i in range(0, len(values), 3)]

    def node_with(self, has):
        return next(n for n in self.d["nodes"] if has(n))


def scene_text(path):
    g = Gltf(path)
    lamp = g.node_with(lambda n: "extensions" in n)
    light = lamp["translation"]
    light_color = g.d["extensions"]["KHR_lights_punctual"]["lights"][0]["color"]
    view = g.node_with(lambda n: "camera" in n)
    eye = view["translation"]
    ahead = turned([0.0, 0.0, -1.0], view["rotation"])
    fov = math.degrees(g.d["cameras"][0]["perspective"]["yfov"])

    vertices, triangles = [], []
    for node in g.d["nodes"]:
        for primitive in g.d["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
            rotation, first = node.get("rotation", [0.0, 0.0, 0.0, 1.0]), len(vertices)
            base = g.d["materials"][primitive["material"]]["pbrMetallicRoughness"]["baseColorFactor"]
            for position, normal in zip(g.accessor(primitive["attributes"]["POSITION"]),
                                        g.accessor(primitive["attributes"]["NORMAL"])):
                p = [a + b for a, b in zip(turned(position, rotation), node["translation"])]
                toward = [l - c for l, c in zip(light, p)]
                length = math.sqrt(sum(c * c for c in toward))
                cosine = abs(sum(a * b for a, b in zip(turned(normal, rotation), toward)) / length)
                lit = [base[i] * (AMBIENT + DIFFUSE * cosine * light_color[i]) for i in range(3)]
                dark = [base[i] * (AMBIENT + DIFFUSE * cosine * light_color[i] * DIFFUSE_IN_SHADOW) for i in range(3)]
                vertices.append([*p, *lit, *dark])
            indices = g.accessor(primitive["indices"])
            triangles += [[first + k for k in indices[i:i + 3]] for i in range(0, len(indices), 3)]

    line = lambda *values: " ".join(f"{v:.9g}" for v in values)
    return "\n".join([
        "camera " + line(*eye, *[a + b for a, b in zip(eye, ahead)], fov, NEAR, FAR),
        "light " + line(*light, NEAR, FAR),
        f"vertices {len(vertices)}", *[line(*v) for v in vertices],
        f"triangles {len(triangles)}", *[" ".join(map(str, t)) for t in triangles]]) + "\n"
