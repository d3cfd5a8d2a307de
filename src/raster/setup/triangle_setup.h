// From polygons in clip coordinates, cut into triangles, to primitives in the window.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "src/raster/setup/polygon_offset.h"
#include "src/raster/setup/setup_context.h"
#include "src/raster/setup/window_primitives.h"

namespace ninebit {

// One triangle of a polygon.
struct PolygonTriangle {
  std::array<glm::vec4, 3> clip;
  std::array<std::uint32_t, 3> vertex;
  std::uint32_t primitive = 0;
  std::array<bool, 3> boundary{true, true, true};  // whether the edges 0-1, 1-2, 2-0 are on the polygon's boundary
};

// Values that are decided for a polygon as a whole.
struct PolygonFacts {
  PolygonMode mode = PolygonMode::fill;
  bool is_drawn = true;
  bool front_facing = true;             // in the modes line and point; when filled, each triangle has its own facing
  std::optional<SetupOffset> offset{};  // empty: there is none
};

// Looks at all triangles of a polygon, as they are after clipping. Its facing is the sign of the sum of their areas
// in the window; its slope is that of the largest of them, the first among equals.
class PolygonSurvey {
 public:
  explicit PolygonSurvey(const SetupContext& context) : context_(context) {}
  void add(const PolygonTriangle& triangle);
  [[nodiscard]] PolygonFacts facts() const;

 private:
  void add(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c);
  __extension__ using Wide = __int128;  // a polygon may have 2^32 triangles
  const SetupContext& context_;
  Wide area_ = 0;
  std::array<WindowVertex, 3> largest_{};
  std::int64_t largest_area_ = 0;
};

// Appends the primitives of one triangle: nothing, the triangle, the fan of its clipped polygon, or its boundary
// as lines or points. Filled triangles are culled by their own facing, so a closed mesh draws as many front as back
// faces at a pixel even if snapping turns a clipped triangle's piece over.
void set_up_triangle(const SetupContext& context, const PolygonTriangle& triangle, const PolygonFacts& facts,
                     SetupBlock& block);

}  // namespace ninebit
