#include "ninebit/shadow/technique.h"

#include <array>

#include "ninebit/shadow/index_cube.h"

namespace ninebit {
namespace {

constexpr std::array kTechniques{
    Technique{"index-cube", "index cube shadow mapping: polygon indices compared by two general combiners",
              &render_index_cube},
};

}  // namespace

std::span<const Technique> techniques() {
  return kTechniques;
}

const Technique* find_technique(std::string_view name) {
  for (const Technique& technique : kTechniques) {
    if (technique.name == name) return &technique;
  }
  return nullptr;
}

}  // namespace ninebit
