#include "ninebit/texture_shader/validate_stages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

class Findings {
 public:
  void at(int stage) { stage_ = stage; }
  void add(GlError error, const std::string& what) {
    const std::string place = stage_ ? "texture stage " + std::to_string(*stage_) + ": " : "";
    found_.push_back({stage_, error, place + what});
  }
  std::vector<TextureShaderDiagnostic> take() { return std::move(found_); }

 private:
  std::optional<int> stage_;
  std::vector<TextureShaderDiagnostic> found_;
};

std::string stages_of(const TextureOperationInfo& info) {
  if (info.first == info.last) return "stage " + std::to_string(info.first);
  return "stages " + std::to_string(info.first) + " to " + std::to_string(info.last);
}

// A caller may have cast any number to these enumerations. Evaluation relies on their enumerators.
bool are_enumerators(const TextureStage& stage, Findings& findings) {
  if (stage.operation > TextureOperation::brdf) {
    findings.add(GlError::invalid_enum, "unknown operation; expected an enumerator of TextureOperation");
    return false;
  }
  if (stage.mapping > DotMapping::hilo_hemisphere) {
    findings.add(GlError::invalid_enum, "unknown dot-product mapping; expected an enumerator of DotMapping");
  }
  const auto is_unknown = [](CullMode mode) { return mode > CullMode::kills_not_negative; };
  if (std::any_of(stage.cull.begin(), stage.cull.end(), is_unknown)) {
    findings.add(GlError::invalid_enum, "unknown cull mode; expected an enumerator of CullMode");
  }
  return true;
}

void check_numbers(const TextureStage& stage, Findings& findings) {
  const auto check = [&](const char* what, const auto& numbers) {
    if (std::any_of(std::begin(numbers), std::end(numbers), [](float x) { return std::isnan(x); })) {
      findings.add(GlError::no_error, std::string(what) + " is not a number (NaN); expected numbers");
    }
  };
  check("an entry of the offset matrix", stage.matrix);
  check("the offset scale or bias", std::array{stage.scale, stage.bias});
  check("a component of the eye vector", stage.eye);
}

void check_stage(int place, const TextureStage& stage, Findings& findings) {
  if (!are_enumerators(stage, findings)) return;
  const TextureOperationInfo& info = info_of(stage.operation);
  const std::string name(info.name);
  if (stage.previous < 0 || stage.previous >= kTextureStages) {
    findings.add(GlError::invalid_enum, "the previous stage is " + std::to_string(stage.previous) +
                                            "; expected one from 0 to " + std::to_string(std::max(place - 1, 0)));
  } else if (place > 0 ? stage.previous >= place : stage.previous != 0) {
    findings.add(GlError::invalid_operation, "the previous stage is " + std::to_string(stage.previous) +
                                                 ", which is not before this one; expected one from 0 to " +
                                                 std::to_string(std::max(place - 1, 0)));
  }
  if (place < info.first || place > info.last) {
    findings.add(GlError::invalid_operation, name + " is for " + stages_of(info) + " only");
  }
  check_numbers(stage, findings);
  const bool is_refused =
      stage.mapping == DotMapping::hilo_hemisphere_d3d || stage.mapping == DotMapping::hilo_hemisphere_gl;
  if (is_refused) {
    findings.add(GlError::invalid_enum, "the NV2A refuses the dot-product mappings 5 and 6; expected 0 to 4, or 7");
  }
  if (stage.operation == TextureOperation::brdf) {
    findings.add(GlError::invalid_enum, "brdf is not modelled: no picture of the NV2A decides what it computes");
  }
}

}  // namespace

std::string no_texture_shaders(const HardwareProfile& profile) {
  return "profile " + std::string(profile.name) +
         " has no texture shaders (NV_texture_shader); expected a profile that has, such as nv2a";
}

std::vector<TextureShaderDiagnostic> validate(const TextureShaderState& state, const HardwareProfile& profile) {
  Findings findings;
  if (!state.enabled) return {};
  if (!profile.texture_shaders) {
    findings.add(GlError::invalid_enum, no_texture_shaders(profile));
  }
  if (state.rules > StageRules::nv2a) {
    findings.add(GlError::invalid_enum, "unknown rules of consistency; expected an enumerator of StageRules");
  }
  if (state.depth_unit > DepthUnit::codes) {
    findings.add(GlError::invalid_enum, "unknown unit of replaced depths; expected an enumerator of DepthUnit");
  }
  for (int place = 0; place < kTextureStages; ++place) {
    const TextureStage& stage = state.stage[static_cast<std::size_t>(place)];
    findings.at(place);
    if (place >= profile.texture_units && stage.operation != TextureOperation::none) {
      const std::string unit = std::to_string(place);
      findings.add(GlError::invalid_enum, "the stage needs texture unit " + unit + "; profile " +
                                              std::string(profile.name) + " has " +
                                              std::to_string(profile.texture_units.value) + " texture units");
    }
    check_stage(place, stage, findings);
  }
  std::vector<TextureShaderDiagnostic> all = findings.take();
  // Within a stage, GL's enumerants come first, and what GL accepts comes last.
  const auto rank = [](const TextureShaderDiagnostic& one) {
    const int order = one.gl_error == GlError::invalid_enum ? 0 : one.gl_error == GlError::no_error ? 2 : 1;
    return 3 * one.stage.value_or(-1) + order;
  };
  std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return all;
}

}  // namespace ninebit
