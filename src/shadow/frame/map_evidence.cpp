#include "src/shadow/frame/map_evidence.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "ninebit/raster/rasterizer.h"
#include "src/raster/texture/cube_face.h"
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

}  // namespace ninebit
