#include "src/tools/prove/opaque_texels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/explain.h"
#include "src/tools/input/printable.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {
namespace {

using Op = TextureOperation;
using Stages = std::array<std::optional<TextureStage>, kTextureStages>;

// The contents of a unit's register before the combiners.
struct UnitTexel {
  enum class Kind { texture, coordinates, value, opaque };
  Kind kind = Kind::texture;
  std::uint8_t alpha = 0;  // of a value, which is (0, 0, 0, alpha)
  Stages from{};           // the stages that an opaque texel comes from
  bool converts_yuv = false;
  friend bool operator==(const UnitTexel&, const UnitTexel&) = default;
};

// Adds a stage and those that it reads.
void add_stages(const TextureShaderState& state, int place, Stages& found) {
  auto& here = found[static_cast<std::size_t>(place)];
  if (here) return;
  const TextureStage& stage = state.stage[static_cast<std::size_t>(place)];
  here = stage;
  const TextureOperationInfo& info = info_of(stage.operation);
  if (info.input != StageInput::none) add_stages(state, stage.previous, found);
  for (int before = 1; before <= info.dots_before; ++before) add_stages(state, place - before, found);
  if (stage.operation == Op::dot_product_diffuse_cube_map) add_stages(state, place + 1, found);
}

UnitTexel texel_of(const StagedProgram& of, int unit) {
  const TextureShaderState state = only_used(of.program->texture_shader);
  UnitTexel texel;
  if (only_reads_textures(state)) return texel;
  const Op operation = state.stage[static_cast<std::size_t>(unit)].operation;
  const bool reads = info_of(operation).target != StageTarget::none;
  if (operation == Op::pass_through) {
    texel.kind = UnitTexel::Kind::coordinates;
  } else if (!reads) {
    texel.kind = UnitTexel::Kind::value;
    const bool is_off = operation == Op::none && state.rules == StageRules::nv2a;
    if (is_off) texel.alpha = static_cast<std::uint8_t>(of.profile->disabled_texture_alpha.value);
  } else if (operation > Op::texture_cube_map || state.converts_yuv) {
    texel.kind = UnitTexel::Kind::opaque;
    texel.converts_yuv = state.converts_yuv;
    add_stages(state, unit, texel.from);
  }
  return texel;
}

// The stages that cull fragments.
Stages culling_stages(const StagedProgram& of) {
  Stages found;
  const TextureShaderState& state = of.program->texture_shader;
  for (std::size_t i = 0; i < found.size() && state.enabled; ++i) {
    if (state.stage[i].operation == Op::cull_fragment) found[i] = TextureStage{.operation = Op::cull_fragment};
    if (found[i]) found[i]->cull = state.stage[i].cull;
  }
  return found;
}

bool depends_on(const StagedProgram& of, int unit, const std::vector<ProofTarget>& targets) {
  const bool registers = std::any_of(targets.begin(), targets.end(), [](const ProofTarget& t) { return bool(t.reg); });
  const BatchProgram batch(normalize(of.program->state, *of.profile), {.registers = registers});
  for (int c = 0; c < 4; ++c) {
    if (batch.reads().contains(texture_register(unit), c)) return true;
  }
  return false;
}

// The equation of a unit's texel: "texture 1 at (s1, t1) + …".
std::string equation_of(const StagedProgram& of, int unit) {
  const std::string start = fmt::format("tex{} = ", unit);
  for (const std::string& line : explain_stages(of.program->texture_shader)) {
    if (line.starts_with(start)) return line.substr(start.size());
  }
  return of.program->texture_shader.enabled ? "nothing" : fmt::format("texture {}", unit);
}

}  // namespace

TexelsOfStages texels_of_stages(const std::vector<StagedProgram>& programs, const std::vector<ProofTarget>& targets) {
  TexelsOfStages out;
  const StagedProgram& first = programs.front();
  const int units = std::min(first.profile->texture_units.value, kTextureStages);
  for (int unit = 0; unit < units; ++unit) {
    const bool is_live = std::any_of(programs.begin(), programs.end(),
                                     [&](const StagedProgram& one) { return depends_on(one, unit, targets); });
    if (!is_live) continue;
    const std::string name = fmt::format("tex{}", unit);
    const UnitTexel texel = texel_of(first, unit);
    for (const StagedProgram& other : programs) {
      if (texel_of(other, unit) == texel || !out.reason.empty()) continue;
      out.reason =
          fmt::format("{} is {} in {} and {} in {}: it cannot be one input of both", name, equation_of(first, unit),
                      printable(first.name), equation_of(other, unit), printable(other.name));
    }
    if (texel.kind == UnitTexel::Kind::opaque) {
      out.opaque.push_back(name);
      out.notes.push_back(fmt::format("{} is an opaque input, any four bytes: {}", name, equation_of(first, unit)));
    }
    if (texel.kind != UnitTexel::Kind::value) continue;
    for (int c = 0; c < 4; ++c) {
      out.fixed.push_back({texture_register(unit), c, c == kAlpha ? texel.alpha : std::uint8_t{0}, {}});
    }
  }
  const Stages culling = culling_stages(first);
  for (const StagedProgram& other : programs) {
    if (culling_stages(other) == culling || !out.reason.empty()) continue;
    out.reason = fmt::format("{} and {} do not cull the same fragments", printable(first.name), printable(other.name));
  }
  if (std::any_of(culling.begin(), culling.end(), [](const auto& stage) { return bool(stage); })) {
    out.notes.emplace_back("fragments that a stage culls are not part of the question");
  }
  return out;
}

void apply_texels(const TexelsOfStages& texels, bool quiet, std::vector<ProofInput>& inputs) {
  for (const ProofInput& one : texels.fixed) {
    const auto same = [&](const ProofInput& other) { return other.name() == one.name(); };
    if (std::none_of(inputs.begin(), inputs.end(), same)) inputs.push_back(one);
  }
  if (quiet) return;
  for (const std::string& note : texels.notes) say(fmt::format("ninebit: note: {}\n", note));
}

}  // namespace ninebit::tools
