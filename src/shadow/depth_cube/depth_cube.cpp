// The technique's entry point: renders one frame.
#include "ninebit/shadow/depth_cube.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "ninebit/combiner/program.h"
#include "ninebit/language/gl_nv.h"
#include "src/frame/camera_frame.h"
#include "src/frame/drawn_passes.h"
#include "src/frame/packed_map.h"
#include "src/frame/shading.h"
#include "src/frame/views.h"
#include "src/shadow/depth_cube/depth_cube_renderer.h"

namespace ninebit {

namespace {

// The passes that mark shadow: 6 with 8 bits, 12 with 16 bits.
Status draw_comparisons(DepthCubeRenderer& renderer, PassTimer& timer, double& milliseconds) {
  const auto& comparisons = renderer.passes().comparisons;
  if (comparisons.empty()) {
    return timer.run("comparison", 0.5, milliseconds, [&] { return renderer.compare_floats(); });
  }
  const double share = 0.4 / static_cast<double>(6 * comparisons.size());
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    for (std::size_t face = 0; face < 6; ++face) {
      const double done = 0.5 + share * static_cast<double>(6 * i + face);
      Status drawn =
          timer.run(comparisons[i].name, done, milliseconds, [&] { return renderer.draw_comparison(i, face); });
      if (!drawn) return drawn;
    }
  }
  return {};
}

}  // namespace

Result<Rendering> render_depth_cube(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  std::optional<DepthCubeRenderer> renderer;
  PassTimer timer(progress);
  PassTimes times;
  double colors = 0.0;
  Status status =
      timer.make("ramps", 0.0, times.transform, renderer, [&] { return DepthCubeRenderer::make(scene, settings); });
  for (std::size_t face = 0; face < 6 && status; ++face) {
    status = timer.run("depth cube map", 0.1 + 0.05 * static_cast<double>(face), times.maps,
                       [&] { return renderer->draw_map(face); });
  }
  if (status) status = timer.run("depth", 0.4, times.camera, [&] { return renderer->draw_depth(); });
  if (status) status = draw_comparisons(*renderer, timer, times.compare);
  if (status && settings.light_facing) {
    status = timer.run("averted", 0.9, times.compare, [&] { return renderer->draw_averted(); });
  }
  // draw_lit_and_shadow takes the times of its passes itself.
  if (status) status = timer.run("colours", 0.9, colors, [&] { return renderer->draw_lit_and_shadow(); });
  if (status) status = renderer->add_evidence();
  if (!status) return status.error();
  renderer->finish();
  PassTimes& taken = renderer->rendering().times;
  times.lit = taken.lit;
  times.shadow = taken.shadow;
  taken = times;
  return std::move(renderer->rendering());
}

namespace {

using namespace gl;

// spare0 = texture0 · 1 + texture1 · (-1), of the portion's own components.
void subtract_textures(GLenum stage, GLenum portion) {
  glCombinerInputNV(stage, portion, GL_VARIABLE_A_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, portion);
  glCombinerInputNV(stage, portion, GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, portion);
  glCombinerInputNV(stage, portion, GL_VARIABLE_C_NV, GL_TEXTURE1_ARB, GL_UNSIGNED_IDENTITY_NV, portion);
  glCombinerInputNV(stage, portion, GL_VARIABLE_D_NV, GL_ZERO, GL_EXPAND_NORMAL_NV, portion);
  glCombinerOutputNV(stage, portion, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_NONE, GL_NONE, GL_FALSE, GL_FALSE,
                     GL_FALSE);
}

// RGB = D, alpha = G. A negative alpha is clamped to 0.
void final_combiner(GLenum d, GLenum g, GLenum g_usage) {
  for (const GLenum variable : {GL_VARIABLE_A_NV, GL_VARIABLE_B_NV, GL_VARIABLE_C_NV}) {
    glFinalCombinerInputNV(variable, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  }
  glFinalCombinerInputNV(GL_VARIABLE_D_NV, d, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glFinalCombinerInputNV(GL_VARIABLE_G_NV, g, GL_UNSIGNED_IDENTITY_NV, g_usage);
}

}  // namespace

Result<CombinerState> ramp_copy_state(const HardwareProfile& profile) {
  return combiner_state_after(profile, "copy of the ramp", [] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
    discard_portion(GL_COMBINER0_NV, GL_RGB);
    discard_portion(GL_COMBINER0_NV, GL_ALPHA);
    final_combiner(GL_TEXTURE0_ARB, GL_TEXTURE0_ARB, GL_ALPHA);
  });
}

Result<CombinerState> luminance_above_state(const HardwareProfile& profile) {
  return combiner_state_after(profile, "comparison of luminances", [] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
    subtract_textures(GL_COMBINER0_NV, GL_RGB);
    discard_portion(GL_COMBINER0_NV, GL_ALPHA);
    final_combiner(GL_ZERO, GL_SPARE0_NV, GL_BLUE);
  });
}

