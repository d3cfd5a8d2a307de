"""Programs in the four languages, profiles, and the tables of eval and verify."""
import json_tree
import seeds
import text_lines
from flags import program_command, some
from judge import Case
from mutate import damage, few
from scenes import bytes_or, finish

GL_WORDS = ["glCombinerParameteriNV", "glCombinerParameterfvNV", "glCombinerInputNV(GL_COMBINER0_NV,",
            "glCombinerOutputNV(", "glFinalCombinerInputNV(", "glEnable(GL_REGISTER_COMBINERS_NV);", "GL_COMBINER7_NV,",
            "GL_RGB,", "GL_ALPHA,", "GL_VARIABLE_A_NV,", "GL_SPARE0_NV,", "GL_DISCARD_NV,", "GL_TEXTURE3_ARB,",
            "GL_SCALE_BY_FOUR_NV,", "GL_BIAS_BY_NEGATIVE_ONE_HALF_NV,", "GL_TRUE);", "/*", "*/", "//", "#define", "(",
            ")", ",", ";", "0x86", "(const GLfloat[]){1,", "-1.0f"]
RC10_WORDS = ["!!RC1.0", "{", "}", "rgb", "alpha", "discard", "spare0", "spare1", "col0", "tex0", "tex3", "const0",
              "zero", "fog", "=", "*", ".", "sum();", "mux();", "scale_by_four();", "bias_by_negative_one_half();",
              "expand(", "half_bias(", "unsigned_invert(", "out.rgb", "out.a", "final_product", "color_sum", "lerp(",
              "clamp_color_sum();", "const0 = (1, 0, 0, 1);", "//", "/*", "-"]
WORD_WORDS = ["RC_IN_RGB[0]", "RC_IN_ALPHA[7]", "RC_OUT_RGB[8]", "RC_OUT_ALPHA[0]", "RC_FINAL0", "RC_FINAL1",
              "RC_CONSTANT_COLOR0[0]", "RC_COLOR0", "=", "0xffffffff", "//"]
COLUMNS = ["primary.r", "tex0.a", "const0.g", "spare0.a", "out.r", "stage0.spare0.r", "fog.a", "name", "program",
           "62|63", "\"", "a\"b", "stage9.tex0.r"]
START = {"gl": "docs/programs/index_compare.gl"}
PROFILE = b"""{"ninebit": "profile", "version": 1, "base": "geforce2", "name": "a.b-c_9", "chip": "a chip", "arithmetic": "integer",
"byte_shift": 1, "one": 127, "lowest": -128, "lowest_output": -128, "half": 63, "expand_offset": 128, "general_narrowing": "nearest-halves-up",
"narrowing_point": "before-scale", "final_narrowing": "toward-zero", "general_combiners": 5, "texture_units": 3,
"per_stage_constants": true, "blue_to_alpha": true, "mux_by_lowest_bit": true, "color_sum_inverts": true,
"spare0_alpha_without_texture0": 1, "disabled_texture_alpha": 2, "secondary_alpha": "as-given", "fog_alpha_without_fog": 3,
"subpixel_bits": 0, "line_shape": "diamonds", "point_shape": "whole-pixels", "vertex_color_mantissa_bits": 23, "polygon_offset_slope": "root", "polygon_offset_fraction": "rounded", "color_interpolation": "affine",
"depth_narrowing": "nearest-halves-up", "fog_byte": "nearest", "color_weights": "exact", "texture_weight_bits": 5, "texture_weight_narrowing": "toward-zero",
"texture_filter_rounding": "once", "texture_bias_narrowing": "nearest-halves-up", "dxt1_palette": "rgb888"}"""
ROWS = b"primary.r,tex0.r,tex0.a,const0.g\n1,2,3,4\n-255,255,0,17\n102,100,255,0\n"
TABLE = b"name,primary.r,tex0.r,out.r,stage0.spare0.r\na,1,2,0,\nb,3,3,255|0,1\n"


def forms(context):
    """The article's program in each language, by the program itself, and each language's corpus."""
    with context.lock:
        if not context.forms:
            source = str(seeds.ROOT / START["gl"])
            for form in ("gl", "rc10", "words", "json", "words-json"):
                made = seeds.answer(context.program, "convert", source, "--to", form)
                context.forms[form] = [made] * 100 + seeds.corpus({"words-json": "words"}.get(form, form))
    return context.forms


def change_json(random, data):
    try:
        tree = json_tree.parse(data.decode())
    except (ValueError, RecursionError):
        return damage(random, data)
    for _ in range(few(random)):
        json_tree.mutate(random, tree)
    return json_tree.encode(tree)


def change_words(words):
    return lambda random, data: text_lines.mutate(random, data, words, few(random))


def program(form, change):
    """The generator of one language."""
    def make(random, context):
        data = random.choice(forms(context)[form])
        data = bytes_or(random, data, lambda d: change(random, d))
        language = form.removesuffix("-json")
        command = program_command(random, "a.program", language)
        return finish(random, Case(command, {"a.program": data, "rows.csv": ROWS, "table.csv": TABLE}))
    return make


def profile(random, _context):
    data = random.choice([PROFILE] * 60 + [b'{"base": "nv2a", "name": "mine"}'] * 20 + seeds.corpus("profile"))
    data = bytes_or(random, data, lambda d: change_json(random, d))
    command = random.choice([["profiles"], ["explain", "a.gl"],
                             ["eval", "a.gl", "--inputs", "rows.csv"],
                             ["convert", "a.gl", "--to", "glsl"],
                             ["render", "scenes/cornell_box.gltf", "-o", "out", "--size", "8x8", "--map-size", "16"]])
    files = {"m.json": data, "a.gl": (seeds.ROOT / START["gl"]).read_bytes(), "rows.csv": ROWS}
    return finish(random, Case([*command, "--profile", "m.json", *some(random, 0.3, "--json")], files))


def table(random, _context):
    """The inputs of eval, and the tables of verify, which name programs."""
    files = {"a.gl": (seeds.ROOT / START["gl"]).read_bytes()}
    if random.random() < 0.5:
        data = random.choice([ROWS] * 60 + seeds.corpus("csv"))
        command = ["eval", "a.gl", "--inputs", "t.csv", *some(random, 0.3, "--registers"),
                   *some(random, 0.3, "-o", "out.csv"),
                   *some(random, 0.3, "--engine", "reference"), *some(random, 0.3, "--json")]
    else:
        data = random.choice([TABLE, b"program," + TABLE.replace(b"\na", b"\na.gl,a").replace(b"\nb", b"\n\"a.gl\",b")])
        command = ["verify", "t.csv", "--threads", "1", *some(random, 0.5, "--program", "a.gl"),
                   *some(random, 0.3, "--json")]
    files["t.csv"] = bytes_or(random, data, lambda d: text_lines.mutate(random, d, COLUMNS, few(random), comma=True))
    return finish(random, Case(command, files))


FORMATS = {"gl": program("gl", change_words(GL_WORDS)), "rc10": program("rc10", change_words(RC10_WORDS)),
           "words": program("words", change_words(WORD_WORDS)), "words-json": program("words-json", change_json),
           "json": program("json", change_json), "profile": profile, "table": table}
