#include "src/tools/render/turntable.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "ninebit/frame/pictures.h"
#include "src/tools/common/given_pictures.h"
#include "src/tools/common/rendering_answer.h"

namespace ninebit::tools {
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
