// Coverage, depth and polygon offset of single triangles and lines.
#include "combiner_tests/oracle/raster_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace ninebit::oracle {
namespace {

__extension__ using Wide = __int128;

int sign(Wide value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

Wide floor_of(Wide n, Wide d) {
  Wide quotient = n / d;
  if (n % d < 0) --quotient;
  return quotient;
}

// The pixel's centre.
Place centre_of(int px, int py) {
  return {std::int64_t{16} * px + 8, std::int64_t{16} * py + 8};
}

// Twice the signed area of a, b and the place.
Wide area_with(const WindowVertex& a, const WindowVertex& b, const Place& place) {
  const Wide x = place.x_q4, y = place.y_q4;
  return (Wide{b.x_q4} - a.x_q4) * (y - a.y_q4) - (Wide{b.y_q4} - a.y_q4) * (x - a.x_q4);
}

Wide area_of(const WindowTriangle& t) {
  return (Wide{t[1].x_q4} - t[0].x_q4) * (Wide{t[2].y_q4} - t[0].y_q4) -
         (Wide{t[1].y_q4} - t[0].y_q4) * (Wide{t[2].x_q4} - t[0].x_q4);
}

// On which side of the line from a to b the place lies after it has moved to the right by less than any distance, and
// down by even less. A point moved so is on no edge, and it is inside where a top or a left edge held it before.
int side(const WindowVertex& a, const WindowVertex& b, const Place& place) {
  if (const int exact = sign(area_with(a, b, place)); exact != 0) return exact;
  if (const int moved_right = -sign(Wide{b.y_q4} - a.y_q4); moved_right != 0) return moved_right;
  return -sign(Wide{b.x_q4} - a.x_q4);
}

// A number with terms in e and e², e being smaller than anything else.
struct Tiny {
  Wide one, e, e2;
  int sign() const { return oracle::sign(one != 0 ? one : e != 0 ? e : e2); }
  Tiny operator*(Wide f) const { return {one * f, e * f, e2 * f}; }
  Tiny operator-(const Tiny& o) const { return {one - o.one, e - o.e, e2 - o.e2}; }
};

// How far a point, moved by (-e, -e²), lies beyond one of the diamond's four borders; negative: within.
Tiny beyond_border(const WindowVertex& v, int px, int py, int sx, int sy) {
  return {sx * (Wide{v.x_q4} - 16 * px - 8) + sy * (Wide{v.y_q4} - 16 * py - 8) - 8, -sx, -sy};
}

// A fraction: where along the line, from 0 to 1, it crosses something.
struct Crossing {
  Tiny n;
  Wide d;  // > 0
};

bool less(const Crossing& a, const Crossing& b) {
  return (a.n * b.d - b.n * a.d).sign() < 0;
}

}  // namespace

bool covers(const WindowTriangle& t, int px, int py) {
  const Place centre = centre_of(px, py);
  return covers_place(t, centre.x_q4, centre.y_q4);
}

bool covers_place(const WindowTriangle& t, std::int64_t x_q4, std::int64_t y_q4) {
  const Place place{x_q4, y_q4};
  const int facing = sign(area_of(t));
  return facing != 0 && side(t[0], t[1], place) == facing && side(t[1], t[2], place) == facing &&
         side(t[2], t[0], place) == facing;
}

Place coverage_place(int px, int py, int i) {
  return {std::int64_t{16} * px + 2 * i, std::int64_t{16} * (py + 1) - 2 * (3 * i % 8)};
}

Within nearest_within(const WindowTriangle& t, int px, int py) {
  const Place centre = centre_of(px, py);
  const int facing = sign(area_of(t));
  std::array<Wide, 3> part{facing * area_with(t[1], t[2], centre), facing * area_with(t[2], t[0], centre),
                           facing * area_with(t[0], t[1], centre)};
  Wide whole = 0, depth = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (part[i] < 0) part[i] = 0;
    whole += part[i];
    depth += part[i] * t[i].z24;
  }
  Within within;
  for (std::size_t i = 0; i < 3; ++i) {
    within.share[i] = static_cast<long double>(part[i]) / static_cast<long double>(whole);
  }
  within.depth_sum = static_cast<std::int64_t>(depth);
  within.parts = static_cast<std::int64_t>(whole);
  return within;
}

