// The depth cube's passes as pipeline states, and the code of its distances.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "ninebit/combiner/program.h"
#include "ninebit/shadow/depth_cube.h"
#include "src/frame/camera_frame.h"
#include "src/frame/views.h"

namespace ninebit {
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

}  // namespace ninebit
