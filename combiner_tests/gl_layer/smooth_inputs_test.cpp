// Colours, fog and texels that the driver interpolates and filters. With NINEBIT_GL_WRITE_INPUTS the layer's shaders
// write these inputs as floats; the colour must be what the library computes for the same ones.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/gl_layer/fragments.h"
#include "combiner_tests/gl_layer/pictures.h"
#include "ninebit/numerics/fixed9.h"

namespace ninebit::test {
namespace {

constexpr int kWrittenSide = 24;
constexpr std::size_t kWrittenTargets = 8;
using Floats4 = std::array<float, 4>;

// The colour and the seven inputs of each pixel.
using WrittenInputs = std::array<std::vector<Floats4>, kWrittenTargets>;

// One framebuffer with eight targets of floats, current.
void make_float_targets() {
  GLuint framebuffer = 0, textures[kWrittenTargets]{};
  GLenum buffers[kWrittenTargets]{};
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glGenTextures(kWrittenTargets, textures);
  for (GLenum i = 0; i < kWrittenTargets; ++i) {
    buffers[i] = GL_COLOR_ATTACHMENT0 + i;
    glBindTexture(GL_TEXTURE_2D, textures[i]);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kWrittenSide, kWrittenSide, 0, GL_RGBA, GL_FLOAT, nullptr);
    glFramebufferTexture2D(GL_FRAMEBUFFER, buffers[i], GL_TEXTURE_2D, textures[i], 0);
  }
  glDrawBuffers(kWrittenTargets, buffers);
  glViewport(0, 0, kWrittenSide, kWrittenSide);
  ASSERT_EQ(glCheckFramebufferStatus(GL_FRAMEBUFFER), static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
}

WrittenInputs read_targets() {
  WrittenInputs written;
  for (GLenum i = 0; i < kWrittenTargets; ++i) {
    written[i].resize(static_cast<std::size_t>(kWrittenSide) * kWrittenSide);
    glReadBuffer(GL_COLOR_ATTACHMENT0 + i);
    glReadPixels(0, 0, kWrittenSide, kWrittenSide, GL_RGBA, GL_FLOAT, written[i].data());
  }
  return written;
}

void set_textures(Random& random, std::size_t units) {
  for (std::size_t u = 0; u < units; ++u) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(u));
    glBindTexture(GL_TEXTURE_2D, 100 + static_cast<GLuint>(u));
    // Floats, as a driver may filter bytes in steps of 1/255.
    std::array<Floats4, 64> texels{};
    for (Floats4& texel : texels) {
      for (float& component : texel) component = random.real_f(-0.1, 1.1);
    }
    const GLint internal = u == 1 ? GL_RGBA8 : GL_RGBA32F;
    glTexImage2D(GL_TEXTURE_2D, 0, internal, 8, 8, 0, GL_RGBA, GL_FLOAT, texels.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glEnable(GL_TEXTURE_2D);
  }
}

// A quadrilateral in perspective over the whole picture, with other colours, coordinates and fog at each corner.
void draw_in_perspective(Random& random) {
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glFrustum(-1, 1, -1, 1, 1, 20);
  draw_corners([&](float x, float y) {
    const float depth = random.real_f(1.1, 8.0);
    glColor4f(random.real_f(0, 1), random.real_f(0, 1), random.real_f(0, 1), random.real_f(0, 1));
    glSecondaryColor3f(random.real_f(0, 1), random.real_f(0, 1), random.real_f(0, 1));
    glFogCoordf(random.real_f(0, 2));
    for (GLenum u = 0; u < 4; ++u) {
      glMultiTexCoord4f(GL_TEXTURE0 + u, random.real_f(-1, 2), random.real_f(-1, 2), 0, random.real_f(0.5, 2));
    }
    glVertex3f(1.5F * x * depth, 1.5F * y * depth, -depth);
  });
}

std::uint8_t byte_of(float value) {
  const float clamped = std::min(std::max(value, 0.0F), 1.0F);
  return static_cast<std::uint8_t>(std::floor(clamped * 255.0F + 0.5F));
}

Bytes4 bytes_of(const Floats4& v) {
  return {byte_of(v[0]), byte_of(v[1]), byte_of(v[2]), byte_of(v[3])};
}

std::uint8_t fog_byte(const HardwareProfile& profile, float factor) {
  if (profile.fog_byte.value == StageByte::nearest) return byte_of(factor);
  const int n = static_cast<int>(std::min(std::max(factor, 0.0F) * 4096.0F, 4095.0F));
  return static_cast<std::uint8_t>(255 * (n + 1) / 4096);
}

FragmentInputs inputs_of(const WrittenInputs& written, std::size_t pixel, const HardwareProfile& profile, bool fog,
                         std::size_t units) {
  FragmentInputs in;
  in.primary = bytes_of(written[1][pixel]);
  in.secondary = bytes_of(written[2][pixel]);
  const Bytes4 color = bytes_of(written[3][pixel]);
  in.fog_color = {color[0], color[1], color[2]};
  if (fog) in.fog_factor = fog_byte(profile, written[3][pixel][3]);
  for (std::size_t u = 0; u < units; ++u) in.texture[u] = Texel{.value = bytes_of(written[4 + u][pixel])};
  return in;
}

class LayerSmoothInputs : public ::testing::TestWithParam<HardwareProfile> {};

TEST_P(LayerSmoothInputs, TheColorIsTheLibrarysForTheWrittenInputs) {
  const HardwareProfile& profile = GetParam();
  setenv("NINEBIT_GL_WRITE_INPUTS", "1", 1);
  std::string why_not;
  const auto context = GlContext::make(why_not, profile);
  unsetenv("NINEBIT_GL_WRITE_INPUTS");
  if (context == nullptr) GTEST_SKIP() << why_not;
  make_float_targets();
  const GLfloat fog_color[]{0.3F, 0.61F, 0.12F, 0.9F};
  glFogfv(GL_FOG_COLOR, fog_color);
  glFogi(GL_FOG_COORDINATE_SOURCE, GL_FOG_COORDINATE);
  std::set<Bytes4> colors;
  std::set<float> primaries, texels, factors;
  for (std::uint64_t i = 0; i < 12; ++i) {
    Random random(20010227, i);
    const CombinerState state = random_gl_state(random, profile);
    const auto program = compile(state, profile);
    ASSERT_TRUE(program) << program.error().message;
    set_combiners(state, profile);
    const bool fog = i % 4 != 3;
    (fog ? glEnable : glDisable)(GL_FOG);
    glFogi(GL_FOG_MODE, random.pick<GLint>({GL_LINEAR, GL_EXP, GL_EXP2}));
    const auto units = static_cast<std::size_t>(profile.texture_units.value);
    set_textures(random, units);
    draw_in_perspective(random);
    const WrittenInputs written = read_targets();
    ASSERT_EQ(glGetError(), kNoError);
    for (std::size_t p = 0; p < written[0].size(); ++p) {
      const Rgba9 codes = evaluate(*program, initial_registers(profile, inputs_of(written, p, profile, fog, units)));
      const Bytes4 expected{to_byte(profile, codes[0]), to_byte(profile, codes[1]), to_byte(profile, codes[2]),
                            to_byte(profile, codes[3])};
      ASSERT_EQ(bytes_of(written[0][p]), expected) << profile.name << ", program " << i << ", pixel " << p;
      colors.insert(expected);
      primaries.insert(written[1][p][0]);
      texels.insert(written[4][p][0]);
      if (fog) factors.insert(written[3][p][3]);
    }
  }
  EXPECT_GT(colors.size(), 1000U);
  EXPECT_GT(primaries.size(), 3000U) << "colours are not smooth";
  EXPECT_GT(texels.size(), 3000U) << "texels are not filtered";
  EXPECT_GT(factors.size(), 2000U) << "fog is not smooth";
}

// Without the variable the shaders write one colour.
TEST(LayerWrittenInputs, NothingIsWrittenWithoutTheVariable) {
  NINEBIT_GL_CONTEXT(context);
  make_float_targets();
  show_constant({0.2F, 0.4F, 0.6F, 0.8F});
  draw_square();
  const WrittenInputs written = read_targets();
  for (std::size_t i = 0; i < kWrittenTargets; ++i)
    EXPECT_EQ(bytes_of(written[i][100]), (Bytes4{51, 102, 153, 204})) << i;
}

INSTANTIATE_TEST_SUITE_P(Profiles, LayerSmoothInputs, ::testing::ValuesIn(integer_profiles()), name_of_case);

}  // namespace
}  // namespace ninebit::test
