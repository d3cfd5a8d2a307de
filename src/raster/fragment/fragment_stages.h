// The texture-shader stages of a batch of fragments: their coordinates, and what the stages do to the fragments.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/raster/texture_stages.h"
#include "src/raster/fragment/draw_context.h"

namespace ninebit {

// Large: about 40 KiB, three times that with derivatives.
class FragmentStages {
 public:
  static constexpr std::size_t kRoom = kBatchSize + 64;  // vectors are stored whole beyond the last fragment
  using Lanes = std::array<float, kRoom>;
  using Coordinates = std::array<std::array<Lanes, 4>, kTextureStages>;  // [unit][s, t, r, q]

  // The context, whose stages are enabled, must outlive the object.
  explicit FragmentStages(const DrawContext& context);

  // Whether the vertices give a unit's q; else it is 1 here, and nobody fills it in.
  [[nodiscard]] bool has_q(std::size_t unit) const { return !context_.arrays.texture_q[unit].empty(); }
  // Whether a unit's coordinate k has to be filled in.
  [[nodiscard]] bool needs(std::size_t unit, std::size_t k) const {
    return context_.stages->reads(static_cast<int>(unit), static_cast<int>(k)) && (k < 3 || has_q(unit));
  }
  // The number of kinds of coordinates: those of the fragments, and, if needed, their changes in x and in y.
  [[nodiscard]] std::size_t kinds() const { return coordinates_.size(); }
  [[nodiscard]] Lanes& at(std::size_t kind, std::size_t unit, std::size_t k) { return coordinates_[kind][unit][k]; }

  // The coordinates of fragment i and of its neighbours.
  [[nodiscard]] StageInputs inputs(std::size_t i) const;

  // Runs the stages of `count` fragments into the texture registers that are read, and spare0's alpha.
  void run(std::size_t count, RegisterBatch& registers);

  // Then, if the stages cull: 1 for a fragment that is culled, else 0.
  [[nodiscard]] const std::uint8_t* culled() const { return culled_.data(); }
  // Then, if the stages replace depths: the codes.
  [[nodiscard]] std::uint32_t depth(std::size_t i) const {
    return replaced_depth_code(context_.stages->program(), depth_[i], context_.largest_depth);
  }

 private:
  const DrawContext& context_;
  std::vector<Coordinates> coordinates_;  // by kind
  std::array<std::uint8_t, kRoom> culled_{};
  Lanes depth_{};
};

}  // namespace ninebit
