// A context that is current for the length of a test.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "ninebit/language/gl_nv.h"

namespace ninebit::gl {

class GlTest : public ::testing::Test {
 protected:
  explicit GlTest(const HardwareProfile& profile = profiles::geforce2) : context(profile), current_(context) {}

  Context context;

 private:
  CurrentContext current_;
};

class GlNv2aTest : public GlTest {
 protected:
  GlNv2aTest() : GlTest(profiles::nv2a) {}
};

inline std::string profile_name(const ::testing::TestParamInfo<const HardwareProfile*>& test) {
  return std::string(test.param->name);
}

inline GLint get_integer(GLenum pname) {
  GLint value = -1;
  glGetIntegerv(pname, &value);
  return value;
}

struct InputArguments {
  GLenum input, mapping, usage;
  friend bool operator==(const InputArguments&, const InputArguments&) = default;
};

struct OutputArguments {
  GLenum ab, cd, sum, scale, bias;
  GLboolean ab_dot, cd_dot, mux;
  friend bool operator==(const OutputArguments&, const OutputArguments&) = default;
};

inline InputArguments get_general_input(GLenum stage, GLenum portion, GLenum variable) {
  const auto get = [&](GLenum pname) {
    GLint value = -1;
    GLfloat as_float = -1;
    glGetCombinerInputParameterivNV(stage, portion, variable, pname, &value);
    glGetCombinerInputParameterfvNV(stage, portion, variable, pname, &as_float);
    EXPECT_EQ(static_cast<GLfloat>(value), as_float);
    return static_cast<GLenum>(value);
  };
  return {get(GL_COMBINER_INPUT_NV), get(GL_COMBINER_MAPPING_NV), get(GL_COMBINER_COMPONENT_USAGE_NV)};
}

inline InputArguments get_final_input(GLenum variable) {
  const auto get = [&](GLenum pname) {
    GLint value = -1;
    GLfloat as_float = -1;
    glGetFinalCombinerInputParameterivNV(variable, pname, &value);
    glGetFinalCombinerInputParameterfvNV(variable, pname, &as_float);
    EXPECT_EQ(static_cast<GLfloat>(value), as_float);
    return static_cast<GLenum>(value);
  };
  return {get(GL_COMBINER_INPUT_NV), get(GL_COMBINER_MAPPING_NV), get(GL_COMBINER_COMPONENT_USAGE_NV)};
}

inline OutputArguments get_output(GLenum stage, GLenum portion) {
  const auto get = [&](GLenum pname) {
    GLint value = -1;
    GLfloat as_float = -1;
    glGetCombinerOutputParameterivNV(stage, portion, pname, &value);
    glGetCombinerOutputParameterfvNV(stage, portion, pname, &as_float);
    EXPECT_EQ(static_cast<GLfloat>(value), as_float);
    return static_cast<GLenum>(value);
  };
  const auto flag = [&](GLenum pname) { return static_cast<GLboolean>(get(pname)); };
  return {get(GL_COMBINER_AB_OUTPUT_NV),       get(GL_COMBINER_CD_OUTPUT_NV), get(GL_COMBINER_SUM_OUTPUT_NV),
          get(GL_COMBINER_SCALE_NV),           get(GL_COMBINER_BIAS_NV),      flag(GL_COMBINER_AB_DOT_PRODUCT_NV),
          flag(GL_COMBINER_CD_DOT_PRODUCT_NV), flag(GL_COMBINER_MUX_SUM_NV)};
}

}  // namespace ninebit::gl
