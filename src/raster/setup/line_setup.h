// Lines and points in the window: primitives of their own, and those that polygon modes make from polygons.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "src/raster/setup/setup_context.h"
#include "src/raster/setup/window_primitives.h"

namespace ninebit {

// The values that a line or a point takes from its source.
struct SetupSource {
  std::array<std::uint32_t, 3> vertex{};
  std::uint32_t primitive = 0;
  bool front_facing = true;
  std::int32_t offset_z24 = 0;
};

// A vertex of a line or a point: one of the source's, or with weights one that clipping made.
struct SetupEnd {
  glm::vec4 clip{};
  std::uint8_t corner = 0;
  glm::vec3 weights{};
};

// Appends the line from a to b, which lie within the planes. `clipped`: the ends' weights count, not their corners. A
// line without length or with both ends beyond a side of the view volume is left out.
void add_line(const SetupContext& context, const SetupEnd& a, const SetupEnd& b, bool clipped,
              const SetupSource& source, SetupBlock& block);

// Appends the point unless it is beyond a side of the view volume.
void add_point(const SetupContext& context, const SetupEnd& at, bool clipped, const SetupSource& source,
               SetupBlock& block);

// Appends the visible part of a line or point primitive. `clip` holds its vertices in clip coordinates.
void set_up_line(const SetupContext& context, const std::array<glm::vec4, 2>& clip,
                 const std::array<std::uint32_t, 2>& vertex, std::uint32_t primitive, SetupBlock& block);
void set_up_point(const SetupContext& context, const glm::vec4& clip, std::uint32_t vertex, std::uint32_t primitive,
                  SetupBlock& block);

}  // namespace ninebit
