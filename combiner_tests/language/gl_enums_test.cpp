#include "ninebit/language/gl_enums.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

namespace ninebit::gl {
namespace {

// The registry gives both extensions one run of numbers; 0x8533 and 0x8534 belong to others.
TEST(GlEnums, StandAtTheRegistrysNumbers) {
  constexpr std::array from_8522{GL_REGISTER_COMBINERS_NV,
                                 GL_VARIABLE_A_NV,
                                 GL_VARIABLE_B_NV,
                                 GL_VARIABLE_C_NV,
                                 GL_VARIABLE_D_NV,
                                 GL_VARIABLE_E_NV,
                                 GL_VARIABLE_F_NV,
                                 GL_VARIABLE_G_NV,
                                 GL_CONSTANT_COLOR0_NV,
                                 GL_CONSTANT_COLOR1_NV,
                                 GL_PRIMARY_COLOR_NV,
                                 GL_SECONDARY_COLOR_NV,
                                 GL_SPARE0_NV,
                                 GL_SPARE1_NV,
                                 GL_DISCARD_NV,
                                 GL_E_TIMES_F_NV,
                                 GL_SPARE0_PLUS_SECONDARY_COLOR_NV};
  for (GLenum i = 0; i < from_8522.size(); ++i) EXPECT_EQ(from_8522[i], 0x8522U + i);
  constexpr std::array from_8535{GL_PER_STAGE_CONSTANTS_NV,
                                 GL_UNSIGNED_IDENTITY_NV,
                                 GL_UNSIGNED_INVERT_NV,
                                 GL_EXPAND_NORMAL_NV,
                                 GL_EXPAND_NEGATE_NV,
                                 GL_HALF_BIAS_NORMAL_NV,
                                 GL_HALF_BIAS_NEGATE_NV,
                                 GL_SIGNED_IDENTITY_NV,
                                 GL_SIGNED_NEGATE_NV,
                                 GL_SCALE_BY_TWO_NV,
                                 GL_SCALE_BY_FOUR_NV,
                                 GL_SCALE_BY_ONE_HALF_NV,
                                 GL_BIAS_BY_NEGATIVE_ONE_HALF_NV,
                                 GL_COMBINER_INPUT_NV,
                                 GL_COMBINER_MAPPING_NV,
                                 GL_COMBINER_COMPONENT_USAGE_NV,
                                 GL_COMBINER_AB_DOT_PRODUCT_NV,
                                 GL_COMBINER_CD_DOT_PRODUCT_NV,
                                 GL_COMBINER_MUX_SUM_NV,
                                 GL_COMBINER_SCALE_NV,
                                 GL_COMBINER_BIAS_NV,
                                 GL_COMBINER_AB_OUTPUT_NV,
                                 GL_COMBINER_CD_OUTPUT_NV,
                                 GL_COMBINER_SUM_OUTPUT_NV,
                                 GL_MAX_GENERAL_COMBINERS_NV,
                                 GL_NUM_GENERAL_COMBINERS_NV,
                                 GL_COLOR_SUM_CLAMP_NV,
                                 GL_COMBINER0_NV,
                                 GL_COMBINER1_NV,
                                 GL_COMBINER2_NV,
                                 GL_COMBINER3_NV,
                                 GL_COMBINER4_NV,
                                 GL_COMBINER5_NV,
                                 GL_COMBINER6_NV,
                                 GL_COMBINER7_NV};
  for (GLenum i = 0; i < from_8535.size(); ++i) EXPECT_EQ(from_8535[i], 0x8535U + i);
}

// All enumerants below 0x10000 that `to` knows, each of which must come back from its word.
template <class To>
std::set<GLenum> words(To to) {
  std::set<GLenum> found;
  for (GLenum value = 0; value < 0x10000; ++value) {
    const auto word = to(value);
    if (!word) continue;
    EXPECT_EQ(to_enum(*word), value);
    found.insert(value);
  }
  return found;
}

TEST(GlEnums, TranslateThereAndBackAndKnowNothingElse) {
  using Set = std::set<GLenum>;
  EXPECT_EQ(words(to_register), (Set{0, 0x0B60, 0x84C0, 0x84C1, 0x84C2, 0x84C3, 0x852A, 0x852B, 0x852C, 0x852D, 0x852E,
                                     0x852F, 0x8530, 0x8531, 0x8532}));
  EXPECT_EQ(words(to_input_mapping), (Set{0x8536, 0x8537, 0x8538, 0x8539, 0x853A, 0x853B, 0x853C, 0x853D}));
  EXPECT_EQ(words(to_component_usage), (Set{GL_RGB, GL_ALPHA, GL_BLUE}));
  EXPECT_EQ(words(to_scale), (Set{0, 0x853E, 0x853F, 0x8540}));
  EXPECT_EQ(words(to_bias), (Set{0, 0x8541}));
  EXPECT_EQ(words(to_portion), (Set{GL_RGB, GL_ALPHA}));
  EXPECT_EQ(words(to_variable), (Set{0x8523, 0x8524, 0x8525, 0x8526, 0x8527, 0x8528, 0x8529}));
}

TEST(GlEnums, NameTheWordsTheyMean) {
  EXPECT_EQ(to_register(GL_ZERO), Register::zero);
  EXPECT_EQ(to_register(GL_CONSTANT_COLOR0_NV), Register::constant0);
  EXPECT_EQ(to_register(GL_CONSTANT_COLOR1_NV), Register::constant1);
  EXPECT_EQ(to_register(GL_FOG), Register::fog);
  EXPECT_EQ(to_register(GL_PRIMARY_COLOR_NV), Register::primary);
  EXPECT_EQ(to_register(GL_SECONDARY_COLOR_NV), Register::secondary);
  EXPECT_EQ(to_register(GL_SPARE0_NV), Register::spare0);
  EXPECT_EQ(to_register(GL_SPARE1_NV), Register::spare1);
  EXPECT_EQ(to_register(GL_DISCARD_NV), Register::discard);
  EXPECT_EQ(to_register(GL_E_TIMES_F_NV), Register::e_times_f);
  EXPECT_EQ(to_register(GL_SPARE0_PLUS_SECONDARY_COLOR_NV), Register::spare0_plus_secondary);
  for (int unit = 0; unit < 4; ++unit) {
    EXPECT_EQ(to_register(GL_TEXTURE0_ARB + static_cast<GLenum>(unit)), texture_register(unit));
  }
  EXPECT_EQ(to_input_mapping(GL_EXPAND_NEGATE_NV), InputMapping::expand_negate);
  EXPECT_EQ(to_input_mapping(GL_HALF_BIAS_NORMAL_NV), InputMapping::half_bias_normal);
  EXPECT_EQ(to_input_mapping(GL_SIGNED_NEGATE_NV), InputMapping::signed_negate);
  EXPECT_EQ(to_component_usage(GL_BLUE), ComponentUsage::blue);
  EXPECT_EQ(to_scale(GL_SCALE_BY_FOUR_NV), Scale::by_four);
  EXPECT_EQ(to_scale(GL_SCALE_BY_ONE_HALF_NV), Scale::by_one_half);
  EXPECT_EQ(to_bias(GL_BIAS_BY_NEGATIVE_ONE_HALF_NV), Bias::by_negative_one_half);
  EXPECT_EQ(to_portion(GL_ALPHA), PortionName::alpha);
  EXPECT_EQ(to_variable(GL_VARIABLE_G_NV), Variable::g);
}

TEST(GlEnums, CountEightStages) {
  for (int i = 0; i < 8; ++i) EXPECT_EQ(to_stage(GL_COMBINER0_NV + static_cast<GLenum>(i)), i);
  EXPECT_EQ(to_stage(GL_COMBINER0_NV - 1), std::nullopt);
  EXPECT_EQ(to_stage(GL_COMBINER7_NV + 1), std::nullopt);
}

// GL programs pass GL_FALSE for "none" and for zero, and enumerants to integers.
TEST(GlEnums, ConvertAsTheMacrosDo) {
  static_assert(GL_FALSE == GL_NONE && GL_FALSE == GL_ZERO);
  const GLenum none = GL_FALSE;
  const GLint integer = GL_TRUE;
  const GLfloat real = GL_TRUE;
  EXPECT_EQ(to_scale(none), Scale::none);
  EXPECT_EQ(static_cast<GLfloat>(integer), real);
}

}  // namespace
}  // namespace ninebit::gl
