#include "combiner_tests/shadow/cookie_support.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "combiner_tests/shadow/support.h"
#include "ninebit/image/texture_io.h"
#include "src/image/texture/texture_file.h"

namespace shadow_test {
namespace {

using ninebit::RenderSettings;
using ninebit::Scene;

constexpr double kPi = 3.14159265358979323846;
const glm::vec3 kLow(-4.0F, -3.0F, -5.0F), kHigh(5.0F, 4.0F, 3.0F);

// The camera's axes, the picture's half height one in front of it, and its shape.
struct View {
  glm::dvec3 eye, forward, right, up;
  double tangent = 0.0, aspect = 0.0;
};

View view_of(const Scene& scene, const RenderSettings& settings) {
  const ninebit::Camera& camera = scene.cameras[0];
  View view;
  view.eye = camera.position;
  view.forward = glm::normalize(glm::dvec3(camera.look_at) - view.eye);
  view.right = glm::normalize(glm::cross(view.forward, glm::dvec3(camera.up)));
  view.up = glm::cross(view.right, view.forward);
  view.tangent = std::tan(static_cast<double>(camera.vertical_fov_degrees) * kPi / 360.0);
  view.aspect = static_cast<double>(settings.width) / settings.height;
  return view;
}

}  // namespace

Scene walls_around_light(int seen) {
  const glm::vec3 eye(0.4F, 0.1F, -0.9F);
  glm::vec3 look(0.2F, -0.1F, 0.15F);
  look[seen / 2] = seen % 2 == 0 ? 1.0F : -1.0F;
  Scene scene = scene_with(eye, eye + look, {0.5F, 0.25F, -0.5F});
  scene.cameras[0].vertical_fov_degrees = 90.0F;
  const auto corner = [](int x, int y, int z) {
    return glm::vec3(x != 0 ? kHigh.x : kLow.x, y != 0 ? kHigh.y : kLow.y, z != 0 ? kHigh.z : kLow.z);
  };
  add_quad(scene, "+X", {corner(1, 0, 0), corner(1, 0, 1), corner(1, 1, 1), corner(1, 1, 0)});
  add_quad(scene, "-X", {corner(0, 0, 1), corner(0, 0, 0), corner(0, 1, 0), corner(0, 1, 1)});
  add_quad(scene, "+Y", {corner(0, 1, 0), corner(1, 1, 0), corner(1, 1, 1), corner(0, 1, 1)});
  add_quad(scene, "-Y", {corner(0, 0, 1), corner(1, 0, 1), corner(1, 0, 0), corner(0, 0, 0)});
  add_quad(scene, "+Z", {corner(1, 0, 1), corner(0, 0, 1), corner(0, 1, 1), corner(1, 1, 1)});
  add_quad(scene, "-Z", {corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0)});
  return scene;
}

glm::dvec3 on_wall(const Scene& scene, const RenderSettings& settings, int x, int y, int wall) {
  const View view = view_of(scene, settings);
  const double sx = ((x + 0.5) / settings.width * 2.0 - 1.0) * view.tangent * view.aspect;
  const double sy = ((y + 0.5) / settings.height * 2.0 - 1.0) * view.tangent;
  const glm::dvec3 ray = view.forward + view.right * sx + view.up * sy;
  const int axis = wall / 2;
  const double plane = static_cast<double>(wall % 2 == 0 ? kHigh[axis] : kLow[axis]);
  return view.eye + ray * ((plane - view.eye[axis]) / ray[axis]);
}

glm::ivec2 pixel_of(const Scene& scene, const RenderSettings& settings, const glm::dvec3& point) {
  const View view = view_of(scene, settings);
  const glm::dvec3 ray = point - view.eye;
  const double depth = glm::dot(ray, view.forward);
  const double sx = glm::dot(ray, view.right) / depth / view.tangent / view.aspect;
  const double sy = glm::dot(ray, view.up) / depth / view.tangent;
  return {static_cast<int>(std::floor((sx + 1.0) / 2.0 * settings.width)),
          static_cast<int>(std::floor((sy + 1.0) / 2.0 * settings.height))};
}

CubePlace cube_place(const glm::dvec3& r) {
  const double x = std::fabs(r.x), y = std::fabs(r.y), z = std::fabs(r.z);
  double sc, tc, ma;
  int face;
  if (x >= y && x >= z) {
    face = r.x > 0 ? 0 : 1;
    sc = r.x > 0 ? -r.z : r.z;
    tc = -r.y;
    ma = x;
  } else if (y >= z) {
    face = r.y > 0 ? 2 : 3;
    sc = r.x;
    tc = r.y > 0 ? r.z : -r.z;
    ma = y;
  } else {
    face = r.z > 0 ? 4 : 5;
    sc = r.z > 0 ? r.x : -r.x;
    tc = -r.y;
    ma = z;
  }
  return {face, (sc / ma + 1.0) / 2.0, (tc / ma + 1.0) / 2.0};
}

glm::dvec3 in_light_space(glm::dvec3 d, const glm::dvec3& degrees) {
  // The last rotation is undone first: z, y, x.
  for (const int axis : {2, 1, 0}) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double angle = -degrees[axis] * kPi / 180.0;
    const double turned_u = d[u] * std::cos(angle) - d[v] * std::sin(angle);
    d[v] = d[u] * std::sin(angle) + d[v] * std::cos(angle);
    d[u] = turned_u;
  }
  return d;
}

std::shared_ptr<const ninebit::Texture> labels() {
  // As the program reads it, without linking OpenImageIO; a DDS file needs no other reader.
  const auto read = ninebit::image_detail::read_texture(ninebit::profiles::geforce2,
                                                        NINEBIT_SOURCE_DIR "/scenes/cookies/labels.dds", {}, {});
  if (!read) throw std::runtime_error(read.error().text());
  return std::make_shared<ninebit::Texture>(*read);
}

std::optional<std::array<int, 3>> even_texel(const ninebit::Texture& cookie, const glm::dvec3& direction) {
  const CubePlace place = cube_place(direction);
  const ninebit::TextureImage& image = cookie.faces[static_cast<std::size_t>(place.face)][0];
  const auto& planes = std::get<std::array<ninebit::Plane<const std::uint8_t>, 4>>(image.planes);
  const int x = static_cast<int>(place.s * image.width), y = static_cast<int>(place.t * image.height);
  // The next face begins within a texel.
  if (std::min(x, y) < 1 || std::max(x, y) > image.width - 2) return std::nullopt;
  std::optional<std::array<int, 3>> color;
  for (int v = y - 1; v <= y + 1; ++v) {
    for (int u = x - 1; u <= x + 1; ++u) {
      std::array<int, 3> here{};
      for (std::size_t c = 0; c < 3; ++c) here[c] = planes[c].at(u, v);
      if (color && *color != here) return std::nullopt;
      color = here;
    }
  }
  return color;
}

RenderSettings cookie_settings() {
  RenderSettings settings = small_settings();
  settings.light_cookie = {.cookie = labels(), .shadows = false};
  return settings;
}

ninebit::Rendering render_cookie(const Scene& scene, const RenderSettings& settings) {
  return render_by("light-cookie", scene, settings);
}

const std::vector<ninebit::s9>& codes_of(const ninebit::Rendering& rendering, const std::string& part, char channel) {
  return samples_of<ninebit::s9>(rendering.layers, part, std::string(1, channel));
}

}  // namespace shadow_test
