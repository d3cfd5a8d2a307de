// Primitive assembly, polygon modes and the pixels of whole primitives.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "combiner_tests/oracle/raster_oracle.h"

namespace ninebit::oracle {
namespace {

__extension__ using Wide = __int128;

struct Box {
  int left, bottom, right, top;  // right and top exclusive
  bool holds(int x, int y) const { return x >= left && x < right && y >= bottom && y < top; }
};

Box viewport_of(const PipelineState& state, const Picture& picture) {
  if (!state.viewport) return {0, 0, picture.width, picture.height};
  const PixelRect& v = *state.viewport;
  return {v.x, v.y, v.x + v.width, v.y + v.height};
}

class Drawing {
 public:
  Drawing(const PipelineState& state, Picture& picture, Tally& tally)
      : state_(state),
        picture_(picture),
        tally_(tally),
        viewport_(viewport_of(state, picture)),
        numbers_(number_format(picture.format)) {}

  // The source of what is drawn next.
  struct Source {
    std::uint32_t number = 0;
    Bytes flat_color{};
    bool front_facing = true;
    std::int64_t offset = 0;  // in 1/65536 of a step of 24 bits
    double number_offset = 0;
  };
  // A depth in steps of 24 bits, as a fraction; or, in formats that hold numbers, a number.
  struct Depth {
    Wide n, d;
    double number;
  };

  void point(const Source& source, const DrawnVertex& v) {
    const WindowVertex& p = v.position;
    if (beyond_sides({p}) || !within_sides(p)) return;
    const std::array<long double, 1> one{1};
    const Depth depth{p.z24, 1, p.number};
    if (state_.profile.point_shape.value == PointShape::squares) {
      const int size = eighths(state_.point_size);
      for (int py = viewport_.bottom; py < viewport_.top; ++py) {
        for (int px = viewport_.left; px < viewport_.right; ++px) {
          if (square_covers(p, size, px, py)) fragment(source, px, py, depth, color_of(source, &v.color, one));
        }
      }
      return;
    }
    const double x = static_cast<double>(p.x_q4) / 16, y = static_cast<double>(p.y_q4) / 16;
    const int size = nearest_whole(state_.point_size);
    const double half = size / 2.0;
    const bool odd = size % 2 == 1;
    const double cx = odd ? std::floor(x) + 0.5 : std::floor(x + 0.5);
    const double cy = odd ? std::floor(y) + 0.5 : std::floor(y + 0.5);
    for (int py = viewport_.bottom; py < viewport_.top; ++py) {
      for (int px = viewport_.left; px < viewport_.right; ++px) {
        if (std::fabs(px + 0.5 - cx) < half && std::fabs(py + 0.5 - cy) < half) {
          fragment(source, px, py, depth, color_of(source, &v.color, one));
        }
      }
    }
  }

  void line(const Source& source, const DrawnVertex& a, const DrawnVertex& b) {
    if (beyond_sides({a.position, b.position})) return;
    if (state_.profile.line_shape.value == LineShape::rectangles || state_.line_smooth) {
      rectangle(source, a, b);
      return;
    }
    const bool x_major = std::abs(b.position.x_q4 - a.position.x_q4) >= std::abs(b.position.y_q4 - a.position.y_q4);
    const int width = nearest_whole(state_.line_width);
    WindowLine lowest{a.position, b.position};
    for (WindowVertex& v : lowest) (x_major ? v.y_q4 : v.x_q4) -= 8 * (width - 1);
    const auto pixel = [](std::int64_t q4) { return static_cast<int>(std::floor(static_cast<double>(q4) / 16)); };
    const int left = pixel(std::min(lowest[0].x_q4, lowest[1].x_q4)) - 1;
    const int right = pixel(std::max(lowest[0].x_q4, lowest[1].x_q4)) + 1;
    const int bottom = pixel(std::min(lowest[0].y_q4, lowest[1].y_q4)) - 1;
    const int top = pixel(std::max(lowest[0].y_q4, lowest[1].y_q4)) + 1;
    // Nothing further away than the width can matter.
    for (int py = std::max(bottom, viewport_.bottom - 64); py <= std::min(top, viewport_.top); ++py) {
      for (int px = std::max(left, viewport_.left - 64); px <= std::min(right, viewport_.right); ++px) {
        if (!exits_diamond(lowest, px, py)) continue;
        const OnLine at = on_line(source, a, b, along_line(lowest, px, py));
        for (int k = 0; k < width; ++k) {
          fragment(source, x_major ? px : px + k, x_major ? py + k : py, at.depth, at.color);
        }
      }
    }
  }

