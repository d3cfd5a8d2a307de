// Fragments gathered over a tile until there are enough for one run of the combiners.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/raster/rasterizer.h"
#include "src/raster/fragment_operations.h"
#include "src/raster/triangle_setup.h"

namespace ninebit {

// What all tiles of one draw call share.
struct DrawContext {
  const PipelineState& state;
  const TriangleArrays& arrays;
  std::span<const CubeMap* const> textures;
  const RenderTarget& target;
  const FragmentOperations& operations;
  RegisterFile initial;  // of a fragment of this draw; primary colour and texels are its own
};

// The primary colour that flat shading gives a triangle: its own, or that of its last vertex.
[[nodiscard]] ColorBytes flat_color(const TriangleArrays& arrays, std::uint32_t primitive);

// Whether every fragment of a triangle leaves the draw with the colour that flat_color gives.
[[nodiscard]] bool has_flat_result(const DrawContext& context);

class FragmentBatch {
 public:
  explicit FragmentBatch(const DrawContext& context) : context_(context) {}

  // `edge` holds the three edge functions at the fragment: twice the areas opposite the triangle's corners.
  void push(const Fragment& fragment, const SetupTriangle& triangle, const SetupBlock& block,
            const std::array<std::int64_t, 3>& edge) {
    gather(fragment, triangle, block, edge);
    if (count_ == kBatchSize) flush();
  }

  // Runs what has been gathered through the program and the fragment operations, in the order of pushing.
  void flush();

  // Runs one fragment through an empty batch, and tells all about it but what it met in the planes.
  ProbedFragment run_alone(const Fragment& fragment, const SetupTriangle& triangle, const SetupBlock& block,
                           const std::array<std::int64_t, 3>& edge);

 private:
  void gather(const Fragment& fragment, const SetupTriangle& triangle, const SetupBlock& block,
              const std::array<std::int64_t, 3>& edge) {
    fragment_[count_] = fragment;
    // The corners' weights for perspective-correct interpolation, up to their sum.
    for (std::size_t i = 0; i < 3; ++i) {
      weight_[triangle.clipped ? i : triangle.corner[i]][count_] = static_cast<float>(edge[i]) * triangle.inv_w[i];
    }
    corners_[count_] = triangle.clipped ? &block.weights[triangle.weights] : nullptr;
    ++count_;
  }

  void normalize_weights();
  void fill_primary();
  void fill_texture(int unit);
  void fill_initial_registers();
  void capture(std::size_t i) const;
  // The colour of fragment i as it leaves the program, if there is one, or the primary colour.
  [[nodiscard]] ColorBytes color_of(std::size_t i) const;

  const DrawContext& context_;
  std::size_t count_ = 0;
  std::array<Fragment, kBatchSize> fragment_;
  std::array<std::array<float, kBatchSize>, 3> weight_;
  std::array<const glm::mat3*, kBatchSize> corners_;
  std::array<ColorBytes, kBatchSize> primary_;
  RegisterBatch registers_;
  OutputBatch out_;
};

}  // namespace ninebit
