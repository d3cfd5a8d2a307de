#!/usr/bin/python3
"""Runs a program with seeds, with the layer and without it: compare.py PROGRAM LAYER COUNT [FIRST]. Their outputs must be equal.

Where they differ, the program runs again without the layer: what then differs, the driver does by itself. The exit status
is 1 if an output differs by the layer, 77 if there is no driver.
"""
import concurrent.futures
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


class Comparison:
    """What the seeds showed; `crashes` are those at which the driver alone ends by a signal, which are not compared."""

    def __init__(self):
        self.by_layer, self.by_driver, self.crashes, self.compared, self.errors = [], [], [], 0, 0
        self.pictures = set()
        self.has_driver = True

    def text(self):
        return (f"{self.compared} processes of random calls: {len(self.by_layer)} differ by the layer, {len(self.by_driver)} by "
                f"the driver; {len(self.pictures)} pictures, {self.errors} errors; {len(self.crashes)} others crash without it")

    def good(self):
        return not self.by_layer and len(self.pictures) > self.compared > 0 and self.errors > self.compared


def compare(program, layer, count, first_seed=0):
    """Compares `count` processes that do not crash without the layer, as many at a time as there are processors."""
    found = Comparison()

    def both(seed):
        without = output(program, seed, None)
        return seed, without, output(program, seed, layer) if without[0] >= 0 and without[0] != 77 else None

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for seed, without, with_layer in pool.map(both, range(first_seed, first_seed + 2 * count)):
            if without[0] == 77:
                found.has_driver = False
            if found.compared == count or not found.has_driver:
                pool.shutdown(cancel_futures=True)
                break
            if without[0] < 0:
                found.crashes.append(seed)
                continue
            found.compared += 1
            found.pictures.update(line for line in without[1].splitlines() if line.startswith("picture"))
            found.errors += without[1].count("error")
            if without != with_layer:
                repeated = any(output(program, seed, None) != without for _ in range(3))
                (found.by_driver if repeated else found.by_layer).append(seed)
                lines = zip(without[1].splitlines(), with_layer[1].splitlines())
                first = next((f"{a!r} became {b!r}" for a, b in lines if a != b), "one output is longer")
                print(f"seed {seed}: exit {without[0]} and {with_layer[0]}, {first}")
    return found


def main():
    found = compare(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]) if len(sys.argv) > 4 else 0)
    if not found.has_driver:
        print("no driver for EGL without a surface")
        sys.exit(77)
    print(found.text())
    sys.exit(0 if found.good() else 1)


if __name__ == "__main__":
    main()
