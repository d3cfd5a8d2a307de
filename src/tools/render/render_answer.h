// The answers of `ninebit render`: lines for people, one object for --json.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/shadow/ground_truth.h"
#include "src/tools/common/scene_flags.h"

namespace ninebit::tools {

struct RenderFlags {
  CommonFlags common;
  SceneFlags scene;
  std::string folder;
  std::string pick;
  std::string only;
  int turntable = 0;    // frames; 0: one picture
  int supersample = 1;  // samples per pixel, along each side
  bool ground_truth = false;
  bool check_order = false;
};

// A finished rendering. The scene and the rendering are present once the scene is rendered.
struct FinishedRender {
  RenderSettings settings;
  std::optional<Scene> scene{};
  std::optional<Rendering> rendering{};
  std::optional<GroundTruth> truth{};  // empty without --ground-truth, or if no shadows were drawn
  std::vector<std::string> ignored{};  // what the rendering leaves out
  std::vector<std::filesystem::path> files{};
  std::vector<std::filesystem::path> removed{};               // files of an earlier run that this one does not write
  std::vector<std::pair<std::string, std::string>> frames{};  // of --turntable: file and hash of its colour planes
  bool wrong_only = false;                                    // --only names a file that the rendering does not have
  double load_ms = 0.0, write_ms = 0.0, total_ms = 0.0;
};

// The summary for stderr: triangles, pixels, time; with IndexOrder::neighbour also the counts of the order, and with
// --ground-truth the errors by cause.
[[nodiscard]] std::string summary_text(const RenderFlags& flags, const FinishedRender& done);

// The polygon or object at the pixel of --pick. The rendering must have a picked index.
[[nodiscard]] std::string pick_text(const RenderFlags& flags, const FinishedRender& done);

// The object of --json.
[[nodiscard]] Json render_json(const RenderFlags& flags, const FinishedRender& done);

}  // namespace ninebit::tools
