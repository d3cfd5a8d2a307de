// The scene flags, shared by all verbs that render.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ninebit/scene/scene.h"
#include "ninebit/scene/scene_io.h"
#include "ninebit/shadow/technique.h"
#include "src/system/parallel/parallel_loop.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

struct SceneFlags {
  std::string file;
  bool allow_outside = false;
  std::string up;  // "y", "z" or empty: as the file says
  std::string technique = "index-cube";
  std::string size = "1024x768";
  std::string camera, look_at, light, light_type, light_target, floor = "auto";
  std::string cookie;
  std::optional<double> fov, spot_angle;
  std::optional<LightKinds> light_kinds;  // empty: those of the technique; without effect if light_type is given
  RenderSettings settings;                // all that the texts above do not hold; settings_of() completes it
};

// Adds --up.
void add_up_flag(CLI::App& verb, std::string& up);
// The axis of --up; empty: not given.
[[nodiscard]] std::optional<UpAxis> up_axis_of(const std::string& up);

// Adds the scene's file as an argument or flag of that name, and --allow-outside.
CLI::Option* add_scene_file(CLI::App& verb, const std::string& name, SceneFlags& flags);

// Adds all other scene flags and returns them.
std::vector<CLI::Option*> add_scene_flags(CLI::App& verb, SceneFlags& flags);

// The kind of --light-type; empty: not given.
[[nodiscard]] std::optional<LightKind> given_light_kind(const SceneFlags& flags);

// Limits the work of its scope to so many threads; 0: all.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);

 private:
  std::optional<ScopedThreadLimit> limit_;
};

// The settings of parsed flags, without the cookie, which render_scene reads.
[[nodiscard]] RenderSettings settings_of(const SceneFlags& flags, const CommonFlags& common);

// Adds the camera, light and floor of the flags to a scene.
[[nodiscard]] Result<Scene> complete_scene_of(const SceneFlags& flags, const RenderSettings& settings, Scene scene);

// Reads the scene's file.
[[nodiscard]] Result<Scene> read_scene_of(const SceneFlags& flags);

// Reads the scene, without its textures, and completes it. Prints one warning that names what the reader ignores.
[[nodiscard]] Result<Scene> load_scene(const SceneFlags& flags, const RenderSettings& settings);

// Renders the scene with the technique and the cookie of the flags.
[[nodiscard]] Result<Rendering> render_scene(const SceneFlags& flags, const Scene& scene,
                                             const RenderSettings& settings, const Progress& progress);

}  // namespace ninebit::tools
