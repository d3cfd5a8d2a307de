// Whatever legal value is set is what a get returns, and nothing else moves.
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "combiner_tests/language/gl_test_support.h"

namespace ninebit::gl {
namespace {

using Color = std::array<GLfloat, 4>;

// The arguments that were set last; independent of CombinerState.
struct Model {
  std::array<std::array<std::array<InputArguments, 4>, 2>, 8> inputs{};
  std::array<std::array<OutputArguments, 2>, 8> outputs{};
  std::array<std::array<Color, 2>, 8> stage_constants{};
  std::array<InputArguments, 7> final_inputs{};
  std::array<Color, 2> constants{};
  GLint number = 1;
  GLint clamp = 1;
  bool enabled = false, per_stage = false;
};

class GlRoundTrip : public ::testing::TestWithParam<const HardwareProfile*> {
 protected:
  GlRoundTrip() : context_(*GetParam()), current_(context_) {
    for (int unit = 0; unit < GetParam()->texture_units; ++unit) {
      ordinary_.push_back(GL_TEXTURE0_ARB + static_cast<GLenum>(unit));
      writable_.push_back(GL_TEXTURE0_ARB + static_cast<GLenum>(unit));
    }
    for (std::size_t s = 0; s < stages(); ++s) {
      for (std::size_t p = 0; p < 2; ++p) {
        for (std::size_t v = 0; v < 4; ++v)
          model_.inputs[s][p][v] = get_general_input(stage(s), portion(p), variable(v));
        model_.outputs[s][p] = get_output(stage(s), portion(p));
      }
    }
    for (std::size_t v = 0; v < 7; ++v) model_.final_inputs[v] = get_final_input(variable(v));
  }

  std::size_t stages() const { return static_cast<std::size_t>(GetParam()->general_combiners.value); }
  static GLenum stage(std::size_t i) { return GL_COMBINER0_NV + static_cast<GLenum>(i); }
  static GLenum portion(std::size_t i) { return i == 0 ? GL_RGB : GL_ALPHA; }
  static GLenum variable(std::size_t i) { return GL_VARIABLE_A_NV + static_cast<GLenum>(i); }
  static GLenum constant(std::size_t i) { return i == 0 ? GL_CONSTANT_COLOR0_NV : GL_CONSTANT_COLOR1_NV; }

  // Modulo and not a distribution, so that every standard library draws the same.
  std::size_t pick(std::size_t below) { return random_() % below; }
  bool coin() { return pick(2) == 0; }
  template <class T>
  T one_of(const std::vector<T>& values) {
    return values[pick(values.size())];
  }
  Color color() {
    Color c{};
    for (GLfloat& component : c) component = static_cast<GLfloat>(pick(65536)) / 65535.0F;
    return c;
  }

  void set_general_input() {
    const std::size_t s = pick(stages()), p = pick(2), v = pick(4);
    InputArguments in{one_of(ordinary_), GL_UNSIGNED_IDENTITY_NV + static_cast<GLenum>(pick(8)),
                      coin()   ? GL_ALPHA
                      : p == 0 ? GL_RGB
                               : GL_BLUE};
    if (in.usage != GL_ALPHA && pick(8) == 0) in.input = GL_FOG;
    glCombinerInputNV(stage(s), portion(p), variable(v), in.input, in.mapping, in.usage);
    model_.inputs[s][p][v] = in;
  }

  void set_final_input() {
    const std::size_t v = pick(7);
    InputArguments in{one_of(ordinary_), coin() ? GL_UNSIGNED_IDENTITY_NV : GL_UNSIGNED_INVERT_NV,
                      coin()   ? GL_ALPHA
                      : v == 6 ? GL_BLUE
                               : GL_RGB};
    if (pick(8) == 0) in.input = GL_FOG;
    if (v <= 3 && in.usage == GL_RGB && pick(4) == 0) in.input = GL_E_TIMES_F_NV;
    if (v >= 1 && v <= 3 && in.usage == GL_RGB && pick(4) == 0) in.input = GL_SPARE0_PLUS_SECONDARY_COLOR_NV;
    glFinalCombinerInputNV(variable(v), in.input, in.mapping, in.usage);
    model_.final_inputs[v] = in;
  }

