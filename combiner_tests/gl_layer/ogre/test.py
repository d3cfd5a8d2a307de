"""OGRE 1.12 of the distribution: with the layer its OpenGL render system offers fp20 and draws RC1.0 materials to the bit.

Every cell of the mesh has one primary colour and one texel of each picture, so that `ninebit eval` gives its colour.
Fixed-function materials are drawn as well, with the layer and without: they show that the mesh is as expected, and that
the layer leaves them alone.
"""
import glob
import shutil

import numpy

import pictures
from kit import HERE, display, require

PACKAGES = "python3-ogre-1.12, libogre1.12.10, python3-numpy and xvfb"
FIXED, COMBINERS = ["textured", "colored"], ["dot3", "gloss", "final", "tinted"]
TINT = "const0 = (0.9, 0.6, 0.2, 0.8);"  # what OGRE gives the program of `tinted`
PROFILE = "nv2a"  # fp20 needs four texture units and constants of each stage
CELLS, CELL = 8, 8  # cells a side of the square, pixels a side of a cell


def plugins():
    """The folder of OGRE's plugins, or where it would be."""
    found = glob.glob("/usr/lib/*/OGRE/RenderSystem_GL.so*")
    return found[0].rsplit("/", 1)[0] if found else "/usr/lib/OGRE"


class Inputs:
    """Pictures and colours for each cell: all bytes at random, with many at the ends of their range."""

    def __init__(self, folder):
        random = numpy.random.default_rng(26)
        values = random.integers(0, 256, (5, CELLS, CELLS, 4), dtype=numpy.uint8)
        ends = numpy.array([0, 1, 127, 128, 254, 255], numpy.uint8)
        values = numpy.where(random.random(values.shape) < 0.3, random.choice(ends, values.shape), values)
        self.colors, self.textures = values[0], values[1:]
        for number, texture in enumerate(self.textures):
            pictures.write_png(folder / f"tex{number}.png", texture)
        numpy.savetxt(folder / "colors.txt", self.colors.reshape(-1, 4), fmt="%d")

    def expected(self, kit, program):
        columns = [f"{name}.{c}" for name in ("primary", "tex0", "tex1", "tex2", "tex3") for c in "rgba"]
        rows = numpy.concatenate([self.colors, *self.textures], axis=-1).reshape(-1, len(columns))
        codes = numpy.array(kit.evaluate(program, columns, rows.tolist(), PROFILE))
        return numpy.clip(codes, 0, 255).reshape(CELLS, CELLS, 4)


def judge(kit, folder, name, cells, how):
    """Compares a picture with its cells' colours, to the bit: in a texture with alpha, in the window without."""
    large = cells.repeat(CELL, axis=0).repeat(CELL, axis=1)
    distinct = len(numpy.unique(cells.reshape(-1, 4), axis=0))
    for file, channels in ((f"{name}.png", 4), (f"{name}_window.png", 3)):
        if not (folder / file).exists():
            kit.check(False, f"ogre, {how}: {file} was not written")
            continue
        drawn = pictures.read_png(folder / file)
        wrong = (drawn != large[:, :, :channels]).any(axis=-1).sum()
        kit.check(wrong == 0 and distinct > 30,
                  f"ogre, {how}: {wrong} of {large.shape[0] * large.shape[1]} pixels of {file} differ, with "
                  f"{distinct} colours")
        (folder / file).rename(folder / f"{how.replace(' ', '_')}_{file}")


def run(kit):
    require(PACKAGES, ["Xvfb"], [plugins(), "/usr/lib/python3/dist-packages/Ogre"])
    folder, here = kit.folder("ogre"), HERE / "ogre"
    for source in [*here.glob("*.material"), *here.glob("*.fp20")]:
        shutil.copy(source, folder)
    inputs = Inputs(folder)
    cells = {"textured": inputs.textures[0], "colored": inputs.colors}
    for name in COMBINERS:
        program = folder / f"{name}.rc1"  # the part that ninebit reads
        text = "!!RC1.0" + (here / f"{name}.fp20").read_text().split("!!RC1.0")[1]
        program.write_text(text.replace("{", "{ " + TINT, 1) if name == "tinted" else text)
        cells[name] = inputs.expected(kit, program)

    with display() as environment:
        environment["OGRE_PLUGINS"] = plugins()
        for how, layer in (("without the layer", False), ("with the layer", True)):
            done = kit.run(["/usr/bin/python3", here / "draw_material.py", folder, *FIXED, *COMBINERS], environment,
                           layer=layer, profile=PROFILE if layer else None)
            (folder / f"{how.replace(' ', '_')}.log").write_text(done.stdout)
            profiles = next((line for line in done.stdout.splitlines() if line.startswith("profiles: ")), done.stdout[-300:])
            kit.check(("fp20" in profiles.split()) == layer and f"fp20: {'yes' if layer else 'no'}" in done.stdout,
                      f"ogre, {how}: {profiles.strip()}")
            log = (folder / "ogre.log").read_text(errors="replace")
            kit.check("nvparse" not in log, f"ogre, {how}: nvparse reports nothing")
            for name in FIXED:
                judge(kit, folder, name, cells[name], how)
            for name in COMBINERS:
                drawn = f"{name}: drawn" in done.stdout
                if layer:
                    kit.check(drawn and done.returncode == 0, f"ogre, {how}: {name} is drawn, exit status {done.returncode}")
                    judge(kit, folder, name, cells[name], how)
                else:
                    kit.check(not drawn, f"ogre, {how}: {name} is not supported")

        capture(kit, folder, environment, cells["dot3"])


def capture(kit, folder, environment, cells):
    """A captured frame, of one draw into a texture and one into the window, is drawn again by `ninebit draw`."""
    done = kit.run(["/usr/bin/python3", HERE / "ogre/draw_material.py", folder, "dot3"], environment, layer=True,
                   profile=PROFILE, options=["--dump", folder / "dump", "--dump-frame", "1"])
    draws = sorted((folder / "dump/frame-001").glob("draw-*.json"))
    kit.check(done.returncode == 0 and len(draws) == 2, f"ogre, captured frame: {len(draws)} of 2 draws")
    large = cells.repeat(CELL, axis=0).repeat(CELL, axis=1)
    for draw, picture in zip(draws, (large[::-1], large)):  # OGRE draws into textures upside down
        kit.ninebit("draw", draw, "-o", folder / "again.png", "--quiet")
        wrong = (pictures.read_png(folder / "again.png") != picture).any(axis=-1).sum()
        kit.check(wrong == 0, f"ogre, captured frame: {wrong} of {large.shape[0] * large.shape[1]} pixels of {draw.name} differ "
                              f"when it is drawn again")
