"""Captured frames: `ninebit draw` draws again what the program drew, also where the secondary colour and fog vary.

Archives have the frame's own files, or there is none.
"""
import json
import os
import pathlib
import zipfile

import numpy

import pictures
from kit import build, display, require

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


def check_tie(kit, folder, environment):
    """0.7 * 255 is 178.5 in floats of 32 bits, in which the shader rounds it to 179, and less in double precision."""
    run = folder / "tie"
    run.mkdir()
    (run / "nearest.json").write_text('{"base": "nv2a", "name": "nearest", "fog_byte": "nearest"}')
    done = kit.run([folder / "captures", "tie"], environment, layer=True, profile=run / "nearest.json", cwd=run,
                   options=["--dump", run, "--dump-frame", "2"])
    kit.ninebit("draw", run / "frame-002/draw-001.json", "--profile", run / "nearest.json", "-o", run / "again.png", "--quiet")
    again, captured = pictures.read_png(run / "again.png"), pictures.read_png(run / "frame-002/draw-001.png")
    alphas = sorted({int(alpha) for alpha in again[:, :, 3].flat})
    kit.check(done.returncode == 0 and (again == captured).all() and alphas == [0, 179],
              f"captures, a fog factor between two bytes: {(again != captured).any(axis=-1).sum()} pixels differ, alphas {alphas}")


def check_archive(kit, folder, mode, environment):
    """In a folder with an earlier run's files: returns the frame, the archive's names (None: it is not there), the log."""
    run = folder / f"archive_{mode}"
    (run / "frame-002").mkdir(parents=True)
    (run / "frame-002/draw-000.json").write_text('{"ninebit": "effect"}')
    os.mkfifo(run / "frame-002/draw-000.ply")  # whoever reads it waits
    (run / "frame-002.zip").write_text("an earlier run's")
    done = kit.run([folder / "captures", mode], environment, layer=True, cwd=run, options=["--dump", run, "--dump-frame", "2"])
    kit.check(done.returncode == 0 and not list(run.rglob("*.part")), f"captures {mode}: exit status {done.returncode}")
    archive, names = run / "frame-002.zip", None
    if archive.exists():
        with zipfile.ZipFile(archive) as files:
            names = files.namelist()
    return json.loads((run / "frame-002.json").read_text()), names, done.stdout


def check_archives(kit, folder, environment):
    frame, names, log = check_archive(kit, folder, "windows", environment)
    own = {pathlib.Path(file).name for call in frame["draws"] for file in call["files"]}
    kit.check(len(frame["draws"]) == 2 and "draw-002.json" in own and own | {"frame-002.json"} ==
              {name for name in names if not name.startswith("program-")} and "and frame-002.zip" in log, f"an archive of two windows has their files alone: {', '.join(names)}")
    frame, names, log = check_archive(kit, folder, "plain", environment)
    kit.check(len(frame["draws"]) == 1 and names is None and "1 draw calls" in log and ".zip" not in log,
              f"a frame without combiners has no archive: {log.strip()}")
    frame, names, log = check_archive(kit, folder, "many", environment)
    kit.check(len(frame["draws"]) == 1400 and names is None and log.count(".zip") == 1 and "at most 4096 files" in log,
              f"a frame with too many files has no archive: {log.strip()}")


def run(kit):
    require(PACKAGES, ["gcc", "Xvfb"], ["/usr/include/GL/freeglut.h"])
    folder = kit.folder("captures")
    build("captures/captures.c", folder / "captures", "-lglut", "-lGL")
    with display() as environment:
        for mode in ("linear", "exp2", "none"):
            for profile in ("geforce2", "nv2a"):
                check_mode(kit, folder, mode, profile, environment)
        check_tie(kit, folder, environment)
        check_archives(kit, folder, environment)
