"""Windows programs under Wine: with the layer wglGetProcAddress finds the combiners, and what they draw is `ninebit eval`'s.

The layer is loaded into Wine's own process, where Wine's OpenGL asks the system's for its functions. Wine's prefix is made
for the test and removed afterwards.
"""
import shutil
import subprocess

import numpy

from kit import HERE, build, display, require
from windows import direct3d

PACKAGES = "wine, wine64, gcc-mingw-w64-x86-64-win32, python3-numpy and xvfb"
COMPILER = "x86_64-w64-mingw32-gcc"
PROGRAMS, WAYS = ["compare", "specular", "mux", "final"], ["immediate", "list", "arrays", "pbuffer"]
FOG = [51, 102, 153, 255]
QUIET = {"WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree,mshtml,winemenubuilder.exe="}  # no questions, no menus
# The lines of print_errors() of the program: INVALID_ENUM 0500, INVALID_VALUE 0501, INVALID_OPERATION 0502; the defaults of
# A, PRIMARY_COLOR_NV, and of G, ALPHA.
ERRORS = """\
input GL_ONE: 0x0500
RGB in the alpha portion: 0x0502
99 combiners: 0x0501
input of A: 0x852c
usage of G: 0x1906
combiners: {}
combiners in use: 1
error: 0x0000"""
PROFILES = {"geforce2": 2, "nv2a": 8}  # and their combiners


def make_inputs(path):
    """Four planes of 256 colours: primary, secondary, and two textures; many bytes at the ends of their range."""
    random = numpy.random.default_rng(7)
    planes = random.integers(0, 256, (4, 256, 4), dtype=numpy.uint8)
    ends = numpy.array([0, 1, 127, 128, 254, 255], numpy.uint8)
    planes = numpy.where(random.random(planes.shape) < 0.3, random.choice(ends, planes.shape), planes)
    # Half of the fragments compare colours that are equal or nearly so.
    planes[2, :128, :3] = numpy.clip(planes[0, :128, :3].astype(int) + random.integers(-1, 2, (128, 3)), 0, 255)
    path.write_bytes(planes.tobytes())
    return planes


def expected(kit, name, planes, profile):
    columns = [f"{register}.{c}" for register in ("primary", "secondary", "tex0", "tex1", "fog") for c in "rgba"]
    columns.remove("secondary.a")  # the profile's
    fog = numpy.tile(FOG, (256, 1))
    rows = numpy.concatenate([planes[0], planes[1][:, :3], planes[2], planes[3], fog], axis=1).tolist()
    codes = kit.evaluate(HERE / "windows/programs.c", columns, rows, profile,
                         more=["--from", "source", "--function", f"set_up_{name}"])
    return numpy.clip(codes, 0, 255)


def judge(kit, profile, text, name, wanted):
    wrong, heads = {}, set()
    for way in WAYS:
        head, _, rest = text.partition(f"program {name}, {way}: ")[2].partition("\n")
        rows = [line.split() for line in rest.splitlines()[:256] if line[:1].isdigit()]
        heads.add(head)
        wrong[way] = (numpy.array(rows, int) != wanted).any(axis=1).sum() if len(rows) == 256 else 256
    distinct = len(numpy.unique(wanted, axis=0))
    figures = ", ".join(f"{count} {way}" for way, count in wrong.items())
    kit.check(not any(wrong.values()) and heads == {"error 0x0000, 0 pixels unlike their cell"} and distinct > 30,
              f"windows, {profile}, {name}: of 256 fragments differ from eval: {figures}; {distinct} results; "
              f"{'; '.join(sorted(heads))}")


def run(kit):
    require(PACKAGES, [COMPILER, "wine", "wineserver", "Xvfb"])
    folder = kit.folder("windows")
    planes = make_inputs(folder / "inputs.bin")
    build("windows/combiners.c", folder / "combiners.exe", "-lopengl32", "-lgdi32", compiler=COMPILER)
    prefix = folder / "prefix"
    with display() as environment:
        environment |= {**QUIET, "WINEPREFIX": str(prefix)}
        try:
            subprocess.run(["wineboot", "--init"], env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL, timeout=300, check=True)
            # Direct3D waits for ten seconds and more in the session that made the prefix: a new one begins.
            subprocess.run(["wineserver", "--kill"], env=environment, timeout=60)
            draw(kit, folder, planes, environment)
            direct3d.check(kit, folder, planes, environment, COMPILER)
        finally:
            subprocess.run(["wineserver", "--kill"], env=environment, stderr=subprocess.DEVNULL)
            subprocess.run(["wineserver", "--wait"], env=environment, stderr=subprocess.DEVNULL, timeout=60)
            shutil.rmtree(prefix, ignore_errors=True)


def draw(kit, folder, planes, environment):
    command = ["wine", "combiners.exe", "inputs.bin"]
    done = kit.run(command, environment, cwd=folder)
    kit.check(done.returncode == 2 and "address of glCombinerInputNV: none" in done.stdout and
              "GL_NV_register_combiners is missing" in done.stdout,
              f"windows, without the layer: {'; '.join(done.stdout.split(chr(10)))[:200].strip('; ')}")

    for profile, combiners in PROFILES.items():
        done = kit.run(command, environment, layer=True, profile=profile, cwd=folder)
        (folder / f"results_{profile}.txt").write_text(done.stdout)
        head = done.stdout.partition("program ")[0].strip()
        kit.check(done.returncode == 0 and "functions: 20 of 20" in head,
                  f"windows, {profile}: exit status {done.returncode}, functions: 20 of 20")
        kit.check(ERRORS.format(combiners) in head,
                  f"windows, {profile}: errors and gets of the specification: {', '.join(head.splitlines()[2:])}")
        for name in PROGRAMS:
            judge(kit, profile, done.stdout, name, expected(kit, name, planes, profile))
