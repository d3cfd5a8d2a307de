// Small scenes whose shadows are known by formula.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <glm/glm.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ninebit/scene/scene.h"
#include "ninebit/shadow/technique.h"

namespace shadow_test {

// An empty scene with one white material, one camera and one light.
ninebit::Scene scene_with(const glm::vec3& camera, const glm::vec3& look_at, const glm::vec3& light);

// Adds an object of two triangles; corners counter-clockwise seen from the front.
void add_quad(ninebit::Scene& scene, const std::string& name, const std::array<glm::vec3, 4>& corners);

// Adds a closed box, faces outward.
void add_box(ninebit::Scene& scene, const std::string& name, const glm::vec3& low, const glm::vec3& high);

// A level floor of side 2 * half at y = 0 and a level square of side 2 at y = 1 above its middle, lit from (0, 3, 0):
// the shadow on the floor is the square |x|, |z| < 1.5. The camera stands to the side and sees both.
ninebit::Scene square_over_floor(float half = 4.0F);

// The layers of the index comparison, copied out of a rendering; throws where one is missing.
struct ComparisonLayers {
  std::array<std::vector<ninebit::s9>, 4> primary, texture0, spare0, spare1;
  std::vector<ninebit::s9> output_alpha;
  std::vector<std::uint32_t> polygon, object;

  // The code numbers of a pixel: its polygon's own, and the one that was fetched from the map.
  [[nodiscard]] std::uint32_t own(const ninebit::IndexCodes& codes, std::size_t pixel) const;
  [[nodiscard]] std::uint32_t fetched(const ninebit::IndexCodes& codes, std::size_t pixel) const;
};
ComparisonLayers comparison_layers(const ninebit::Rendering& rendering);

// The samples of a layer or map; throws where it is missing.
template <class Sample>
const std::vector<Sample>& samples_of(const std::deque<ninebit::Layer>& layers, const std::string& part,
                                      const std::string& channel) {
  for (const ninebit::Layer& layer : layers) {
    if (layer.part == part && layer.channel == channel) return std::get<std::vector<Sample>>(layer.samples);
  }
  throw std::runtime_error("no layer " + part + "." + channel);
}

// A fact of that type that a rendering counted or measured; throws if it is missing.
template <class T>
const T& fact(const ninebit::Rendering& rendering, const std::string& name) {
  for (const ninebit::Fact& f : rendering.facts) {
    if (f.name == name) return std::get<T>(f.value);
  }
  throw std::runtime_error("no fact " + name);
}

// Renders by a technique; throws where that fails.
ninebit::Rendering render_by(std::string_view technique, const ninebit::Scene& scene,
                             const ninebit::RenderSettings& settings);

// Renders by index-cube. The default settings are those of the tests: small.
ninebit::Rendering render(const ninebit::Scene& scene, const ninebit::RenderSettings& settings);
ninebit::RenderSettings small_settings();

// Calls visit(x, y, index) for every pixel of a frame, rows from the lowest up.
template <class Visit>
void for_each_pixel(const ninebit::RenderSettings& settings, const Visit& visit) {
  for (int y = 0; y < settings.height; ++y) {
    for (int x = 0; x < settings.width; ++x) visit(x, y, static_cast<std::size_t>(y * settings.width + x));
  }
}

// The world point that the centre of pixel (x, y), rows from the lowest up, shows on the level plane y = height.
glm::vec3 on_plane(const ninebit::Scene& scene, const ninebit::RenderSettings& settings, int x, int y, float height);

}  // namespace shadow_test
