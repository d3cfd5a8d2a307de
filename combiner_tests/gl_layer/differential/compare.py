#!/usr/bin/python3
"""Runs a program with seeds, with the layer and without it: compare.py PROGRAM LAYER COUNT. Their outputs must be equal.

Where they differ, the program runs again without the layer: what then differs, the driver does by itself. The exit status
is 1 if an output differs by the layer, 77 if there is no driver.
"""
import os
import subprocess
import sys


def output(program, seed, layer):
    environment = {**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1", "LP_NUM_THREADS": "0", "GALLIVM_PERF": "nopt",
                   "MESA_SHADER_CACHE_DISABLE": "true"}
    for name in ("LD_PRELOAD", "NINEBIT_GL_LOG"):
        environment.pop(name, None)
    if layer:
        environment |= {"LD_PRELOAD": str(layer), "NINEBIT_GL_EXTENSIONS": "all" if seed % 2 else "none"}
    done = subprocess.run([program, str(seed)], env=environment, capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout


def compare(program, layer, count):
    """(processes that differ by the layer, those that differ by the driver, different pictures, errors); None: no driver."""
    by_layer, by_driver, pictures, errors = [], [], set(), 0
    for seed in range(count):
        without, with_layer = output(program, seed, None), output(program, seed, layer)
        if without[0] == 77:
            return None
        pictures.update(line for line in without[1].splitlines() if line.startswith("picture"))
        errors += without[1].count("error")
        if without != with_layer:
            repeated = any(output(program, seed, None) != without for _ in range(3))
            (by_driver if repeated else by_layer).append(seed)
            lines = zip(without[1].splitlines(), with_layer[1].splitlines())
            first = next((f"{a!r} became {b!r}" for a, b in lines if a != b), "one output is longer")
            print(f"seed {seed}: exit {without[0]} and {with_layer[0]}, {first}")
    return by_layer, by_driver, len(pictures), errors


def main():
    found = compare(sys.argv[1], sys.argv[2], int(sys.argv[3]))
    if found is None:
        print("no driver for EGL without a surface")
        sys.exit(77)
    by_layer, by_driver, pictures, errors = found
    print(f"{sys.argv[3]} seeds: {len(by_layer)} differ by the layer, {len(by_driver)} by the driver; {pictures} pictures, "
          f"{errors} errors")
    sys.exit(1 if by_layer or pictures < 2 or errors == 0 else 0)


if __name__ == "__main__":
    main()
