// Which input may stand where: the matrix of NV_register_combiners, written out as a table and tried exhaustively.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "combiner_tests/language/gl_test_support.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::gl {
namespace {

constexpr std::array kUsages{GL_RGB, GL_ALPHA, GL_BLUE};
constexpr std::array kMappings{GL_UNSIGNED_IDENTITY_NV, GL_UNSIGNED_INVERT_NV,  GL_EXPAND_NORMAL_NV,
                               GL_EXPAND_NEGATE_NV,     GL_HALF_BIAS_NORMAL_NV, GL_HALF_BIAS_NEGATE_NV,
                               GL_SIGNED_IDENTITY_NV,   GL_SIGNED_NEGATE_NV};

// One letter for each of the usages RGB, ALPHA, BLUE: '.' legal, 'O' GL_INVALID_OPERATION, 'E' GL_INVALID_ENUM.
struct Row {
  const char* general_rgb;
  const char* general_alpha;
  const char* final_a;
  const char* final_bcd;
  const char* final_ef;
  const char* final_g;
};
constexpr Row kOrdinary{"..O", "O..", "..O", "..O", "..O", "O.."};
constexpr Row kFog{".OO", "OO.", "..O", "..O", "..O", "O.."};
constexpr Row kETimesF{"EEE", "EEE", ".OO", ".OO", "OOO", "OOO"};
constexpr Row kColorSum{"EEE", "EEE", "OOO", ".OO", "OOO", "OOO"};
constexpr Row kNoInput{"EEE", "EEE", "EEE", "EEE", "EEE", "EEE"};

struct Input {
  GLenum input;
  Row row;
};

std::vector<Input> inputs(int texture_units) {
  std::vector<Input> all{{GL_ZERO, kOrdinary},
                         {GL_CONSTANT_COLOR0_NV, kOrdinary},
                         {GL_CONSTANT_COLOR1_NV, kOrdinary},
                         {GL_FOG, kFog},
                         {GL_PRIMARY_COLOR_NV, kOrdinary},
                         {GL_SECONDARY_COLOR_NV, kOrdinary},
                         {GL_SPARE0_NV, kOrdinary},
                         {GL_SPARE1_NV, kOrdinary},
                         {GL_E_TIMES_F_NV, kETimesF},
                         {GL_SPARE0_PLUS_SECONDARY_COLOR_NV, kColorSum},
                         {GL_DISCARD_NV, kNoInput},
                         {GL_ONE, kNoInput}};
  for (int unit = 0; unit < 32; ++unit) {
    all.push_back({GL_TEXTURE0_ARB + static_cast<GLenum>(unit), unit < texture_units ? kOrdinary : kNoInput});
  }
  return all;
}

GLenum error_of(char letter) {
  return letter == '.' ? GL_NO_ERROR : letter == 'O' ? GL_INVALID_OPERATION : GL_INVALID_ENUM;
}

std::string text_of(const std::array<GLenum, 6>& arguments) {
  std::string text = "arguments:";
  for (const GLenum argument : arguments) text.append(" ").append(std::to_string(argument));
  return text;
}

class GlLegality : public ::testing::TestWithParam<const HardwareProfile*> {
 protected:
  GlLegality() : context_(*GetParam()), current_(context_) {}

  // The command has just run: was its error `expected`, and did it take effect exactly if there was none?
  void check(GLenum expected, const CombinerState& before, bool applied, const std::array<GLenum, 6>& arguments) {
    ASSERT_EQ(glGetError(), expected) << text_of(arguments);
    if (expected == GL_NO_ERROR) {
      ASSERT_TRUE(applied) << text_of(arguments);
      ++legal_;
    } else {
      ASSERT_TRUE(context_.state() == before) << text_of(arguments);
      ++refused_;
    }
  }

  Context context_;
  int legal_ = 0, refused_ = 0;

