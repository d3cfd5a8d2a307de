// A room around a light, and what a cube map says of its walls: by the extension's table and by trigonometry, without a
// line of src/.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/raster/texture.h"
#include "ninebit/shadow/technique.h"

namespace shadow_test {

// A white box of six walls that face inward, in the order +X -X +Y -Y +Z -Z, an object each; the light is inside, off
// the middle, and the camera sees the wall of that number.
ninebit::Scene walls_around_light(int seen);

// The world point of a wall of that scene which the centre of a pixel shows, rows from the lowest up.
glm::dvec3 on_wall(const ninebit::Scene& scene, const ninebit::RenderSettings& settings, int x, int y, int wall);

// The pixel that shows a point; its rows count from the lowest up.
glm::ivec2 pixel_of(const ninebit::Scene& scene, const ninebit::RenderSettings& settings, const glm::dvec3& point);

// Where a direction meets a cube map, by the major-axis table of ARB_texture_cube_map: face, s and t.
struct CubePlace {
  int face = 0;
  double s = 0.0;
  double t = 0.0;
};
CubePlace cube_place(const glm::dvec3& r);

// A direction of the world in the space of a light that was turned about x, then y, then z.
glm::dvec3 in_light_space(glm::dvec3 direction, const glm::dvec3& degrees);

// scenes/cookies/labels.dds; throws where it cannot be read.
std::shared_ptr<const ninebit::Texture> labels();

// Red, green and blue of the texel in which a direction ends, or nothing where the texels about it differ or the face
// ends.
std::optional<std::array<int, 3>> even_texel(const ninebit::Texture& cookie, const glm::dvec3& direction);

// The settings of the tests: small, with layers and the cube of labels, without shadows.
ninebit::RenderSettings cookie_settings();

// Renders with light-cookie; throws where that fails.
ninebit::Rendering render_cookie(const ninebit::Scene& scene, const ninebit::RenderSettings& settings);

// The samples of one layer; throws where there is none.
const std::vector<ninebit::s9>& codes_of(const ninebit::Rendering& rendering, const std::string& part, char channel);

}  // namespace shadow_test
