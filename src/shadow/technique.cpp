#include "ninebit/shadow/technique.h"

#include <array>

#include "ninebit/shadow/index_cube.h"
#include "ninebit/shadow/reflective.h"

namespace ninebit {
namespace {

constexpr std::array kTechniques{
    Technique{"index-cube",
              "index cube shadow mapping: polygon indices compared by two general combiners",
              {.point = true},
              &render_index_cube},
    Technique{"reflective",
              "reflective shadow maps: one bounce of diffuse light gathered from what the light sees",
              {.point = false, .spot = true, .directional = true},
              &render_reflective},
};

}  // namespace

std::span<const Technique> techniques() {
  return kTechniques;
}

const ProbedFragment* deciding_fragment(const ProbedPass& pass) {
  const ProbedFragment* decided = nullptr;
  for (const ProbedFragment& fragment : pass.fragments) {
    const bool outranked = decided != nullptr && decided->fate == FragmentFate::written;
    if (fragment.fate == FragmentFate::written || (fragment.depth_passes && !outranked)) decided = &fragment;
  }
  return decided;
}

const Technique* find_technique(std::string_view name) {
  for (const Technique& technique : kTechniques) {
    if (technique.name == name) return &technique;
  }
  return nullptr;
}

}  // namespace ninebit
