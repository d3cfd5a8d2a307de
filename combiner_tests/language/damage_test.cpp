// Damaged texts of every form but JSON.
#include "combiner_tests/language/damage.h"

#include <gtest/gtest.h>

#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/language/register_log_shapes.h"
#include "combiner_tests/language/xbox_shapes.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/register_log.h"
#include "ninebit/language/source_code.h"
#include "ninebit/language/xbox_pixel_shader.h"
#include "ninebit/texture_shader/validate_stages.h"

namespace ninebit::test {
namespace {

using namespace std::string_view_literals;

template <class T>
const T& one_of(Random& random, const std::vector<T>& all) {
  return all[static_cast<std::size_t>(random.below(static_cast<int>(all.size())))];
}

std::function<std::string(Random&)> always(std::string_view text) {
  return [text](Random&) { return std::string(text); };
}

constexpr auto kRc10 =
    "!!RC1.0\nconst0 = (1, 0.5, -.25, 1.);\n{ const1 = (0, 0, 0, 1);\n rgb { spare0.rgb = expand(tex0) . tex1.rgb;\n"
    "  spare1 = -half_bias(col0.a) * one;\n  scale_by_two(); } # comment\n alpha { discard = tex0; col1 = -one.b;\n"
    "  spare0 = mux(); bias_by_negative_one_half_scale_by_two(); } }\n// another\n{ alpha { discard = zero; } }\n"
    "clamp_color_sum(); final_product = fog * unsigned(col1);\n"
    "out.rgb = lerp(fog.a, color_sum, fog) + final_product; /* last */\nout.a = unsigned_invert(spare0.b);\n"sv;

TEST(Damaged, GlCalls) {
  const std::string all = "GLfloat c[4] = {0.5f, 1, 0x0, 1e-3};\nglCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, c);\n" +
                          *print_gl_calls(*parse_rc10({kRc10, ""}, profiles::nv2a), profiles::nv2a);
  // Whole lines, so that some of the edited texts remain valid.
  const auto lines = [&](Random& random) {
    const std::size_t from = all.find('\n', static_cast<std::size_t>(random.below(static_cast<int>(all.size())))) + 1;
    return random.one_in(2) ? all.substr(0, from) : all.substr(from, all.find('\n', from) + 1 - from);
  };
  expect_states_or_faults({.seed = 7,
                           .whole = lines,
                           .bytes = "(){}[],;=+-&*#/\"'\\.0x1eEfGL_NV \n\t\0\x80\xFF"sv,
                           .parse = [](const SourceText& text) { return parse_gl_calls(text, profiles::nv2a); },
                           .states = 25,
                           .refused = 4000});
}

TEST(Damaged, Rc10) {
  expect_states_or_faults({.seed = 10,
                           .whole = always(kRc10),
                           .bytes = "(){}.,;=+-*#/!_abrgx0159 \n\t\0\x80\xFF"sv,
                           .parse = [](const SourceText& text) { return parse_rc10(text, profiles::nv2a); },
                           .states = 120,
                           .refused = 4000,
                           .kept = 7});
}

TEST(Damaged, Ts10) {
  constexpr auto kWhole =
      "!!TS1.0\ntexture_2d();\ndot_product_reflect_cube_map_const_eye_1of3(expand(tex0), 1, .5, -2);\n"
      "dot_product_reflect_cube_map_const_eye_2of3(tex0);\n"
      "dot_product_reflect_cube_map_const_eye_3of3(expand(tex0));\n!!RC1.0\nout.rgb = tex0;\nout.a = tex0.a;\n"sv;
  const auto parse = [](const SourceText& text) {
    TextureShaderState stages;
    auto parsed = parse_rc10(text, profiles::nv2a, &stages);
    EXPECT_TRUE(!parsed || validate(stages, profiles::nv2a).empty());
    return parsed;
  };
  expect_states_or_faults({.seed = 63,
                           .whole = always(kWhole),
                           .bytes = "!RCTS0123456789abcdefoxt_(){},;.-+= \n",
                           .parse = parse,
                           .states = 20,
                           .refused = 3000,
                           .kept = 7});
}

TEST(Damaged, PixelShaders) {
  constexpr auto kWhole =
      "xps.1.1\n#define K c0.a\ndef c0, 1, 0.5, -.25, 1.f\n#ifdef Z\n#else\ntex t0\n#endif\nmul_x2 r0.rgb, t0_bx2, "
      "1-v0 ; c\n+mov r0.a, K\ndp3_sat r1, t0, r0\ncnd r0, r0.a, -r1, v1_bias\nxmma r1, discard, v0, r1, c[1], "
      "fog.rgb, 1 - zero\nlrp r0.rgb, r1.a, r0, v0\nxfc fog.a, r0, sum, prod, v0, 1-r1.a, r0.a\n"sv;
  expect_states_or_faults({.seed = 8,
                           .whole = always(kWhole),
                           .bytes = "rtvcx0123_.,+-;#abdmulsop \n\t\0\x80\xFF[]1"sv,
                           .parse = [](const SourceText& text) { return parse_pixel_shader(text, profiles::nv2a); },
                           .states = 120,
                           .refused = 3000,
                           .kept = 7});
}

TEST(Damaged, RegisterWords) {
  for (const ChipClass chip : {ChipClass::nv10, ChipClass::nv20}) {
    const HardwareProfile& profile = chip == ChipClass::nv10 ? profiles::geforce2 : profiles::nv2a;
    expect_states_or_faults(
        {.seed = 15,
         .whole = [&](Random& random) { return *print_register_words(random_state(random, profile), chip, profile); },
         .bytes = "0123456789abcdefxX=[]()_ \t\r\n#/RCINOUTALPHGB{}\",:\x01\x80\xff",
         .parse = [&](const SourceText& text) { return parse_register_words(text, chip, profile); },
         .states = 50,
         .refused = 500,
         .texts = 4000,
         .profile = profile});
  }
}

Parsed<CombinerState> parse_definition(const SourceText& text) {
  return parse_xbox_pixel_shader(text, profiles::nv2a);
}

TEST(Damaged, DefinitionsOfEveryShape) {
  const std::vector<Shape> shapes = all_shapes();
  expect_states_or_faults({.seed = 85,
                           .whole = [&](Random& random) { return one_of(random, shapes).text(random_words(random)); },
                           .bytes = "0123456789abcdefxX{}[]()=,;.|<>-~+ \n\"/*#:&PSRGB",
                           .parse = parse_definition,
                           .states = 300,
                           .refused = 300});
}

TEST(Damaged, DefinitionsInMacros) {
  const auto printed = [](Random& random) {
    std::vector<RegisterWord> words;
    const auto state = parse_xbox_pixel_shader({as_bytes(random_words(random)), ""}, profiles::nv2a, &words);
    return *print_xbox_pixel_shader(*state, profiles::nv2a, words);
  };
  expect_states_or_faults({.seed = 86,
                           .whole = printed,
                           .bytes = "0123{}()=,|<>-~ \n_PSREGITZC",
                           .parse = parse_definition,
                           .states = 60,
                           .refused = 400,
                           .texts = 4000});
}

TEST(Damaged, RegisterLogs) {
  const std::vector<TraceStyle> styles = all_styles();
  // The programs of all set-ups.
  const auto parse = [](const SourceText& text) {
    auto log = parse_register_log(text);
    Parsed<CombinerState> program(log.faults(), std::move(log.notes));
    for (std::size_t k = 1; log && k <= log->setups.size() && (k == 1 || program); ++k) {
      program = program_of(*log, k, text.file, profiles::nv2a);
    }
    return program;
  };
  expect_states_or_faults({.seed = 112,
                           .whole = [&](Random& random) { return one_of(random, styles).text(random_trace(random)); },
                           .bytes = "0123456789abcdefxX<>[]()->,;:|\"=/\n\r\t \x01\x80",
                           .parse = parse,
                           .states = 150,
                           .refused = 15,
                           .texts = 2500,
                           .edits = 40});
}

TEST(Damaged, Sources) {
  const std::vector<std::string> pieces{
      "void f(int a, float *b = c) { glCombinerInputNV(GL_COMBINER0_NV + a, GL_RGB, GL_VARIABLE_A_NV, t[a].r, m, "
      "GL_RGB); }\n",
      "#define M(a, b) a ## b # a\n#if defined(X) && Y > 2\nM(gl, Enable)(1);\n#else\n#endif\n",
      "class A : public B { enum { x = 1, y }; static const float k[4] = { 1, .5f, 0x2, 1e3 }; void g() const { f(x, "
      "k); } };\n",
      "switch (m) { case A::x: for (int i = 0; i < 3; ++i) v[i++] = i * 2; break; default: { nvparse(\"!!RC1.0\\n\" "
      "\"out.rgb=tex0;\"); } }\n",
      "if (p->q(3)[1].z != NULL) return; else while (--n) ;\n",
      "float[] a = new float[] { 1f, 2d }; R\"x(!!RC1.0)x\" // c\n"};
  const auto parse = [](const SourceText& text) {
    for (const SourceFunction& f : find_source_functions(text, {{"m", "A::x"}, {"a", "1"}}, profiles::nv2a)) {
      EXPECT_GE(f.line, 1);
    }
    (void)is_source_code(text.text);
    return parse_source_code(text, {}, profiles::nv2a);
  };
  expect_states_or_faults({.seed = 24,
                           .whole =
                               [&](Random& random) {
                                 std::string text;
                                 for (int i = 0; i < 4; ++i) text += one_of(random, pieces);
                                 return text;
                               },
                           .bytes = "(){}[],;#=+-*/&|!?:.'\"\\ \naglNV0",
                           .parse = parse,
                           .refused = 1000,
                           .texts = 2000});
}

}  // namespace
}  // namespace ninebit::test
