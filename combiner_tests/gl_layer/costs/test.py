"""The processor's time of many draws: with the layer against without it, and combiners against a shader written by hand.

Each figure is the best of three processes. The limits leave room for a loaded machine, and fail where something is done at
each draw that need not be.
"""
import re

from kit import HERE, build, display, require

PACKAGES = "freeglut3-dev, gcc and xvfb"
# What one draw after a change may take longer than the same with a shader written by hand, in microseconds.
LIMITS = {"nothing": 0.15, "blending": 0.2, "texture": 2.0, "constant": 0.8, "fog colour": 0.2, "program": 3.0}
WITH_STAGES = {**LIMITS, "texture": 2.5, "program": 3.0}


def run(kit):
    require(PACKAGES, ["gcc", "Xvfb"], ["/usr/include/GL/freeglut.h"])
    program = kit.folder("costs") / "costs"
    build(["gcc", "-std=gnu99", "-O2", "-Wall", "-Wextra", "-Wno-cast-function-type", "-Werror", HERE / "costs/costs.c",
           "-o", program, "-lglut", "-lGL"])
    best = {}
    with display() as environment:
        environment |= {"LP_NUM_THREADS": "0"}
        for _ in range(3):
            for mode, layer in (("fixed", False), ("fixed", True), ("glsl", False), ("combiners", True), ("stages", True)):
                done = kit.run([program, mode], environment, layer=layer, profile="nv2a" if layer else None)
                times = {name: int(time) for name, time in re.findall(r"^(.*): (\d+)$", done.stdout, re.M)}
                if done.returncode or len(times) != 7:
                    kit.check(False, f"costs {mode}: {done.stdout.strip()}")
                    return
                known = best.setdefault((mode, layer), times)
                best[mode, layer] = {name: min(time, known[name]) for name, time in times.items()}
    without, unused = best["fixed", False], best["fixed", True]
    total = sum(unused.values()) / sum(without.values())
    kit.check(total < 1.15, f"costs, combiners unused: {total:.2f} times the time without the layer; of single changes "
              f"{', '.join(f'{name} {unused[name] / without[name]:.2f}' for name in without)}")
    for mode, limits in (("combiners", LIMITS), ("stages", WITH_STAGES)):
        times, rival = best[mode, True], best["glsl", False]
        more = {name: (times[name] - rival[name]) / 1000 for name in limits}
        kit.check(all(more[name] < limit for name, limit in limits.items()),
                  f"costs, {mode}: {times['nothing'] / rival['nothing']:.2f} times a shader's time where nothing changes; "
                  f"a change takes more, in us: {', '.join(f'{name} {value:.2f}' for name, value in more.items())}; "
                  f"fog on and off {times['fog'] / 1000:.2f} us a draw, fixed functions {without['fog'] / 1000:.2f}")