 private:
  CurrentContext current_;
};

TEST_P(GlLegality, OfGeneralCombinerInputs) {
  if (ninebit::test::kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  const GLenum stages = static_cast<GLenum>(GetParam()->general_combiners.value);
  const auto all = inputs(GetParam()->texture_units);
  for (GLenum i = 0; i < 9; ++i) {
    for (const GLenum portion : {GL_RGB, GL_ALPHA}) {
      for (GLenum variable = GL_VARIABLE_A_NV; variable <= GL_VARIABLE_G_NV; ++variable) {
        for (const Input& input : all) {
          for (std::size_t usage = 0; usage < kUsages.size(); ++usage) {
            for (const GLenum mapping : kMappings) {
              const GLenum stage = GL_COMBINER0_NV + i;
              const char* const letters = portion == GL_RGB ? input.row.general_rgb : input.row.general_alpha;
              const bool exists = i < stages && variable <= GL_VARIABLE_D_NV;
              const CombinerState before = context_.state();
              glCombinerInputNV(stage, portion, variable, input.input, mapping, kUsages[usage]);
              const GLenum expected = exists ? error_of(letters[usage]) : GL_INVALID_ENUM;
              const bool applied = expected == GL_NO_ERROR && get_general_input(stage, portion, variable) ==
                                                                  InputArguments{input.input, mapping, kUsages[usage]};
              ASSERT_NO_FATAL_FAILURE(
                  check(expected, before, applied, {stage, portion, variable, input.input, mapping, kUsages[usage]}));
            }
          }
        }
      }
    }
  }
  // Legal: of the ordinary inputs two usages a portion, of fog one.
  const int ordinary = 7 + GetParam()->texture_units;
  EXPECT_EQ(legal_, static_cast<int>(stages) * 2 * 4 * 8 * (2 * ordinary + 1));
  EXPECT_EQ(legal_ + refused_, 9 * 2 * 7 * static_cast<int>(all.size()) * 3 * 8);
}

TEST_P(GlLegality, OfFinalCombinerInputs) {
  if (ninebit::test::kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  for (GLenum variable = GL_VARIABLE_A_NV; variable <= GL_VARIABLE_G_NV; ++variable) {
    for (const Input& input : inputs(GetParam()->texture_units)) {
      const char* const letters = variable == GL_VARIABLE_A_NV   ? input.row.final_a
                                  : variable <= GL_VARIABLE_D_NV ? input.row.final_bcd
                                  : variable <= GL_VARIABLE_F_NV ? input.row.final_ef
                                                                 : input.row.final_g;
      for (std::size_t usage = 0; usage < kUsages.size(); ++usage) {
        for (const GLenum mapping : kMappings) {
          const bool mapping_exists = mapping == GL_UNSIGNED_IDENTITY_NV || mapping == GL_UNSIGNED_INVERT_NV;
          const CombinerState before = context_.state();
          glFinalCombinerInputNV(variable, input.input, mapping, kUsages[usage]);
          const GLenum expected = mapping_exists ? error_of(letters[usage]) : GL_INVALID_ENUM;
          const bool applied = expected == GL_NO_ERROR &&
                               get_final_input(variable) == InputArguments{input.input, mapping, kUsages[usage]};
          ASSERT_NO_FATAL_FAILURE(
              check(expected, before, applied, {variable, input.input, mapping, kUsages[usage], 0, 0}));
        }
      }
    }
  }
  const int ordinary = 8 + GetParam()->texture_units;  // with fog
  EXPECT_EQ(legal_, 2 * (7 * 2 * ordinary + 4 + 3));   // E·F in A to D, the colour sum in B to D
}

// Every triple of destinations, every scale with every bias, every set of flags, in both portions.
TEST_P(GlLegality, OfOutputs) {
  if (ninebit::test::kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  std::vector<GLenum> writable{GL_DISCARD_NV, GL_PRIMARY_COLOR_NV, GL_SECONDARY_COLOR_NV, GL_SPARE0_NV, GL_SPARE1_NV};
  std::vector<GLenum> others{
      GL_ZERO, GL_CONSTANT_COLOR0_NV, GL_FOG, GL_CONSTANT_COLOR1_NV, GL_E_TIMES_F_NV, GL_SPARE0_PLUS_SECONDARY_COLOR_NV,
      GL_ONE};
  for (GLenum unit = 0; unit < 5; ++unit) {
    const bool exists = unit < static_cast<GLenum>(GetParam()->texture_units.value);
    (exists ? writable : others).push_back(GL_TEXTURE0_ARB + unit);
  }
  std::vector<GLenum> all = writable;
  all.insert(all.end(), others.begin(), others.end());
  const auto is_writable = [&](GLenum name) {
    return std::find(writable.begin(), writable.end(), name) != writable.end();
  };
  const auto same = [](GLenum x, GLenum y) { return x == y && x != GL_DISCARD_NV; };
  constexpr std::array scales{GL_NONE, GL_SCALE_BY_TWO_NV, GL_SCALE_BY_FOUR_NV, GL_SCALE_BY_ONE_HALF_NV};

  // Rules of GL_INVALID_VALUE and GL_INVALID_OPERATION can meet; GL does not say which wins.
  const auto try_one = [&](GLenum portion, const OutputArguments& o, bool wrong_enum, bool wrong_operation) {
    const bool wrong_value = portion == GL_ALPHA && (o.ab_dot != 0 || o.cd_dot != 0);
    const CombinerState before = context_.state();
    glCombinerOutputNV(GL_COMBINER1_NV, portion, o.ab, o.cd, o.sum, o.scale, o.bias, o.ab_dot, o.cd_dot, o.mux);
    const GLenum error = glGetError();
    const std::string text = text_of({portion, o.ab, o.cd, o.sum, o.scale, o.bias});
    if (wrong_enum) {
      ASSERT_EQ(error, GL_INVALID_ENUM) << text;
    } else if (wrong_operation && wrong_value) {
      ASSERT_TRUE(error == GL_INVALID_OPERATION || error == GL_INVALID_VALUE) << text;
    } else {
      ASSERT_EQ(error, wrong_operation ? GL_INVALID_OPERATION : wrong_value ? GL_INVALID_VALUE : GL_NO_ERROR) << text;
    }
    if (error == GL_NO_ERROR) {
      ASSERT_EQ(get_output(GL_COMBINER1_NV, portion), o) << text;
      ++legal_;
    } else {
      ASSERT_TRUE(context_.state() == before) << text;
      ++refused_;
    }
  };

  for (const GLenum portion : {GL_RGB, GL_ALPHA}) {
    for (const GLenum ab : all) {
      for (const GLenum cd : all) {
        for (const GLenum sum : all) {
          const bool wrong_enum = !is_writable(ab) || !is_writable(cd) || !is_writable(sum);
          const bool twice = same(ab, cd) || same(ab, sum) || same(cd, sum);
          for (const GLenum scale : scales) {
            for (const GLenum bias : {GL_NONE, GL_BIAS_BY_NEGATIVE_ONE_HALF_NV}) {
              const bool wrong_bias =
                  bias != GL_NONE && (scale == GL_SCALE_BY_FOUR_NV || scale == GL_SCALE_BY_ONE_HALF_NV);
              for (int flags = 0; flags < 8; ++flags) {
                const auto flag = [flags](int bit) { return static_cast<GLboolean>(flags >> bit & 1); };
                ASSERT_NO_FATAL_FAILURE(try_one(portion, {ab, cd, sum, scale, bias, flag(0), flag(1), flag(2)},
                                                wrong_enum, twice || wrong_bias));
              }
            }
          }
        }
      }
    }
  }
  // Triples of n registers, all different but for discard; 6 pairs of scale and bias; 8 sets of flags, alpha 2.
  const int n = static_cast<int>(writable.size()) - 1;
  const int triples = 1 + 3 * n + 3 * n * (n - 1) + n * (n - 1) * (n - 2);
  EXPECT_EQ(legal_, triples * 6 * (8 + 2));
}

INSTANTIATE_TEST_SUITE_P(Profiles, GlLegality, ::testing::Values(&profiles::geforce2, &profiles::nv2a), profile_name);

}  // namespace
}  // namespace ninebit::gl
