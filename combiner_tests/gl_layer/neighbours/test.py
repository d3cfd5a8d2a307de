"""What else lives in a process beside the layer: interposers before it and after it, another OpenGL, apitrace, RenderDoc.

Each gets what it would get without the layer, and the combiners draw where the program looks them up.
"""
import os
import re
import subprocess

from kit import build, display, require

PACKAGES = "freeglut3-dev, gcc, libosmesa6, apitrace, renderdoccmd and xvfb"
RENDERDOC = "/usr/lib/librenderdoc.so"
WAYS = ("library", "default", "next")


def compiled(kit, name, options, libraries=(), output=None):
    return build(f"neighbours/{name}.c", kit.output / "neighbours" / (output or name), *options, *libraries)


def logs(kit, draws, environment):
    """The last lines of the log file: what was looked up in vain, and what was not used."""
    unused = "ninebit: functions looked up and never used: those of GL_NV_vertex_program\n"
    addable = "ninebit: functions looked up of extensions that --extensions can add: NV_vertex_program\n"
    for function, added, expected in (("glEnable", "all", ""), ("glLoadProgramNV", "all", unused),
                                      ("glLoadProgramNV", "none", addable)):
        log = kit.output / "neighbours/log.txt"
        log.unlink(missing_ok=True)
        kit.run([draws, "library", "GL_NV_fence", function], environment, layer=True,
                options=("--extensions", added, "--log", log))
        written = log.read_text() if log.exists() else ""
        kit.check(written == expected, f"{function} with --extensions {added}: the log has {written.strip() or 'no line'!r}")