  // Triangles as places in `v`, in the order in which they are drawn; edges as their ends and their triangle.
  using Places = std::array<std::size_t, 3>;

  void polygon(std::uint32_t number, const Bytes& flat_color, const std::vector<DrawnVertex>& v,
               const std::vector<Places>& triangles, const std::vector<Places>& edges) {
    std::vector<WindowTriangle> cut;
    std::int64_t area = 0, largest_area = 0;
    WindowTriangle largest{};
    for (const auto& [a, b, c] : triangles) {
      cut.push_back({v[a].position, v[b].position, v[c].position});
      if (beyond_sides({cut.back()[0], cut.back()[1], cut.back()[2]})) continue;
      const std::int64_t own = area_of(cut.back());
      area += own;
      if (std::abs(own) > largest_area) {
        largest_area = std::abs(own);
        largest = cut.back();
      }
    }
    if (largest_area == 0) return;
    const bool front = is_front(area);
    const PolygonMode mode = front ? state_.front_mode : state_.back_mode;
    Source source{.number = number, .flat_color = flat_color, .front_facing = front};
    const PolygonOffset& o = state_.polygon_offset;
    if (mode == PolygonMode::fill ? o.fill : mode == PolygonMode::line ? o.line : o.point) {
      source.offset = polygon_offset(o, state_.profile, picture_.format, largest);
      source.number_offset = number_offset(o, state_.profile.polygon_offset_slope.value, largest, numbers_.is_w);
    }
    if (mode == PolygonMode::fill) {
      for (std::size_t i = 0; i < cut.size(); ++i) {
        const auto& [a, b, c] = triangles[i];
        filled(source, cut[i], {v[a].color, v[b].color, v[c].color});
      }
      return;
    }
    if (area == 0 || is_culled(front)) return;
    for (const auto& [from, to, triangle] : edges) {
      // Parts of a triangle beyond a side of the view volume are clipped with it.
      const WindowTriangle& t = cut[triangle];
      if (beyond_sides({t[0], t[1], t[2]})) continue;
      if (mode == PolygonMode::line) {
        line(source, v[from], v[to]);
      } else {
        point(source, v[from]);
      }
    }
  }

 private:
  static std::int64_t area_of(const WindowTriangle& t) {
    return (t[1].x_q4 - t[0].x_q4) * (t[2].y_q4 - t[0].y_q4) - (t[1].y_q4 - t[0].y_q4) * (t[2].x_q4 - t[0].x_q4);
  }
  bool is_front(std::int64_t area) const { return (area > 0) == (state_.front_face == FrontFace::counter_clockwise); }
  bool is_culled(bool front) const {
    if (state_.cull_face == CullFace::front_and_back) return true;
    return state_.cull_face == (front ? CullFace::front : CullFace::back);
  }
  // Positions stand for the middle of their snapping cell.
  bool within_sides(const WindowVertex& v) const {
    return v.x_q4 >= 16 * viewport_.left && v.x_q4 < 16 * viewport_.right && v.y_q4 >= 16 * viewport_.bottom &&
           v.y_q4 < 16 * viewport_.top;
  }
  bool beyond_sides(std::initializer_list<WindowVertex> all) const {
    const auto every = [&](auto beyond) { return std::all_of(all.begin(), all.end(), beyond); };
    return every([&](const WindowVertex& v) { return v.x_q4 < 16 * viewport_.left; }) ||
           every([&](const WindowVertex& v) { return v.x_q4 >= 16 * viewport_.right; }) ||
           every([&](const WindowVertex& v) { return v.y_q4 < 16 * viewport_.bottom; }) ||
           every([&](const WindowVertex& v) { return v.y_q4 >= 16 * viewport_.top; });
  }

