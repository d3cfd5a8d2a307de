"""Where mutants begin: files of the tree, small files of the model packages, and some that are written here."""
import functools
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORPUS = ROOT / "combiner_tests" / "fuzz" / "corpus"
MODELS = [pathlib.Path("/usr/share/assimp/models"), pathlib.Path("/usr/share/glmark2/models")]
LARGEST = 24 << 10

CUBE = """# a cube with materials
mtllib a.mtl
o cube
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
vt 0 0
vt 1 0
vt 1 1
vn 0 0 1
vn 0 0 -1
g sides
usemtl red
s 1
f 1//2 4//2 3//2 2//2
f 5/1/1 6/2/1 7/3/1 8/1/1
usemtl blue
f 1 2 6 5
f -6 -5 -1 -2
g other
f 3 4 8 7
f 4 1 5
f 4 5 8
"""
LIBRARY = """newmtl red
Kd 1 0 0
Ka 0.1 0 0
Ns 10
illum 2
map_Kd a.png
newmtl blue
Kd 0 0 1
d 0.5
map_Kd -s 1 1 1 -o 0 0 0 a.png
map_Bump -bm 0.5 a.png
"""
OFF = "OFF\n5 5 8\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.5 1\n4 0 3 2 1\n3 0 1 4\n3 1 2 4 255 0 0\n3 2 3 4\n3 3 0 4\n"
PLY = """ply
format ascii 1.0
comment a pyramid
element vertex 5
property float x
property float y
property float z
property uchar red
element face 5
property list uchar int vertex_indices
end_header
0 0 0 1
1 0 0 2
1 1 0 3
0 1 0 4
0.5 0.5 1 5
4 0 3 2 1
3 0 1 4
3 1 2 4
3 2 3 4
3 3 0 4
"""


@functools.lru_cache(maxsize=None)
def models(extensions):
    """Small models of the installed packages, in order of their names."""
    found = []
    for folder in MODELS:
        for path in sorted(folder.rglob("*")):
            if path.suffix.lower() in extensions and path.is_file() and 0 < path.stat().st_size <= LARGEST:
                found.append(path)
    return found


@functools.lru_cache(maxsize=None)
def corpus(name):
    return [path.read_bytes() for path in sorted((CORPUS / name).iterdir())]


@functools.lru_cache(maxsize=None)
def corpus_with(name, *starts):
    """Files of a corpus that begin with one of these bytes."""
    return [data for data in corpus(name) if data.startswith(starts)]


def answer(program, *arguments, folder=None):
    """What the program prints; a start file that cannot be made is an error of the run."""
    result = subprocess.run([str(program), *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False,
                            cwd=folder, timeout=120)
    if result.returncode != 0:
        raise RuntimeError(f"ninebit {' '.join(arguments)}: exit {result.returncode}: {result.stderr.decode()}")
    return result.stdout
