#!/usr/bin/env python3
"""Program.evaluate beside NumPy's float32: the same formula, 2 * primary * tex0, of two RGBA8 pictures in one run.

usage: PYTHONPATH=build/release/python python3 combiner_tests/bench/numpy_float32.py [--size 1024] [--seconds 2]

Prints the fastest time of each. The ways take turns, so that other work on the machine slows all of them down. NumPy
writes into arrays that are kept from run to run, and so does ninebit.
"""
import argparse
import math
import time

import ninebit
import numpy as np

PROGRAM = """!!RC1.0
{ rgb { spare0 = col0 * tex0; scale_by_two(); } alpha { spare0 = col0 * tex0; scale_by_two(); } }
out.rgb = spare0;
out.a = spare0.a;
"""


def ways(size):
    """The measured calls by name; each returns its picture."""
    random = np.random.default_rng(1)
    primary, tex0 = (random.integers(0, 256, (size, size, 4), np.uint8) for _ in range(2))
    program = ninebit.Program(PROGRAM)
    out, codes = np.empty_like(primary), np.empty(primary.shape, np.int16)
    one, other = (np.empty(primary.shape, np.float32) for _ in range(2))
    real_primary, real_tex0 = (np.float32(1 / 255) * picture for picture in (primary, tex0))

    def ninebit_bytes():
        return program.evaluate(primary=primary, tex0=tex0, out=out)

    def ninebit_codes():
        return program.evaluate(primary=primary, tex0=tex0, out=codes)

    def numpy_bytes():
        np.multiply(primary, np.float32(2 / 255), out=one, dtype=np.float32)
        np.multiply(one, tex0, out=one, dtype=np.float32)
        np.clip(one, 0, 255, out=one)
        return one.astype(np.uint8)

    def numpy_floats():
        np.multiply(real_primary, real_tex0, out=other)
        np.multiply(other, np.float32(2), out=other)
        return np.clip(other, 0, 1, out=other)

    return {
        "Program.evaluate, bytes to bytes": ninebit_bytes,
        "Program.evaluate, bytes to int16": ninebit_codes,
        "NumPy float32, bytes to bytes": numpy_bytes,
        "NumPy float32, floats to floats": numpy_floats,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, default=1024, help="pixels of a side")
    parser.add_argument("--seconds", type=float, default=2.0, help="time of each way")
    arguments = parser.parse_args()
    measured = ways(arguments.size)
    pictures = [picture * 255 if picture.dtype == np.float32 else picture.astype(np.float64)
                for picture in (way() for way in measured.values())]
    for name, picture in zip(measured, pictures):
        if np.abs(picture - pictures[0]).max() > 1:
            raise SystemExit(f"{name}: another picture")
    fastest = dict.fromkeys(measured, math.inf)
    end = time.perf_counter() + arguments.seconds * len(measured)
    while True:
        for name, way in measured.items():
            begin = time.perf_counter()
            way()
            fastest[name] = min(fastest[name], time.perf_counter() - begin)
        if time.perf_counter() >= end:
            break
    for name, seconds in fastest.items():
        print(f"{name:34} {1000 * seconds:7.2f} ms")


if __name__ == "__main__":
    main()
