#!/usr/bin/env python3
"""The combiner of an emulator, as many have it: register words of an NV2A in, the RGB portions computed in floats.

    float_combiner.py WORDS > TABLE

runs the program of WORDS over a grid of textures and primary colours, and writes what its registers held and what came
out as a table for `ninebit verify`. docs/tutorials/checking-an-emulator.md finds two faults in it.
"""
import math
import os
import re
import sys

HALF = 0.5
REGISTERS = {0: 'zero', 4: 'primary', 8: 'tex0', 12: 'spare0', 13: 'spare1'}
MAPPINGS = [
    lambda e: max(0.0, e),
    lambda e: 1.0 - min(max(0.0, e), 1.0),
    lambda e: 2.0 * max(0.0, e) - 1.0,
    lambda e: 1.0 - 2.0 * max(0.0, e),
    lambda e: max(0.0, e) - HALF,
    lambda e: HALF - max(0.0, e),
    lambda e: e,
    lambda e: -e,
]
SCALES = [1.0, 2.0, 4.0, 0.5]


def read_words(path):
    with open(path, encoding='utf-8') as file:
        return {name: int(value, 16) for name, value in re.findall(r'^(\S+) *= *(0x\w+)', file.read(), re.MULTILINE)}


def stored(value):
    """What a register keeps of a value."""
    clamped = max(-1.0, min(1.0, value))
    return clamped


def run_stage(inputs, outputs, registers):
    def factor(shift):
        byte = inputs >> shift & 0xFF
        return MAPPINGS[byte >> 5](registers[REGISTERS[byte & 0xF]])

    def put(code, value):
        if code:
            bias = HALF if outputs >> 15 & 1 else 0.0
            written[REGISTERS[code]] = stored((value - bias) * SCALES[outputs >> 16 & 3])

    ab, cd, written = factor(24) * factor(16), factor(8) * factor(0), {}
    put(outputs & 0xF, cd)
    put(outputs >> 4 & 0xF, ab)
    put(outputs >> 8 & 0xF, ab + cd)
    registers.update(written)


def code(value):
    """A float as the byte that it stands for."""
    return math.floor(value * 255.0 + 0.5)


def main():
    words = read_words(sys.argv[1])
    stages = words['SET_COMBINER_CONTROL'] & 0xF
    print(','.join(['program', 'tex0.r', 'primary.r', *(f'stage{i}.spare0.r' for i in range(stages)), 'out.r']))
    for texel in range(0, 256, 15):
        for primary in range(0, 256, 17):
            registers = {'zero': 0.0, 'tex0': texel / 255.0, 'primary': primary / 255.0, 'spare0': 0.0, 'spare1': 0.0}
            held = []
            for i in range(stages):
                run_stage(words[f'SET_COMBINER_COLOR_ICW[{i}]'], words[f'SET_COMBINER_COLOR_OCW[{i}]'], registers)
                held.append(code(registers['spare0']))
            out = code(max(0.0, registers['spare0']))  # the final combiner of a program that does not set it
            print(','.join(map(str, [os.path.basename(sys.argv[1]), texel, primary, *held, out])))


if __name__ == '__main__':
    main()