Result<CombinerState> high_byte_above_state(const HardwareProfile& profile) {
  return combiner_state_after(profile, "comparison of high bytes", [] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
    discard_portion(GL_COMBINER0_NV, GL_RGB);
    subtract_textures(GL_COMBINER0_NV, GL_ALPHA);
    final_combiner(GL_ZERO, GL_SPARE0_NV, GL_ALPHA);
  });
}

Result<CombinerState> low_byte_above_state(const HardwareProfile& profile) {
  return combiner_state_after(profile, "comparison of low bytes", [] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);

    // Stage 0, RGB: the difference of the low bytes. Alpha: texture1 · 1 + (1 - texture0) · 1 - 1/2, which is one half
    // or more exactly if texture 1 has the larger high byte: the sum is 255 where they are equal, and 255 - 128 is 127.
    subtract_textures(GL_COMBINER0_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_A_NV, GL_TEXTURE1_ARB, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_C_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_INVERT_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, GL_ALPHA);
    glCombinerOutputNV(GL_COMBINER0_NV, GL_ALPHA, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_NONE,
                       GL_BIAS_BY_NEGATIVE_ONE_HALF_NV, GL_FALSE, GL_FALSE, GL_FALSE);

    // Stage 1, alpha: 0 if the mux finds one half or more, otherwise the difference of the low bytes.
    discard_portion(GL_COMBINER1_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER1_NV, GL_ALPHA, GL_VARIABLE_A_NV, GL_SPARE0_NV, GL_SIGNED_IDENTITY_NV, GL_BLUE);
    glCombinerInputNV(GL_COMBINER1_NV, GL_ALPHA, GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER1_NV, GL_ALPHA, GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER1_NV, GL_ALPHA, GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerOutputNV(GL_COMBINER1_NV, GL_ALPHA, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_NONE, GL_NONE,
                       GL_FALSE, GL_FALSE, GL_TRUE);

    final_combiner(GL_ZERO, GL_SPARE0_NV, GL_ALPHA);
  });
}

namespace {

constexpr float kDefaultBiasTexels = 3.0F;

// Textures of a GeForce 2 have at most 2048 texels a side: the ramp is one such row, with 8 texels per luminance.
constexpr int kLuminanceRampBits = 11;

struct NamedState {
  const char* name;
  Result<CombinerState> (*state)(const HardwareProfile& profile);
};
constexpr std::array kEight{NamedState{"comparison", &luminance_above_state}};
constexpr std::array kSixteen{NamedState{"high byte", &high_byte_above_state},
                              NamedState{"low byte", &low_byte_above_state}};

Result<Program> program_of(const Result<CombinerState>& state, const HardwareProfile& profile) {
  if (!state) return state.error();
  return compile(*state, profile);
}

// The range of the ramp: no planar distance is larger than the largest component.
DepthRange range_of(const Scene& scene) {
  const glm::vec3& light = scene.lights[0].position;
  const Bounds bounds = bounds_of(scene);
  const glm::vec3 farthest = glm::max(glm::abs(bounds.low - light), glm::abs(bounds.high - light));
  const DepthRange views = depth_range(scene, light, kCubeCornerCosine);
  // If the near plane is at its limit, parts of the scene may be nearer.
  const bool limited = views.near_plane <= views.far_plane / 65536.0F;
  return {limited ? 0.0F : views.near_plane, std::max({farthest.x, farthest.y, farthest.z, 1e-6F}) * 1.01F};
}

}  // namespace

float default_depth_cube_bias(const Scene& scene, const RenderSettings& settings) {
  return kDefaultBiasTexels * 2.0F * range_of(scene).far_plane / static_cast<float>(settings.map_size);
}

