// Programs emitted as GLSL, run by a GL without a window (Mesa's llvmpipe where there is no other), against the
// reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "combiner_tests/language/emit_cases.h"
#include "combiner_tests/language/emit_gl_runner.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/language/glsl.h"

namespace ninebit::test {
namespace {

constexpr std::uint64_t kGlslSeed = 0x676C736C206F7574U;
constexpr int kGlslCases = 60;
constexpr std::size_t kGlslFragments = 256;

// The text of a program as a function with a name.
using TextOf = std::function<std::string(const Program&, const std::string& name)>;

// Several programs of one profile go into one shader, as glsl.h says they may.
void compare(GlRunner& runner, const TextOf& text_of, const std::vector<EmitCase>& cases, std::size_t fragments,
             std::size_t programs, Outputs& outputs) {
  for (std::size_t first = 0; first < cases.size(); first += programs) {
    const std::size_t end = std::min(first + programs, cases.size());
    std::string text, message;
    std::vector<std::string> names;
    for (std::size_t i = first; i < end; ++i) {
      ASSERT_EQ(cases[i].profile.name, cases[first].profile.name);
      names.push_back(programs == 1 ? "ninebit_combine" : "program" + std::to_string(i));
      const std::string source = text_of(cases[i].program, names.back());
      text += i == first ? source : source.substr(source.find('\n') + 1);
    }
    const std::vector<RegisterFile> inputs = emit_inputs(cases[first].profile, kGlslSeed + first, fragments);
    const auto colors = runner.run(text, names, inputs, message);
    ASSERT_TRUE(colors.has_value()) << cases[first].name << '\n' << message;
    for (std::size_t i = first; i < end; ++i) {
      for (std::size_t k = 0; k < inputs.size(); ++k) {
        const Rgba9 expected = evaluate(cases[i].program, inputs[k]), actual = (*colors)[i - first][k];
        ASSERT_EQ(expected, actual) << mismatch(cases[i], inputs[k], expected, actual)
                                    << text_of(cases[i].program, names[i - first]);
        outputs.add(expected);
      }
    }
  }
}

class EmitGlsl : public ::testing::TestWithParam<GlslVersion> {
 protected:
  void SetUp() override {
    if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
    std::string why_not;
    runner_ = GlRunner::make(GetParam(), why_not);
    if (runner_ == nullptr) {
      std::fprintf(stderr, "NOTICE: emitted GLSL was not run: %s\n", why_not.c_str());
      GTEST_SKIP() << why_not;
    }
    RecordProperty("renderer", runner_->renderer());
  }

  static std::string text(const Program& program, const std::string& name) {
    return emit_glsl(program, GetParam(), name).value();
  }

