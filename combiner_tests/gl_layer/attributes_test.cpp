// glPushAttrib and glPopAttrib: all state of the combiners and of texture shaders is in GL_TEXTURE_BIT, and what
// glEnable sets is in GL_ENABLE_BIT, too.
#include <gtest/gtest.h>

#include "combiner_tests/gl_layer/combiner_commands.h"
#include "combiner_tests/gl_layer/pictures.h"

namespace ninebit::test {
namespace {

// What can be read of the layer's state, texture shaders and all.
std::vector<GLfloat> whole_state() {
  std::vector<GLfloat> values = read_state(kLayerFunctions, profiles::nv2a);
  values.push_back(glIsEnabled(GL_TEXTURE_SHADER_NV));
  for (GLenum unit = 0; unit < 4; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    GLfloat got[4]{};
    glGetTexEnvfv(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, got);
    values.push_back(got[0]);
    glGetTexEnvfv(GL_TEXTURE_SHADER_NV, GL_CULL_MODES_NV, got);
    values.insert(values.end(), got, got + 4);
  }
  glActiveTexture(GL_TEXTURE0);
  return values;
}

std::array<GLboolean, 3> enables() {
  return {glIsEnabled(GL_REGISTER_COMBINERS_NV), glIsEnabled(GL_PER_STAGE_CONSTANTS_NV),
          glIsEnabled(GL_TEXTURE_SHADER_NV)};
}

void change_everything(Random& random) {
  for (int i = 0; i < 60; ++i) execute(kLayerFunctions, random_command(random, profiles::nv2a, true));
  for (const int cap : {GL_REGISTER_COMBINERS_NV, GL_PER_STAGE_CONSTANTS_NV, GL_TEXTURE_SHADER_NV}) {
    (random.one_in(2) ? glEnable : glDisable)(static_cast<GLenum>(cap));
  }
  for (GLenum unit = 0; unit < 4; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV,
              random.pick<GLint>({GL_NONE, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_PASS_THROUGH_NV, GL_CULL_FRAGMENT_NV}));
    const GLint modes[]{random.pick<GLint>({GL_LESS, GL_GEQUAL}), GL_LESS, GL_GEQUAL, GL_LESS};
    glTexEnviv(GL_TEXTURE_SHADER_NV, GL_CULL_MODES_NV, modes);
  }
  glActiveTexture(GL_TEXTURE0);
  while (glGetError() != kNoError) {
  }
}

TEST(LayerAttributes, Groups) {
  NINEBIT_GL_CONTEXT(context);
  std::array<bool, 2> restored_differs{};
  for (std::uint64_t round = 0; round < 40; ++round) {
    for (const GLbitfield mask :
         {GLbitfield{GL_TEXTURE_BIT}, GLbitfield{GL_ENABLE_BIT}, GLbitfield{GL_ALL_ATTRIB_BITS},
          GLbitfield{GL_CURRENT_BIT | GL_FOG_BIT}, GLbitfield{0}, GLbitfield{GL_ENABLE_BIT | GL_TEXTURE_BIT}}) {
      Random random(mask, round);
      change_everything(random);
      const auto before = whole_state();
      const auto enabled_before = enables();
      glPushAttrib(mask);
      EXPECT_EQ(whole_state(), before) << "a push changes the state";
      change_everything(random);
      const auto between = whole_state();
      const auto enabled_between = enables();
      glPopAttrib();
      const bool texture = (mask & GL_TEXTURE_BIT) != 0, enable = (mask & GL_ENABLE_BIT) != 0;
      EXPECT_EQ(enables(), texture || enable ? enabled_before : enabled_between) << mask << ", round " << round;
      if (texture) {
        EXPECT_EQ(whole_state(), before) << mask << ", round " << round;
      } else if (!enable) {
        EXPECT_EQ(whole_state(), between) << mask << ", round " << round;
      } else {
        // Put the enables back: nothing else may differ.
        const int caps[]{GL_REGISTER_COMBINERS_NV, GL_PER_STAGE_CONSTANTS_NV, GL_TEXTURE_SHADER_NV};
        for (std::size_t i = 0; i < 3; ++i) {
          (enabled_between[i] != GL_FALSE ? glEnable : glDisable)(static_cast<GLenum>(caps[i]));
        }
        EXPECT_EQ(whole_state(), between) << mask << ", round " << round;
      }
      restored_differs[0] = restored_differs[0] || before != between;
      restored_differs[1] = restored_differs[1] || enabled_before != enabled_between;
    }
  }
  EXPECT_TRUE(restored_differs[0] && restored_differs[1]);
}

TEST(LayerAttributes, Nested) {
  NINEBIT_GL_CONTEXT(context);
  constexpr GLbitfield masks[]{GL_TEXTURE_BIT, GL_FOG_BIT,  GL_ALL_ATTRIB_BITS,
                               GL_TEXTURE_BIT, GL_LIST_BIT, GL_TEXTURE_BIT};
  std::vector<std::vector<GLfloat>> states;
  Random random(5);
  for (const GLbitfield mask : masks) {
    change_everything(random);
    states.push_back(whole_state());
    glPushAttrib(mask);
  }
  for (std::size_t i = 6; i-- > 0;) {
    change_everything(random);
    const auto now = whole_state();
    glPopAttrib();
    EXPECT_EQ(whole_state(), (masks[i] & GL_TEXTURE_BIT) != 0 ? states[i] : now) << "level " << i;
  }
}

TEST(LayerAttributes, OverflowAndUnderflow) {
  NINEBIT_GL_CONTEXT(context);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
  glPopAttrib();
  EXPECT_EQ(glGetError(), kStackUnderflow);
  const GLint deepest = integer_of(GL_MAX_ATTRIB_STACK_DEPTH);
  for (GLint i = 0; i < deepest; ++i) {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1 + i % 8);
    glPushAttrib(GL_TEXTURE_BIT);
  }
  EXPECT_EQ(glGetError(), kNoError);
  for (int i = 0; i < 3; ++i) {
    glPushAttrib(GL_TEXTURE_BIT);
    EXPECT_EQ(glGetError(), kStackOverflow);
  }
  for (GLint i = deepest; i-- > 0;) {
    glPopAttrib();
    EXPECT_EQ(integer_of(GL_NUM_GENERAL_COMBINERS_NV), 1 + i % 8) << i;
  }
  EXPECT_EQ(glGetError(), kNoError);
  glPopAttrib();
  EXPECT_EQ(glGetError(), kStackUnderflow);
}

