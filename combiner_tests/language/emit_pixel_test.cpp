// Programs by stages: HLSL, compiled as C++ with vectors of its own, against the reference, and by a compiler of HLSL;
// the number of operations. emit_glsl_test.cpp runs the GLSL.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <regex>
#include <string>
#include <vector>

#include "combiner_tests/language/compiled_c.h"
#include "combiner_tests/language/emit_cases.h"
#include "combiner_tests/support/has.h"
#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/support/temp_folder.h"
#include "ninebit/language/glsl.h"

namespace ninebit::test {
namespace {

// What HLSL has of vectors, as far as emitted texts use it.
constexpr const char* kVectors = R"(#include <stdint.h>
struct int3 {
  int r, g, b;
  int3() = default;
  int3(int x) : r(x), g(x), b(x) {}
  int3(int x, int y, int z) : r(x), g(y), b(z) {}
};
struct int4 {
  int3 rgb;
  int a;
  int4() = default;
  int4(int3 v, int w) : rgb(v), a(w) {}
  int4(int x, int y, int z, int w) : rgb(x, y, z), a(w) {}
};
#define EACH(op) inline int3 operator op(int3 x, int3 y) { return {x.r op y.r, x.g op y.g, x.b op y.b}; }
EACH(+) EACH(-) EACH(*) EACH(/) EACH(<)
inline int3 operator-(int3 x) { return {-x.r, -x.g, -x.b}; }
inline int min(int x, int y) { return x < y ? x : y; }
inline int max(int x, int y) { return x > y ? x : y; }
inline int abs(int x) { return x < 0 ? -x : x; }
inline int clamp(int x, int low, int high) { return min(max(x, low), high); }
inline int3 min(int3 x, int3 y) { return {min(x.r, y.r), min(x.g, y.g), min(x.b, y.b)}; }
inline int3 max(int3 x, int3 y) { return {max(x.r, y.r), max(x.g, y.g), max(x.b, y.b)}; }
inline int3 abs(int3 x) { return {abs(x.r), abs(x.g), abs(x.b)}; }
inline int3 clamp(int3 x, int low, int high) { return min(max(x, low), high); }
)";

// HLSL as C++: its buffer is a namespace, inout a reference, and blue of four stands in their first three.
std::string as_cpp(std::string text, const std::string& name) {
  text = std::regex_replace(text, std::regex("cbuffer (\\w+)"), "namespace $1");
  text = std::regex_replace(text, std::regex("inout (\\w+) r"), "$1& r");
  text = std::regex_replace(text, std::regex("(\\br\\.\\w+|_constants\\[\\d+\\])\\.b\\b"), "$1.rgb.b");
  const std::size_t buffer = text.find("\nstruct");
  text.insert(buffer, "\nusing namespace " + name + "_of_program;\n");
  return "namespace of_" + name + " {\n" + text + "}\n";
}

// The function that a test calls, which sets the constants.
std::string caller(const Program& program, const std::string& name) {
  std::string text = "extern \"C\" void " + name +
                     "(const int32_t p[4], const int32_t s[4], const int32_t f[4], const int32_t t0[4], const int32_t "
                     "t1[4], const int32_t t2[4], const int32_t t3[4], int32_t spare0_alpha, int32_t to[4]) {\n";
  const auto set = [&](int element, const Rgba9& codes) {
    text += "  of_" + name + "::" + name + "_constants[" + std::to_string(element) + "] = int4(";
    for (std::size_t c = 0; c < 4; ++c) text += (c > 0 ? ", " : "") + std::to_string(codes[c]);
    text += ");\n";
  };
  for (int i = 0; i < kMaxGeneralCombiners; ++i) {
    set(2 * i, program.general[static_cast<std::size_t>(i)].constant0);
    set(2 * i + 1, program.general[static_cast<std::size_t>(i)].constant1);
  }
  set(2 * kMaxGeneralCombiners, program.constant0);
  set(2 * kMaxGeneralCombiners + 1, program.constant1);
  const auto four = [](const std::string& v) { return "int4(" + v + "[0], " + v + "[1], " + v + "[2], " + v + "[3])"; };
  return text + "  const int4 result = of_" + name + "::" + name + '(' + four("p") + ", " + four("s") + ", " +
         four("f") + ", " + four("t0") + ", " + four("t1") + ", " + four("t2") + ", " + four("t3") +
         ", spare0_alpha);\n  to[0] = result.rgb.r; to[1] = result.rgb.g; to[2] = result.rgb.b; to[3] = result.a;\n}\n";
}

std::vector<EmitCase> hlsl_cases() {
  std::vector<EmitCase> cases = random_cases(0x686C736CU, 50);
  for (const EmitCase& c : known_cases()) cases.push_back(c);
  return cases;
}

TEST(EmitPixel, HlslGivesTheBitsOfTheReference) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  const std::vector<EmitCase> cases = hlsl_cases();
  std::string source = kVectors;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string name = "program" + std::to_string(i);
    const auto text = emit_pixel_shader(cases[i].program, PixelLanguage::hlsl, name);
    ASSERT_TRUE(text.ok()) << text.error().text();
    source += as_cpp(*text, name) + caller(cases[i].program, name);
  }
  const CompiledC compiled(source, CompiledC::Runs::seldom, "-x c++ -std=c++17 -Wno-unused-parameter");
  ASSERT_FALSE(::testing::Test::HasFailure());
  Outputs outputs;
  const auto text_of = [](const Program& p) { return emit_pixel_shader(p, PixelLanguage::hlsl).value(); };
  compare(compiled, cases, 0x68U, 64, text_of, outputs);
  outputs.expect_meaning(cases.size() * 64);
}

