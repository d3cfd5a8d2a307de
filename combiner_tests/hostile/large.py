"""Files of kept cases that are too large to be kept: small texts that ask for much."""
import json
import struct


def gltf(vertices, primitives, nodes=1, stride=12):
    """Primitives that share one large accessor, and nodes that share one mesh; each draws one triangle."""
    size = (vertices - 1) * stride + 12
    data = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + bytes(size - 36) + struct.pack("<4H", 0, 1, 2, 0)
    tree = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(nodes))}],
            "nodes": [{"mesh": 0}] * nodes,
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}] * primitives}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": vertices},
                          {"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 3}],
            "bufferViews": [{"buffer": 0, "byteLength": size, "byteStride": stride},
                            {"buffer": 0, "byteOffset": size, "byteLength": 6}],
            "buffers": [{"byteLength": size + 8, "uri": "a.bin"}]}
    return {"a.gltf": json.dumps(tree).encode(), "a.bin": data}


def shared_accessor():
    """1.2 MB of primitives that overlap in one accessor of 65,536 vertices."""
    return gltf(65536, 20000, stride=4)


def shared_large_accessor():
    return gltf(1000000, 400, stride=4)


def shared_mesh():
    """Nodes that place one mesh of a million vertices, of which one triangle is drawn."""
    return gltf(1000000, 1, nodes=5000)


def obj_usemtl():
    lines = ["mtllib a.mtl", "v 0 0 0", "v 1 0 0", "v 0 1 0"]
    lines += [f"usemtl m{k % 100}\nf 1 2 3" for k in range(100000)]
    library = "".join(f"newmtl m{k}\nKd 1 0 0\n" for k in range(100))
    return {"a.obj": "\n".join(lines).encode(), "a.mtl": library.encode()}


def obj_newmtl():
    library = "".join(f"newmtl m{k}\nKd 1 0 0\n" for k in range(60000))
    return {"a.obj": b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m59999\nf 1 2 3\n", "a.mtl": library.encode()}


def obj_groups():
    return {"a.obj": ("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "".join(f"g g{k}\nf 1 2 3\n" for k in range(200000))).encode()}


def obj_objects():
    return {"a.obj": ("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "".join(f"o g{k}\nf 1 2 3\n" for k in range(200000))).encode()}


def obj_fan():
    """100,000 triangles around one vertex."""
    rows = ["v 0 0 1"] + [f"v {k % 317} {k // 317} 0" for k in range(100001)]
    return {"a.obj": "\n".join(rows + [f"f 1 {k + 2} {k + 3}" for k in range(100000)]).encode()}


def obj_polygon():
    """One polygon of 60,000 corners."""
    rows = [f"v {k} {k * k % 65537} 0" for k in range(60000)]
    return {"a.obj": ("\n".join(rows) + "\nf " + " ".join(str(k + 1) for k in range(60000)) + "\n").encode()}


def chunk(ident, body):
    return struct.pack("<HI", ident, len(body) + 6) + body


def instances_3ds(faces=1000, nodes=20000):
    """Key-frame nodes that all place one mesh."""
    vertices = struct.pack("<H", 3) + struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    mesh = chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120,
                                                         struct.pack("<H", faces) + struct.pack("<4H", 0, 1, 2,
                                                                                                0) * faces))
    placed = b"".join(chunk(0xB002, chunk(0xB030, struct.pack("<H", k % 65535)) + chunk(0xB010,
                                                                                        b"a\0" + struct.pack("<HHH", 0,
                                                                                                             0,
                                                                                                             0xffff)))
                      for k in range(nodes))
    return {"a.3ds": chunk(0x4D4D, chunk(0x3D3D, chunk(0x4000, b"a\0" + mesh)) + chunk(0xB000, placed))}


def instances_3ds_many_faces():
    return instances_3ds(60000, 10000)


def off_long_line():
    """A face of 200,000 corners in one line."""
    return {"a.off": ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n200000 " + "0 1 2 " * 66667 + "\n").encode()}


def program_of_faults():
    return {"a.gl": b"glCombinerInputNV(GL_FALSE);\n" * 100000}


def json_of_one_key():
    return {"a.json": b'{"ninebit":"program",' + b",".join(b'"a":0' for _ in range(500000)) + b"}"}
