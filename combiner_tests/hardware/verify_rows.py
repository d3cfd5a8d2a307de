#!/usr/bin/env python3
"""Makes the tables of this folder into verify/rows.csv and its programs, as `ninebit verify` reads them.

usage: verify_rows.py [--check]    --check writes nothing, and fails where the files differ from what would be written

Programs that OpenGL can express are !!RC1.0 texts, others register words. Tables of other things than the combiners are
left out.
"""
import csv
import io
import pathlib
import sys

here = pathlib.Path(__file__).resolve().parent
inputs = [f"{reg}.{c}" for reg in ("const0", "const1", "primary", "secondary", "spare0", "tex3") for c in "rgba"]
outputs = ["stage0.spare0.a", "stage1.spare0.a", "stage1.spare1.a", "out.r", "out.g", "out.b", "out.a"]
rows, programs = [], {}


def table(name):
    lines = [line for line in (here / f"{name}.csv").read_text().splitlines() if not line.startswith("#")]
    return csv.DictReader(lines)


def program(name, *body):
    programs.setdefault(f"{name}.rc", "\n".join(("!!RC1.0",) + body) + "\n")
    return f"{name}.rc"


def words(name, **values):
    programs.setdefault(f"{name}.words", "".join(f"{word} = {value:#010x}\n" for word, value in values.items()))
    return f"{name}.words"


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
# The same, but for the mux's bit in RC_ENABLE.
mux_by_lowest_bit = words(
    "mux_by_lowest_bit",
    RC_IN_ALPHA_0=0x11300000,
    RC_OUT_ALPHA_0=0x000000C0,
    RC_OUT_RGB_0=0,
    RC_IN_RGB_1=0x01200220,
    RC_OUT_RGB_1=0x00004D00,
    RC_OUT_ALPHA_1=0,
    RC_CONSTANT_COLOR0_1=0x00FF0000,
    RC_CONSTANT_COLOR1_1=0x000000FF,
    RC_FINAL0=0x0000000D,
    RC_FINAL1=0x00003000,
    RC_ENABLE=0x00011002,
)
for r in table("nv2a_mux"):
    alpha = r["spare0_alpha_byte"]
    expected = {f"out.{c.lower()}": r[c] for c in "RGBA"}
    highest = r["mux_select"] == "MSB"
    row(f"mux {'' if highest else 'by the lowest bit '}at {alpha}", mux if highest else mux_by_lowest_bit,
        {"const0.a": alpha, "stage0.spare0.a": alpha, **expected})


def inverted_sum(name, abcd, flags):
    return words(name, RC_OUT_RGB_0=0, RC_OUT_ALPHA_0=0, RC_FINAL0=abcd, RC_FINAL1=0x00003000 | flags)


# Stage 0 leaves blue 63 in spare0, stage 1 blue 191 there and the old one in spare1, both to alpha, too; stage 2 spreads
# the alpha of one of them.
def blue_to_alpha(name, shown):
    return words(
        name,
        RC_IN_RGB_0=0x01200000,
        RC_OUT_RGB_0=0x000000C0,
        RC_OUT_ALPHA_0=0,
        RC_IN_RGB_1=0x01200C20,
        RC_OUT_RGB_1=0x000C00CD,
        RC_OUT_ALPHA_1=0,
        RC_IN_RGB_2=0x10200000 | shown << 24,
        RC_OUT_RGB_2=shown << 4,
        RC_OUT_ALPHA_2=0,
        RC_CONSTANT_COLOR0_0=63,
        RC_CONSTANT_COLOR0_1=191,
        RC_FINAL0=shown,
        RC_FINAL1=0x00003000,
        RC_ENABLE=0x00011103,
    )


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
    "1-R0": (inverted_sum("sum_inverted_spare0", 0x010E0000, 0x20), {**rgb("const0", [255] * 3), **rgb("spare0", [191] * 3)}),
    "1-V1": (inverted_sum("sum_inverted_secondary", 0x010E0000, 0x40),
             {**rgb("const0", [255] * 3), **rgb("secondary", [191] * 3)}),
    "SUM inv R0": (inverted_sum("sum_alone_inverted_spare0", 0x0000000E, 0x20),
                   {**rgb("spare0", (63, 127, 191)), **rgb("secondary", (178, 127, 38))}),
    "SUM inv V1": (inverted_sum("sum_alone_inverted_secondary", 0x0000000E, 0x40),
                   {**rgb("spare0", (63, 127, 191)), **rgb("secondary", (178, 127, 38))}),
    "blue->alpha CD": (blue_to_alpha("blue_to_alpha_cd", 0xD), {"stage1.spare1.a": 63}),
    "blue->alpha AB": (blue_to_alpha("blue_to_alpha_ab", 0xC), {"stage1.spare0.a": 191}),
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
