"""The processor's time of many draws: with the layer against without it, and combiners against a shader written by hand.

Each round runs all processes one after the other, and a figure is the median of the rounds' ratios: other programs slow down
both sides. So what a change takes is counted in the time of the driver's own glUseProgram. Where a limit is exceeded, more
rounds decide.
"""
import re
import statistics

from kit import build, display, require

PACKAGES = "freeglut3-dev, gcc and xvfb"
MODES = (("fixed", False), ("fixed", True), ("glsl", False), ("combiners", True), ("stages", True))
ROUNDS, MOST_ROUNDS = 5, 15
UNUSED = 1.10  # times the time without the layer, over all changes, if combiners are never enabled
# What one draw after a change may take longer than the same with a shader written by hand, by what the draw after glUseProgram
# takes: 1.2 us on a machine that does nothing else, so that 1.67 are 2 us.
LIMITS = {"nothing": 0.12, "blending": 0.16, "texture": 1.67, "constant": 0.5, "fog colour": 0.16, "program": 1.67, "fog": 1.67}
# Fog on or off takes another shader: by hand, glUseProgram.
RIVALS = {"fog": "program"}


def measure(kit, program, environment):
    """Nanoseconds a draw of each change, by mode and layer."""
    found = {}
    for mode, layer in MODES:
        done = kit.run([program, mode], environment, layer=layer, profile="nv2a" if layer else None)
        found[mode, layer] = {name: int(time) for name, time in re.findall(r"^(.*): (\d+)$", done.stdout, re.M)}
        if done.returncode or len(found[mode, layer]) != 7:
            raise RuntimeError(f"costs {mode}: {done.stdout.strip()}")
    return found


class Figures:
    """Medians of the rounds so far."""

    def __init__(self, rounds):
        def median(of):
            return statistics.median(map(of, rounds))

        def unused(found, names):
            return sum(found["fixed", True][name] for name in names) / sum(found["fixed", False][name] for name in names)

        self.unused = median(lambda found: unused(found, LIMITS))
        self.unused_each = {name: median(lambda found, name=name: unused(found, [name])) for name in LIMITS}
        self.more = {mode: {name: median(lambda found, mode=mode, name=name: (
            found[mode, True][name] - found["glsl", False][RIVALS.get(name, name)]) / found["glsl", False]["program"])
            for name in LIMITS} for mode in ("combiners", "stages")}
        self.times = {key: {name: median(lambda found, key=key, name=name: found[key][name] / 1000) for name in LIMITS}
                      for key in MODES}
        self.good = {"unused": self.unused < UNUSED} | {
            mode: all(more[name] < limit for name, limit in LIMITS.items()) for mode, more in self.more.items()}


def run(kit):
    require(PACKAGES, ["gcc", "Xvfb"], ["/usr/include/GL/freeglut.h"])
    program = build("costs/costs.c", kit.folder("costs") / "costs", "-lglut", "-lGL")
    rounds = []
    with display() as environment:
        environment |= {"LP_NUM_THREADS": "0"}
        while True:
            rounds.append(measure(kit, program, environment))
            if len(rounds) < ROUNDS:
                continue
            figures = Figures(rounds)
            if all(figures.good.values()) or len(rounds) >= MOST_ROUNDS:
                break
    kit.check(figures.good["unused"], f"costs, combiners unused: {figures.unused:.2f} times the time without the layer, the median "
              f"of {len(rounds)} rounds; of single changes "
              f"{', '.join(f'{name} {ratio:.2f}' for name, ratio in figures.unused_each.items())}")
    rival = figures.times["glsl", False]
    for mode, more in figures.more.items():
        times = figures.times[mode, True]
        kit.check(figures.good[mode], f"costs, {mode}: {times['nothing'] / rival['nothing']:.2f} times a shader's time where nothing "
                  f"changes; a change takes more, by {rival['program']:.2f} us: "
                  f"{', '.join(f'{name} {value:.2f}' for name, value in more.items())}; fog on and off "
                  f"{times['fog'] / figures.times['fixed', False]['fog']:.2f} times fixed functions")
