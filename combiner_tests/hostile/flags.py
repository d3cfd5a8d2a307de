"""Commands with flags that vary: legal ones, small enough for a run of some 20 ms."""

TECHNIQUES = ["index-cube", "depth-cube", "shadow-map", "shadow-volume", "reflective", "light-cookie"]


def some(random, chance, *words):
    return list(words) if random.random() < chance else []


def indices(random):
    """Flags that only techniques with an index cube read."""
    flags = some(random, 0.2, "--index-scope", random.choice(["object", "section"]))
    flags += some(random, 0.25, "--index-order", "neighbour")
    flags += some(random, 0.2, "--patch-angle", random.choice(["0", "45", "90"]))
    flags += some(random, 0.2, "--index-scales", random.choice(["first-x4", "second-x4", "no-scale"]))
    flags += some(random, 0.3, "--index-format", random.choice(["rgb", "la", "l", "a"]))
    return flags + some(random, 0.3, "--index-step", random.choice(["1", "3", "16"]))


def technique_flags(random, technique, cookie):
    if technique == "index-cube":
        return indices(random)
    if technique == "depth-cube":
        return some(random, 0.4, "--depth-bits", random.choice(["16", "float"]))
    if technique == "shadow-map":
        return (some(random, 0.4, "--depth-encoding", random.choice(["d16", "rgba8-fract", "rgba8-modf"])) +
                some(random, 0.2, "--polygon-offset", "1,4"))
    if technique == "shadow-volume":
        return some(random, 0.4, "--volume-method", "depth-pass") + some(random, 0.4, "--stencil-sides", "one")
    if technique == "reflective":
        return ["--samples", "4"] + some(random, 0.5, "--gather-scale", "4")
    shadows = ["--cookie-shadows", "none"] if random.random() < 0.5 else indices(random)
    return ["--cookie", cookie or "scenes/cookies/labels.dds", *shadows]


def drawing(random, cookie=None):
    """Flags of a technique and of the frame."""
    technique = "light-cookie" if cookie else random.choice(TECHNIQUES)
    flags = ["--technique", technique, "--size", random.choice(["8x8", "16x16", "7x33", "64x48"]),
             "--threads", random.choice(["1", "1", "1", "3"])]
    flags += some(random, 0.2, "--color-format", random.choice(["a8r8g8b8", "r5g6b5", "x1a7r8g8b8_z", "b8"]))
    flags += some(random, 0.2, "--depth-stencil", random.choice(["d24s8", "d16", "d15s1"]))
    flags += some(random, 0.1, "--cull", random.choice(["back", "front"])) + some(random, 0.1, "--light-facing")
    flags += some(random, 0.1, "--style", "cartoon")
    flags += some(random, 0.1, "--up", random.choice(["y", "z"]))
    flags += some(random, 0.1, "--floor", random.choice(["none", "auto", "0"]))
    flags += some(random, 0.1, "--light", random.choice(["2,4,3", "0,0,0", "1e30,0,0", "-1,1e-30,5"]))
    flags += some(random, 0.1, "--light-type", random.choice(["point", "spot", "directional"]))
    flags += technique_flags(random, technique, cookie)
    if technique != "shadow-volume" and "--cookie-shadows" not in flags:
        flags += ["--map-size", random.choice(["1", "16", "32"])]
    return flags


def scene_command(random, file):
    """A verb that reads a scene."""
    choice = random.random()
    if choice < 0.06:
        return ["trace", "--scene", file, "--pixel", "3,4", *drawing(random), *some(random, 0.5, "--json")]
    if choice < 0.10:
        return ["study", "shadows", file, "--size", "8x8", "--map-sizes", "16,32", "-o", "out",
                *some(random, 0.3, "--orders", "file,neighbour"), *some(random, 0.3, "--scales", "both-x4,no-scale"),
                *some(random, 0.5, "--json")]
    command = ["render", file, "-o", "out", *drawing(random)]
    command += some(random, 0.2, "--check-order")
    return command + some(random, 0.15, "--ground-truth") + some(random, 0.15, "--layers") + some(random, 0.2, "--json")


def program_command(random, file, form):
    """A verb that reads a program."""
    from_form = some(random, 0.3, "--from", form)
    profile = some(random, 0.3, "--profile", random.choice(["geforce2", "nv2a", "ideal", "float-shader"]))
    common = [*from_form, *profile, *some(random, 0.3, "--json")]
    verb = random.choice(["validate", "explain", "convert", "convert", "eval", "trace", "verify", "study"])
    if verb == "convert":
        to = random.choice(["gl", "rc10", "words", "words-json", "json", "glsl", "glsl-es", "c"])
        return ["convert", file, "--to", to, *common, *some(random, 0.3, "-o", "out/program.txt")]
    if verb == "eval":
        return ["eval", file, "--inputs", "rows.csv", *common, *some(random, 0.3, "--registers"),
                *some(random, 0.3, "--engine", "reference"), *some(random, 0.3, "-o", "out/rows.csv")]
    if verb == "trace":
        return ["trace", file, *common, *some(random, 0.5, "--set", "tex0=10,20,30,255")]
    if verb == "verify":
        return ["verify", "table.csv", "--program", file, "--threads", "1", *common]
    if verb == "study":
        return ["study", "datapath", "--program", file, "--over", "tex0.r", "--threads", "1", *profile]
    return [verb, file, *common]
