#include "src/raster/fragment/interpolation.h"

#include <cmath>

namespace ninebit {
namespace {

// Divides the weights by their sum. Colours then cut them to eight bits (rules/eight_bit_weights.inl).
void normalize(std::size_t count, WeightPlanes& weight, std::array<float, kBatchSize>& sums) {
  for (std::size_t i = 0; i < count; ++i) {
    const float sum = (weight[0][i] + weight[1][i]) + weight[2][i];
    for (auto& plane : weight) plane[i] /= sum;
    sums[i] = sum;
  }
}

// From weights of clipped corners to weights of the vertices.
void unclip(std::span<const FragmentPlace> places, WeightPlanes& weight) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].weights == nullptr) continue;
    const glm::mat3& m = *places[i].weights;
    const std::array<float, 3> w{weight[0][i], weight[1][i], weight[2][i]};
    for (int k = 0; k < 3; ++k) {
      weight[static_cast<std::size_t>(k)][i] = (w[0] * m[0][k] + w[1] * m[1][k]) + w[2] * m[2][k];
    }
  }
}

}  // namespace

EdgeSteps edge_steps(const SetupPrimitive& p) {
  EdgeSteps steps;
  const std::array<std::int32_t, 3> x = p.x_q4(), y = p.y_q4();
  if (p.kind == SetupKind::triangle || p.kind == SetupKind::pixel) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
      steps.x[i] = static_cast<float>((y[a] - y[b]) * 16);
      steps.y[i] = static_cast<float>((x[b] - x[a]) * 16);
    }
  } else if (p.kind == SetupKind::line) {
    // The distances add up to the squared length and change by the length for each 1/16 pixel along the line.
    const std::int64_t dx = x[1] - x[0], dy = y[1] - y[0];
    const float length = std::sqrt(static_cast<float>(dx * dx + dy * dy));
    steps.x[0] = -16.0F * length;
    steps.x[1] = 16.0F * length;
  }
  return steps;
}

void Interpolation::compute(std::span<const FragmentPlace> places, bool affine, bool changes) {
  if (affine) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const FragmentPlace& place = places[i];
      for (std::size_t k = 0; k < 3; ++k) affine_[place.corners->corner[k]][i] = place.edge[k];
    }
    normalize(places.size(), affine_, sum_);
    unclip(places, affine_);
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const FragmentPlace& place = places[i];
    for (std::size_t k = 0; k < 3; ++k) {
      perspective_[place.corners->corner[k]][i] = place.edge[k] * place.corners->inv_w[k];
    }
  }
  normalize(places.size(), perspective_, sum_);
  if (changes) compute_changes(places);
  unclip(places, perspective_);
}

// A weight is g / sum, g being edge / w, which is linear in the window: its derivative is (g' - weight × sum') / sum.
void Interpolation::compute_changes(std::span<const FragmentPlace> places) {
  const auto derive = [this](std::size_t i, const SetupCorners& c, const std::array<float, 3>& step, WeightPlanes& to) {
    std::array<float, 3> change{};
    for (std::size_t k = 0; k < 3; ++k) change[c.corner[k]] = step[k] * c.inv_w[k];
    const float sum_change = (change[0] + change[1]) + change[2];
    for (std::size_t k = 0; k < 3; ++k) to[k][i] = (change[k] - perspective_[k][i] * sum_change) / sum_[i];
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const EdgeSteps steps = edge_steps(*places[i].primitive);
    derive(i, *places[i].corners, steps.x, dx_);
    derive(i, *places[i].corners, steps.y, dy_);
  }
  unclip(places, dx_);
  unclip(places, dy_);
}

}  // namespace ninebit
