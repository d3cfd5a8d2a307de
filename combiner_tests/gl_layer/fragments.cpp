#include "combiner_tests/gl_layer/fragments.h"

#include "combiner_tests/combiner/random_state.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/numerics/fixed9.h"

namespace ninebit::test {
namespace {

std::uint8_t random_byte(Random& random) {
  if (random.one_in(4)) return random.pick<std::uint8_t>({0, 1, 63, 64, 126, 127, 128, 129, 254, 255});
  return random.byte();
}

Bytes4 random_bytes(Random& random) {
  return {random_byte(random), random_byte(random), random_byte(random), random_byte(random)};
}

// A fog coordinate that gives the factor's byte k with start 255 and end 0, whichever way the profile narrows.
float fog_coordinate(const HardwareProfile& profile, std::uint8_t k) {
  const bool up = profile.fog_byte.value == StageByte::nearest;
  return static_cast<float>(k) + (up || k == 255 ? 0.0F : 0.5F);
}

void upload_texture(const Fragments& fragments, std::size_t unit) {
  std::vector<Bytes4> texels;
  for (const FragmentInputs& in : fragments.inputs) texels.push_back(in.texture[unit]->value);
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, 1 + static_cast<GLuint>(unit));
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kPictureSize, kPictureSize, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
  use_nearest(GL_TEXTURE_2D);
  glEnable(GL_TEXTURE_2D);
}

void set_fog(const Fragments& fragments) {
  if (!fragments.fog) return glDisable(GL_FOG);
  glEnable(GL_FOG);
  glFogi(GL_FOG_MODE, GL_LINEAR);
  glFogi(GL_FOG_COORDINATE_SOURCE, GL_FOG_COORDINATE);
  glFogf(GL_FOG_START, 255.0F);
  glFogf(GL_FOG_END, 0.0F);
}

}  // namespace

std::string name_of_case(const ::testing::TestParamInfo<HardwareProfile>& profile) {
  std::string name(profile.param.name);
  std::erase(name, '-');
  return name;
}

CombinerState random_gl_state(Random& random, const HardwareProfile& profile) {
  CombinerState state = random_state(random, profile);
  state.mux_by_lowest_bit = state.color_sum_invert_spare0 = state.color_sum_invert_secondary = false;
  for (GeneralCombiner& general : state.general) {
    general.rgb.out.ab_blue_to_alpha = general.rgb.out.cd_blue_to_alpha = false;
  }
  return state;
}

Fragments random_fragments(Random& random, const HardwareProfile& profile) {
  Fragments fragments;
  fragments.fog = random.one_in(2);
  fragments.units = static_cast<std::size_t>(random.between(0, profile.texture_units));
  const std::array<std::uint8_t, 3> fog_color{random_byte(random), random_byte(random), random_byte(random)};
  for (FragmentInputs& in : fragments.inputs) {
    in.primary = random_bytes(random);
    in.secondary = random_bytes(random);
    in.secondary[3] = 255;  // OpenGL sets it (OpenGL 1.4, table 6.5)
    in.fog_color = fog_color;
    if (fragments.fog) in.fog_factor = random_byte(random);
    for (std::size_t u = 0; u < fragments.units; ++u) in.texture[u] = Texel{.value = random_bytes(random)};
  }
  return fragments;
}

std::vector<Pixel> draw(const Fragments& fragments, const HardwareProfile& profile) {
  for (std::size_t u = 0; u < 4; ++u) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(u));
    glDisable(GL_TEXTURE_2D);
    if (u < fragments.units) upload_texture(fragments, u);
  }
  set_fog(fragments);
  const auto& fog = fragments.inputs.front().fog_color;
  const GLfloat fog_color[]{static_cast<float>(fog[0]) / 255.0F, static_cast<float>(fog[1]) / 255.0F,
                            static_cast<float>(fog[2]) / 255.0F, 0.25F};
  glFogfv(GL_FOG_COLOR, fog_color);
  glBegin(GL_POINTS);
  for (std::size_t i = 0; i < kFragments; ++i) {
    const FragmentInputs& in = fragments.inputs[i];
    const float x = (static_cast<float>(i % kPictureSize) + 0.5F) / kPictureSize;
    const float y = (static_cast<float>(i / kPictureSize) + 0.5F) / kPictureSize;
    glColor4ubv(in.primary.data());
    glSecondaryColor3ubv(in.secondary.data());
    if (in.fog_factor) glFogCoordf(fog_coordinate(profile, *in.fog_factor));
    for (GLenum u = 0; u < 4; ++u) glMultiTexCoord2f(GL_TEXTURE0 + u, x, y);
    glVertex2f(2.0F * x - 1.0F, 2.0F * y - 1.0F);
  }
  glEnd();
  return read_picture();
}

std::vector<Pixel> compute(const Program& program, const HardwareProfile& profile, const Fragments& fragments) {
  std::vector<Pixel> picture;
  for (const FragmentInputs& in : fragments.inputs) {
    const Rgba9 codes = evaluate(program, initial_registers(profile, in));
    picture.push_back({to_byte(profile, codes[0]), to_byte(profile, codes[1]), to_byte(profile, codes[2]),
                       to_byte(profile, codes[3])});
  }
  return picture;
}

}  // namespace ninebit::test
