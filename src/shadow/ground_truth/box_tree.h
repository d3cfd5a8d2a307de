// A tree of boxes around a scene's triangles, which finds a ray's candidates without another library.
#pragma once

#include <cstdint>
#include <vector>

#include "src/shadow/ground_truth/ground_truth_rays.h"

namespace ninebit {

class BoxTree final : public BoxSearch {
 public:
  // Keeps no reference to the scene.
  explicit BoxTree(const Scene& scene);
  [[nodiscard]] bool search(const LightRay& ray, CandidateTest& test) const override;

 private:
  struct Node {
    TriangleBox box;
    std::uint32_t first;  // of a leaf: its first place in order_; of others: the second child, the first one follows
    std::uint32_t count;  // triangles of a leaf; 0: not a leaf
  };

  // Adds the tree of order_[first, last).
  void add_tree(const std::vector<TriangleBox>& boxes, std::uint32_t first, std::uint32_t last);

  std::vector<Node> nodes_{};           // the root first; empty: no triangles
  std::vector<std::uint32_t> order_{};  // the triangles, leaf by leaf
};

}  // namespace ninebit