std::int64_t depth_at(const WindowTriangle& t, int px, int py, bool is_cut) {
  return depth_at_place(t, centre_of(px, py), is_cut);
}

std::int64_t depth_at_place(const WindowTriangle& t, const Place& place, bool is_cut) {
  Wide area = area_of(t);
  Wide sum = area_with(t[1], t[2], place) * t[0].z24 + area_with(t[2], t[0], place) * t[1].z24 +
             area_with(t[0], t[1], place) * t[2].z24;
  if (area < 0) {
    area = -area;
    sum = -sum;
  }
  return static_cast<std::int64_t>(is_cut ? floor_of(sum, area) : floor_of(2 * sum + area, 2 * area));
}

bool exits_diamond(const WindowLine& line, int px, int py) {
  const WindowVertex &a = line[0], &b = line[1];
  if (a.x_q4 == b.x_q4 && a.y_q4 == b.y_q4) return false;
  const Crossing start{{0, 0, 0}, 1}, end{{1, 0, 0}, 1};
  // Of four borders.
  std::array<Crossing, 4> entered{}, left{};
  std::size_t number_entered = 0, number_left = 0;
  bool ends_inside = true;
  for (const int sx : {-1, 1}) {
    for (const int sy : {-1, 1}) {
      const Tiny at_start = beyond_border(a, px, py, sx, sy);
      const Wide change = sx * (Wide{b.x_q4} - a.x_q4) + sy * (Wide{b.y_q4} - a.y_q4);
      if (beyond_border(b, px, py, sx, sy).sign() >= 0) ends_inside = false;
      if (change == 0 && at_start.sign() >= 0) return false;
      if (change > 0) left[number_left++] = {at_start * -1, change};
      if (change < 0) entered[number_entered++] = {at_start, -change};
    }
  }
  if (ends_inside) return false;
  // Within the open diamond for a while between start and end?
  const std::span enters(entered.data(), number_entered), leaves(left.data(), number_left);
  for (const Crossing& in : enters) {
    if (!less(in, end)) return false;
    for (const Crossing& out : leaves) {
      if (!less(in, out)) return false;
    }
  }
  return std::all_of(leaves.begin(), leaves.end(), [&](const Crossing& out) { return less(start, out); });
}

bool rectangle_covers(const WindowLine& line, int width, int px, int py) {
  return rectangle_covers_place(line, width, centre_of(px, py));
}

bool rectangle_covers_place(const WindowLine& line, int width, const Place& place) {
  const Wide dx = line[1].x_q4 - line[0].x_q4, dy = line[1].y_q4 - line[0].y_q4;
  if (dx == 0 && dy == 0) return false;
  // h is (-dy, dx) times a fraction, which has the squared length below the line. All is multiplied by twice that.
  const Wide ax = dx < 0 ? -dx : dx, ay = dy < 0 ? -dy : dy;
  const Wide above = width * (ax + ay + (ax > ay ? ax : ay)), scale = 2 * (dx * dx + dy * dy);
  struct WidePlace {
    Wide x, y;
  };
  const auto corner = [&](std::size_t end, int up) {
    return WidePlace{scale * line[end].x_q4 - up * above * dy, scale * line[end].y_q4 + up * above * dx};
  };
  const WidePlace centre{scale * place.x_q4, scale * place.y_q4};
  const std::array<WidePlace, 4> corners{corner(0, -1), corner(1, -1), corner(1, 1), corner(0, 1)};
  for (std::size_t i = 0; i < 4; ++i) {
    const WidePlace &a = corners[i], &b = corners[(i + 1) % 4];
    const Wide x = b.x - a.x, y = b.y - a.y;
    int inner = sign(x * (centre.y - a.y) - y * (centre.x - a.x));
    // A centre on a side moves a little: to the right, then down, or of slanted lines to the left.
    if (inner == 0 && (dx == 0 || dy == 0)) inner = y != 0 ? -sign(y) : -sign(x);
    if (inner == 0) inner = sign(y);
    if (inner < 0) return false;
  }
  return true;
}

