#!/usr/bin/env python3
"""Why the article numbers its polygons two apart: a plot of what is left of a difference between two indices.

Run it with the Python module: PYTHONPATH=build/release/python python3 docs/tutorials/step_plot.py [steps.svg]
It needs NumPy, and writes one picture, steps.svg. Read it like a notebook: each part says what the next lines show.
"""
import pathlib
import sys

import ninebit
import numpy as np

top = pathlib.Path(__file__).resolve().parents[2]

# %% The comparison of two indices, in the article's two stages: the difference, times four, then its square, times four.
state_text = (top / "docs/programs/index_compare.gl").read_text()
state = ninebit.State.parse(state_text, "gl")
print(ninebit.Program(state).explain())

# %% Two indices that are `step` apart, in one channel: every pair of bytes there is, on every kind of arithmetic. A byte
# enters a register as a code: as it is where 1.0 is 255, halved where it is 127.
# What the second stage leaves in spare1 is what the alpha test looks at: nonzero where the difference was noticed.
steps = np.arange(1, 17)


def noticed(profile, step):
    """The share of pairs of bytes `step` apart that the comparison tells from equal ones."""
    program = ninebit.Program(ninebit.State.parse(state_text, "gl", profile))
    bytes_ = np.arange(0, 256 - step)
    one, other = ((b * (program.one + 1) // 256).astype(np.int16) for b in (bytes_, bytes_ + step))
    left = program.evaluate({"primary.r": one, "tex0.r": other}, registers=True)
    return np.count_nonzero(left["spare1"][2]) / len(one)


profiles = ["geforce2", "geforce2-early-truncation", "geforce256-8bit", "nv2a", "ideal"]
shares = {name: [noticed(name, int(step)) for step in steps] for name in profiles}

# %% As numbers: the first step at which every pair is told apart.
for name in profiles:
    whole = [int(step) for step, share in zip(steps, shares[name]) if share == 1.0]
    print(f"{name:<28} every pair is told apart from step {whole[0] if whole else 'beyond 16'} on")

# %% As a picture: one row of bars for each profile, a bar for each step.
width, row, bar = 560, 70, 18
parts = []
for i, name in enumerate(profiles):
    base = 30 + (i + 1) * row
    parts.append(f'<text x="10" y="{base - 44}">{name}</text>')
    for k, share in enumerate(shares[name]):
        height = round(36 * share)
        x = 230 + k * (bar + 2)
        parts.append(f'<rect x="{x}" y="{base - 36}" width="{bar}" height="36" fill="#e4e4e4"/>')
        parts.append(f'<rect x="{x}" y="{base - height}" width="{bar}" height="{height}" fill="#3465a4"/>')
for k, step in enumerate(steps):
    parts.append(f'<text x="{234 + k * (bar + 2)}" y="{50 + len(profiles) * row}">{step}</text>')
picture = (
    f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{70 + len(profiles) * row}" '
    'font-family="sans-serif" font-size="12">'
    '<rect width="100%" height="100%" fill="white"/>'
    '<text x="10" y="20">Share of index pairs that are told apart, by the step between them</text>'
    + "".join(parts)
    + "</svg>\n"
)
target = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "steps.svg")
target.write_text(picture)
print(f"wrote {target}")
