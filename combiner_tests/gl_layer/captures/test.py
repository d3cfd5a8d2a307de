"""Captured frames: `ninebit draw` draws again what the program drew, also where the secondary colour and fog vary."""
import json
import zipfile

import numpy

import pictures
from kit import HERE, build, display, require

PACKAGES = "freeglut3-dev, gcc, python3-numpy and xvfb"
WIDTH, HEIGHT = 96, 64


def check_mode(kit, folder, mode, profile, environment):
    run = folder / f"{mode}_{profile}"
    run.mkdir()
    done = kit.run([folder / "captures", mode], environment, layer=True, profile=profile, cwd=run,
                   options=["--dump", run, "--dump-frame", "2"])
    name = f"captures, fog {mode}, {profile}"
    if not kit.check(done.returncode == 0, f"{name}: exit status {done.returncode} {done.stdout.strip()[-200:]}"):
        return
    window = numpy.frombuffer((run / "captures.rgb").read_bytes(), numpy.uint8).reshape(HEIGHT, WIDTH, 3)[::-1]
    frame = json.loads((run / "frame-002.json").read_text())
    draw = run / "frame-002/draw-001.json"
    kit.ninebit("draw", draw, "-o", run / "again.png", "--quiet")
    again, captured = pictures.read_png(run / "again.png"), pictures.read_png(draw.with_suffix(".png"))
    colors, factors = (len(numpy.unique(again[:, :, part].reshape(-1, depth), axis=0))
                       for part, depth in ((slice(0, 3), 3), (slice(3, 4), 1)))
    left = [part for call in frame["draws"] for part in call.get("left_out", [])]
    drawn = frame["draws"][0]["pixels"]
    wrong = (again != captured).any(axis=-1).sum()
    unlike = (captured[:, :, :3] != window).any(axis=-1).sum()
    traced = kit.ninebit("trace", "--effect", f"{run / 'frame-002.zip'}/draw-001.json", "--pixel", f"{WIDTH // 2},{HEIGHT // 2}")
    code = "fog.a" in traced
    archive = run / "frame-002.zip"
    kit.ninebit("draw", archive, "-o", run / "archive.png", "--quiet")
    with zipfile.ZipFile(archive) as files:
        names, damaged = files.namelist(), files.testzip()
    same = (run / "archive.png").read_bytes() == (run / "again.png").read_bytes()
    kit.check(same and code and damaged is None and {"draw-001.json", "draw-001.ply", "program-001.json", "frame-002.json"} <= set(names),
              f"{name}: frame-002.zip has {len(names)} files, and is drawn and traced as it is")
    kit.check(wrong == 0 and drawn > 4000 and unlike <= WIDTH * HEIGHT // 200 and not left and colors > 1000 and (factors > 50) == (mode != "none"),
              f"{name}: {wrong} of {drawn} pixels differ when they are drawn again, {unlike} from the program's own; {colors} "
              f"colours, {factors} alphas; left out: {left or 'nothing'}")


def run(kit):
    require(PACKAGES, ["gcc", "Xvfb"], ["/usr/include/GL/freeglut.h"])
    folder = kit.folder("captures")
    build(["gcc", "-std=gnu99", "-O2", "-Wall", "-Wextra", "-Wno-cast-function-type", "-Werror", HERE / "captures/captures.c", "-o",
           folder / "captures", "-lglut", "-lGL"])
    with display() as environment:
        for mode in ("linear", "exp2", "none"):
            for profile in ("geforce2", "nv2a"):
                check_mode(kit, folder, mode, profile, environment)
