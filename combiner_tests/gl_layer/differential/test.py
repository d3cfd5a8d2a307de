"""Random calls without combiners, with the layer and without it, each in a process of its own."""
import os

from differential.compare import compare
from kit import build, require


def run(kit):
    require("gcc, libegl-dev and libgl-dev", ["gcc"], ["/usr/include/EGL/egl.h", "/usr/include/GL/glext.h"])
    program = build("differential/random_calls.c", kit.folder("differential") / "random_calls", "-lEGL", "-lGL")
    count = int(os.environ.get("NINEBIT_GL_PROCESSES", "60"))
    found = compare(program, kit.ninebit_path.parent / "libninebit_gl.so", count)
    kit.check(found.good(), found.text())