// What glslang's compiler of HLSL says against a pixel shader; empty: nothing.
std::string hlsl_errors(const std::string& text) {
  const TempFolder folder;
  const std::string file = folder / "shader.hlsl";
  std::ofstream(file) << text;
  FILE* const out = popen(("glslangValidator -D -V -S frag -e main -o /dev/null '" + file + "' 2>&1").c_str(), "r");
  if (out == nullptr) return "popen failed";
  std::string said;
  for (int byte = std::fgetc(out); byte != EOF; byte = std::fgetc(out)) said += static_cast<char>(byte);
  return pclose(out) == 0 ? std::string() : said;
}

TEST(EmitPixel, ACompilerOfHlslTakesTheTexts) {
  if (std::system("glslangValidator --version >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "no compiler of HLSL is here (install glslang-tools)";
  }
  const std::vector<EmitCase> cases = hlsl_cases();
  std::string text, body;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string name = "program" + std::to_string(i);
    text += emit_pixel_shader(cases[i].program, PixelLanguage::hlsl, name).value();
    body += "  if (column == " + std::to_string(i) + ") return " + name +
            "(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7].a);\n";
  }
  text +=
      "Texture2D<int4> arguments;\nint4 main(float4 at : SV_Position) : SV_Target {\n  int4 a[8];\n"
      "  for (int i = 0; i < 8; ++i) a[i] = arguments.Load(int3(i, int(at.y), 0));\n  const int column = int(at.x);\n" +
      body + "  return a[0];\n}\n";
  EXPECT_EQ(hlsl_errors(text), "") << text;
  EXPECT_NE(hlsl_errors(std::regex_replace(text, std::regex("inout "), "input ")), "");
}

std::string without_words(const std::string& text) {
  return std::regex_replace(text, std::regex("//[^\n]*"), "");
}

TEST(EmitPixel, LanguagesDifferInTheirWordsAlone) {
  for (const EmitCase& c : random_cases(0x776F7264U, 40)) {
    const std::string text = without_words(emit_pixel_shader(c.program, PixelLanguage::glsl_330).value());
    const std::string body = text.substr(text.find('\n'));
    for (const auto& [language, head] : {std::pair(PixelLanguage::glsl_130, "#version 130\n"),
                                         std::pair(PixelLanguage::glsl_450, "#version 450 core\n"),
                                         std::pair(PixelLanguage::es_300, "#version 300 es\nprecision highp int;\n")}) {
      const std::string other = without_words(emit_pixel_shader(c.program, language).value());
      EXPECT_TRUE(other.starts_with(head)) << other;
      EXPECT_TRUE(other.ends_with(body)) << other;
    }
    EXPECT_EQ(std::count(body.begin(), body.end(), '.') > 0, true);
    EXPECT_FALSE(std::regex_search(body, std::regex("[0-9]\\.[0-9]|float"))) << body;
  }
}

TEST(EmitPixel, ConstantsAreNoPartOfTheText) {
  CombinerState state;
  state.per_stage_constants = true;
  state.general[0].rgb.a.reg = Register::constant0;
  CombinerState other = state;
  other.general[0].constant0 = {1.0F, 0.5F, 0.25F, 0.0F};
  const auto text_of = [](const CombinerState& of) {
    return emit_pixel_shader(compile(of, profiles::nv2a).value(), PixelLanguage::glsl_130).value();
  };
  EXPECT_EQ(text_of(state), text_of(other));
  EXPECT_TRUE(has(text_of(state), "ninebit_combine_constants[0].rgb"));
}

