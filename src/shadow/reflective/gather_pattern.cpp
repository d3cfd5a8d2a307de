#include "src/shadow/reflective/gather_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "src/system/hashing/splitmix.h"

namespace ninebit {
namespace {

constexpr std::int32_t kRadius = 1 << 15;

struct GridPoint {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

constexpr std::int64_t square_of_length(std::int64_t x, std::int64_t y) {
  return x * x + y * y;
}

// The first point that lies in the disc, except its centre, of a sequence of random points in the square around it.
GridPoint random_in_disc(std::uint64_t seed) {
  for (std::uint64_t attempt = 0;; ++attempt) {
    const std::uint64_t bits = splitmix(seed ^ (attempt << 58));
    const GridPoint p{static_cast<std::int32_t>(bits & 0xFFFFU) - kRadius,
                      static_cast<std::int32_t>((bits >> 16) & 0xFFFFU) - kRadius};
    const std::int64_t square = square_of_length(p.x, p.y);
    if (square > 0 && square <= square_of_length(kRadius, 0)) return p;
  }
}

std::int64_t distance_to_nearest(const std::vector<GridPoint>& points, const GridPoint& p) {
  std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
  for (const GridPoint& q : points) nearest = std::min(nearest, square_of_length(p.x - q.x, p.y - q.y));
  return nearest;
}

std::vector<GridPoint> poisson_disk(std::size_t count) {
  constexpr std::uint64_t kCandidates = 24;
  std::vector<GridPoint> points;
  points.reserve(count);
  for (std::uint64_t i = 0; points.size() < count; ++i) {
    GridPoint best;
    std::int64_t farthest = -1;
    for (std::uint64_t c = 0; c < kCandidates; ++c) {
      const GridPoint candidate = random_in_disc(i * kCandidates + c);
      const std::int64_t distance = distance_to_nearest(points, candidate);
      if (distance > farthest) farthest = distance, best = candidate;
    }
    points.push_back(best);
  }
  return points;
}

constexpr int kAngleBits = 12;
static_assert(kMaxPixelLights <= 1 << kAngleBits);

// Cosine and sine of a whole turn divided by 2, 4, 8, …, each from the one before by the half-angle formulas.
std::array<glm::dvec2, kAngleBits> halved_turns() {
  std::array<glm::dvec2, kAngleBits> turns;
  turns[0] = {-1.0, 0.0};
  turns[1] = {0.0, 1.0};
  for (std::size_t i = 2; i < turns.size(); ++i) {
    const double cosine = std::sqrt((1.0 + turns[i - 1].x) * 0.5);
    turns[i] = {cosine, turns[i - 1].y / (2.0 * cosine)};
  }
  return turns;
}

void add_polar(GatherPattern& pattern, std::size_t count) {
  const auto turns = halved_turns();
  for (std::size_t i = 0; i < count; ++i) {
    const double radius = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    // The bits of i, lowest first, are the binary digits of the angle after the point.
    glm::dvec2 angle(1.0, 0.0);
    for (std::size_t bit = 0; bit < turns.size(); ++bit) {
      if ((i >> bit & 1U) == 0) continue;
      angle = {angle.x * turns[bit].x - angle.y * turns[bit].y, angle.x * turns[bit].y + angle.y * turns[bit].x};
    }
    pattern.x.push_back(static_cast<float>(radius * angle.y));
    pattern.y.push_back(static_cast<float>(radius * angle.x));
    pattern.weight.push_back(static_cast<float>(radius * radius));
  }
}

}  // namespace

double GatherPattern::total_weight() const {
  double sum = 0.0;
  if (kind == SamplePattern::polar) {
    for (const float w : weight) sum += w;
  } else {
    for (std::size_t i = 0; i < x.size(); ++i) sum += 0.5 * (double{x[i]} * x[i] + double{y[i]} * y[i]);
  }
  return sum;
}

GatherPattern make_pattern(const ReflectiveSettings& settings) {
  GatherPattern pattern{.kind = settings.pattern, .x = {}, .y = {}};
  const auto count = static_cast<std::size_t>(settings.samples);
  if (settings.pattern == SamplePattern::polar) {
    add_polar(pattern, count);
    return pattern;
  }
  for (const GridPoint& p : poisson_disk(count)) {
    pattern.x.push_back(static_cast<float>(p.x) / static_cast<float>(kRadius));
    pattern.y.push_back(static_cast<float>(p.y) / static_cast<float>(kRadius));
  }
  return pattern;
}

glm::vec2 pixel_turn(std::uint32_t x, std::uint32_t y) {
  const GridPoint p = random_in_disc(splitmix(std::uint64_t{y} << 32 | x) >> 6);
  const double length = std::sqrt(static_cast<double>(square_of_length(p.x, p.y)));
  return {static_cast<float>(p.x / length), static_cast<float>(p.y / length)};
}

}  // namespace ninebit
