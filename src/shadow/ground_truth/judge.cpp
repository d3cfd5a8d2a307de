#include "src/shadow/ground_truth/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "src/frame/views.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

// The polygon that the light sees in the pixel's direction: the one nearest to the light of those in between.
const RayCrossing* seen_by_light(std::span<const RayCrossing> between) {
  const auto nearer = [](const RayCrossing& l, const RayCrossing& r) { return l.at < r.at; };
  const auto found = std::max_element(between.begin(), between.end(), nearer);
  return found == between.end() ? nullptr : &*found;
}

}  // namespace

Status check_rendering(const RenderSettings& settings, const Rendering& rendering) {
  const Surface& frame = rendering.frame;
  if (!rendering.evidence || frame.primitive().empty()) {
    return Diagnostic{.message = "the rendering has no evidence to judge it by"};
  }
  if (frame.width() != settings.width || frame.height() != settings.height) {
    return Diagnostic{.message = fmt::format("the rendering has {} x {} pixels, its settings {} x {}", frame.width(),
                                             frame.height(), settings.width, settings.height)};
  }
  return {};
}

Judge::Judge(const GroundTruthScene::Rays& rays, const RenderSettings& settings, const Rendering& rendering)
    : rays_(rays),
      scene_(*rays.scene),
      light_(scene_.lights[0]),
      settings_(settings),
      rendering_(rendering),
      pixel_rays_(scene_.cameras[0], settings.width, settings.height) {
  if (light_.kind == LightKind::spot) spot_ = glm::dmat4(light_projection(scene_, light_));
  truth_.truth.resize(rendering.frame.stencil().size(), PixelTruth::background);
  truth_.cause.resize(rendering.frame.stencil().size(), ErrorCause::none);
}

void Judge::judge_rows(int first, int last) {
  parallel_ranges(static_cast<std::size_t>(last - first), 1, [&](std::size_t begin, std::size_t end) {
    std::vector<RayCrossing> between;
    for (std::size_t row = begin; row < end; ++row) {
      for (int x = 0; x < settings_.width; ++x) judge_pixel(x, first + static_cast<int>(row), between);
    }
  });
}

GroundTruth Judge::finish() {
  for (std::size_t i = 0; i < truth_.cause.size(); ++i) {
    if (truth_.cause[i] == ErrorCause::none) continue;
    ++truth_.by_cause[static_cast<std::size_t>(truth_.cause[i])];
    ++(truth_.truth[i] == PixelTruth::shadowed ? truth_.false_lit : truth_.false_shadowed);
  }
  return std::move(truth_);
}

void Judge::judge_pixel(int x, int y, std::vector<RayCrossing>& between) {
  const std::size_t i =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(settings_.width) + static_cast<std::size_t>(x);
  const std::uint32_t own = rendering_.frame.primitive()[i];
  if (own >= scene_.triangles.size()) return;
  const Corners corners = corners_of(scene_, own);
  const LightRay ray = light_ray(light_, pixel_rays_.point_on(corners, x, y));
  const bool shadowed = turns_away(corners) || outside_spot(ray.from) || rays_.blocked(ray, own);
  truth_.truth[i] = shadowed ? PixelTruth::shadowed : PixelTruth::lit;
  const bool drawn_lit = rendering_.frame.stencil()[i] == 0;
  if (drawn_lit != shadowed) return;
  rays_.find_all(ray, own, between);
  const ShadowEvidence& evidence = *rendering_.evidence;
  const std::uint32_t fetched = evidence.fetched.empty() ? 0 : evidence.fetched[i];
  truth_.cause[i] = cause_of(scene_, evidence, {.lit = drawn_lit, .own = own, .fetched = fetched, .between = between});
}

JudgedPixel Judge::judged(int x, int y) const {
  const std::size_t i =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(settings_.width) + static_cast<std::size_t>(x);
  const std::uint32_t own = rendering_.frame.primitive()[i];
  if (own >= scene_.triangles.size()) return {};
  const Corners corners = corners_of(scene_, own);
  const LightRay ray = light_ray(light_, pixel_rays_.point_on(corners, x, y));
  std::vector<RayCrossing> between;
  rays_.find_all(ray, own, between);
  const ShadowEvidence& evidence = *rendering_.evidence;
  const std::uint32_t fetched = evidence.fetched.empty() ? 0 : evidence.fetched[i];
  JudgedPixel pixel{.shown = own, .turned_away = turns_away(corners), .outside_spot = outside_spot(ray.from)};
  if (fetched != 0) pixel.fetched = fetched - 1;
  if (const RayCrossing* const first = seen_by_light(between)) pixel.occluder = first->triangle;
  const bool shadowed = pixel.turned_away || pixel.outside_spot || pixel.occluder;
  pixel.truth = shadowed ? PixelTruth::shadowed : PixelTruth::lit;
  const bool lit = rendering_.frame.stencil()[i] == 0;
  if (lit == shadowed) {
    pixel.cause = cause_of(scene_, evidence, {.lit = lit, .own = own, .fetched = fetched, .between = between});
  }
  return pixel;
}

bool Judge::spot_holds_picture() const {
  const std::span<const std::uint32_t> shown = rendering_.frame.primitive();
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (shown[i] >= scene_.triangles.size()) continue;
    const int x = static_cast<int>(i % static_cast<std::size_t>(settings_.width));
    const int y = static_cast<int>(i / static_cast<std::size_t>(settings_.width));
    if (outside_spot(pixel_rays_.point_on(corners_of(scene_, shown[i]), x, y))) return false;
  }
  return true;
}

bool Judge::turns_away(const Corners& t) const {
  return settings_.light_facing && glm::dot(glm::cross(t.b - t.a, t.c - t.a), light_ray(light_, t.a).way) <= 0.0;
}

bool Judge::outside_spot(const glm::dvec3& point) const {
  return light_.kind == LightKind::spot && !in_spot(spot_, point);
}

namespace {

constexpr std::array kIndexCauses{ErrorCause::truncation, ErrorCause::joint, ErrorCause::vanished, ErrorCause::shared,
                                  ErrorCause::sampling};
constexpr std::array kDepthCauses{ErrorCause::acne, ErrorCause::detached, ErrorCause::sampling};
constexpr std::array kMaplessCauses{ErrorCause::sampling};

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