  // Of `Count` colours.
  template <std::size_t Count>
  Bytes color_of(const Source& source, const Bytes* colors, const std::array<long double, Count>& shares) const {
    if (state_.shade_model == ShadeModel::flat || has_primitive_colors) return source.flat_color;
    Bytes color{};
    // The NV2A's weights are whole 256ths: the first and the last of three are cut, of a line the last.
    std::array<double, Count> weights{};
    for (std::size_t k = 0; k < Count; ++k) weights[k] = static_cast<double>(shares[k]);
    if (state_.profile.color_weights.value == ColorWeights::eight_bits && Count > 1) {
      const std::size_t rest = Count == 3 ? 1 : 0;
      double left = 1;
      for (std::size_t k = 0; k < Count; ++k) {
        weights[k] = std::floor(256 * weights[k]) / 256;
        if (k != rest) left -= weights[k];
      }
      weights[rest] = left;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      double real = 0;
      for (std::size_t k = 0; k < Count; ++k) real += weights[k] * colors[k][i];
      color[i] = static_cast<std::uint8_t>(std::min(std::max(std::floor(real + 0.5), 0.0), 255.0));
    }
    return color;
  }

  static int eighths(float size) { return static_cast<int>(std::lround(8.0 * static_cast<double>(size))); }
  // OpenGL's sizes without antialiasing.
  static int nearest_whole(float size) {
    return std::max(static_cast<int>(std::floor(static_cast<double>(size) + 0.5)), 1);
  }

  // A line's values at a place along it.
  struct OnLine {
    Depth depth;
    Bytes color;
  };
  OnLine on_line(const Source& source, const DrawnVertex& a, const DrawnVertex& b, const Along& t) const {
    const long double share = static_cast<long double>(t.along) / static_cast<long double>(t.squared_length);
    const std::array shares{1 - share, share};
    const std::int64_t l = t.squared_length;
    const Wide sum = Wide{l - t.along} * a.position.z24 + Wide{t.along} * b.position.z24;
    const std::array colors{a.color, b.color};
    const double number = number_of(std::array{a.position, b.position}, shares, numbers_.is_w);
    return {{sum, l, number}, color_of(source, colors.data(), shares)};
  }

  void rectangle(const Source& source, const DrawnVertex& a, const DrawnVertex& b) {
    const WindowLine ends{a.position, b.position};
    const int width = eighths(state_.line_width);
    // Nothing further away than the width can matter.
    const std::int64_t border = 2 * width + 32;  // in sixteenths
    const auto [x_low, x_high] = std::minmax(a.position.x_q4, b.position.x_q4);
    const auto [y_low, y_high] = std::minmax(a.position.y_q4, b.position.y_q4);
    for (int py = viewport_.bottom; py < viewport_.top; ++py) {
      if (16 * py < y_low - border || 16 * py > y_high + border) continue;
      for (int px = viewport_.left; px < viewport_.right; ++px) {
        if (16 * px < x_low - border || 16 * px > x_high + border) continue;
        int coverage = rectangle_covers(ends, width, px, py) ? 8 : 0;
        if (state_.line_smooth) {
          coverage = 0;
          for (int i = 0; i < 8; ++i)
            coverage += rectangle_covers_place(ends, width, coverage_place(px, py, i)) ? 1 : 0;
        }
        if (coverage == 0) continue;
        const OnLine at = on_line(source, a, b, along_line(ends, px, py));
        fragment(source, px, py, at.depth, at.color, coverage);
      }
    }
  }

  void filled(Source source, const WindowTriangle& t, const std::array<Bytes, 3>& colors) {
    const std::int64_t area = area_of(t);
    source.front_facing = is_front(area);
    if (area == 0 || is_culled(source.front_facing) || beyond_sides({t[0], t[1], t[2]})) return;
    const auto [x_low, x_high] = std::minmax({t[0].x_q4, t[1].x_q4, t[2].x_q4});
    const auto [y_low, y_high] = std::minmax({t[0].y_q4, t[1].y_q4, t[2].y_q4});
    const auto from = [](std::int64_t low, int start) { return low < 16 * start ? start : static_cast<int>(low / 16); };
    const auto to = [](std::int64_t high, int end) { return high >= 16 * end ? end : static_cast<int>(high / 16) + 1; };
    if (state_.polygon_smooth) return smoothed(source, t, colors);
    for (int py = from(y_low, viewport_.bottom); py < to(y_high, viewport_.top); ++py) {
      for (int px = from(x_low, viewport_.left); px < to(x_high, viewport_.right); ++px) {
        if (!covers(t, px, py) || !is_stippled(px, py)) continue;
        const std::array<long double, 3> share = shares_at(t, px, py);
        fragment(source, px, py, plane_at(t, share, px, py), color_of(source, colors.data(), share));
      }
    }
  }