bool square_covers(const WindowVertex& position, int size, int px, int py) {
  // From the position to the centre, to the right and down, in sixteenths.
  const std::int64_t right = 16 * px + 8 - position.x_q4, down = position.y_q4 - 16 * py - 8;
  if (size == 0) return right > -8 && right <= 8 && down > -8 && down <= 8;
  bool is_power = false;
  for (int power = 1; power <= size; power *= 2) is_power = is_power || power == size;
  const auto is_in = [&](std::int64_t from) { return from >= -size && (from < size || (from == size && !is_power)); };
  return is_in(right) && is_in(down);
}

Along along_line(const WindowLine& line, int px, int py) {
  const std::int64_t dx = line[1].x_q4 - line[0].x_q4, dy = line[1].y_q4 - line[0].y_q4;
  const std::int64_t squared = dx * dx + dy * dy;
  const std::int64_t along = dx * (16 * px + 8 - line[0].x_q4) + dy * (16 * py + 8 - line[0].y_q4);
  return {std::min(std::max(along, std::int64_t{0}), squared), squared};
}

std::int64_t polygon_offset(const PolygonOffset& offset, const HardwareProfile& profile, DepthStencilFormat format,
                            const WindowTriangle& t) {
  const OffsetSlope slope = profile.polygon_offset_slope.value;
  const std::int64_t parts = profile.polygon_offset_fraction.value == OffsetFraction::kept ? 65536 : 1;
  const std::int64_t step = std::int64_t{1} << (24 - depth_bits(format));
  const Wide area = area_of(t) < 0 ? -area_of(t) : area_of(t);
  // EXT_polygon_offset's formulas, times the area; in window depth for a pixel.
  const auto& [a, b, c] = t;
  Wide dx = 16 * ((Wide{c.y_q4} - b.y_q4) * (b.z24 - a.z24) - (Wide{b.y_q4} - a.y_q4) * (c.z24 - b.z24));
  Wide dy = 16 * ((Wide{b.x_q4} - a.x_q4) * (c.z24 - b.z24) - (Wide{c.x_q4} - b.x_q4) * (b.z24 - a.z24));
  dx = dx < 0 ? -dx : dx;
  dy = dy < 0 ? -dy : dy;
  const Wide larger = std::max(dx, dy);
  // Whole multiples of 2^-20 are computed in exact fractions: all floats but small ones.
  const double factor = static_cast<double>(offset.factor) * 0x1p20, units = static_cast<double>(offset.units) * 0x1p20;
  const bool exact = std::fabs(factor) < 0x1p50 && std::fabs(units) < 0x1p50 && factor == std::floor(factor) &&
                     units == std::floor(units);
  if (slope == OffsetSlope::larger && exact) {
    const Wide sum = static_cast<std::int64_t>(factor) * larger + static_cast<std::int64_t>(units) * step * area;
    const Wide rounded = floor_of(parts * sum + (area << 19), area << 20), most = Wide{parts} << 25;
    return static_cast<std::int64_t>(std::clamp(rounded, -most, most)) * (65536 / parts);
  }
  double m = static_cast<double>(larger) / static_cast<double>(area);
  if (slope == OffsetSlope::root) {
    const double x = static_cast<double>(dx) / static_cast<double>(area);
    const double y = static_cast<double>(dy) / static_cast<double>(area);
    m = std::sqrt(x * x + y * y);
  }
  const double sum =
      static_cast<double>(offset.factor) * m + static_cast<double>(offset.units) * static_cast<double>(step);
  const double clamped = std::min(std::max(sum, -0x1p25), 0x1p25);
  return static_cast<std::int64_t>(std::floor(clamped * static_cast<double>(parts) + 0.5)) * (65536 / parts);
}

