#include "src/shadow/ground_truth/ground_truth_causes.h"

#include <algorithm>

namespace ninebit {
namespace {

constexpr std::array kIndexCauses{ErrorCause::truncation, ErrorCause::joint, ErrorCause::vanished, ErrorCause::shared,
                                  ErrorCause::sampling};
constexpr std::array kDepthCauses{ErrorCause::acne, ErrorCause::detached, ErrorCause::sampling};
constexpr std::array kMaplessCauses{ErrorCause::sampling};

// The polygon that the light sees in the pixel's direction: the one nearest to the light of those in between.
const RayCrossing* seen_by_light(std::span<const RayCrossing> between) {
  const auto nearer = [](const RayCrossing& l, const RayCrossing& r) { return l.at < r.at; };
  const auto found = std::max_element(between.begin(), between.end(), nearer);
  return found == between.end() ? nullptr : &*found;
}

bool texel_holds_neighbour(const Scene& scene, const WrongPixel& pixel) {
  return pixel.fetched != 0 && are_neighbours(scene, pixel.own, pixel.fetched - 1);
}

ErrorCause index_cause(const Scene& scene, const ShadowEvidence& evidence, const WrongPixel& pixel) {
  const std::vector<std::uint32_t>& index = evidence.index_of_triangle;
  if (pixel.lit) {
    const std::uint32_t read = pixel.fetched == 0 ? 0 : index[pixel.fetched - 1];
    if (read != index[pixel.own]) return ErrorCause::truncation;
    const RayCrossing* const first = seen_by_light(pixel.between);
    if (first != nullptr && index[first->triangle] == index[pixel.own]) return ErrorCause::shared;
    return ErrorCause::sampling;
  }
  if (!evidence.in_map[pixel.own]) return ErrorCause::vanished;
  return texel_holds_neighbour(scene, pixel) ? ErrorCause::joint : ErrorCause::sampling;
}

ErrorCause depth_cause(const Scene& scene, const WrongPixel& pixel) {
  if (!pixel.lit) {
    const bool own_surface = pixel.fetched == pixel.own + 1 || texel_holds_neighbour(scene, pixel);
    return own_surface ? ErrorCause::acne : ErrorCause::sampling;
  }
  if (pixel.fetched == 0) return ErrorCause::sampling;
  // The texel's centre lies beside the pixel's ray, so it may see a neighbour of the polygon that shades the pixel.
  const auto is_fetched = [&](const RayCrossing& c) {
    return c.triangle == pixel.fetched - 1 || are_neighbours(scene, c.triangle, pixel.fetched - 1);
  };
  const bool seen = std::any_of(pixel.between.begin(), pixel.between.end(), is_fetched);
  return seen ? ErrorCause::detached : ErrorCause::sampling;
}

}  // namespace

std::string_view name_of(ErrorCause cause) {
  constexpr std::array<std::string_view, kErrorCauses> names{"none",   "truncation", "joint",    "vanished",
                                                             "shared", "acne",       "detached", "sampling"};
  return names[static_cast<std::size_t>(cause)];
}

std::span<const ErrorCause> causes_of(const ShadowEvidence& evidence) {
  if (evidence.fetched.empty()) return kMaplessCauses;
  if (evidence.index_of_triangle.empty()) return kDepthCauses;
  return kIndexCauses;
}

ErrorCause cause_of(const Scene& scene, const ShadowEvidence& evidence, const WrongPixel& pixel) {
  if (evidence.fetched.empty()) return ErrorCause::sampling;
  if (evidence.index_of_triangle.empty()) return depth_cause(scene, pixel);
  return index_cause(scene, evidence, pixel);
}

}  // namespace ninebit
