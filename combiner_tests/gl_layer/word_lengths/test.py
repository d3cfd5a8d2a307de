"""Programs of 32 bits beside those of 64: the dynamic linker takes the layer of the program's own word length.

Where there is a 32-bit OpenGL, old_ways draws with it, index_cube_2000, a program with further extensions, and random programs,
NINEBIT_GL_PROGRAMS of them or 60; the pictures of the last two must be those of 64 bits: in NINEBIT_GL32_LIBRARIES, or where Debian has it. In CI, `fetch` gets it.
"""
import os
import pathlib
import shutil
import subprocess

from index_cube_2000.scene_text import scene_text
from index_cube_2000.test import Picture, judge, report
from kit import HERE, ROOT, Missing, build, display, require
from old_ways.test import check_ways, compile_old_ways

PACKAGES = "g++-multilib, libegl-dev and libgl-dev"
OPENGL = "libglut3.12:i386, libglu1-mesa:i386, libegl1:i386 and libgl1-mesa-dri:i386"
DRAWN = """a vertex program: 51 102 153 255, error 0x0000
attribute arrays, after a state program: 102 153 0 255, error 0x0000
a texture of indices: 10 20 30 40, error 0x0000
another colour in its palette: 90 80 70 60, error 0x0000
"""


def check_loading(kit, folder):
    found = {"": "%d bits, glCombinerParameteriNV of nobody\n", "layer": "%d bits, glCombinerParameteriNV of libninebit_gl.so\n"}
    for bits, options in ((64, []), (32, ["-m32", "-mpreferred-stack-boundary=2"])):
        program = build("word_lengths/loads.c", folder / f"loads{bits}", *options)
        for layer in ("", "layer"):
            done = kit.run([program], None, layer=bool(layer))
            kit.check(done.returncode == 0 and done.stdout == found[layer] % bits,
                      f"{bits} bits{', with the layer' if layer else ''}: {done.stdout.strip()}")
    # One program of each word length, started by a shell of 64 bits.
    done = kit.run(["sh", "-c", f"{folder}/loads32 && {folder}/loads64 fails"], None, layer=True)
    kit.check(done.returncode == 5 and done.stdout == found["layer"] % 32 + found["layer"] % 64,
              f"both from one shell: {' '.join(done.stdout.split())}")


def check_missing(kit, folder):
    """A build without the layer of 32 bits says so of such a program, and runs others."""
    alone = folder / "without_gl32"
    alone.mkdir()
    for name in ("ninebit", "libninebit_gl.so"):
        shutil.copy(kit.ninebit_path.parent / name, alone)
    for bits, expected in ((32, 3), (64, 0)):
        done = subprocess.run([alone / "ninebit", "gl-run", "--", folder / f"loads{bits}"], capture_output=True, text=True)
        said = "libninebit_gl32.so is missing" in done.stderr and done.stderr.count("\n") == 1
        kit.check(done.returncode == expected and said == (bits == 32),
                  f"without libninebit_gl32.so, {bits} bits: exit {done.returncode} {done.stderr.strip()}")


