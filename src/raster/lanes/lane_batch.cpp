// What a batch of fragments goes through: interpolation, combiners, fragment operations.
#include "src/raster/lanes/lane_batch.h"

#include "src/raster/lanes/lane_inputs.h"
#include "src/raster/lanes/tile_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/lanes/lane_batch.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

void draw_batch(LaneTile&, LanePass&, LaneFragments&) {}

#else

#include "src/raster/lanes/lane_operations.inl"

using D = hn::CappedTag<std::int32_t, 16>;
using V = hn::Vec<D>;
using DF = hn::Rebind<float, D>;
using VF = hn::Vec<DF>;
using D16 = hn::Rebind<std::int16_t, D>;
constexpr D kD;
constexpr DF kDF;
constexpr D16 kD16;
constexpr std::size_t kLanes = hn::MaxLanes(kD);

#include "src/raster/lanes/lane_interpolation.inl"

// The bytes of each colour that the program reads, as register codes.
HWY_INLINE void colors_to_codes(LaneBatch& batch, std::size_t count, const DrawContext& context) {
  for (int k = 0; k < 4; ++k) {
    if (!context.program->reads().contains(Register::primary, k)) continue;
    s9* const to = batch.registers(Register::primary, k);
    const int shift = 8 * k, byte_shift = context.state.profile.byte_shift;
    for (std::size_t i = 0; i < count; i += kLanes) {
      const V color = hn::Load(kD, lanes_of(batch.color.data()) + i);
      const V byte = hn::And(hn::ShiftRightSame(color, shift), hn::Set(kD, 0xFF));
      hn::StoreU(hn::DemoteTo(kD16, hn::ShiftRightSame(byte, byte_shift)), kD16, to + i);
    }
  }
}

// What leaves the combiners as bytes, see to_byte; those that nothing looks at as 0.
HWY_INLINE void output_to_colors(LaneBatch& batch, std::size_t count, const DrawContext& context) {
  const HardwareProfile& profile = context.state.profile;
  const int shift = profile.byte_shift;
  const V one = hn::Set(kD, profile.one);
  for (std::size_t i = 0; i < count; i += kLanes) {
    V color = hn::Zero(kD);
    for (std::size_t k = 4; k-- > 0;) {
      color = hn::ShiftLeft<8>(color);
      if (!context.wanted_color[k]) continue;
      const V code = hn::Max(hn::PromoteTo(kD, hn::LoadU(kD16, batch.out.plane[k].data() + i)), hn::Zero(kD));
      const V wide =
          shift == 0 ? code : hn::Or(hn::ShiftLeftSame(code, shift), hn::ShiftRightSame(code, 8 - 2 * shift));
      color = hn::Or(color, hn::IfThenElse(hn::Lt(code, one), wide, hn::Set(kD, 255)));
    }
    hn::Store(color, kD, lanes_of(batch.color.data()) + i);
  }
}

// Whether of a batch's fragments, which were gathered whatever the stencil says, those count that pass its test.
bool asks_stencil(const LanePass& pass) {
  return (pass.keeps || pass.repeats) && pass.operations.stencil_decides;
}

// What the operations make of fragments from i on, all of one facing: `mask` of them, whose pixels hold `stored`.
HWY_INLINE LaneResult<D> operate(const LaneFragments& f, const LaneDraw<D>& draw, bool asks_stencil, std::size_t i,
                                 hn::Mask<D> mask, V color, V stored) {
  const V alpha = hn::BitCast(kD, hn::ShiftRight<24>(hn::BitCast(hn::RebindToUnsigned<D>(), color)));
  if (!draw.operations.are_tests_final) {
    return apply_lanes(kD, draw, mask, hn::LoadU(kD, lanes_of(f.depth.data()) + i), alpha, stored);
  }
  if (asks_stencil) mask = hn::And(mask, stencil_passes(kD, draw, stored));
  mask = alpha_passes(kD, draw, mask, alpha);
  if (!draw.operations.stencil_write) return {stored, mask};
  const V bits = hn::Set(kD, 0xFF);
  const V value = stencil_lanes(kD, draw.side.depth_pass, draw.side, hn::And(stored, bits));
  return {hn::IfThenElse(mask, hn::Or(hn::AndNot(bits, stored), value), stored), mask};
}

