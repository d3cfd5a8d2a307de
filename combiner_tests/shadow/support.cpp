#include "combiner_tests/shadow/support.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace shadow_test {

using ninebit::Scene;

Scene scene_with(const glm::vec3& camera, const glm::vec3& look_at, const glm::vec3& light) {
  Scene scene;
  scene.name = "test";
  scene.materials.push_back({"white", glm::vec3(1.0F)});
  scene.cameras.push_back({.position = camera, .look_at = look_at});
  scene.lights.push_back({.name = "light", .position = light, .color = glm::vec3(1.0F)});
  return scene;
}

void add_quad(Scene& scene, const std::string& name, const std::array<glm::vec3, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  for (const glm::vec3& corner : corners) {
    scene.positions.push_back(corner);
    scene.normals.push_back(normal);
  }
  const auto object = static_cast<std::uint32_t>(scene.objects.size());
  scene.objects.push_back({name, static_cast<std::uint32_t>(scene.triangles.size()), 2});
  scene.triangles.emplace_back(first, first + 1, first + 2);
  scene.triangles.emplace_back(first, first + 2, first + 3);
  scene.triangle_object.insert(scene.triangle_object.end(), 2, object);
  scene.triangle_material.insert(scene.triangle_material.end(), 2, 0);
}

void add_box(Scene& scene, const std::string& name, const glm::vec3& low, const glm::vec3& high) {
  const auto corner = [&](int x, int y, int z) {
    return glm::vec3(x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z);
  };
  const std::size_t first_object = scene.objects.size();
  const auto first_triangle = static_cast<std::uint32_t>(scene.triangles.size());
  add_quad(scene, name, {corner(1, 0, 1), corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1)});
  add_quad(scene, name, {corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0)});
  add_quad(scene, name, {corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), corner(0, 1, 0)});
  add_quad(scene, name, {corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)});
  add_quad(scene, name, {corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)});
  add_quad(scene, name, {corner(1, 0, 0), corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0)});
  scene.objects.resize(first_object);
  scene.objects.push_back({name, first_triangle, 12});
  for (std::size_t t = first_triangle; t < scene.triangles.size(); ++t) {
    scene.triangle_object[t] = static_cast<std::uint32_t>(first_object);
  }
}

Scene square_over_floor(float half) {
  Scene scene = scene_with({1.0F, 5.0F, 7.0F}, {0.0F, 0.5F, 0.0F}, {0.0F, 3.0F, 0.0F});
  add_quad(scene, "floor", {{{-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}}});
  add_quad(scene, "square", {{{-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1}}});
  return scene;
}

ComparisonLayers comparison_layers(const ninebit::Rendering& rendering) {
  const auto samples = [&](const std::string& part, const std::string& channel) -> const auto& {
    for (const ninebit::Layer& layer : rendering.layers) {
      if (layer.part == part && layer.channel == channel) return layer.samples;
    }
    throw std::runtime_error("no layer " + part + "." + channel);
  };
  using Codes = std::vector<ninebit::s9>;
  using Numbers = std::vector<std::uint32_t>;
  ComparisonLayers out;
  for (std::size_t c = 0; c < 4; ++c) {
    const std::string channel(1, "RGBA"[c]);
    out.primary[c] = std::get<Codes>(samples("primary", channel));
    out.texture0[c] = std::get<Codes>(samples("texture0", channel));
    out.spare0[c] = std::get<Codes>(samples("spare0", channel));
    out.spare1[c] = std::get<Codes>(samples("spare1", channel));
  }
  out.output_alpha = std::get<Codes>(samples("output", "A"));
  out.polygon = std::get<Numbers>(samples("polygon", "polygon"));
  out.object = std::get<Numbers>(samples("object", "object"));
  return out;
}

namespace {

std::uint32_t number_in(const ninebit::IndexCodes& codes, const std::array<std::vector<ninebit::s9>, 4>& planes,
                        std::size_t pixel) {
  ninebit::ColorBytes color;
  for (std::size_t c = 0; c < 4; ++c) color[c] = static_cast<std::uint8_t>(planes[c][pixel]);
  return codes.number(color);
}

}  // namespace

std::uint32_t ComparisonLayers::own(const ninebit::IndexCodes& codes, std::size_t pixel) const {
  return number_in(codes, primary, pixel);
}

std::uint32_t ComparisonLayers::fetched(const ninebit::IndexCodes& codes, std::size_t pixel) const {
  return number_in(codes, texture0, pixel);
}

ninebit::RenderSettings small_settings() {
  ninebit::RenderSettings settings;
  settings.width = 200;
  settings.height = 150;
  settings.map_size = 256;
  settings.layers = true;
  return settings;
}

ninebit::Rendering render_by(std::string_view technique, const Scene& scene, const ninebit::RenderSettings& settings) {
  auto result = ninebit::find_technique(technique)->render(scene, settings, {});
  if (!result) throw std::runtime_error(result.error().text());
  return std::move(*result);
}

ninebit::Rendering render(const Scene& scene, const ninebit::RenderSettings& settings) {
  return render_by("index-cube", scene, settings);
}

glm::vec3 on_plane(const Scene& scene, const ninebit::RenderSettings& settings, int x, int y, float height) {
  const ninebit::Camera& camera = scene.cameras[0];
  const glm::dvec3 eye(camera.position);
  const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.look_at) - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
  const glm::dvec3 up = glm::cross(right, forward);
  const double tangent = std::tan(camera.vertical_fov_degrees * 3.14159265358979323846 / 360.0);
  const double aspect = static_cast<double>(settings.width) / settings.height;
  const double sx = ((x + 0.5) / settings.width * 2.0 - 1.0) * tangent * aspect;
  const double sy = ((y + 0.5) / settings.height * 2.0 - 1.0) * tangent;
  const glm::dvec3 ray = forward + right * sx + up * sy;
  return glm::vec3(eye + ray * ((height - eye.y) / ray.y));
}

}  // namespace shadow_test
