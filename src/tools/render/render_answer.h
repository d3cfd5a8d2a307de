// The answers of `ninebit render`: lines for people, one object for --json.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/image/staged_files.h"
#include "ninebit/numerics/result.h"
#include "ninebit/shadow/ground_truth.h"
#include "ninebit/shadow/technique.h"
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
  std::vector<CLI::Option*> scene_options{};  // those of add_scene_flags, and --profile
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

// The summary for people: triangles, pixels, time; with IndexOrder::neighbour also the counts of the order, and with
// --ground-truth the errors by cause.
[[nodiscard]] std::string summary_text(const RenderFlags& flags, const FinishedRender& done);

// The polygon or object at the pixel of --pick. The rendering must have a picked index.
[[nodiscard]] std::string pick_text(const RenderFlags& flags, const FinishedRender& done);

// The object of --json.
[[nodiscard]] Json render_json(const RenderFlags& flags, const FinishedRender& done);

// The files of a rendering: which are written, and the manifest that names them for the next run.

// The name of the manifest.
inline constexpr const char* kManifest = "render.json";

// The names of the files that --only asks for, a list such as "color,index_cube"; all of them if it is empty. Reports a
// name that the rendering does not have, with those that it has.
[[nodiscard]] Result<std::vector<std::string>> chosen_files(const Rendering& rendering, const std::string& only);

// The files that the manifest of an earlier run in this folder names. Empty without a manifest, and for one that is not
// valid: then no file is removed.
[[nodiscard]] std::vector<std::string> earlier_files(const std::filesystem::path& folder);

// Stages the manifest of these names.
[[nodiscard]] Status write_manifest(const std::vector<std::string>& names, StagedFiles& files);

// Removes those of the earlier files that are not among the new ones. Only regular files are removed; a file that
// cannot be removed stays. Returns the paths of the removed files.
std::vector<std::filesystem::path> remove_earlier(const std::filesystem::path& folder,
                                                  const std::vector<std::string>& earlier,
                                                  const std::vector<std::string>& names);

// `ninebit render --turntable`: pictures from all around.

// The most frames of --turntable.
inline constexpr int kMostFrames = 3600;

// The camera of frame `number` of `count`: turned about the vertical axis through the point that it looks at, counter-
// clockwise as seen from above. Frame 0 is the camera itself.
[[nodiscard]] Camera turned(const Camera& camera, int number, int count);

// Renders the frames of --turntable and stages color_000.png and so on. The light stays where it is. The rendering of
// frame 0 stays in `done`. Without `files` the pictures go to the host alone. `step` is called with the share of the
// work that is done; false ends it.
[[nodiscard]] Status draw_turntable(const RenderFlags& flags, StagedFiles* files, const Progress& step,
                                    FinishedRender& done);

}  // namespace ninebit::tools
