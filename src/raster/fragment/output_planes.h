// Writes a target's output planes: registers, outputs, attributes, primitive numbers and depths of fragments.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/surface.h"
#include "src/raster/fragment/fragment_operations.h"

namespace ninebit {

// The outcome of a fragment. depth_passed comes from FragmentOperations::depth_passes, called before the fragment's own
// `apply` writes its depth; drawn is the result of `apply`.
struct FragmentOutcome {
  bool depth_passed = false;
  bool drawn = false;
};

// The results of a batch; lane i of every member belongs to fragments[i].
struct BatchResults {
  std::span<const UncoloredFragment> fragments;
  std::span<const FragmentOutcome> outcomes;
  const RegisterBatch* registers = nullptr;  // after the last general combiner; for needs_registers()
  const OutputBatch* output = nullptr;       // codes of the final combiner; for needs_output()
  std::span<const ColorBytes> colors{};      // input of `apply`; for needs_colors()
  // Lanes of an attribute's four components, for needs_attribute().
  std::array<std::array<const float*, 4>, kMaxAttributes> attributes{};
};

// The output planes of one draw call, empty planes left out.
class OutputPlanes {
 public:
  explicit OutputPlanes(const RenderTarget& target);

  [[nodiscard]] bool empty() const { return planes_.empty(); }
  [[nodiscard]] bool needs_registers() const { return needs_registers_; }
  [[nodiscard]] bool needs_output() const { return needs_output_; }
  [[nodiscard]] bool needs_colors() const { return needs_colors_; }
  [[nodiscard]] bool needs_attribute(int attribute) const {
    return needs_attribute_[static_cast<std::size_t>(attribute)];
  }
  // Whether the planes need only the fragment itself: they hold only primitive numbers and depths.
  [[nodiscard]] bool need_fragment_alone() const { return need_fragment_alone_; }

  // Writes the planes' values for the fragments of a batch, in their order.
  void write(const BatchResults& results) const;

  // The same for one fragment where need_fragment_alone().
  void write(const UncoloredFragment& fragment, FragmentOutcome outcome) const;

 private:
  std::vector<OutputPlane> planes_;
  bool need_fragment_alone_ = true;
  bool needs_registers_ = false;
  bool needs_output_ = false;
  bool needs_colors_ = false;
  std::array<bool, kMaxAttributes> needs_attribute_{};
};

// Draws one fragment whose colour and planes need no batch: applies the operations and writes the planes.
inline void draw_fragment(const FragmentOperations& operations, const OutputPlanes& outputs,
                          const UncoloredFragment& fragment, const ColorBytes& color) {
  FragmentOutcome outcome{.depth_passed = operations.depth_passes(fragment)};
  outcome.drawn = operations.apply(fragment, color);
  outputs.write(fragment, outcome);
}

}  // namespace ninebit
