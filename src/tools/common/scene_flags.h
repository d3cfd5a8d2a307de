// The flags that say which scene is rendered and how, for every verb that renders.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ninebit/scene/scene.h"
#include "ninebit/shadow/technique.h"
#include "src/system/parallel/parallel_loop.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

struct SceneFlags {
  std::string file;
  bool allow_outside = false;
  std::string technique = "index-cube";
  std::string size = "1024x768";
  std::string camera, look_at, light, light_type, light_target, floor = "auto";
  std::string bias, polygon_offset, cookie, light_rotate;
  std::optional<double> fov, spot_angle;
  RenderSettings settings;  // what stands in no text above; settings_of completes it
};

// The names of enumerators, as flags take them and JSON gives them.
template <class E>
using Names = std::vector<std::pair<std::string, E>>;
extern const Names<IndexFormat> kIndexFormats;
extern const Names<IndexScope> kIndexScopes;
extern const Names<DepthCubeBits> kDepthBits;
extern const Names<DepthEncoding> kDepthEncodings;

template <class E>
[[nodiscard]] std::string name_in(const Names<E>& names, E value) {
  for (const auto& [name, v] : names) {
    if (v == value) return name;
  }
  return {};
}

// Adds the scene's file as an argument or a flag of that name, and --allow-outside.
CLI::Option* add_scene_file(CLI::App& verb, const std::string& name, SceneFlags& flags);

// Adds the flags that say how it is rendered, and gives them.
std::vector<CLI::Option*> add_scene_flags(CLI::App& verb, SceneFlags& flags);

// Lets work of this scope use so many threads; 0: all.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);

 private:
  std::optional<ScopedThreadLimit> limit_;
};

// The settings of flags that were checked while they were parsed, but for the cookie, which render_scene reads.
[[nodiscard]] RenderSettings settings_of(const SceneFlags& flags, const CommonFlags& common);

// Gives a scene the camera, light and floor that the flags ask for.
[[nodiscard]] Result<Scene> complete_scene_of(const SceneFlags& flags, const RenderSettings& settings, Scene scene);

// Reads the scene and completes it. Unless quiet, stderr gets a line for each file that it names and that is missing.
[[nodiscard]] Result<Scene> load_scene(const SceneFlags& flags, const RenderSettings& settings, bool quiet);

// Renders it with the technique that the flags name, and with the cookie where they name one.
[[nodiscard]] Result<Rendering> render_scene(const SceneFlags& flags, const Scene& scene,
                                             const RenderSettings& settings, const Progress& progress);

}  // namespace ninebit::tools