  std::unique_ptr<GlRunner> runner_;
};

// By stages, with the uniform array as an array of constants.
std::string pixel_text(const Program& program, PixelLanguage language, const std::string& name) {
  std::string text = emit_pixel_shader(program, language, name).value();
  std::string values;
  const auto add = [&](const Rgba9& codes) {
    values += values.empty() ? "ivec4(" : ", ivec4(";
    for (std::size_t c = 0; c < 4; ++c) values += (c > 0 ? ", " : "") + std::to_string(codes[c]);
    values += ')';
  };
  for (const ProgramStage& stage : program.general) {
    add(stage.constant0);
    add(stage.constant1);
  }
  add(program.constant0);
  add(program.constant1);
  const std::string declared = "uniform ivec4 " + name + "_constants[18];";
  text.replace(text.find(declared), declared.size(),
               "const ivec4 " + name + "_constants[18] = ivec4[18](" + values + ");");
  return text;
}

constexpr std::array kLanguageNames{"Glsl130", "Glsl330", "Glsl450", "Es300"};  // by PixelLanguage

class EmitPixelGlsl : public ::testing::TestWithParam<PixelLanguage> {};

TEST_P(EmitPixelGlsl, ProgramsByStagesGiveTheBitsOfTheReference) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  std::string why_not;
  const auto runner = GlRunner::make(GetParam(), why_not);
  if (runner == nullptr) GTEST_SKIP() << why_not;
  // The texts differ in their first lines alone (emit_pixel_test.cpp).
  const bool is_first = GetParam() == PixelLanguage::glsl_330;
  std::vector<EmitCase> cases = random_cases(kGlslSeed + 1, is_first ? kGlslCases / 2 : 6);
  for (const EmitCase& c : known_cases()) cases.push_back(c);
  const auto text_of = [](const Program& program, const std::string& name) {
    return pixel_text(program, GetParam(), name);
  };
  Outputs outputs;
  compare(*runner, text_of, cases, kGlslFragments, 1, outputs);
  if (!HasFailure()) outputs.expect_meaning(cases.size() * kGlslFragments);
}

INSTANTIATE_TEST_SUITE_P(Languages, EmitPixelGlsl,
                         ::testing::Values(PixelLanguage::glsl_130, PixelLanguage::glsl_330, PixelLanguage::glsl_450,
                                           PixelLanguage::es_300),
                         [](const auto& language) {
                           return std::string(kLanguageNames[static_cast<std::size_t>(language.param)]);
                         });

TEST_P(EmitGlsl, RandomProgramsGiveTheBitsOfTheReference) {
  const int count = GetParam() == GlslVersion::es_300 ? kGlslCases : kGlslCases / 3;
  Outputs outputs;
  compare(*runner_, text, random_cases(kGlslSeed, count), kGlslFragments, 1, outputs);
  if (!HasFailure()) outputs.expect_meaning(static_cast<std::size_t>(count) * kGlslFragments);
}

TEST_P(EmitGlsl, KnownProgramsGiveTheBitsOfTheReference) {
  Outputs outputs;
  compare(*runner_, text, known_cases(), 1024, 1, outputs);
  outputs.expect_distinct(1000);
}

// Of OpenGL ES, whose integers may have fewer bits: the texts differ in their first lines alone (emit_text_test.cpp).
TEST(EmitGlslEs, EveryMappingScaleAndBiasGivesTheBitsOfTheReference) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  std::string why_not;
  const auto runner = GlRunner::make(GlslVersion::es_300, why_not);
  if (runner == nullptr) GTEST_SKIP() << why_not;
  const auto text_of = [](const Program& program, const std::string& name) {
    return emit_glsl(program, GlslVersion::es_300, name).value();
  };
  Outputs outputs;
  compare(*runner, text_of, row_cases(), kGlslFragments, 12, outputs);
  outputs.expect_distinct(10000);
}

TEST_P(EmitGlsl, TheRunnerTellsWrongResultsAndWrongShadersApart) {
  const std::vector<EmitCase> cases = known_cases();
  std::string source = emit_glsl(cases[1].program, GetParam()).value(), message;
  const std::vector<RegisterFile> inputs = emit_inputs(cases[1].profile, kGlslSeed, kGlslFragments);
  const std::size_t at = source.find("return ivec4(");
  ASSERT_NE(at, std::string::npos);
  const std::string good = source;
  const auto right = runner_->run(good, {"ninebit_combine"}, inputs, message);
  source.insert(at + 13, "1 + ");
  const auto wrong = runner_->run(source, {"ninebit_combine"}, inputs, message);
  ASSERT_TRUE(right.has_value() && wrong.has_value()) << message;
  EXPECT_NE(*right, *wrong);
  EXPECT_FALSE(runner_->run(good + "}", {"ninebit_combine"}, inputs, message).has_value());
  EXPECT_NE(message, "");
}

INSTANTIATE_TEST_SUITE_P(Versions, EmitGlsl, ::testing::Values(GlslVersion::glsl_330, GlslVersion::es_300),
                         [](const auto& version) {
                           return std::string(version.param == GlslVersion::es_300 ? "Es300" : "Glsl330");
                         });

}  // namespace
}  // namespace ninebit::test
