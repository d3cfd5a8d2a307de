#include "src/shadow/index_order/shadow_relation.h"

#include <algorithm>
#include <utility>

namespace ninebit {
namespace {

// Pairs of a plane and a corner that are compared for one pair of patches at most.
constexpr std::size_t kMostComparisons = std::size_t{1} << 20;

}  // namespace

bool ShadowRelation::may_shadow(std::uint32_t a, std::uint32_t b) {
  if (a > b) std::swap(a, b);
  const auto [entry, is_new] = known_.try_emplace((std::uint64_t{a} << 32) | b, false);
  if (is_new) entry->second = decide(a, b);
  return entry->second;
}

bool ShadowRelation::decide(std::uint32_t a, std::uint32_t b) const {
  const std::size_t most = std::max(patches_.planes(a).size() * patches_.places(b).size(),
                                    patches_.planes(b).size() * patches_.places(a).size());
  if (most > kMostComparisons) return true;
  return occludes(a, b) || occludes(b, a);
}

bool ShadowRelation::reaches(std::uint32_t patch, std::uint32_t other, double side) const {
  const glm::dvec3& middle = patches_.middle(patch);
  const glm::dvec3& half = patches_.half_size(patch);
  for (const std::uint32_t plane : patches_.planes(other)) {
    const glm::dvec3 normal = surface_.normal(plane) * side;
    const double offset = surface_.offset(plane) * side + relief_;
    // The box around the patch decides most planes.
    if (glm::dot(normal, middle) + glm::dot(glm::abs(normal), half) <= offset) continue;
    for (const std::uint32_t place : patches_.places(patch)) {
      if (glm::dot(normal, surface_.position(place)) > offset) return true;
    }
  }
  return false;
}

}  // namespace ninebit
