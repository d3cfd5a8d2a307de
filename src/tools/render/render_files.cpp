#include "src/tools/render/render_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <system_error>

#include "ninebit/frame/pictures.h"
#include "ninebit/shadow/picture_files.h"
#include "src/system/stream.h"
#include "src/tools/common/given_pictures.h"
#include "src/tools/common/picture_hashes.h"

namespace ninebit::tools {

namespace {

constexpr std::size_t kLargestManifest = std::size_t{1} << 20;
constexpr std::size_t kMostNames = 10'000;

bool is_in(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string stem_of(const std::string& name) {
  return name.substr(0, name.rfind('.'));
}

// A name of a file in the folder itself.
bool is_plain(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos &&
         name.find('\0') == std::string::npos;
}

}  // namespace

Result<std::vector<std::string>> chosen_files(const Rendering& rendering, const std::string& only) {
  std::vector<std::string> names = file_names(rendering);
  if (only.empty()) return names;
  std::vector<std::string> chosen;
  for (std::size_t start = 0; start <= only.size();) {
    const std::size_t end = std::min(only.find(',', start), only.size());
    const std::string stem = only.substr(start, end - start);
    const std::size_t before = chosen.size();
    for (const std::string& name : names) {
      if (stem_of(name) == stem && !is_in(chosen, name)) chosen.push_back(name);
    }
    const bool known = std::any_of(names.begin(), names.end(), [&](const auto& name) { return stem_of(name) == stem; });
    if (chosen.size() == before && !known) {
      std::vector<std::string> stems;
      for (const std::string& name : names) {
        if (!is_in(stems, stem_of(name))) stems.push_back(stem_of(name));
      }
      return Diagnostic{.message = fmt::format("--only: '{}' is not a file of this rendering; expected {}", stem,
                                               fmt::join(stems, ", "))};
    }
    start = end + 1;
  }
  return chosen;
}

std::vector<std::string> earlier_files(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path path = folder / kManifest;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path, error))) return {};
  if (std::filesystem::file_size(path, error) > kLargestManifest || error) return {};
  const std::string text = posix::read_file(path, kLargestManifest, error);
  const nlohmann::json manifest = nlohmann::json::parse(text, nullptr, false);
  if (!manifest.is_object() || manifest.value("ninebit", nlohmann::json()) != "render") return {};
  const auto files = manifest.find("files");
  if (files == manifest.end() || !files->is_array() || files->size() > kMostNames) return {};
  std::vector<std::string> names;
  for (const nlohmann::json& name : *files) {
    if (!name.is_string() || !is_plain(name.get<std::string>())) return {};
    names.push_back(name.get<std::string>());
  }
  return names;
}

Status write_manifest(const std::vector<std::string>& names, StagedFiles& files) {
  const nlohmann::ordered_json manifest{{"ninebit", "render"}, {"version", 1}, {"files", names}};
  std::ofstream out(files.stage(kManifest), std::ios::binary);
  out << manifest.dump(2) << '\n' << std::flush;
  if (out) return {};
  return Diagnostic{
      .message = "cannot be written", .file = files.files().back().string(), .fault = Fault::cannot_write};
}

std::vector<std::filesystem::path> remove_earlier(const std::filesystem::path& folder,
                                                  const std::vector<std::string>& earlier,
                                                  const std::vector<std::string>& names) {
  std::vector<std::filesystem::path> removed;
  for (const std::string& name : earlier) {
    if (is_in(names, name) || name == kManifest) continue;
    const std::filesystem::path path = folder / name;
    std::error_code error;
    if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path, error))) continue;
    if (std::filesystem::remove(path, error)) removed.push_back(path);
  }
  return removed;
}

namespace {

glm::vec3 turned_about_y(const glm::vec3& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const glm::dvec3 d(v);
  return glm::vec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x);
}

}  // namespace

Camera turned(const Camera& camera, int number, int count) {
  if (number == 0) return camera;
  const double angle = 2.0 * std::numbers::pi * number / count;
  Camera out = camera;
  out.position = camera.look_at + turned_about_y(camera.position - camera.look_at, angle);
  out.up = turned_about_y(camera.up, angle);
  return out;
}

Status draw_turntable(const RenderFlags& flags, StagedFiles* files, const Progress& step, FinishedRender& done) {
  Scene scene = *done.scene;
  const Camera first = scene.cameras[0];
  const int digits = flags.turntable > 1000 ? 4 : 3;
  for (int i = 0; i < flags.turntable; ++i) {
    scene.cameras[0] = turned(first, i, flags.turntable);
    const auto progress = [&](std::string_view, double share) {
      return step(fmt::format("frame {} of {}", i + 1, flags.turntable), (i + share) / flags.turntable);
    };
    auto rendering = render_scene(flags.scene, scene, done.settings, progress);
    if (!rendering) return rendering.error();
    const std::string name = fmt::format("color_{:0{}}.png", i, digits);
    Image8 picture = averaged(color_picture(*rendering), flags.supersample);
    const Status written = files != nullptr ? write_png(files->stage(name), picture) : Status();
    if (!written) {
      Diagnostic fault = written.error();
      fault.file = files->files().back().string();
      return fault;
    }
    give_picture("frames", std::move(picture));
    done.frames.push_back({name, picture_hashes(*rendering)[0].second});
    if (i == 0) done.rendering.emplace(std::move(*rendering));
  }
  return {};
}

}  // namespace ninebit::tools
