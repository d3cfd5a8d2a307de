#!/usr/bin/env python3
"""Makes the tables of this folder into verify/rows.csv and its programs, as `ninebit verify` reads them.

usage: verify_rows.py [--check]    --check writes nothing, and fails where the files differ from what would be written

Rows that use what OpenGL cannot express (mux by the lowest bit, inverted colour sum, blue to alpha) are left out, and
so are tables of other things than the combiners.
"""
import csv
import io
import pathlib
import sys

here = pathlib.Path(__file__).resolve().parent
inputs = [f"{reg}.{c}" for reg in ("const0", "const1", "primary", "secondary", "spare0", "tex3") for c in "rgba"]
outputs = ["stage0.spare0.a", "out.r", "out.g", "out.b", "out.a"]
rows, programs = [], {}


def table(name):
    lines = [line for line in (here / f"{name}.csv").read_text().splitlines() if not line.startswith("#")]
    return csv.DictReader(lines)


def program(name, *body):
    programs.setdefault(f"{name}.rc", "\n".join(("!!RC1.0",) + body) + "\n")
    return f"{name}.rc"


def row(name, file, values):
    unknown = set(values) - set(inputs) - set(outputs)
    assert not unknown, unknown
    rows.append([name, file] + [str(values.get(column, "")) for column in inputs + outputs])


def rgb(reg, codes):
    return {f"{reg}.{c}": code for c, code in zip("rgb", codes)}


scales = {
    "IDENTITY": "",
    "BIAS": "bias_by_negative_one_half();",
    "SHL1": "scale_by_two();",
    "SHL1_BIAS": "bias_by_negative_one_half_scale_by_two();",
    "SHL2": "scale_by_four();",
    "SHR1": "scale_by_one_half();",
}
for r in table("nv2a_combiner_ops"):
    op, channel = r["op"], r["channel"][0].lower()
    file = program(
        f"op_{op.lower()}",
        "{",
        f"  rgb {{ spare0 = const0; {scales[op]} }}",
        f"  alpha {{ spare0 = const0.b; {scales[op]} }}",
        "}",
        "out.rgb = spare0;",
        "out.a = spare0;",
    )
    row(f"{op} {channel}", file, {**rgb("const0", (25, 63, 255)), f"out.{channel}": r["hw_out"]})

mux = program(
    "mux",
    "{",
    "  alpha { spare0 = const0; }",
    "}",
    "{",
    "  const0 = (1, 0, 0, 0);",
    "  const1 = (0, 0, 1, 0);",
    "  rgb { discard = const0; discard = const1; spare1 = mux(); }",
    "}",
    "out.rgb = spare1;",
    "out.a = unsigned_invert(zero);",
)
for r in table("nv2a_mux"):
    if r["mux_select"] == "MSB":
        alpha = r["spare0_alpha_byte"]
        expected = {f"out.{c.lower()}": r[c] for c in "RGBA"}
        row(f"mux at {alpha}", mux, {"const0.a": alpha, "stage0.spare0.a": alpha, **expected})

opaque = "out.a = unsigned_invert(zero);"
color_sum = "out.rgb = const0 * color_sum;"
cases = {
    "Uncapped": (program("sum", color_sum, opaque),
                 {**rgb("const0", [127] * 3), **rgb("spare0", [255] * 3), **rgb("secondary", [255] * 3)}),
    "Capped": (program("sum_clamped", "clamp_color_sum();", color_sum, opaque),
               {**rgb("const0", [127] * 3), **rgb("spare0", [255] * 3), **rgb("secondary", [255] * 3)}),
    "Normal R0": (program("sum", color_sum, opaque), {**rgb("const0", [255] * 3), **rgb("spare0", [191] * 3)}),
    "V1": (program("sum", color_sum, opaque), {**rgb("const0", [255] * 3), **rgb("secondary", [191] * 3)}),
    "EFProd": (program("product", "final_product = const0 * const1;", "out.rgb = final_product;", opaque),
               {**rgb("const0", (255, 191, 127)), **rgb("const1", [127] * 3)}),
    "SUM": (program("sum_alone", "out.rgb = color_sum;", opaque),
            {**rgb("spare0", (63, 127, 191)), **rgb("secondary", (178, 127, 38))}),
    "R1=old R0": (program("old_spare0", "{", "  rgb { spare0 = const0; spare1 = spare0; }", "}", "out.rgb = spare1;", opaque),
                  {**rgb("const0", (255, 0, 0)), **rgb("spare0", (0, 255, 0))}),
    "alpha reads old R0.blue": (
        program("old_blue", "{", "  rgb { spare0 = const0; }", "  alpha { spare0 = spare0.b; }", "}",
                "out.rgb = lerp(spare0.a, spare0, col0);", opaque),
        {**rgb("const0", (0, 0, 255)), **rgb("primary", (25, 255, 25)), "stage0.spare0.a": 0}),
    "tex0 rgb unbound": (program("texture", "out.rgb = tex0;", opaque), {}),
    "tex0 alpha unbound": (program("texture_alpha", "out.rgb = tex0.a;", opaque), {}),
}
for r in table("nv2a_final_flags_special"):
    if r["case"] in cases:
        file, values = cases[r["case"]]
        row(r["case"], file, {**values, **{f"out.{c.lower()}": r[c] for c in "RGB"}})

final = program("texel_times_colour", "out.rgb = tex3 * col0;", opaque)
for r in table("nv2a_final_AB_pointparams"):
    for texel, column in ((255, "hw_full"), (51, "hw_dim")):
        values = {**rgb("tex3", [texel] * 3), **rgb("primary", [r["f2b_model"]] * 3)}
        row(f"{texel} x {r['f2b_model']}", final, {**values, **{f"out.{c}": r[column] for c in "rgb"}})

text = io.StringIO()
writer = csv.writer(text, lineterminator="\n")
writer.writerow(["name", "program"] + inputs + outputs)
writer.writerows(rows)
files = {"rows.csv": text.getvalue(), **programs}
folder = here / "verify"
if "--check" in sys.argv[1:]:
    found = {path.name: path.read_text() for path in folder.iterdir()}
    if found != files:
        sys.exit("combiner_tests/hardware/verify/ is not what verify_rows.py would write: run it without --check")
    print(f"{len(rows)} rows, {len(programs)} programs")
else:
    for path in folder.iterdir():
        path.unlink()
    for name, content in files.items():
        (folder / name).write_text(content)
