// Fragments gathered over a tile until there are enough for one run of the combiners.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/raster/rasterizer.h"
#include "src/raster/fragment/draw_context.h"
#include "src/raster/fragment/fragment_operations.h"
#include "src/raster/fragment/fragment_stages.h"
#include "src/raster/fragment/interpolation.h"
#include "src/raster/fragment/sprite_place.h"
#include "src/raster/setup/window_primitives.h"

namespace ninebit {

class FragmentBatch {
 public:
  explicit FragmentBatch(const DrawContext& context)
      : context_(context), stages_(context.stages ? std::make_unique<FragmentStages>(context) : nullptr) {}

  // `edge`: see FragmentPlace. The primitive and its block must stay until the next flush.
  void push(const UncoloredFragment& fragment, const SetupPrimitive& primitive, const SetupBlock& block,
            const std::array<std::int64_t, 3>& edge) {
    fragment_[count_] = fragment;
    FragmentPlace& place = place_[count_];
    place.primitive = &primitive;
    place.corners = &block.corners_of(primitive);
    place.weights = block.weights_of(*place.corners);
    for (std::size_t i = 0; i < 3; ++i) place.edge[i] = static_cast<float>(edge[i]);
    if (++count_ == kBatchSize) flush();
  }

  // Runs the gathered fragments through the program and the fragment operations, in the order of pushing.
  void flush();

  [[nodiscard]] std::size_t size() const { return count_; }
  // The same for a single gathered fragment of a probe's context; returns all its values except the stored ones.
  [[nodiscard]] ProbedFragment run_alone();

 private:
  using Lanes = std::array<float, kBatchSize>;

  [[nodiscard]] bool has_smooth_colors() const;
  void begin();
  void fill_primary();
  void fill_secondary();
  void fill_fog();
  void fill_texture(std::size_t unit);
  void run_stages();
  void fill_stage_coordinate(std::size_t kind, std::size_t unit, std::size_t k);
  // Whether fragment i has coordinates that run across its point, of that unit.
  [[nodiscard]] bool is_sprite(std::size_t i, std::size_t unit) const {
    return has_sprites(context_.state, unit) && place_[i].primitive->kind == SetupKind::point;
  }
  void divide_coordinates(std::size_t unit, std::size_t components, std::size_t kinds);
  void fill_registers();
  void interpolate_attributes();
  void run_program();
  void draw();
  [[nodiscard]] bool is_culled(std::size_t i) const {
    if (context_.kills_by_key) return keyed_[i] != 0;
    return stages_ && context_.stages->culls() && stages_->culled()[i] != 0;
  }

  // A smooth colour of vertices at fragment i, each component rounded to nearest.
  [[nodiscard]] ColorBytes smooth_color(std::span<const ColorBytes> colors, std::size_t i) const;

  const DrawContext& context_;
  std::size_t count_ = 0;
  bool has_constants_ = false;  // whether the constant registers have been filled
  std::array<UncoloredFragment, kBatchSize> fragment_;
  std::array<FragmentPlace, kBatchSize> place_;
  std::array<FragmentOutcome, kBatchSize> outcome_;
  std::array<ColorBytes, kBatchSize> color_;  // primary, then the combiners' output
  Interpolation weights_;
  std::array<std::array<Lanes, 3>, 3> coordinates_;  // of a texture: values, changes in x, changes in y
  std::array<std::array<Lanes, 4>, kMaxAttributes> attributes_;
  std::array<std::uint8_t, kBatchSize> keyed_{};  // 1: killed by a colour key
  std::unique_ptr<FragmentStages> stages_;        // if they are enabled
  RegisterBatch registers_;
  OutputBatch out_;
};

}  // namespace ninebit