  void set_output() {
    const std::size_t s = pick(stages()), p = pick(2);
    OutputArguments o{GL_DISCARD_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE, GL_FALSE, GL_FALSE, GL_FALSE};
    std::vector<GLenum> left = writable_;
    for (GLenum* const destination : {&o.ab, &o.cd, &o.sum}) {
      if (coin()) continue;
      const std::size_t i = pick(left.size());
      *destination = left[i];
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
    }
    o.bias = coin() ? GL_NONE : GL_BIAS_BY_NEGATIVE_ONE_HALF_NV;
    o.scale = coin() ? GL_NONE : GL_SCALE_BY_TWO_NV;
    if (o.bias == GL_NONE && coin()) o.scale = coin() ? GL_SCALE_BY_FOUR_NV : GL_SCALE_BY_ONE_HALF_NV;
    const auto flag = [&] { return coin() ? GL_TRUE : GL_FALSE; };
    if (p == 0) {
      o.ab_dot = flag();
      o.cd_dot = flag();
    }
    o.mux = flag();
    glCombinerOutputNV(stage(s), portion(p), o.ab, o.cd, o.sum, o.scale, o.bias, o.ab_dot, o.cd_dot, o.mux);
    model_.outputs[s][p] = o;
  }

  void set_parameter() {
    const std::size_t i = pick(2);
    switch (pick(5)) {
      case 0:
        model_.number = 1 + static_cast<GLint>(pick(stages()));
        if (coin()) {
          glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, model_.number);
        } else {
          const auto number = static_cast<GLfloat>(model_.number);
          glCombinerParameterfvNV(GL_NUM_GENERAL_COMBINERS_NV, &number);
        }
        break;
      case 1: {
        const GLint clamp = static_cast<GLint>(pick(3)) - 1;
        model_.clamp = clamp != 0 ? 1 : 0;
        coin() ? glCombinerParameterivNV(GL_COLOR_SUM_CLAMP_NV, &clamp)
               : glCombinerParameterfNV(GL_COLOR_SUM_CLAMP_NV, static_cast<GLfloat>(clamp) * 0.25F);
        break;
      }
      case 2:
        model_.constants[i] = color();
        glCombinerParameterfvNV(constant(i), model_.constants[i].data());
        break;
      case 3:
        model_.enabled = coin();
        (model_.enabled ? glEnable : glDisable)(GL_REGISTER_COMBINERS_NV);
        break;
      default:
        if (!GetParam()->per_stage_constants) break;
        if (coin()) {
          model_.per_stage = !model_.per_stage;
          (model_.per_stage ? glEnable : glDisable)(GL_PER_STAGE_CONSTANTS_NV);
        } else {
          const std::size_t s = pick(stages());
          model_.stage_constants[s][i] = color();
          glCombinerStageParameterfvNV(stage(s), constant(i), model_.stage_constants[s][i].data());
        }
    }
  }

  void check_all() {
    ASSERT_EQ(glGetError(), GL_NO_ERROR);
    for (std::size_t s = 0; s < stages(); ++s) {
      for (std::size_t p = 0; p < 2; ++p) {
        for (std::size_t v = 0; v < 4; ++v) {
          ASSERT_EQ(get_general_input(stage(s), portion(p), variable(v)), model_.inputs[s][p][v]);
        }
        ASSERT_EQ(get_output(stage(s), portion(p)), model_.outputs[s][p]);
      }
      for (std::size_t i = 0; i < 2 && GetParam()->per_stage_constants; ++i) {
        Color c{};
        glGetCombinerStageParameterfvNV(stage(s), constant(i), c.data());
        ASSERT_EQ(c, model_.stage_constants[s][i]);
      }
    }
    for (std::size_t v = 0; v < 7; ++v) ASSERT_EQ(get_final_input(variable(v)), model_.final_inputs[v]);
    for (std::size_t i = 0; i < 2; ++i) {
      Color c{};
      glGetFloatv(constant(i), c.data());
      ASSERT_EQ(c, model_.constants[i]);
    }
    ASSERT_EQ(get_integer(GL_NUM_GENERAL_COMBINERS_NV), model_.number);
    ASSERT_EQ(get_integer(GL_COLOR_SUM_CLAMP_NV), model_.clamp);
    ASSERT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV) == GL_TRUE, model_.enabled);
    if (GetParam()->per_stage_constants) {
      ASSERT_EQ(glIsEnabled(GL_PER_STAGE_CONSTANTS_NV) == GL_TRUE, model_.per_stage);
    }
    ASSERT_EQ(glGetError(), GL_NO_ERROR);
  }

  Context context_;
  Model model_;

 private:
  CurrentContext current_;
  std::vector<GLenum> ordinary_{GL_ZERO,      GL_CONSTANT_COLOR0_NV, GL_CONSTANT_COLOR1_NV, GL_PRIMARY_COLOR_NV,
                                GL_SPARE0_NV, GL_SPARE1_NV,          GL_SECONDARY_COLOR_NV};
  std::vector<GLenum> writable_{GL_PRIMARY_COLOR_NV, GL_SECONDARY_COLOR_NV, GL_SPARE0_NV, GL_SPARE1_NV};
  std::mt19937 random_{20260112};
};

