#include "src/shadow/ground_truth/box_tree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace ninebit {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
// Each step halves the number of triangles, of which there are less than 2^32.
constexpr std::size_t kTreeDepth = 33;

// A ray as the test of boxes reads it: multiplied by `inverse`, the distance to a plane is the place along the ray.
struct BoxRay {
  explicit BoxRay(const LightRay& ray)
      : from(ray.from), inverse(1.0 / ray.way), end(ray.endless ? std::numeric_limits<double>::infinity() : 1.0) {}

  // In doubles, whose rounding is far below the margin of the boxes. A ray in a box's plane (0 times infinity, not a
  // number) leaves the bounds as they are, because std::max and std::min then return their first argument.
  [[nodiscard]] bool hits(const TriangleBox& box) const {
    double enter = 0.0, leave = end;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
      const double low = (static_cast<double>(box.low[axis]) - from[axis]) * inverse[axis];
      const double high = (static_cast<double>(box.high[axis]) - from[axis]) * inverse[axis];
      const bool forward = inverse[axis] >= 0.0;
      enter = std::max(enter, forward ? low : high);
      leave = std::min(leave, forward ? high : low);
    }
    return enter <= leave;
  }

  glm::dvec3 from, inverse;
  double end;
};

TriangleBox joined(const TriangleBox& a, const TriangleBox& b) {
  return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

// The axis along which the middles of the boxes are spread widest.
glm::length_t widest_axis(const std::vector<TriangleBox>& boxes, const std::uint32_t* first,
                          const std::uint32_t* last) {
  glm::vec3 low(std::numeric_limits<float>::infinity()), high = -low;
  for (; first != last; ++first) {
    const glm::vec3 middle = boxes[*first].low + boxes[*first].high;
    low = glm::min(low, middle);
    high = glm::max(high, middle);
  }
  const glm::vec3 spread = high - low;
  if (spread.x >= spread.y && spread.x >= spread.z) return 0;
  return spread.y >= spread.z ? 1 : 2;
}

}  // namespace

BoxTree::BoxTree(const Scene& scene) : order_(scene.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  std::vector<TriangleBox> boxes(order_.size());
  const double margin = box_margin(scene);
  for (const std::uint32_t triangle : order_) boxes[triangle] = box_of(scene, triangle, margin);
  if (!order_.empty()) add_tree(boxes, 0, static_cast<std::uint32_t>(order_.size()));
}

void BoxTree::add_tree(const std::vector<TriangleBox>& boxes, std::uint32_t first, std::uint32_t last) {
  const std::size_t number = nodes_.size();
  TriangleBox box = boxes[order_[first]];
  for (std::uint32_t i = first + 1; i < last; ++i) box = joined(box, boxes[order_[i]]);
  nodes_.push_back({box, first, last - first});
  if (last - first <= kLeafTriangles) return;
  const std::uint32_t middle = first + (last - first) / 2;
  const glm::length_t axis = widest_axis(boxes, order_.data() + first, order_.data() + last);
  const auto nearer = [&](std::uint32_t l, std::uint32_t r) {
    return boxes[l].low[axis] + boxes[l].high[axis] < boxes[r].low[axis] + boxes[r].high[axis];
  };
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last, nearer);
  add_tree(boxes, first, middle);
  nodes_[number].first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[number].count = 0;
  add_tree(boxes, middle, last);
}

bool BoxTree::search(const LightRay& ray, CandidateTest& test) const {
  const BoxRay boxed(ray);
  std::array<std::uint32_t, kTreeDepth + 1> waiting{};
  std::size_t count = 0;
  if (!nodes_.empty()) waiting[count++] = 0;
  while (count > 0) {
    const std::uint32_t number = waiting[--count];
    const Node& node = nodes_[number];
    if (!boxed.hits(node.box)) continue;
    if (node.count == 0) {
      waiting[count++] = node.first;
      waiting[count++] = number + 1;
      continue;
    }
    for (std::uint32_t i = 0; i < node.count; ++i) {
      if (test.take(order_[node.first + i])) return true;
    }
  }
  return false;
}

}  // namespace ninebit