HWY_INLINE V load_stored(const LaneTile& tile, const LaneFragments::Span& span) {
  return hn::LoadU(kD, lanes_of(tile.tile.depth_stencil.data()) + span.place);
}

// Spans of fragments, a vector for each.
HWY_INLINE void operate_on_spans(LaneTile& tile, const LaneFragments& f, const LanePass& pass, const LaneDraw<D>& draw,
                                 std::size_t first, std::size_t end) {
  const LaneOperations& operations = draw.operations;
  const LaneBatch& batch = *pass.batch;
  const bool asks = asks_stencil(pass);
  const bool writes = operations.depth_write || operations.stencil_write;
  if (operations.are_tests_final && !operations.alpha && !writes) {
    for (std::size_t s = first; s < end; ++s) {
      const LaneFragments::Span& span = f.span[s];
      auto mask = hn::FirstN(kD, span.count);
      if (asks) mask = hn::And(mask, stencil_passes(kD, draw, load_stored(tile, span)));
      hn::BlendedStore(hn::LoadU(kD, lanes_of(batch.color.data()) + span.first), mask, kD,
                       lanes_of(tile.tile.color.data()) + span.place);
    }
    return;
  }
  for (std::size_t s = first; s < end; ++s) {
    const LaneFragments::Span& span = f.span[s];
    std::int32_t* const stored = lanes_of(tile.tile.depth_stencil.data()) + span.place;
    std::int32_t* const colors = lanes_of(tile.tile.color.data()) + span.place;
    const V color = hn::LoadU(kD, lanes_of(batch.color.data()) + span.first);
    const LaneResult<D> result =
        operate(f, draw, asks, span.first, hn::FirstN(kD, span.count), color, hn::LoadU(kD, stored));
    if (writes) hn::StoreU(result.depth_stencil, kD, stored);
    if (operations.color) hn::BlendedStore(color, result.drawn, kD, colors);
  }
}

// Whether spans are worth a vector each: gathering is faster below this mean length.
HWY_INLINE bool has_long_spans(const LaneFragments& f) {
  constexpr std::size_t kShort = 3;
  return f.count >= kShort * f.spans;
}

// Where the fragments of `mask` lie, from i on; the others at a word behind the planes.
HWY_INLINE V places_from(const LaneFragments& f, std::size_t i, hn::Mask<D> mask) {
  return hn::IfThenElse(mask, hn::LoadU(kD, lanes_of(f.place.data()) + i), hn::Set(kD, kTilePixels));
}

// Fragments at any places, a full vector at a time.
HWY_INLINE void operate_on_places(LaneTile& tile, const LaneFragments& f, const LanePass& pass,
                                  const LaneDraw<D>& draw) {
  const LaneBatch& batch = *pass.batch;
  const LaneOperations& operations = draw.operations;
  std::int32_t* const stored = lanes_of(tile.tile.depth_stencil.data());
  std::int32_t* const colors = lanes_of(tile.tile.color.data());
  for (std::size_t i = 0; i < f.count; i += kLanes) {
    const auto mask = hn::FirstN(kD, f.count - i);
    const V place = places_from(f, i, mask);
    const V color = hn::LoadU(kD, lanes_of(batch.color.data()) + i);
    const LaneResult<D> result =
        operate(f, draw, asks_stencil(pass), i, mask, color, hn::GatherIndex(kD, stored, place));
    if (operations.depth_write || operations.stencil_write) {
      hn::ScatterIndex(result.depth_stencil, kD, stored, place);
    }
    if (operations.color) {
      hn::ScatterIndex(hn::IfThenElse(result.drawn, color, hn::GatherIndex(kD, colors, place)), kD, colors, place);
    }
  }
}

// The registers that the program reads.
HWY_INLINE void fill_registers(LaneFragments& f, LaneBatch& batch, const DrawContext& context) {
  refill_constants(batch, context);
  if (context.reads[static_cast<std::size_t>(Register::primary)]) {
    if (context.shades_flat()) {
      fill_flat_codes(f, batch, context);
    } else {
      find_shares(f);
      fill_smooth_colors(f, batch, context.arrays.vertex_colors);
      colors_to_codes(batch, f.count, context);
    }
  }
  for (std::size_t unit = 0; unit < context.samplers.size(); ++unit) {
    if (!context.reads_unit[unit]) continue;
    find_shares(f);
    const int components = context.samplers[unit]->needs_r() ? 3 : 2;
    fill_coordinates(f, batch, context.arrays.texture_coordinates[unit], components);
    if (context.reads_q(unit)) divide_coordinates(f, batch, context.arrays.texture_q[unit], components);
    sample(batch, f.count, context, unit);
  }
}