// The first command of the extensions comes after the push: a pop brings the defaults back.
TEST(LayerAttributes, PushedBeforeTheFirstCommand) {
  for (const GLbitfield mask : {GLbitfield{GL_TEXTURE_BIT}, GLbitfield{GL_ENABLE_BIT}, GLbitfield{GL_FOG_BIT}}) {
    NINEBIT_GL_CONTEXT(context);
    glPushAttrib(mask);
    const GLfloat white[]{1, 1, 1, 1};
    glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, white);
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 4);
    glEnable(GL_REGISTER_COMBINERS_NV);
    glEnable(GL_TEXTURE_SHADER_NV);
    const auto between = whole_state();
    glPopAttrib();
    EXPECT_EQ(integer_of(GL_NUM_GENERAL_COMBINERS_NV), mask == GL_TEXTURE_BIT ? 1 : 4);
    EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), mask == GL_FOG_BIT ? GL_TRUE : GL_FALSE);
    EXPECT_EQ(glIsEnabled(GL_TEXTURE_SHADER_NV), mask == GL_FOG_BIT ? GL_TRUE : GL_FALSE);
    EXPECT_EQ(whole_state() == between, mask == GL_FOG_BIT);
  }
}

// What is drawn follows the state that a pop restores.
TEST(LayerAttributes, ThePictureFollows) {
  NINEBIT_GL_CONTEXT(context);
  show_constant({1, 0, 0, 1});
  glPushAttrib(GL_TEXTURE_BIT);
  show_constant({0, 0, 1, 1});
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 0, 255, 255}));
  glPopAttrib();
  EXPECT_EQ(drawn_pixel(), (Pixel{255, 0, 0, 255}));
  glPushAttrib(GL_ENABLE_BIT);
  glDisable(GL_REGISTER_COMBINERS_NV);
  glColor4ub(0, 255, 0, 255);
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 255, 0, 255}));
  glPopAttrib();
  EXPECT_EQ(drawn_pixel(), (Pixel{255, 0, 0, 255}));
}

// Between glBegin and glEnd neither command does anything.
TEST(LayerAttributes, BetweenBeginAndEnd) {
  NINEBIT_GL_CONTEXT(context);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
  glPushAttrib(GL_TEXTURE_BIT);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 3);
  glBegin(GL_POINTS);
  glPopAttrib();
  glPushAttrib(GL_TEXTURE_BIT);
  glEnd();
  EXPECT_EQ(glGetError(), kInvalidOperation);
  EXPECT_EQ(integer_of(GL_NUM_GENERAL_COMBINERS_NV), 3);
  glPopAttrib();
  EXPECT_EQ(integer_of(GL_NUM_GENERAL_COMBINERS_NV), 2);
  glPopAttrib();
  EXPECT_EQ(glGetError(), kStackUnderflow);
}

}  // namespace
}  // namespace ninebit::test