DistanceCode distance_code(const Scene& scene, const RenderSettings& settings) {
  const DepthRange range = range_of(scene);
  DistanceCode code;
  code.low = range.near_plane;
  code.high = range.far_plane;
  const bool sixteen = settings.depth_cube.bits == DepthCubeBits::sixteen;
  code.code_bits = sixteen ? 16 : 8;
  code.ramp_bits = sixteen ? 16 : kLuminanceRampBits;
  const double bias = settings.depth_cube.bias.value_or(default_depth_cube_bias(scene, settings));
  const double texels = std::ceil(bias / code.ramp_step());
  code.offset = static_cast<std::uint32_t>(std::min(texels, static_cast<double>(code.ramp_size())));
  return code;
}

Result<DepthCubePasses> depth_cube_passes(const RenderSettings& settings) {
  const FramePasses frame = frame_passes(settings);
  DepthCubePasses passes{frame.depth, frame.depth, {}, marking_pass(settings)};
  const HardwareProfile& profile = settings.profile;
  const bool sixteen = settings.depth_cube.bits == DepthCubeBits::sixteen;
  // Floats go into a plane of an interpolated attribute.
  if (settings.depth_cube.bits == DepthCubeBits::real) return passes;

  auto copy = program_of(ramp_copy_state(profile), profile);
  if (!copy) return copy.error();
  passes.map.program = std::move(*copy);
  passes.map.color_mask = {true, false, false, sixteen};
  const std::span<const NamedState> comparisons = sixteen ? std::span<const NamedState>(kSixteen) : kEight;
  for (const NamedState& named : comparisons) {
    auto program = program_of(named.state(profile), profile);
    if (!program) return program.error();
    PipelineState state = marking_pass(settings);
    state.program = std::move(*program);
    state.alpha_test = {.enabled = true, .function = CompareFunction::greater, .reference = 0};
    passes.comparisons.push_back({named.name, std::move(state)});
  }
  return passes;
}

// The technique's outputs: maps, pictures and facts.

void DepthCubeRenderer::finish() {
  frame_.finish();
  add_picture();
  add_facts();
  keep_maps();
}

// Shows the map in grey, near surfaces dark: the luminance, the high byte, or the distance divided by the far plane's.
void DepthCubeRenderer::add_picture() {
  const auto grey = [this](std::size_t face, std::size_t texel) -> std::array<std::uint8_t, 3> {
    std::uint8_t level = 255;
    if (uses_floats()) {
      const float part = faces_[face].distance[texel] / range_.far_plane;
      level = static_cast<std::uint8_t>(std::min(part, 1.0F) * 255.0F);
    } else {
      level = code_.code_bits == 16 ? faces_[face].alpha[texel] : faces_[face].luminance[texel];
    }
    return {level, level, level};
  };
  rendering().pictures.push_back({"depth_cube.png", cube_cross(settings().map_size, grey)});
}

void DepthCubeRenderer::keep_maps() {
  const int size = settings().map_size;
  for (std::size_t f = 0; f < 6; ++f) {
    Layer& layer = rendering().maps.emplace_back(Layer{"depth_cube", kCubeFaceNames[f], size, size, {}});
    Face& face = faces_[f];
    if (uses_floats()) {
      layer.samples = std::move(face.distance);
    } else if (code_.code_bits == 8) {
      layer.samples = std::move(face.luminance);
    } else {
      auto& codes = layer.samples.emplace<std::vector<std::uint32_t>>(face.luminance.size());
      for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = face.alpha[i] * 256U + face.luminance[i];
    }
  }
}

void DepthCubeRenderer::add_facts() {
  std::vector<Fact>& facts = rendering().facts;
  facts.push_back({"depth_bits", uses_floats() ? std::string("float") : std::to_string(code_.code_bits)});
  if (uses_floats()) {
    facts.push_back({"bias", double{bias_}});
  } else {
    facts.push_back({"distance_near", double{code_.low}});
    facts.push_back({"distance_far", double{code_.high}});
    facts.push_back({"distance_step", code_.code_step()});
    facts.push_back({"bias", code_.bias()});
  }
  int units = 0, stages = 0;
  for (const DepthCubeComparison& comparison : passes_.comparisons) {
    units = std::max(units, texture_units_read(*comparison.state.program));
    stages = std::max(stages, comparison.state.program->num_general_combiners);
  }
  facts.push_back({"comparison_passes", std::uint64_t{passes_.comparisons.size() * faces_.size()}});
  facts.push_back({"texture_units", static_cast<std::uint64_t>(units)});
  facts.push_back({"general_combiners", static_cast<std::uint64_t>(stages)});
}

}  // namespace ninebit