// What leaves the combiners.
HWY_INLINE void find_colors(LaneFragments& f, LaneBatch& batch, const DrawContext& context) {
  if (context.state.program) {
    fill_registers(f, batch, context);
    context.program->run(batch.registers, f.count, batch.out);
    output_to_colors(batch, f.count, context);
  } else if (context.shades_flat()) {
    fill_flat_colors(f, batch, context);
  } else {
    find_shares(f);
    fill_smooth_colors(f, batch, context.arrays.vertex_colors);
  }
}

// Sends fragments through the combiners and what follows.
HWY_NOINLINE void finish(LaneTile& tile, LanePass& pass, LaneFragments& f) {
  if (pass.operations.needs_color()) find_colors(f, *pass.batch, pass.context);
  if (pass.operations.two_sided) {
    std::size_t r = 0;
    for (std::size_t s = 0; s < f.spans; ++s) {
      while (f.span[s].first >= f.run[r + 1].first) ++r;
      operate_on_spans(tile, f, pass, LaneDraw<D>(kD, pass.operations, f.run[r].primitive->front_facing), s, s + 1);
    }
    return;
  }
  const LaneDraw<D> draw(kD, pass.operations, true);
  if (has_long_spans(f)) {
    operate_on_spans(tile, f, pass, draw, 0, f.spans);
  } else {
    operate_on_places(tile, f, pass, draw);
  }
}

// Whether any fragment passes the stencil test.
HWY_INLINE bool any_passes_stencil(const LaneTile& tile, const LanePass& pass, const LaneFragments& f) {
  const LaneDraw<D> draw(kD, pass.operations, true);
  if (has_long_spans(f)) {
    for (std::size_t s = 0; s < f.spans; ++s) {
      const auto passing = stencil_passes(kD, draw, load_stored(tile, f.span[s]));
      if (!hn::AllFalse(kD, hn::And(hn::FirstN(kD, f.span[s].count), passing))) return true;
    }
    return false;
  }
  for (std::size_t i = 0; i < f.count; i += kLanes) {
    const auto mask = hn::FirstN(kD, f.count - i);
    const V stored = hn::GatherIndex(kD, lanes_of(tile.tile.depth_stencil.data()), places_from(f, i, mask));
    if (!hn::AllFalse(kD, hn::And(mask, stencil_passes(kD, draw, stored)))) return true;
  }
  return false;
}

// Draws the fragments of a batch, or of one that is kept those that pass the stencil test.
void draw_batch(LaneTile& tile, LanePass& pass, LaneFragments& f) {
  if (!asks_stencil(pass) || any_passes_stencil(tile, pass, f)) finish(tile, pass, f);
}

#endif

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {

HWY_EXPORT(draw_batch);

void LaneTile::keep_none() {
  kept = 0;
  has_kept_all = true;
  begin_batch(false);
}

void LaneTile::begin_batch(bool keeps_last) {
  if (keeps_last && kept + 1 < kMostKept) {
    ++kept;
  } else if (keeps_last) {
    has_kept_all = false;
  }
  if (batches.size() == kept) batches.push_back(std::make_unique<LaneFragments>());
  fragments = batches[kept].get();
  fragments->clear();
  occupied.fill(0);
}

void flush_lanes(LaneTile& tile, LanePass& pass) {
  LaneFragments& f = *tile.fragments;
  if (f.count == 0) return;
  f.run[f.runs].first = f.count;
  HWY_DYNAMIC_DISPATCH(draw_batch)(tile, pass, f);
  tile.begin_batch(pass.keeps);
}

void repeat_fragments(LaneTile& tile, LanePass& pass) {
  for (std::size_t i = 0; i < tile.kept; ++i) HWY_DYNAMIC_DISPATCH(draw_batch)(tile, pass, *tile.batches[i]);
}

}  // namespace ninebit
#endif
