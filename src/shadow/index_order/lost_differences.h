// The differences of two index codes that a comparison loses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/frame/index_codes.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene.h"
#include "src/shadow/index_order/patches.h"

namespace ninebit {

// The bytes of a code in the channels of its format, or a difference of two codes. Channels that the format does not
// have are 0.
using CodeBytes = std::array<int, 3>;

[[nodiscard]] constexpr CodeBytes difference(const CodeBytes& a, const CodeBytes& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// The number of channels of a format: 3, 2 or 1.
[[nodiscard]] int channels_of(IndexFormat format);

// The code's number in IndexCodes(1, format).
[[nodiscard]] std::uint32_t code_number(const CodeBytes& code);

// A table of differences, measured by evaluation: the comparison runs as a program of register combiners, and a
// difference is lost where the alpha that leaves them is byte 0. Which differences are lost depends on the profile, the
// format and the scales. Where the register bits are fewer than the code's, it also depends on the codes.
class LostDifferences {
 public:
  // Reports what index_comparison_state reports.
  [[nodiscard]] static Result<LostDifferences> measure(const HardwareProfile& profile, IndexFormat format,
                                                       IndexScales scales);

  [[nodiscard]] int channels() const { return channels_; }
  // The largest component of a difference that any pair of codes loses; 0: all differences are found.
  [[nodiscard]] int radius() const { return radius_; }
  // Whether every pair of codes with this difference compares equal.
  [[nodiscard]] bool always(const CodeBytes& d) const { return within(d) && verdict_[place(d)] == Verdict::always; }
  // Whether no pair of codes with this difference compares equal.
  [[nodiscard]] bool never(const CodeBytes& d) const { return !within(d) || verdict_[place(d)] == Verdict::never; }
  // All differences but 0 that are always lost.
  [[nodiscard]] const std::vector<CodeBytes>& all_always() const { return always_; }

 private:
  enum class Verdict : std::uint8_t { never, sometimes, always };
  class Comparison;

  explicit LostDifferences(int channels) : channels_(channels) {}
  void find_radius(const Comparison& comparison);
  void judge(const Comparison& comparison);

  [[nodiscard]] bool within(const CodeBytes& d) const {
    const auto in = [this](int v) { return v >= -radius_ && v <= radius_; };
    return in(d[0]) && in(d[1]) && in(d[2]);
  }
  [[nodiscard]] std::size_t place(const CodeBytes& d) const {
    const int side = 2 * radius_ + 1;
    return static_cast<std::size_t>(((d[2] + radius_) * side + d[1] + radius_) * side + d[0] + radius_);
  }

  int channels_;
  int radius_ = 0;
  std::vector<Verdict> verdict_{Verdict::always};
  std::vector<CodeBytes> always_;
};

// Whether two patches of a scene can shadow one another.

// How far a patch may rise in front of another one and count as unable to shadow it, as a part of the scene's diagonal.
// At 256 texels across the scene this is one texel.
inline constexpr double kShadowRelief = 1.0 / 256.0;

// Answers from planes and corners alone, for points that face the light. A polygon shadows such a point only if a part
// of it lies in front of the point's plane; and if it faces the light too, only if the point lies behind its own plane.
// The answer may be a needless "yes": also for pairs of large patches, whose planes and corners are too many to
// compare.
class ShadowRelation {
 public:
  // back_is_hidden: for each patch, whether only polygons that face the light get into the map (find_hidden_backs). All
  // must outlive the object.
  ShadowRelation(const SceneSurface& surface, const Patches& patches, const std::vector<bool>& back_is_hidden)
      : surface_(surface),
        patches_(patches),
        back_is_hidden_(back_is_hidden),
        relief_(kShadowRelief * surface.diagonal()) {}

  // Whether one of two different patches may shadow the other by more than kShadowRelief. Remembers its answers.
  [[nodiscard]] bool may_shadow(std::uint32_t a, std::uint32_t b);

 private:
  [[nodiscard]] bool decide(std::uint32_t a, std::uint32_t b) const;
  // Whether a part of `patch` lies more than the relief in front of a plane of `other` (side 1) or behind one (-1).
  [[nodiscard]] bool reaches(std::uint32_t patch, std::uint32_t other, double side) const;
  [[nodiscard]] bool occludes(std::uint32_t occluder, std::uint32_t receiver) const {
    return reaches(occluder, receiver, 1.0) && (!back_is_hidden_[occluder] || reaches(receiver, occluder, -1.0));
  }

  const SceneSurface& surface_;
  const Patches& patches_;
  const std::vector<bool>& back_is_hidden_;
  double relief_;
  std::unordered_map<std::uint64_t, bool> known_;
};

// Objects whose back sides the light never sees first.

// For each object of the scene, whether a ray from the light always meets the front of one of its polygons before the
// back of another: solids that face outward, and rooms that face inward with the light inside. In the light's map,
// their polygons then face the light, except beside an edge. An object with edges that are not shared by two polygons
// counts as closed while these edges have at most kMostOpen of the length of all edges. The scene has a light.
[[nodiscard]] std::vector<bool> find_hidden_backs(const Scene& scene, const SceneSurface& surface);

inline constexpr double kMostOpen = 0.02;
// A light with this winding number or less is inside a room that faces inward; -1: entirely.
inline constexpr double kInsideRoom = -0.75;

}  // namespace ninebit