// Operations in a text: operators between values, and calls of functions.
std::size_t operations_in(const std::string& text) {
  const std::string code = without_words(text);
  const std::regex one(
      R"( [-+*/] |\b(min|max|clamp|abs)\(|_with_sign\((?!int|ivec)|_sum\((?!ivec)| \? |[(,] ?-[a-z(])");
  return static_cast<std::size_t>(
      std::distance(std::sregex_iterator(code.begin(), code.end(), one), std::sregex_iterator()));
}

// Operations that the rules ask a program for, in vectors of red, green and blue.
class Needed {
 public:
  explicit Needed(const Program& program) {
    for (int i = 0; i < program.num_general_combiners; ++i) {
      const ProgramStage& stage = program.general[static_cast<std::size_t>(i)];
      add(stage.rgb);
      add(stage.alpha);
    }
    const FinalCombiner& f = program.final_combiner;
    if (detail::reads_directly(f, Register::e_times_f)) count += input(f.e) + input(f.f) + 1 + 2;
    if (detail::reads_directly(f, Register::spare0_plus_secondary))
      count += 2 + 1 + (program.color_sum_clamp ? 1U : 0U);
    const bool ab = !is_zero(f.a) && !is_zero(f.b), c = !is_zero(f.c);
    if (ab) count += input(f.a) + input(f.b) + 1;
    if (c) count += input(f.c) + (is_zero(f.a) ? 0U : 2U);
    if (ab || c) count += (ab && c ? 1U : 0U) + 2;
    if (!is_zero(f.d)) count += input(f.d) + (ab || c ? 1U : 0U);
    count += 1 + input(f.g);  // the clamp
  }

  std::size_t count = 0;

 private:
  static bool is_zero(const CombinerInput& in) {
    return in.reg == Register::zero &&
           (in.mapping == InputMapping::unsigned_identity || in.mapping == InputMapping::signed_identity ||
            in.mapping == InputMapping::signed_negate);
  }
  static bool is_number(const CombinerInput& in) { return in.reg == Register::zero; }
  // Reading and mapping.
  static std::size_t input(const CombinerInput& in) {
    if (is_number(in)) return 0;
    switch (in.mapping) {
      case InputMapping::signed_identity:
        return 0;
      case InputMapping::unsigned_identity:
      case InputMapping::signed_negate:
        return 1;
      default:
        return 2;
    }
  }
  void add(const Portion& p) {
    const PortionOutput& out = p.out;
    if (!is_live(out)) return;
    const bool ab = !is_zero(p.a) && !is_zero(p.b), cd = !is_zero(p.c) && !is_zero(p.d);
    bool is_wide = false;
    const auto product = [&](const CombinerInput& x, const CombinerInput& y, bool dot) {
      const bool is_product = !is_number(x) && !is_number(y);
      is_wide = is_wide || is_product || dot;
      count += input(x) + input(y) + (is_product ? 1U : 0U) + (dot ? 1U : 0U);
    };
    if (ab) product(p.a, p.b, out.ab_dot_product);
    if (cd) product(p.c, p.d, out.cd_dot_product);
    if (out.sum != Register::discard) count += out.mux_sum ? 1U : ab && cd ? 1U : 0U;
    for (const Register r : {out.ab, out.cd, out.sum}) {
      if (r == Register::discard) continue;
      count += (out.bias != Bias::none ? 1U : 0U) + (out.scale != Scale::none ? 1U : 0U) + (is_wide ? 2U : 0U) + 1;
    }
  }
};

TEST(EmitPixel, TextsHaveAtMostHalfMoreOperationsThanProgramsNeed) {
  std::size_t before = 0, now = 0, needed = 0;
  std::string rows;
  const auto programs = gallery_programs(profiles::nv2a);
  for (const auto& [name, program] : programs) {
    const std::size_t own = operations_in(emit_pixel_shader(program, PixelLanguage::glsl_330).value());
    const std::size_t need = Needed(program).count;
    before += operations_in(emit_glsl_with_uniform_constants(program, GlslVersion::glsl_330).value());
    now += own;
    needed += need;
    rows += name + ' ' + std::to_string(own) + " of " + std::to_string(need) + '\n';
    EXPECT_LE(2 * own, 3 * need + 2) << name << '\n' << emit_pixel_shader(program, PixelLanguage::glsl_330).value();
  }
  EXPECT_GT(programs.size(), 30U);
  EXPECT_LE(2 * now, 3 * needed) << rows;
  std::cout << programs.size() << " programs: " << needed << " operations needed, " << now << " in texts by stages, "
            << before << " in texts without\n";
}

}  // namespace
}  // namespace ninebit::test