  // Whether a polygon is drawn at the pixel: bits from the left, rows from below, both again after 32.
  bool is_stippled(int px, int py) const {
    if (!state_.polygon_stipple) return true;
    const int byte = (*state_.polygon_stipple)[static_cast<std::size_t>(py % 32 * 4 + px % 32 / 8)];
    return byte / (1 << (7 - px % 8)) % 2 == 1;
  }

  // A triangle whose pixels are drawn if any of eight samples lies inside.
  void smoothed(const Source& source, const WindowTriangle& t, const std::array<Bytes, 3>& colors) {
    const auto [x_low, x_high] = std::minmax({t[0].x_q4, t[1].x_q4, t[2].x_q4});
    const auto [y_low, y_high] = std::minmax({t[0].y_q4, t[1].y_q4, t[2].y_q4});
    for (int py = viewport_.bottom; py < viewport_.top; ++py) {
      if (16 * py + 16 < y_low || 16 * py > y_high) continue;
      for (int px = viewport_.left; px < viewport_.right; ++px) {
        if (16 * px + 16 < x_low || 16 * px > x_high || !is_stippled(px, py)) continue;
        int coverage = 0;
        for (int i = 0; i < 8; ++i) {
          const Place place = coverage_place(px, py, i);
          coverage += covers_place(t, place.x_q4, place.y_q4) ? 1 : 0;
        }
        if (coverage == 0) continue;
        const Within within = nearest_within(t, px, py);
        const double number = number_of(t, within.share, numbers_.is_w);
        fragment(source, px, py, {within.depth_sum, within.parts, number},
                 color_of(source, colors.data(), within.share), coverage);
      }
    }
  }

  // The NV2A cuts depths to codes.
  bool cuts_depth() const { return state_.profile.depth_narrowing.value == Narrowing::toward_zero; }

  Depth plane_at(const WindowTriangle& t, const std::array<long double, 3>& share, int px, int py) const {
    const Wide area = area_of(t);
    Wide sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      WindowTriangle part = t;
      part[i] = {16 * px + 8, 16 * py + 8, 0};
      sum += Wide{area_of(part)} * t[i].z24;
    }
    const double number = number_of(t, share, numbers_.is_w);
    return area < 0 ? Depth{-sum, -area, number} : Depth{sum, area, number};
  }

  // The depth and the offset are added, then cut, or rounded to nearest.
  std::int64_t code_of(const Source& source, const Depth& depth) const {
    if (numbers_.has_numbers()) {
      const double sum = depth.number + source.number_offset;
      return number_code(depth_bits(picture_.format), numbers_.exponent_bits, sum, cuts_depth());
    }
    constexpr Wide kParts = 65536;
    const Wide sum = depth.n * kParts + (source.offset + (cuts_depth() ? Wide{0} : kParts / 2)) * depth.d;
    const Wide parts = depth.d * kParts;
    const auto z24 = static_cast<std::int64_t>(sum / parts - (sum % parts < 0 ? 1 : 0));
    const std::int64_t step = std::int64_t{1} << (24 - depth_bits(picture_.format));
    const std::int64_t deepest = step * max_depth(picture_.format);
    const std::int64_t z = std::min(std::max(z24, std::int64_t{0}), deepest);
    return !cuts_depth() && z % step * 2 >= step && step > 1 ? z / step + 1 : z / step;
  }

  void fragment(const Source& source, int x, int y, const Depth& depth, const Bytes& color, int coverage = 8) {
    if (!viewport_.holds(x, y)) return;
    process(state_,
            {.x = x,
             .y = y,
             .depth = code_of(source, depth),
             .number = source.number,
             .front_facing = source.front_facing,
             .color = color,
             .coverage = coverage},
            picture_, tally_);
  }

  const PipelineState& state_;
  Picture& picture_;
  Tally& tally_;
  Box viewport_;
  NumberFormat numbers_;

