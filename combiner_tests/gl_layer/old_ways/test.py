"""A freeglut program that draws in all ways of its time: with combiners the picture is the negative of the fixed-function one.

A smooth colour that lies within a float's error of the middle between two bytes may be rounded either way, which at most 1
in 200 pixels may be. Combiners in their default state draw fog and a separate highlight as fixed function does, within 2.
"""
import re

from kit import build, display, require

PACKAGES = "freeglut3-dev, gcc, python3-numpy and xvfb"
FIXED_FUNCTION = ("highlight", "fog")  # compared with itself, within 2


def compile_old_ways(program, *options, libraries=("-lglut", "-lGLU", "-lGL")):
    build("old_ways/old_ways.c", program, *options, *libraries)


def check_ways(kit, done, name):
    """Judges what old_ways prints with the layer."""
    ways = re.findall(r"^(.*): drawn (\d+), close (\d+), wrong (\d+), error (0x\d+)$", done.stdout, re.M)
    bad = [way for way, drawn, close, wrong, error in ways
           if int(drawn) < 100 or int(wrong) or error != "0x0000" or
           (int(close) * 200 > int(drawn) and way not in FIXED_FUNCTION)]
    close = sum(int(way[2]) for way in ways if way[0] not in FIXED_FUNCTION)
    drawn = sum(int(way[1]) for way in ways)
    kit.check(done.returncode == 0 and len(ways) == 33 and not bad,
              f"old_ways, {name}: {len(ways)} of 33 ways, {len(bad)} wrong ({', '.join(bad) or 'none'}); "
              f"{close} of {drawn} pixels were rounded the other way")


def run(kit):
    require(PACKAGES, ["gcc", "Xvfb"], ["/usr/include/GL/glut.h"])
    program = kit.folder("old_ways") / "old_ways"
    compile_old_ways(program)
    with display() as environment:
        done = kit.run([program], environment)
        kit.check(done.returncode == 2, f"old_ways, without the layer: {done.stdout.strip()}")
        for profile in ("geforce2", "nv2a"):
            done = kit.run([program], environment, layer=True, profile=profile)
            check_ways(kit, done, profile)
            (program.parent / f"{profile}.txt").write_text(done.stdout)
        old = {**environment, "MESA_GL_VERSION_OVERRIDE": "2.0", "MESA_GLSL_VERSION_OVERRIDE": "120"}
        done = kit.run([program], old, layer=True)
        said = [line for line in done.stdout.splitlines() if "GLSL 1.30" in line]
        kit.check(done.returncode == 2 and len(said) == 1 and "runs without register combiners" in said[0],
                  f"old_ways, a driver without integers in GLSL: {' '.join(said)}")