def other_contexts(kit):
    """Contexts without fixed functions are the driver's alone; a process that forks has its combiners in both."""
    program = compiled(kit, "contexts", [], ["-lEGL", "-lGL"])
    environment = {**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1"}
    for kind in ("core", "gles"):
        without, done = kit.run([program, kind], environment), kit.run([program, kind], environment, layer=True)
        said = [line for line in done.stdout.splitlines() if not line.startswith("ninebit: ")]  # what the context lacks
        kit.check(done.returncode == without.returncode == 0 and said == without.stdout.splitlines(),
                  f"a context of {kind}: {', '.join(said)}")
    done = kit.run([program, "fork"], environment, layer=True)
    expected = "".join(f"{who}: pixel 0 255 0, error 0x0000\n" for who in ("child", "parent"))
    kit.check(done.returncode == 0 and done.stdout == expected, f"a process that forks: {done.stdout.strip()}")


def copied_contexts(kit, environment):
    """Mesa refuses to copy a context that draws by itself. The layer's state is never copied, which the log says."""
    program = compiled(kit, "copies", [], ["-lGL", "-lX11"])
    without, done = kit.run([program], environment), kit.run([program], environment, layer=True)
    kit.check(done.returncode == without.returncode == 0 and done.stdout == without.stdout and "fog 0" in done.stdout,
              f"glXCopyContext: {', '.join(done.stdout.splitlines())}")
    done = kit.run([program, "combiners"], environment, layer=True)
    said = "ninebit: glXCopyContext: the state of the extensions that the layer adds is not copied\n"
    kit.check(done.returncode == 0 and done.stdout.count(said) == 1 and done.stdout.replace(said, "") == without.stdout,
              f"glXCopyContext with combiners: {', '.join(done.stdout.splitlines())}")


def several_interposers(kit, draws, interposers, layer, environment):
    """Two interposers on either side of the layer. One that takes the library's functions skips those behind it, but for
    the layer, which has no glFlush."""
    passes, looks = interposers
    both, begin = "glBegin 1, glFlush 1", "glBegin 1, glFlush 0"
    for preloaded, called in (((layer, passes, looks), [both, both]), ((layer, looks, passes), [both]),
                              ((passes, layer, looks), [both, both]), ((looks, layer, passes), [both, begin]),
                              ((passes, looks, layer), [both, both]), ((looks, passes, layer), [both])):
        done = kit.run(["env", f"LD_PRELOAD={':'.join(map(str, preloaded))}", draws, "default"], environment)
        expected = ["pixel 0 255 0, error 0x0000", *(f"interposer: {calls}" for calls in called)]
        kit.check(done.returncode == 0 and done.stdout.splitlines() == expected,
                  f"{' before '.join(library.stem for library in preloaded)}: exit {done.returncode}, {done.stdout.strip()}")


def renderdoc(kit, draws, environment):
    """The program under RenderDoc, which is loaded behind the layer, and before it: there it hides extensions of others."""
    environment = {**environment, "HOME": str(kit.output / "neighbours")}  # for its settings
    capture = ["renderdoccmd", "capture", "--wait-for-exit", "--capture-file", kit.output / "neighbours/capture"]
    asked = [draws, "library", "GL_NV_register_combiners"]
    with_combiners = "GL_NV_register_combiners is listed\npixel 0 255 0, error 0x0000\n"
    without = "GL_NV_register_combiners is not listed\npixel 255 0 0, error 0x0000\n"
    layer = kit.ninebit_path.parent / "libninebit_gl.so"
    for name, expected, done in (
            ("in gl-run", with_combiners, kit.run([*capture, *asked], environment, layer=True)),
            ("that starts gl-run", with_combiners,
             kit.run([*capture, "--opt-hook-children", *kit.command(asked, layer=True)], environment)),
            ("before the layer", without, kit.run(["env", f"LD_PRELOAD={RENDERDOC}:{layer}", *asked], environment)),
            ("alone", without, kit.run([*capture, *asked], environment))):
        kit.check(done.returncode == 0 and expected in done.stdout,
                  f"RenderDoc {name}: exit {done.returncode}, {done.stdout.strip().splitlines()[-2:]}")


def run(kit):
    require(PACKAGES, ["gcc", "Xvfb", "apitrace", "renderdoccmd"],
            ["/usr/include/GL/freeglut.h", "/usr/lib/x86_64-linux-gnu/libOSMesa.so.8", RENDERDOC])
    folder = kit.folder("neighbours")
    interposers = {"interposer": compiled(kit, "interposer", ["-shared", "-fPIC"], output="libinterposer.so"),
                   "interposer that looks in the library": compiled(kit, "interposer", ["-shared", "-fPIC", "-DFROM_LIBRARY"],
                                                                    output="liblooks.so")}
    draws = compiled(kit, "draws", [], ["-lglut", "-lGL", "-ldl"])
    layer = kit.ninebit_path.parent / "libninebit_gl.so"
    expected = "pixel 0 255 0, error 0x0000\n"
    counted = expected + "interposer: glBegin 1, glFlush 1\n"
    with display() as environment:
        for way in WAYS:
            done = kit.run([draws, way], environment, layer=True)
            kit.check(done.returncode == 0 and done.stdout == expected, f"functions by dlsym, {way}: {done.stdout.strip()}")
        for wanted, word in ((None, " not"), ("none", " not"), ("SGIX_shadow,NV_fence", ""), ("all", "")):
            options = ("--extensions", wanted) if wanted else ()
            done = kit.run([draws, "library", "GL_NV_fence"], environment, layer=True, options=options)
            kit.check(done.stdout == f"GL_NV_fence is{word} listed\n{expected}",
                      f"--extensions {wanted}: {done.stdout.splitlines()[0]}")
        logs(kit, draws, environment)
        copied_contexts(kit, environment)
        for kind, interposer in interposers.items():
            for name, preloaded in (("before", f"{interposer}:{layer}"), ("after", f"{layer}:{interposer}")):
                done = kit.run(["env", f"LD_PRELOAD={preloaded}", draws, "default"], environment)
                kit.check(done.returncode == 0 and done.stdout == counted,
                          f"an {kind} {name} the layer: exit {done.returncode}, {done.stdout.strip()}")
        several_interposers(kit, draws, list(interposers.values()), layer, environment)
        renderdoc(kit, draws, environment)
        trace = folder / "draws.trace"
        done = kit.run(["apitrace", "trace", "--output", trace, draws, "library"], environment, layer=True)
        dump = subprocess.run(["apitrace", "dump", "--color=never", trace], capture_output=True, text=True).stdout
        calls = re.findall(r"^\d+ (gl\w*Combiner\w*)\(", dump, re.M)
        kit.check(done.returncode == 0 and expected in done.stdout and len(calls) == 6 and "glBegin(" in dump,
                  f"apitrace: exit {done.returncode}, {len(calls)} calls of the combiners in the trace")
    other_contexts(kit)
    for options in ((), ("-DWITH_GL",)):
        program = compiled(kit, "osmesa", options, ["-ldl"])
        without, done = kit.run([program], None), kit.run([program], None, layer=True)
        kit.check(done.returncode == without.returncode == 0 and done.stdout == without.stdout,
                  f"OSMesa {' '.join(options)}: {without.stdout.strip()}; with the layer {done.stdout.strip()}")