def check_extensions(kit, folder, bits, options, environment):
    program = build("word_lengths/extensions.c", folder / f"extensions{bits}", *options)
    done = kit.run([program], {**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1", **environment}, layer=True,
                   options=("--extensions", "all"))
    kit.check(done.returncode == 0 and done.stdout == DRAWN, f"further extensions, {bits} bits: {'; '.join(done.stdout.splitlines())}")


def check_random_programs(kit, folder, of_each):
    """of_each: for each word length the compiler's options and the environment."""
    count = int(os.environ.get("NINEBIT_GL_PROGRAMS", 60))
    printed = {}
    for bits, (options, environment) in of_each.items():
        program = build("word_lengths/random_programs.c", folder / f"random_programs{bits}", *options)
        printed[bits] = kit.run([program, count], {**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1", **environment}, layer=True,
                                timeout=60 + count).stdout.splitlines()
        good = [line for line in printed[bits] if line.endswith("error 0x0000")]
        pictures = {line.split()[1] for line in good}
        kit.check(len(good) == len(printed[bits]) == count and 2 * len(pictures) > count,
                  f"random programs, {bits} bits: {len(good)} of {count} drawn, {len(pictures)} different pictures")
    differ = sum(map(str.__ne__, printed[64], printed[32]))
    kit.check(differ == 0, f"random programs: {differ} of {count} pictures of 256 fragments differ between 32 and 64 bits")


def check_index_cube(kit, folder, libraries, of_32_bits):
    """The article's program with both word lengths: its rules hold for the pictures of 32 bits beside those of 64."""
    (folder / "room.txt").write_text(scene_text(ROOT / "scenes/index_room.gltf"))
    with display() as environment:
        for bits, options, more in ((64, ["-lglut", "-lGLU", "-lGL"], {}), (32, ["-m32", *libraries, "-lm"], of_32_bits)):
            program = build("index_cube_2000/index_cube_2000.c", folder / f"index_cube_2000_{bits}", *options)
            done = kit.run([program, folder / "room.txt", "--size", "320x240", "--map-size", 128, "--step", 2, "--frames", 1,
                            "--output", folder / f"room{bits}"], environment | more, layer=True)
            kit.check(done.returncode == 0, f"index_cube_2000, {bits} bits: exit status {done.returncode} {done.stdout.strip()[-200:]}")
    ours, theirs = (Picture.of_program(folder / f"room{bits}") for bits in (32, 64))
    # The vertices' floats differ between the processor's units. Too few polygons differ for the fourth rule.
    report(kit, "32 bits (in the place of render: 64)", judge(kit, ours, theirs, "nv2a")[:3])


def libraries_of_32_bits(folder):
    """The folder of a 32-bit OpenGL, or None."""
    libraries = pathlib.Path(os.environ.get("NINEBIT_GL32_LIBRARIES", "/usr/lib/i386-linux-gnu"))
    if (libraries / "libGL.so.1").exists() or not os.environ.get("CI"):
        return libraries
    fetched = subprocess.run([HERE / "word_lengths/fetch", folder / "fetched"], capture_output=True, text=True)
    print(fetched.stderr, end="")
    return pathlib.Path(fetched.stdout.strip()) if fetched.returncode == 0 else libraries


def check_drawing(kit, folder):
    libraries = libraries_of_32_bits(folder)
    linked = [libraries / name for name in ("libglut.so.3.12", "libGLU.so.1", "libGL.so.1", "libEGL.so.1")]
    if not all(map(pathlib.Path.exists, linked)) or not shutil.which("Xvfb"):
        print(f"      skipped: drawing with 32 bits needs {OPENGL}, and xvfb")
        return
    of_32_bits = {"LD_LIBRARY_PATH": str(libraries), "LIBGL_DRIVERS_PATH": str(libraries / "dri")}
    options = ["-m32", "-mpreferred-stack-boundary=2", *linked[2:], "-Wl,--allow-shlib-undefined"]
    check_extensions(kit, folder, 32, options, of_32_bits)
    check_random_programs(kit, folder, {64: (["-lEGL", "-lGL"], {}), 32: (options, of_32_bits)})
    check_index_cube(kit, folder, [*linked[:3], "-Wl,--allow-shlib-undefined"], of_32_bits)
    for name, stack in (("32 bits", []), ("32 bits, a stack at multiples of 4", ["-mpreferred-stack-boundary=2"])):
        program = folder / "old_ways32"
        compile_old_ways(program, "-m32", *stack, libraries=[*linked[:3], "-Wl,--allow-shlib-undefined", "-lm"])
        with display() as environment:
            environment |= of_32_bits
            check_ways(kit, kit.run([program], environment, layer=True), name)


def run(kit):
    require(PACKAGES, ["gcc"], ["/usr/include/EGL/egl.h", "/usr/include/GL/glext.h"])
    folder = kit.folder("word_lengths")
    (folder / "none.c").write_text("#include <errno.h>\nint main(void) { return 0; }\n")
    if subprocess.run(["gcc", "-m32", folder / "none.c", "-o", folder / "none"], capture_output=True).returncode:
        raise Missing("gcc makes no programs of 32 bits; install g++-multilib")
    if not (kit.ninebit_path.parent / "libninebit_gl32.so").exists():
        raise Missing("libninebit_gl32.so is not built; configure again where g++-multilib is installed")
    check_loading(kit, folder)
    check_missing(kit, folder)
    check_extensions(kit, folder, 64, ["-lEGL", "-lGL"], {})
    check_drawing(kit, folder)
