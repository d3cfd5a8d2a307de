"""The article's program with the article's calls: its shadows are those of `ninebit render` except for rasterization.

The rules for a difference:
1. At every pixel the stencil equals `ninebit eval` of the two inputs that the program draws there without combiners: the
   polygon's index and the cube map's index.
2. Wherever `ninebit render` has the same two inputs, it has the same stencil.
3. The inputs differ only where an edge, in the window or in the map, passes a centre on the other side. ninebit snaps
   vertices to 1/16 pixel and llvmpipe to 1/256, so that edges lie at most 1/16 pixel apart: at most 1/16 of the pixels on
   edges may differ.
4. Where the polygons differ, each of both occurs within two pixels in the other picture.

A program that compares in floating point with step 1 must break these rules, and so must one with another step.

A frame with the layer may take 1.3 times the frame with a shader written by hand.
"""
import re

import numpy

import pictures
from index_cube_2000.scene_text import scene_text
from kit import HERE, ROOT, build, display, require

PACKAGES = "freeglut3-dev, gcc, python3-numpy and xvfb"
SIZE, MAP_SIZE, FRAMES, FRAMES_TIMED = "640x480", 256, 2, 20


def numbers(colors):
    return (colors.astype(int) * [1, 256, 65536]).sum(-1)


def around(picture, reach):
    """The picture moved by up to `reach` pixels in each direction."""
    height, width = picture.shape
    padded = numpy.pad(picture, reach, mode="edge")
    for y in range(2 * reach + 1):
        for x in range(2 * reach + 1):
            yield padded[y:y + height, x:x + width]


def on_edge(picture):
    return numpy.any([moved != picture for moved in around(picture, 1)], axis=0)


def within(value, picture, reach):
    return numpy.any([moved == value for moved in around(picture, reach)], axis=0)


class Picture:
    """The two inputs of the comparison, and the shadows."""

    def __init__(self, primary, texel, shadow):
        self.primary, self.texel, self.shadow = primary, texel, shadow

    @classmethod
    def of_program(cls, prefix):
        return cls(numbers(pictures.read_pnm(f"{prefix}_primary.ppm")), numbers(pictures.read_pnm(f"{prefix}_texel.ppm")),
                   pictures.read_pnm(f"{prefix}_shadow.pgm") != 0)

    @classmethod
    def of_render(cls, folder):
        layers = pictures.read_layers(folder / "layers.exr")
        index = lambda part: numbers(numpy.stack([layers[part][c] for c in "RGB"], axis=-1))
        return cls(index("primary"), index("texture0"), layers["stencil"]["stencil"] != 0)


def judge(kit, ours, theirs, profile):
    """The four rules for a program's picture and that of `ninebit render`: [(holds, figures)]."""
    pairs, place = numpy.unique(numpy.stack([ours.primary.ravel(), ours.texel.ravel()]), axis=1, return_inverse=True)
    bytes_of = lambda n: [n & 255, n >> 8 & 255, n >> 16]
    columns = [f"{name}.{c}" for name in ("primary", "tex0") for c in "rgb"]
    rows = [bytes_of(p) + bytes_of(t) for p, t in pairs.T.tolist()]
    alpha = numpy.array([out[3] for out in kit.evaluate(HERE / "index_cube_2000/compare.gl", columns, rows, profile)])
    expected = (alpha > 0)[place.ravel()].reshape(ours.shadow.shape)

    primary, texel = ours.primary != theirs.primary, ours.texel != theirs.texel
    wrong = (ours.shadow != expected).sum()
    apart = ((ours.shadow != theirs.shadow) & ~primary & ~texel).sum()
    differ, edges = (primary | texel).sum(), (on_edge(theirs.primary) | on_edge(theirs.texel)).sum()
    stray = (primary & ~(within(ours.primary, theirs.primary, 2) & within(theirs.primary, ours.primary, 2))).sum()
    return [
        (wrong == 0, f"{wrong} of {expected.size} pixels differ from eval, for {len(rows)} pairs of indices"),
        (apart == 0, f"{apart} pixels with the inputs of render have another shadow"),
        (differ * 16 <= edges, f"inputs differ at {differ} pixels, at most 1/16 of the {edges} on edges"),
        (stray * 20 <= primary.sum(), f"{stray} of {primary.sum()} differing polygons are not neighbours, at most 1/20"),
    ]