TEST_P(GlRoundTrip, OfRandomLegalCommands) {
  const CombinerState defaults;
  for (int i = 0; i < 6000; ++i) {
    SCOPED_TRACE("command " + std::to_string(i));
    switch (pick(4)) {
      case 0:
        set_general_input();
        break;
      case 1:
        set_final_input();
        break;
      case 2:
        set_output();
        break;
      default:
        set_parameter();
    }
    ASSERT_NO_FATAL_FAILURE(check_all());
    ASSERT_TRUE(validate(context_.state(), context_.profile()).empty());
  }
  EXPECT_FALSE(context_.state() == defaults);
}

INSTANTIATE_TEST_SUITE_P(Profiles, GlRoundTrip, ::testing::Values(&profiles::geforce2, &profiles::nv2a), profile_name);

class GlColors : public GlNv2aTest {};

TEST_F(GlColors, AreClampedAsFloats) {
  constexpr GLfloat inf = std::numeric_limits<GLfloat>::infinity();
  const std::array<Color, 2> given{Color{-0.5F, 1.5F, 0.3F, std::numeric_limits<GLfloat>::quiet_NaN()},
                                   Color{-inf, inf, 0.0F, 1.0F}};
  const std::array<Color, 2> kept{Color{0.0F, 1.0F, 0.3F, 0.0F}, Color{0.0F, 1.0F, 0.0F, 1.0F}};
  for (std::size_t i = 0; i < 2; ++i) {
    Color global{}, stage{};
    glCombinerParameterfvNV(GL_CONSTANT_COLOR1_NV, given[i].data());
    glGetFloatv(GL_CONSTANT_COLOR1_NV, global.data());
    EXPECT_EQ(global, kept[i]);
    glCombinerStageParameterfvNV(GL_COMBINER5_NV, GL_CONSTANT_COLOR0_NV, given[i].data());
    glGetCombinerStageParameterfvNV(GL_COMBINER5_NV, GL_CONSTANT_COLOR0_NV, stage.data());
    EXPECT_EQ(stage, kept[i]);
  }
  EXPECT_EQ(context.state().general[5].constant0, kept[1]);
  EXPECT_EQ(context.state().general[5].constant1, Color{}) << "the other constant moved";
  EXPECT_EQ(context.state().constant0, Color{}) << "the global constant moved";
}

TEST_F(GlColors, AreLinearAsIntegers) {
  constexpr GLint most = std::numeric_limits<GLint>::max(), least = std::numeric_limits<GLint>::min();
  const std::array<GLint, 4> given{most, 0, least, 1 << 30};
  glCombinerParameterivNV(GL_CONSTANT_COLOR0_NV, given.data());
  Color floats{};
  glGetFloatv(GL_CONSTANT_COLOR0_NV, floats.data());
  EXPECT_EQ(floats[0], 1.0F);
  EXPECT_EQ(floats[1], static_cast<GLfloat>(1.0 / 4294967295.0)) << "an integer zero is not quite zero in GL";
  EXPECT_EQ(floats[2], 0.0F);
  EXPECT_NEAR(floats[3], 0.5F, 1e-7);
  std::array<GLint, 4> back{};
  glGetIntegerv(GL_CONSTANT_COLOR0_NV, back.data());
  EXPECT_EQ(back[0], most);
  EXPECT_EQ(back[1], 0);
  EXPECT_EQ(back[2], 0);
  EXPECT_NEAR(back[3], 1 << 30, 1 << 7) << "a float holds 24 of 31 bits";
}

}  // namespace
}  // namespace ninebit::gl
