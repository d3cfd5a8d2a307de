"""ZIP archives with an effect: fields of their headings, and bytes of what is packed."""
import io
import zipfile

from judge import Case
from mutate import few, integer, name
from scenes import bytes_or, finish

EFFECT = (b'{"ninebit": "effect", "version": 1, "size": [8, 8], "scene": {"mesh": "m.ply"}, "passes": '
          b'[{"program": "p.rc1", "primary": "color", "secondary": "secondary-color", "fog": {"factor": "mesh"}}]}')
MESH = (b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        b"property uchar secondary_red\nproperty uchar secondary_green\nproperty uchar secondary_blue\n"
        b"property float fog_factor\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        b"0 0 0 1 2 3 0.5\n1 0 0 4 5 6 1\n0 1 0 7 8 9 0\n3 0 1 2\n")
FILES = {"a.json": EFFECT, "m.ply": MESH, "p.rc1": b"!!RC1.0\nout.rgb = col0.rgb + col1.rgb;\nout.a = fog.a;\n"}


def change_fields(random, data):
    """Numbers of headings, at any place after the two letters with which each begins."""
    data = bytearray(data)
    headings = [at for at in range(len(data) - 4) if data[at:at + 2] == b"PK"]
    for _ in range(few(random)):
        size = random.choice([2, 4])
        at = min(random.choice(headings) + random.randrange(4, 46), len(data) - size)
        value = integer(random, int.from_bytes(data[at:at + size], "little"))
        data[at:at + size] = (value % 256 ** size).to_bytes(size, "little")
    return bytes(data)


def archive(random, _context):
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as files:
        for own, data in FILES.items():
            named = name(random)[:1000] if random.random() < 0.03 else own
            entry = zipfile.ZipInfo(named.replace("\x00", ""))  # of 1980, so that a number gives the same mutant
            files.writestr(entry, data, random.choice([zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED]))
    data = bytes_or(random, content.getvalue(), lambda d: change_fields(random, d))
    command = random.choice([["draw", "a.zip", "-o", "out.png"], ["draw", "a.zip/a.json", "-o", "out.png"],
                             ["trace", "--effect", "a.zip", "--pixel", "3,3"]])
    return finish(random, Case(command, {"a.zip": data}))