def report(kit, name, rules):
    for holds, figures in rules:
        kit.check(holds, f"index_cube_2000, {name}: {figures}")


def refused(kit, name, rules):
    broken = [figures for holds, figures in rules if not holds]
    kit.check(broken, f"index_cube_2000, {name}: breaks the rules ({'; '.join(broken) or 'it does not'})")


def run(kit):
    require(PACKAGES, ["gcc", "Xvfb"], ["/usr/include/GL/glut.h"])
    folder, here = kit.folder("index_cube_2000"), HERE / "index_cube_2000"
    room = ROOT / "scenes/index_room.gltf"
    (folder / "room.txt").write_text(scene_text(room))
    program = build("index_cube_2000/index_cube_2000.c", folder / "index_cube_2000", "-lglut", "-lGLU", "-lGL")

    def render(name, step, profile):
        kit.ninebit("render", room, "-o", folder / name, "--size", SIZE, "--map-size", MAP_SIZE, "--index-step", step,
                    "--profile", profile, "--layers", "--only", "layers", "--quiet")
        return Picture.of_render(folder / name)

    with display() as environment:
        def draw(name, step, *more, **how):
            done = kit.run([program, folder / "room.txt", "--size", SIZE, "--map-size", MAP_SIZE, "--step", step, "--frames",
                            FRAMES, "--output", folder / name, *more], environment, **how)
            if done.returncode != 0:
                kit.check(False, f"index_cube_2000, {name}: exit status {done.returncode}: {done.stdout.strip()}")
                return None
            return Picture.of_program(folder / name)

        done = kit.run([program, folder / "room.txt"], environment)
        kit.check(done.returncode == 2 and "GL_NV_register_combiners is missing" in done.stdout,
                  f"index_cube_2000, without the layer: {done.stdout.strip()}")

        expected = {(2, "geforce2"): render("render_2", 2, "geforce2"), (1, "geforce2"): render("render_1", 1, "geforce2"),
                    (1, "nv2a"): render("render_nv2a", 1, "nv2a")}
        for (step, profile), theirs in expected.items():
            ours = draw(f"layer_step_{step}_{profile}", step, layer=True, profile=profile)
            if ours:
                report(kit, f"step {step}, {profile}", judge(kit, ours, theirs, profile))

        shader = ["--glsl", here / "compare.frag"]
        report(kit, "a shader by hand", judge(kit, draw("hand", 2, *shader), expected[2, "geforce2"], "geforce2"))
        refused(kit, "another step", judge(kit, draw("other_step", 3, *shader), expected[2, "geforce2"], "geforce2"))
        float_shader = ["--glsl", here / "compare_float.frag"]
        refused(kit, "a comparison in floating point, step 1",
                judge(kit, draw("float", 1, *float_shader), expected[1, "geforce2"], "geforce2"))

        def milliseconds(frames, *more, **how):
            done = kit.run([program, folder / "room.txt", "--size", SIZE, "--map-size", MAP_SIZE, "--frames", frames,
                            *more], environment, **how)
            found = re.search(r"([0-9.]+) ms a frame", done.stdout)
            if done.returncode != 0 or not found:
                raise RuntimeError(f"exit status {done.returncode}: {done.stdout.strip()}")
            return float(found[1])

        for _ in range(10):  # a program with a shader of its own draws and ends as without the layer
            milliseconds(2, *shader, layer=True)
        # The best of each, as other programs run beside them; more rounds only while it is not good enough.
        ours = by_hand = float("inf")
        for _ in range(12):
            ours = min(ours, milliseconds(FRAMES_TIMED, layer=True, profile="geforce2"))
            by_hand = min(by_hand, milliseconds(FRAMES_TIMED, *shader))
            if ours <= 1.3 * by_hand:
                break
        kit.check(ours <= 1.3 * by_hand, f"index_cube_2000, cost: {ours:.1f} ms a frame with the layer, {by_hand:.1f} ms "
                                         f"with a shader by hand; at most 1.3 times")
