// Effect files: read or refused, and what is read draws or is refused, at a small size and without files.
#include <algorithm>
#include <string>

#include "combiner_tests/fuzz/checks.h"
#include "combiner_tests/fuzz/common.h"
#include "ninebit/effect/effect_json.h"
#include "ninebit/effect/effect_renderer.h"
#include "ninebit/effect/generated_meshes.h"
#include "ninebit/effect/generated_textures.h"

namespace ninebit::fuzz {
namespace {

constexpr int kLargest = 16;  // pixels a side of what is drawn
constexpr std::size_t kMostPasses = 8;

// Files that are always there: a program that reads everything, a small texture or cube map, a cube.
EffectReaders small_readers() {
  EffectReaders readers;
  readers.program = [](const std::filesystem::path&, const HardwareProfile&) -> Result<TextProgram> {
    TextProgram program;
    CombinerState& state = program.state;
    state.general[0].rgb.a = {Register::texture0, InputMapping::expand_normal, ComponentUsage::rgb};
    state.general[0].rgb.b = {Register::primary, InputMapping::signed_identity, ComponentUsage::rgb};
    state.general[0].rgb.c = {Register::texture1, InputMapping::unsigned_identity, ComponentUsage::rgb};
    state.general[0].rgb.d = {Register::secondary, InputMapping::unsigned_identity, ComponentUsage::rgb};
    return program;
  };
  readers.texture = [](std::span<const std::filesystem::path> files, const HardwareProfile&) {
    return files.size() == 6 ? normalization_cube_map(2) : checkerboard(4);
  };
  readers.scene = [](const std::filesystem::path&, std::optional<UpAxis>) { return generated_mesh("cube"); };
  return readers;
}

// The same effect with small surfaces and meshes, so that a run is short.
Effect small(Effect effect) {
  effect.width = std::min(effect.width, kLargest);
  effect.height = std::min(effect.height, kLargest);
  for (EffectTarget& target : effect.targets) {
    target.width = std::min(target.width, kLargest);
    target.height = std::min(target.height, kLargest);
  }
  for (EffectTexture& texture : effect.textures) texture.size = std::min(texture.size, kLargest);
  if (is_generated_mesh(effect.scene.mesh)) effect.scene.mesh = effect.scene.mesh.size() % 2 == 0 ? "cube" : "sphere:6";
  return effect;
}

}  // namespace

std::string check_effect(std::string_view bytes) {
  const auto parsed = parse_effect({bytes, kFile});
  std::string wrong = wrong_with_answer(parsed, bytes);
  if (!wrong.empty() || !parsed) return wrong;
  if (!check_effect(*parsed).empty()) return "an effect with faults is read";
  if (parsed->passes.size() > kMostPasses) return {};
  auto renderer = EffectRenderer::make(small(*parsed), profiles::geforce2, small_readers());
  if (!renderer) return renderer.error().message.empty() ? "a refusal without a message" : "";
  const Status drawn = renderer->draw();
  return drawn || !drawn.error().message.empty() ? "" : "a failure without a message";
}

}  // namespace ninebit::fuzz
