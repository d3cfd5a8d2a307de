#include "src/frame/vanished_polygons.h"

#include <cmath>
#include <cstddef>

#include "ninebit/raster/texture.h"

namespace ninebit {
namespace {

// On a face of side 2. A smaller area may be the rounding error of a polygon that the light sees edge-on.
constexpr double kLeastArea = 1e-12;

// A convex polygon that clipping a triangle against five planes can make.
struct Polygon {
  std::array<glm::dvec3, 8> corners;
  std::size_t count = 0;
  void add(const glm::dvec3& corner) { corners[count++] = corner; }
};

// The part of a polygon where dot(plane, p) >= least.
Polygon clip(const Polygon& polygon, const glm::dvec3& plane, double least) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const glm::dvec3 &a = polygon.corners[i], &b = polygon.corners[(i + 1) % polygon.count];
    const double da = glm::dot(plane, a) - least, db = glm::dot(plane, b) - least;
    if (da >= 0.0) kept.add(a);
    if ((da >= 0.0) != (db >= 0.0)) kept.add(a + (b - a) * (da / (da - db)));
  }
  return kept;
}

// The area on a face of side 2, from positions in the face's axes: s, t, and the distance along the major axis.
double area_on_face(Polygon polygon, double near_plane) {
  polygon = clip(polygon, {0.0, 0.0, 1.0}, near_plane);
  for (const double side : {-1.0, 1.0}) {
    polygon = clip(polygon, {side, 0.0, 1.0}, 0.0);
    polygon = clip(polygon, {0.0, side, 1.0}, 0.0);
  }
  double twice = 0.0;
  for (std::size_t i = 2; i < polygon.count; ++i) {
    const auto at = [&](std::size_t k) { return glm::dvec2(polygon.corners[k]) / polygon.corners[k].z; };
    const glm::dvec2 u = at(i - 1) - at(0), v = at(i) - at(0);
    twice += u.x * v.y - u.y * v.x;
  }
  return std::fabs(twice) * 0.5;
}

glm::dvec3 axis(const std::array<int, 3>& a) {
  return {a[0], a[1], a[2]};
}

double area_on_cube(const std::array<glm::dvec3, 3>& corners, double near_plane) {
  double area = 0.0;
  for (const CubeFace face : kCubeFaces) {
    const CubeFaceAxes& axes = cube_face_axes(face);
    Polygon polygon;
    for (const glm::dvec3& p : corners) {
      polygon.add({glm::dot(axis(axes.s), p), glm::dot(axis(axes.t), p), glm::dot(axis(axes.major), p)});
    }
    area += area_on_face(polygon, near_plane);
  }
  return area;
}

// A triangle whose corners run counter-clockwise, seen from the light, is a front.
bool is_culled(const std::array<glm::dvec3, 3>& corners, CullFace cull_face) {
  const double facing = glm::dot(glm::cross(corners[1] - corners[0], corners[2] - corners[0]), -corners[0]);
  return cull_face == CullFace::front_and_back || (cull_face == CullFace::back && facing < 0.0) ||
         (cull_face == CullFace::front && facing > 0.0);
}

}  // namespace

VanishedPolygons find_vanished_polygons(const Scene& scene, std::span<const glm::vec3> from_light,
                                        std::span<const PreparedDraw, 6> faces, int size, float near_plane,
                                        CullFace cull_face) {
  std::vector<bool> covering(scene.triangles.size());
  for (const PreparedDraw& face : faces) mark_covering_polygons(face, covering);
  VanishedPolygons vanished;
  const double texels_a_unit = size / 2.0;
  for (std::size_t t = 0; t < covering.size(); ++t) {
    if (covering[t]) continue;
    const glm::uvec3& triangle = scene.triangles[t];
    const std::array corners{glm::dvec3(from_light[triangle.x]), glm::dvec3(from_light[triangle.y]),
                             glm::dvec3(from_light[triangle.z])};
    if (is_culled(corners, cull_face)) continue;
    const double area = area_on_cube(corners, static_cast<double>(near_plane));
    if (!(area > kLeastArea)) continue;
    vanished.triangles.push_back(static_cast<std::uint32_t>(t));
    vanished.texels += area * texels_a_unit * texels_a_unit;
  }
  return vanished;
}

}  // namespace ninebit