 public:
  bool has_primitive_colors = false;
};

// Vertices of primitive i and its provoking vertex, as places in the list; empty: there is none.
struct Assembled {
  std::vector<std::size_t> places;
  std::size_t provoking = 0;
};

Assembled assemble(Primitive type, std::size_t i, std::size_t n) {
  Assembled a;
  switch (type) {
    case Primitive::points:
      a = {{i}, i};
      break;
    case Primitive::lines:
      a = {{2 * i, 2 * i + 1}, 2 * i + 1};
      break;
    case Primitive::line_strip:
      a = {{i, i + 1}, i + 1};
      break;
    case Primitive::line_loop:
      if (n >= 2 && i + 1 == n) return {{i, 0}, 0};
      a = {{i, i + 1}, i + 1};
      break;
    case Primitive::triangles:
      a = {{3 * i, 3 * i + 1, 3 * i + 2}, 3 * i + 2};
      break;
    case Primitive::triangle_strip:
      a = {{i, i + 1, i + 2}, i + 2};
      if (i % 2 == 1) a.places = {i + 1, i, i + 2};
      break;
    case Primitive::triangle_fan:
      a = {{0, i + 1, i + 2}, i + 2};
      break;
    case Primitive::quads:
      a = {{4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3}, 4 * i + 3};
      break;
    case Primitive::quad_strip:
      a = {{2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3}, 2 * i + 3};
      break;
    case Primitive::polygon:
      if (i > 0 || n < 3) return {};
      for (std::size_t k = 0; k < n; ++k) a.places.push_back(k);
      return a;
  }
  for (const std::size_t place : a.places) {
    if (place >= n) return {};
  }
  return a;
}

}  // namespace

void draw(const PipelineState& state, const DrawCall& call, Picture& picture, Tally& tally) {
  Drawing drawing(state, picture, tally);
  drawing.has_primitive_colors = !call.primitive_colors.empty();
  for (std::size_t i = 0;; ++i) {
    const Assembled a = assemble(call.type, i, call.vertices.size());
    if (a.places.empty()) return;
    std::vector<DrawnVertex> v;
    for (const std::size_t place : a.places) v.push_back(call.vertices[place]);
    const Bytes flat = drawing.has_primitive_colors ? call.primitive_colors[i] : call.vertices[a.provoking].color;
    const auto number = static_cast<std::uint32_t>(i);
    if (v.size() == 1) {
      drawing.point({.number = number, .flat_color = flat}, v[0]);
    } else if (v.size() == 2) {
      drawing.line({.number = number, .flat_color = flat}, v[0], v[1]);
    } else if (call.type == Primitive::quad_strip) {
      drawing.polygon(number, flat, v, {{0, 1, 2}, {2, 1, 3}}, {{0, 1, 0}, {2, 0, 0}, {1, 3, 1}, {3, 2, 1}});
    } else {  // a fan; each edge belongs to the triangle that it bounds
      std::vector<Drawing::Places> fan, edges{{0, 1, 0}};
      for (std::size_t k = 1; k + 1 < v.size(); ++k) {
        fan.push_back({0, k, k + 1});
        edges.push_back({k, k + 1, k - 1});
      }
      edges.push_back({v.size() - 1, 0, fan.size() - 1});
      drawing.polygon(number, flat, v, fan, edges);
    }
  }
}

void clear(const PipelineState& state, const Clear& values, Picture& picture) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const PixelRect s = state.scissor.value_or(PixelRect{0, 0, picture.width, picture.height});
      if (x < s.x || y < s.y || x - s.x >= s.width || y - s.y >= s.height) continue;
      const auto at = static_cast<std::size_t>(y * picture.width + x);
      for (std::size_t i = 0; i < 4 && values.clears_color; ++i) {
        const Bytes color = kept(picture.color_format, values.color);
        if ((i < 3 || picture.has_alpha) && state.color_mask[i]) picture.color[at][i] = color[i];
      }
      if (values.clears_depth && state.depth_test.write) picture.depth[at] = values.depth;
      if (!values.clears_stencil) continue;
      for (int bit = 0; bit < stencil_bits(picture.format); ++bit) {
        const auto mask = static_cast<std::uint8_t>(1 << bit);
        if ((state.stencil_test.front.write_mask & mask) == 0) continue;
        picture.stencil[at] = static_cast<std::uint8_t>((picture.stencil[at] & ~mask) | (values.stencil & mask));
      }
    }
  }
}

}  // namespace ninebit::oracle
