"""Wine's own Direct3D on the layer: with its shaders switched off, it draws texture stages by register combiners.

Mesa hides the extensions that Wine prefers. The layer's dump has Wine's combiner programs: `ninebit eval` of them gives each
result to the bit. The picture is that of Wine's usual way, by GLSL, within 1. The alpha of the dot product is left out: Wine
replicates the dot product into alpha by GLSL alone.
"""
import numpy

from kit import build

PROFILE = "nv2a"
LIBRARIES = {7: ["-lddraw", "-ldxguid"], 8: [], 9: ["-ld3d9"]}
PLAIN = {"WINE_D3D_CONFIG": "shader_backend=none,MaxVersionGL=0x00020001",
         "MESA_EXTENSION_OVERRIDE": "-GL_ATI_fragment_shader -GL_ARB_fragment_program -GL_ARB_vertex_program"}


def results(text):
    """{name: 256 colours} of what texture_stages prints."""
    found = {}
    for part in text.split("stages ")[1:]:
        name, _, rest = part.partition(":")
        rows = [line.split() for line in rest.splitlines() if line[:1].isdigit()]
        if len(rows) == 256:
            found[name] = numpy.array(rows, int)
    return found


def check_version(kit, folder, planes, environment, compiler, version):
    stem = f"direct3d{version}"
    build("windows/texture_stages.c", folder / f"{stem}.exe", f"-DDIRECT3D={version}", *LIBRARIES[version], compiler=compiler)
    command = ["wine", f"{stem}.exe", "inputs.bin"]
    usual = results(kit.run(command, environment, cwd=folder).stdout)
    dump = folder / stem
    done = kit.run(command, environment | PLAIN, layer=True, profile=PROFILE, options=["--dump", dump], cwd=folder)
    ours, programs = results(done.stdout), sorted(dump.glob("program-*.json"))
    kit.check(len(usual) == len(ours) == 13 and len(programs) >= 12 and "pixel shaders: 0" in done.stdout,
              f"windows, Direct3D {version}: {len(ours)} of 13 set-ups, {len(programs)} combiner programs, exit status "
              f"{done.returncode}")

    columns = [f"{register}.{c}" for register in ("primary", "tex0", "tex1") for c in "rgba"]
    rows = numpy.concatenate([planes[0], planes[2], planes[3]], axis=1).tolist()
    evaluated = [numpy.clip(kit.evaluate(program, columns, rows, PROFILE), 0, 255) for program in programs]
    for name in (name for name in usual if name in ours):
        wrong = min(((ours[name] != picture).any(axis=1).sum() for picture in evaluated), default=256)
        off = abs(ours[name] - usual[name])[:, :3 if name == "dot3" else 4].max()
        kit.check(wrong == 0 and off <= 1, f"windows, Direct3D {version}, {name}: {wrong} of 256 fragments differ from eval of the dumped "
                                           f"program, off by {off} from GLSL, at most 1")


def check(kit, folder, planes, environment, compiler):
    for version in LIBRARIES:
        check_version(kit, folder, planes, environment, compiler, version)
