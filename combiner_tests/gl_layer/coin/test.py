"""Coin 4 of the distribution: its sorted layers, by combiners and texture shaders, blend surfaces that cut each other.

Each pass draws the surfaces behind those of the pass before: a HILO texture and two dot products replace the depth, and a
depth comparison makes the combiners' alpha 0. The expected picture is computed from the rectangles' distances.
"""
import numpy

from kit import build, display, require

PACKAGES = "libcoin-dev, freeglut3-dev, python3-numpy and xvfb"
SIDE = 256
# Colours, and z at the left and right end (layers.cpp); the camera looks along -z.
SURFACES = [((255, 0, 0), -1.0, 1.0), ((0, 255, 0), 1.0, -1.0), ((0, 0, 255), 0.3, 0.3)]


def picture(file):
    content = file.read_bytes()
    return numpy.frombuffer(content[-3 * SIDE * SIDE:], numpy.uint8).reshape(SIDE, SIDE, 3)


def expected():
    """The row that all rows equal, and the pixels where two surfaces are as good as equally far."""
    center = (numpy.arange(SIDE) + 0.5) / SIDE
    depths = numpy.array([left + (right - left) * center for _, left, right in SURFACES])
    row = numpy.zeros((SIDE, 3))
    for x in range(SIDE):
        for surface in numpy.argsort(depths[:, x]):
            row[x] = 0.5 * row[x] + 0.5 * numpy.array(SURFACES[surface][0])
    gaps = numpy.diff(numpy.sort(depths, axis=0), axis=0).min(axis=0)
    return row, gaps < 1e-4


def run(kit):
    require(PACKAGES, ["Xvfb", "g++"], ["/usr/include/Inventor/SoDB.h", "/usr/include/GL/freeglut.h"])
    folder = kit.folder("coin")
    build("coin/layers.cpp", folder / "layers", "-lCoin", "-lglut", "-lGL", compiler="g++")
    row, ties = expected()
    with display() as environment:
        environment["COIN_SORTED_LAYERS_USE_NVIDIA_RC"] = "1"
        done = kit.run([folder / "layers", folder / "layers.ppm"], environment, layer=True)
        (folder / "layers.log").write_text(done.stdout)
        if not kit.check(done.returncode == 0, f"coin: exit status {done.returncode}"):
            return
        got = picture(folder / "layers.ppm").astype(int)
        wrong = (numpy.abs(got - row) > 2).any(axis=-1) & ~ties  # three blends in bytes
        distinct = len(numpy.unique(got.reshape(-1, 3), axis=0))
        kit.check(not wrong.any() and distinct == 4,
                  f"coin: {wrong.sum()} of {SIDE * SIDE} pixels of sorted layers are wrong, with {distinct} colours, "
                  f"{ties.sum()} columns left out")
        fragment_program = {**environment, "COIN_SORTED_LAYERS_USE_NVIDIA_RC": "0"}
        kit.run([folder / "layers", folder / "own.ppm"], fragment_program)
        own = picture(folder / "own.ppm").astype(int)
        differs = (numpy.abs(got - own) > 2).any(axis=-1).sum()
        kit.check(differs < SIDE * SIDE // 8,
                  f"coin: {differs} pixels differ from its fragment program's, which loses layers where two are near")
