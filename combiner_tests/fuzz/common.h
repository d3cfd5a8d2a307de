// Shared by the checks.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/texture_shader/stage_state.h"

namespace ninebit::fuzz {

// The name that the checks give to their texts.
inline constexpr std::string_view kFile = "fuzzed";

// The profiles that programs are read for: one with the least that GL allows, and one with the most.
inline constexpr const HardwareProfile* kProfiles[] = {&profiles::geforce2, &profiles::nv2a};

// The fault of a message or of its place in the text; empty: none.
std::string wrong_with_message(std::string_view message);
std::string wrong_with_place(TextPlace place, std::string_view text);

// The fault of the faults of a text that is refused.
std::string wrong_with_faults(const std::vector<TextFault>& faults, std::string_view text);

// What is wrong with a state that a parser gave: GL must accept it, it must compile, be explained and emitted, and come
// back from GL calls, !!RC1.0 and register words as far as they can express it.
std::string wrong_with_state(const CombinerState& state, const HardwareProfile& profile);

// The same of texture-shader stages: they must be valid, be explained, and come back from GL calls and !!TS1.0.
std::string wrong_with_stages(const TextureShaderState& stages, const HardwareProfile& profile);

// The fault of the faults in a parser's answer.
template <class T>
std::string wrong_with_answer(const Parsed<T>& parsed, std::string_view text) {
  if (parsed) return "";
  return wrong_with_faults(parsed.faults(), text);
}

// The first that is not empty; each is asked only if none before it was.
template <class... Later>
std::string first_of(std::string wrong, const Later&... later) {
  ((wrong.empty() ? void(wrong = later()) : void()), ...);
  return wrong;
}

}  // namespace ninebit::fuzz