NumberFormat number_format(DepthStencilFormat format) {
  switch (format) {
    case DepthStencilFormat::f24s8:
      return {false, 8};
    case DepthStencilFormat::f16:
      return {false, 4};
    case DepthStencilFormat::w24s8:
    case DepthStencilFormat::w16:
      return {true, 0};
    case DepthStencilFormat::wf24s8:
      return {true, 8};
    case DepthStencilFormat::wf16:
      return {true, 4};
    default:
      return {};
  }
}

double largest_number(int bits, int exponent_bits) {
  if (exponent_bits == 0) return std::ldexp(1, bits) - 1;
  return std::ldexp(2 - std::ldexp(1, exponent_bits - bits), exponent_bits == 4 ? 8 : 128);
}

std::array<long double, 3> shares_at(const WindowTriangle& t, int px, int py) {
  const auto area = static_cast<long double>(area_of(t));
  std::array<long double, 3> share{};
  for (std::size_t i = 0; i < 3; ++i) {
    share[i] = static_cast<long double>(area_with(t[(i + 1) % 3], t[(i + 2) % 3], centre_of(px, py))) / area;
  }
  return share;
}

double number_offset(const PolygonOffset& offset, OffsetSlope slope, const WindowTriangle& t, bool is_w) {
  const auto& [a, b, c] = t;
  // Changes per pixel of the plane through the corners, or of 1/w, whose change times w² is that of w.
  const auto value = [&](const WindowVertex& v) { return is_w ? 1 / v.number : v.number; };
  const double scale = is_w ? a.number * a.number : 1;
  const auto at = [](std::int64_t q4) { return static_cast<double>(q4) / 16; };
  const double area = at(b.x_q4 - a.x_q4) * at(c.y_q4 - a.y_q4) - at(b.y_q4 - a.y_q4) * at(c.x_q4 - a.x_q4);
  const double vb = value(b) - value(a), vc = value(c) - value(a);
  const double dx = std::fabs((vb * at(c.y_q4 - a.y_q4) - vc * at(b.y_q4 - a.y_q4)) / area) * scale;
  const double dy = std::fabs((vc * at(b.x_q4 - a.x_q4) - vb * at(c.x_q4 - a.x_q4)) / area) * scale;
  const double m = slope == OffsetSlope::root ? std::hypot(dx, dy) : std::max(dx, dy);
  constexpr double kMost = std::numeric_limits<float>::max();
  const double sum = static_cast<double>(offset.factor) * m + static_cast<double>(offset.units);
  return static_cast<double>(static_cast<float>(std::clamp(sum, -kMost, kMost)));
}

std::uint32_t number_code(int bits, int exponent_bits, double number, bool is_cut) {
  const double largest = std::ldexp(1, bits) - 1, half = is_cut ? 0 : 0.5;
  double code = 0;
  if (exponent_bits == 0) {
    code = std::floor(number + half);
  } else {
    const int bias = exponent_bits == 4 ? 7 : 127, mantissa = bits - exponent_bits;
    if (std::isinf(number) && number > 0) {
      code = largest;
    } else if (number >= std::ldexp(1, -bias)) {
      const int exponent = static_cast<int>(std::floor(std::log2(number)));
      const double share = std::ldexp(number, -exponent) - 1;  // from 0 to 1
      code = std::ldexp(exponent + bias, mantissa) + std::floor(std::ldexp(share, mantissa) + half);
    }
  }
  return static_cast<std::uint32_t>(std::min(std::max(code, 0.0), largest));
}

}  // namespace ninebit::oracle
