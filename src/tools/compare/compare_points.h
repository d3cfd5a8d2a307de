// The renderings that `ninebit compare` puts side by side: one per technique, or one per combination of --vary.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/shadow/ground_truth.h"
#include "ninebit/shadow/technique.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/common/trace_command.h"
#include "src/tools/input/host.h"

namespace ninebit::tools {

struct CompareFlags {
  CommonFlags common;
  SceneFlags scene;
  std::string folder;
  std::string sheet;                        // a PNG file; empty: none
  std::vector<std::string> vary;            // each FLAG=VALUE,VALUE…
  std::vector<CLI::Option*> scene_options;  // those of add_scene_flags, and --profile

  enum class Traces { none, one_of_cause, all } traces = Traces::none;  // that the page has of the listed pixels

  [[nodiscard]] bool makes_page() const { return !folder.empty() || host() != nullptr; }
};

// One rendering, with the flags that `render` would get.
struct ComparedPoint {
  std::string name;                                           // unique: "index-cube", "index-step 1, map-size 256"
  std::vector<std::pair<std::string, std::string>> varied{};  // flag without dashes, value
  SceneFlags scene{};
  CommonFlags common{};
  std::vector<std::string> arguments{};  // the flags that it was parsed from
  bool as_point = false;                 // the scene's spot light is drawn as a point light at its place
  bool exact = false;                    // with exact combiners: --vary arithmetic=exact
};

// The settings of its rendering.
[[nodiscard]] RenderSettings settings_of(const ComparedPoint& point);

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

// The most renderings on a page that has the traces of all listed pixels; beyond, it has one of each cause.
inline constexpr std::size_t kMostFullyTraced = 8;

// "point", "spot" or "directional".
[[nodiscard]] const char* light_kind_name(LightKind kind);

// The kinds of light that the scene may have: those that all techniques of --vary support; any without --vary. If there
// is none, a spot light, where those without support for it support a point light. Throws CLI::ValidationError if that
// is not so, either.
[[nodiscard]] LightKinds light_kinds_of(const CompareFlags& flags);

// The combinations of --vary, in the order of the lists, the last one fastest. Throws CLI::ValidationError for a flag
// that cannot be varied, a value that `render` would reject, and too many combinations.
[[nodiscard]] ComparedPoints varied_points(const CompareFlags& flags);

// A point for each technique that supports this light or, if it is a spot that `holds_picture`, a point light. The
// Diagnostic, wrong usage, names a given flag that none of them reads.
[[nodiscard]] Result<ComparedPoints> technique_points(const CompareFlags& flags, LightKind light, bool holds_picture);

// Whether the scene's light, a spot, reaches all that the picture shows: for the camera it is a point light then.
[[nodiscard]] Result<bool> spot_holds_picture(const CompareFlags& flags, const Scene& scene);

// The rows of `ninebit compare`: each point rendered, judged by rays and measured.

// The wrong pixels of a rendering.
struct ComparedErrors {
  std::uint64_t false_lit = 0, false_shadowed = 0;
  std::vector<std::pair<std::string, std::uint64_t>> by_cause{};  // the causes that are possible
  std::vector<WrongPixelTrace> worst{};
};

struct ComparedRow {
  std::string refused{};  // why the technique cannot draw the scene; empty: it was drawn
  LightKind light = LightKind::point;
  std::uint64_t background = 0, lit = 0, shadowed = 0;
  std::optional<ComparedErrors> errors{};                     // empty if no shadows were drawn
  PassTimes times{};                                          // of a rendering that is not judged
  std::vector<DrawnPass> drawn{};                             // as Rendering::drawn
  std::uint64_t map_bytes = 0;                                // as Rendering::map_bytes
  std::vector<std::pair<std::string, std::string>> hashes{};  // as picture_hashes
  std::string color{};                                        // the picture as PNG
  std::string wrong{};  // as PNG, grey: 0, or the number of an ErrorCause, plus 128 if the pixel is falsely lit
  Image8 picture{}, error_picture{};  // the picture, and error_picture() of it, if the flags want a sheet
};

// Everything that a comparison found.
struct Comparison {
  ComparedPoints compared{};
  std::vector<ComparedRow> rows{};  // one per point
  std::vector<std::string> ignored{};
  std::string light{};  // "point light at 1, 2, 3"
  bool spot_holds_picture = false;
  int width = 0, height = 0;
  std::size_t triangles = 0;
};

// Renders, judges and measures one point. A scene or a setting that the technique cannot draw is a row with the reason.
[[nodiscard]] Result<ComparedRow> compared_row(const CompareFlags& flags, const ComparedPoint& point,
                                               const Scene& scene, const GroundTruthScene& rays,
                                               const Progress& progress);

[[nodiscard]] double total_ms(const PassTimes& times);

// The object of --json and report.json.
[[nodiscard]] Json compare_json(const CompareFlags& flags, const Comparison& comparison);

}  // namespace ninebit::tools
