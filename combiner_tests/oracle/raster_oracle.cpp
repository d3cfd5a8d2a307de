#include "combiner_tests/oracle/raster_oracle.h"

#include <cmath>

namespace ninebit::oracle {
namespace {

__extension__ using Wide = __int128;

int sign(Wide value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

// Twice the signed area of a, b and the pixel's centre.
Wide area_with_centre(const WindowVertex& a, const WindowVertex& b, int px, int py) {
  const Wide x = Wide{16} * px + 8, y = Wide{16} * py + 8;
  return (Wide{b.x_q4} - a.x_q4) * (y - a.y_q4) - (Wide{b.y_q4} - a.y_q4) * (x - a.x_q4);
}

Wide area_of(const WindowTriangle& t) {
  return (Wide{t[1].x_q4} - t[0].x_q4) * (Wide{t[2].y_q4} - t[0].y_q4) -
         (Wide{t[1].y_q4} - t[0].y_q4) * (Wide{t[2].x_q4} - t[0].x_q4);
}

// On which side of the line from a to b the centre lies after it has moved to the right by less than any distance, and
// down by even less. A point moved so is on no edge, and it is inside where a top or a left edge held it before.
int side(const WindowVertex& a, const WindowVertex& b, int px, int py) {
  if (const int exact = sign(area_with_centre(a, b, px, py)); exact != 0) return exact;
  if (const int moved_right = -sign(Wide{b.y_q4} - a.y_q4); moved_right != 0) return moved_right;
  return -sign(Wide{b.x_q4} - a.x_q4);
}

bool passes(CompareFunction function, std::int64_t left, std::int64_t right) {
  switch (function) {
    case CompareFunction::never:
      return false;
    case CompareFunction::less:
      return left < right;
    case CompareFunction::equal:
      return left == right;
    case CompareFunction::lequal:
      return left <= right;
    case CompareFunction::greater:
      return left > right;
    case CompareFunction::notequal:
      return left != right;
    case CompareFunction::gequal:
      return left >= right;
    case CompareFunction::always:
      return true;
  }
  return false;
}

void update_stencil(const StencilTest& test, StencilOperation operation, std::uint8_t& stored) {
  int result = stored;
  if (operation == StencilOperation::zero) result = 0;
  if (operation == StencilOperation::replace) result = test.reference;
  if (operation == StencilOperation::incr && stored < 255) result = stored + 1;
  if (operation == StencilOperation::decr && stored > 0) result = stored - 1;
  if (operation == StencilOperation::invert) result = 255 - stored;
  if (operation == StencilOperation::incr_wrap) result = (stored + 1) % 256;
  if (operation == StencilOperation::decr_wrap) result = (stored + 255) % 256;
  int merged = 0;
  for (int bit = 1; bit <= 128; bit *= 2) {
    const int from = (test.write_mask & bit) != 0 ? result : stored;
    if ((from & bit) != 0) merged += bit;
  }
  stored = static_cast<std::uint8_t>(merged);
}

void process(const PipelineState& state, std::uint32_t number, const Bytes& color, std::int64_t z, std::size_t at,
             Picture& picture, Tally& tally) {
  ++tally.fragments;
  const bool depth_passes = !state.depth_test.enabled || passes(state.depth_test.function, z, picture.depth_z24[at]);
  if (depth_passes) picture.captured[at] = color[0];

  if (state.alpha_test.enabled && !passes(state.alpha_test.function, color[3], state.alpha_test.reference)) {
    ++tally.alpha_fail;
    return;
  }
  if (state.stencil_test.enabled) {
    const StencilTest& test = state.stencil_test;
    std::uint8_t& stored = picture.stencil[at];
    if (!passes(test.function, test.reference & test.mask, stored & test.mask)) {
      ++tally.stencil_fail;
      update_stencil(test, test.fail, stored);
      return;
    }
    update_stencil(test, depth_passes ? test.depth_pass : test.depth_fail, stored);
  }
  if (!depth_passes) {
    ++tally.depth_fail;
    return;
  }
  ++tally.drawn;
  if (state.depth_test.enabled && state.depth_test.write) picture.depth_z24[at] = static_cast<std::uint32_t>(z);
  bool any = false;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!state.color_mask[i]) continue;
    picture.color[at][i] = color[i];
    any = true;
  }
  if (any) picture.primitive[at] = number;
}

}  // namespace

bool covers(const WindowTriangle& t, int px, int py) {
  const int facing = sign(area_of(t));
  return facing != 0 && side(t[0], t[1], px, py) == facing && side(t[1], t[2], px, py) == facing &&
         side(t[2], t[0], px, py) == facing;
}

std::int64_t depth_at(const WindowTriangle& t, int px, int py) {
  Wide area = area_of(t);
  Wide sum = area_with_centre(t[1], t[2], px, py) * t[0].z24 + area_with_centre(t[2], t[0], px, py) * t[1].z24 +
             area_with_centre(t[0], t[1], px, py) * t[2].z24;
  if (area < 0) {
    area = -area;
    sum = -sum;
  }
  const Wide n = 2 * sum + area, d = 2 * area;
  Wide quotient = n / d;
  if (n % d < 0) --quotient;
  return static_cast<std::int64_t>(quotient);
}

std::array<double, 4> color_at(const WindowTriangle& t, const std::array<Bytes, 3>& colors, int px, int py) {
  const auto area = static_cast<double>(area_of(t));
  std::array<double, 4> color{};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const auto weight = static_cast<double>(area_with_centre(t[(corner + 1) % 3], t[(corner + 2) % 3], px, py)) / area;
    for (std::size_t i = 0; i < 4; ++i) color[i] += weight * colors[corner][i];
  }
  return color;
}

void draw(const PipelineState& state, const std::vector<DrawnTriangle>& triangles, Picture& picture, Tally& tally) {
  for (const DrawnTriangle& triangle : triangles) {
    const Wide area = area_of(triangle.corners);
    if (area == 0) continue;
    if (area > 0 && state.cull_face == CullFace::front) continue;
    if (area < 0 && state.cull_face == CullFace::back) continue;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        if (!covers(triangle.corners, x, y)) continue;
        Bytes color = triangle.colors[2];
        if (state.shade_model == ShadeModel::smooth) {
          const std::array<double, 4> real = color_at(triangle.corners, triangle.colors, x, y);
          for (std::size_t i = 0; i < 4; ++i) color[i] = static_cast<std::uint8_t>(std::floor(real[i] + 0.5));
        }
        const auto at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
        process(state, triangle.number, color, depth_at(triangle.corners, x, y), at, picture, tally);
      }
    }
  }
}

}  // namespace ninebit::oracle
