#include "src/frame/map_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/texture.h"
#include "src/raster/texture/cube_coordinate.h"
#include "src/raster/texture/texture_wrap.h"

namespace ninebit {

namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;  // no triangle in a texel, no texel for a pixel

// The texel that a pixel's fragment looks up.
struct TexelPlace {
  std::uint32_t face = kNone;
  std::uint32_t offset = 0;  // in the face's plane
};

TexelPlace texel_at(std::uint32_t face, float s, float t, int size) {
  const auto axis = [&](float v) {
    return static_cast<std::uint32_t>(nearest_texel(v, {size, size, Wrap::clamp_to_edge}));
  };
  return {face, axis(t) * static_cast<std::uint32_t>(size) + axis(s)};
}

TexelPlace cube_place(float x, float y, float z, int size) {
  const CubeCoordinate at = cube_coordinate_inline(x, y, z);
  return texel_at(static_cast<std::uint32_t>(at.face), at.s, at.t, size);
}

TexelPlace projected_place(float s, float t, float q, int size) {
  if (!(q > 0.0F)) return {};
  s /= q;
  t /= q;
  const bool inside = s >= 0.0F && s <= 1.0F && t >= 0.0F && t <= 1.0F;
  return inside ? texel_at(0, s, t, size) : TexelPlace{};
}

// Draws the frame's visible fragments again, with their interpolated coordinates. Of several at the same depth the last
// one stays, as for the colours.
Status find_texels(CameraFrame& frame, const LightMap& map, std::vector<TexelPlace>& places) {
  const Surface& surface = frame.rendering().frame;
  const bool cube = map.projections.size() == 6;
  std::vector<glm::vec4> directions;
  if (map.coordinates.empty()) {
    for (const glm::vec3& position : map.positions) directions.emplace_back(position, 1.0F);
  }
  VertexArrays arrays = frame.all_triangles(frame.scene().positions);
  arrays.attributes[0] = directions.empty() ? map.coordinates : directions;

  RenderTarget target = frame.rendering().frame.target();
  target.color = {};
  target.stencil = {};
  target.outputs.clear();
  const std::array<int, 3> components{0, 1, cube ? 2 : 3};
  std::array<std::vector<float>, 3> planes;
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c].resize(places.size());
    target.outputs.push_back({.source = OutputSource::attribute,
                              .component = components[c],
                              .plane = Plane<float>{planes[c].data(), target.width}});
  }
  const PipelineState seen = surface_pass(frame.settings());
  if (Status drawn = rasterize(seen, frame.projection(), arrays, {}, target); !drawn) return drawn;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (surface.depth()[i] == max_depth(surface.format())) continue;
    places[i] = (cube ? cube_place : projected_place)(planes[0][i], planes[1][i], planes[2][i], map.size);
  }
  return {};
}

// Draws the number of the triangle in each texel of one face, or of a 2D map.
Status draw_numbers(const CameraFrame& frame, const LightMap& map, std::size_t face, std::vector<std::uint32_t>& depth,
                    std::vector<std::uint32_t>& numbers) {
  PipelineState state = map.pass;
  state.program.reset();
  state.alpha_test = {};
  state.stencil_test = {};
  state.blend = {};
  state.color_mask = {false, false, false, false};
  std::fill(depth.begin(), depth.end(), max_depth(map.format));
  std::fill(numbers.begin(), numbers.end(), kNone);
  RenderTarget target{.width = map.size, .height = map.size, .format = map.format};
  target.depth = {depth.data(), map.size};
  target.outputs.push_back(
      {.source = OutputSource::primitive, .plane = Plane<std::uint32_t>{numbers.data(), map.size}});
  return rasterize(state, map.projections[face], frame.all_triangles(map.positions), {}, target);
}

}  // namespace

Status add_map_evidence(CameraFrame& frame, const LightMap& map) {
  if (!frame.settings().evidence) return {};
  const Surface& surface = frame.rendering().frame;
  ShadowEvidence evidence;
  evidence.fetched.assign(surface.depth().size(), 0);
  evidence.in_map.assign(frame.scene().triangles.size(), false);
  std::vector<TexelPlace> places(surface.depth().size());
  if (Status found = find_texels(frame, map, places); !found) return found;

  const auto texels = static_cast<std::size_t>(map.size) * static_cast<std::size_t>(map.size);
  std::vector<std::uint32_t> depth(texels), numbers(texels);
  for (std::size_t face = 0; face < map.projections.size(); ++face) {
    if (Status drawn = draw_numbers(frame, map, face, depth, numbers); !drawn) return drawn;
    for (const std::uint32_t triangle : numbers) {
      if (triangle != kNone) evidence.in_map[triangle] = true;
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].face == face) evidence.fetched[i] = numbers[places[i].offset] + 1;  // none is 0
    }
  }
  frame.rendering().evidence = std::move(evidence);
  return {};
}

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
