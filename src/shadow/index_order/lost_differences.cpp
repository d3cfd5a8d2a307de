#include "src/shadow/index_order/lost_differences.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/shadow/index_cube.h"

namespace ninebit {
namespace {

constexpr int kLargestByte = 255;

// Two bytes of one channel, the polygon's and the texel's.
struct BytePair {
  int own = 0, other = 0;
};

}  // namespace

int channels_of(IndexFormat format) {
  return format == IndexFormat::rgb ? 3 : format == IndexFormat::luminance_alpha ? 2 : 1;
}

std::uint32_t code_number(const CodeBytes& code) {
  return static_cast<std::uint32_t>(code[0] + 256 * (code[1] + 256 * code[2]));
}

class LostDifferences::Comparison {
 public:
  Comparison(Program program, const HardwareProfile& profile, IndexFormat format)
      : program_(std::move(program)), profile_(profile), codes_(1, format) {}

  struct Result {
    bool lost = false;
    std::array<Rgba9, 2> registers{};  // spare0 and spare1
  };
  [[nodiscard]] Result compare(const CodeBytes& own, const CodeBytes& other) const {
    FragmentInputs inputs;
    inputs.primary = codes_.color(code_number(own));
    inputs.texture[0] = Texel{.value = codes_.color(code_number(other))};
    const EvaluatedFragment out = evaluate_fragment(program_, initial_registers(profile_, inputs));
    return {to_byte(profile_, out.color[kAlpha]) == 0,
            {out.registers[Register::spare0], out.registers[Register::spare1]}};
  }
  // The same for codes that differ in one channel; the others are 0.
  [[nodiscard]] Result compare(int channel, const BytePair& pair) const {
    CodeBytes own{}, other{};
    own[static_cast<std::size_t>(channel)] = pair.own;
    other[static_cast<std::size_t>(channel)] = pair.other;
    return compare(own, other);
  }
  // One pair of bytes for each result that the pairs with this difference have in one channel. Only the results go on
  // into the next stage, so that these pairs stand for all.
  [[nodiscard]] std::vector<BytePair> representatives(int channel, int d) const {
    std::vector<BytePair> pairs;
    std::vector<std::array<Rgba9, 2>> seen;
    for (int own = std::max(0, d); own <= std::min(kLargestByte, kLargestByte + d); ++own) {
      const BytePair pair{own, own - d};
      const auto registers = compare(channel, pair).registers;
      if (std::find(seen.begin(), seen.end(), registers) != seen.end()) continue;
      seen.push_back(registers);
      pairs.push_back(pair);
    }
    return pairs;
  }

 private:
  Program program_;
  const HardwareProfile& profile_;
  IndexCodes codes_;
};

Result<LostDifferences> LostDifferences::measure(const HardwareProfile& profile, IndexFormat format,
                                                 IndexScales scales) {
  const auto state = index_comparison_state(profile, format, scales);
  if (!state) return state.error();
  auto program = compile(*state, profile);
  if (!program) return program.error();
  const Comparison comparison(std::move(*program), profile, format);
  LostDifferences lost(channels_of(format));
  lost.find_radius(comparison);
  lost.judge(comparison);
  return lost;
}

// A square never shrinks as its difference grows, so that the first difference that is always found ends the search;
// and a second difference adds a square that is not negative.
void LostDifferences::find_radius(const Comparison& comparison) {
  for (int channel = 0; channel < channels_; ++channel) {
    for (int d = 1; d <= kLargestByte; ++d) {
      const auto any_lost = [&](int signed_difference) {
        const auto pairs = comparison.representatives(channel, signed_difference);
        return std::any_of(pairs.begin(), pairs.end(),
                           [&](const BytePair& pair) { return comparison.compare(channel, pair).lost; });
      };
      if (!any_lost(d) && !any_lost(-d)) break;
      radius_ = std::max(radius_, d);
    }
  }
}

void LostDifferences::judge(const Comparison& comparison) {
  std::array<std::vector<std::vector<BytePair>>, 3> pairs;  // by channel, then difference
  for (int channel = 0; channel < 3; ++channel) {
    for (int d = -radius_; d <= radius_; ++d) {
      auto& of_channel = pairs[static_cast<std::size_t>(channel)];
      of_channel.push_back(channel < channels_ ? comparison.representatives(channel, d) : std::vector<BytePair>(1));
    }
  }
  const auto range = [&](int channel) { return channel < channels_ ? radius_ : 0; };
  const int side = 2 * radius_ + 1;
  verdict_.assign(static_cast<std::size_t>(side * side * side), Verdict::never);
  for (int z = -range(2); z <= range(2); ++z) {
    for (int y = -range(1); y <= range(1); ++y) {
      for (int x = -range(0); x <= range(0); ++x) {
        int lost = 0, all = 0;
        for (const BytePair& r : pairs[0][static_cast<std::size_t>(x + radius_)]) {
          for (const BytePair& g : pairs[1][static_cast<std::size_t>(y + radius_)]) {
            for (const BytePair& b : pairs[2][static_cast<std::size_t>(z + radius_)]) {
              ++all;
              if (comparison.compare({r.own, g.own, b.own}, {r.other, g.other, b.other}).lost) ++lost;
            }
          }
        }
        verdict_[place({x, y, z})] = lost == all ? Verdict::always : lost > 0 ? Verdict::sometimes : Verdict::never;
        if (lost == all && (x != 0 || y != 0 || z != 0)) always_.push_back({x, y, z});
      }
    }
  }
}

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

namespace {

// Whether an edge of a polygon is shared by exactly one other polygon, which runs along it in the other direction.
bool is_closed(const SceneSurface& surface, std::uint32_t polygon, std::size_t edge) {
  const std::uint32_t from = surface.corners(polygon)[edge], to = surface.corners(polygon)[(edge + 1) % 3];
  int others = 0, opposite = 0;
  surface.across_edge(polygon, edge, [&](std::uint32_t other) {
    const SceneSurface::Corners& c = surface.corners(other);
    ++others;
    for (std::size_t i = 0; i < 3; ++i) opposite += c[i] == to && c[(i + 1) % 3] == from ? 1 : 0;
  });
  return others == 1 && opposite == 1;
}

bool hides_backs(const Scene& scene, const SceneObject& object, const SceneSurface& surface) {
  double length = 0.0, open = 0.0, volume = 0.0;
  const glm::dvec3 origin = object.triangle_count > 0 ? surface.centroid(object.first_triangle) : glm::dvec3(0.0);
  for (std::uint32_t t = object.first_triangle; t < object.first_triangle + object.triangle_count; ++t) {
    if (surface.twice_area(t) <= 0.0) continue;
    const SceneSurface::Corners& c = surface.corners(t);
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const double own = glm::length(surface.position(c[(edge + 1) % 3]) - surface.position(c[edge]));
      length += own;
      if (!is_closed(surface, t, edge)) open += own;
    }
    volume += glm::dot(surface.position(c[0]) - origin, surface.normal(t)) * surface.twice_area(t);
  }
  if (open > kMostOpen * length || volume == 0.0) return false;
  return volume > 0.0 || winding_number(scene, object, scene.lights[0].position) <= kInsideRoom;
}

}  // namespace

std::vector<bool> find_hidden_backs(const Scene& scene, const SceneSurface& surface) {
  std::vector<bool> hidden;
  for (const SceneObject& object : scene.objects) hidden.push_back(hides_backs(scene, object, surface));
  return hidden;
}

}  // namespace ninebit
