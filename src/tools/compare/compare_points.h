// The renderings that `ninebit compare` puts side by side: one per technique, or one per combination of --vary.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "src/tools/common/scene_flags.h"

namespace ninebit::tools {

struct CompareFlags {
  CommonFlags common;
  SceneFlags scene;
  std::string folder;
  std::vector<std::string> vary;            // each FLAG=VALUE,VALUE…
  std::vector<CLI::Option*> scene_options;  // those of add_scene_flags, and --profile
};

// One rendering, with the flags that `render` would get.
struct ComparedPoint {
  std::string name;                                           // unique: "index-cube", "index-step 1, map-size 256"
  std::vector<std::pair<std::string, std::string>> varied{};  // flag without dashes, value
  SceneFlags scene{};
  CommonFlags common{};
};

// A technique that is not compared.
struct LeftOut {
  std::string technique;
  std::string reason;
};

struct ComparedPoints {
  std::vector<ComparedPoint> points{};
  std::vector<LeftOut> left_out{};
};

// The most renderings, and the most pixels of all of them together: their pictures are part of the page.
inline constexpr std::size_t kMostCompared = 64;
inline constexpr std::size_t kMostComparedPixels = std::size_t{1} << 26;

// "point", "spot" or "directional".
[[nodiscard]] const char* light_kind_name(LightKind kind);

// The kinds of light that the scene may have: those that all techniques of --vary support; any without --vary.
// Throws CLI::ValidationError if there is none.
[[nodiscard]] LightKinds light_kinds_of(const CompareFlags& flags);

// The combinations of --vary, in the order of the lists, the last one fastest. Throws CLI::ValidationError for a flag
// that cannot be varied, a value that `render` would reject, and too many combinations.
[[nodiscard]] ComparedPoints varied_points(const CompareFlags& flags);

// A point for each technique that supports this light. The Diagnostic, wrong usage, names a given flag that none of
// them reads.
[[nodiscard]] Result<ComparedPoints> technique_points(const CompareFlags& flags, LightKind light);

}  // namespace ninebit::tools
