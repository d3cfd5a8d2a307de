#include "src/raster/lanes/lane_batch.h"

#include <algorithm>
#include <cstdint>

#include "src/numerics/simd_targets.h"
#include "src/raster/lanes/lane_inputs.h"
#include "src/raster/lanes/lane_pass.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/lanes/lane_batch.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
#include "src/raster/lanes/lane_interpolation-inl.h"
#include "src/raster/lanes/lane_operations-inl.h"
#include "src/raster/lanes/lane_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

void draw_batch(TilePlanes&, const LanePass&, LaneFragments&) {}

#else

constexpr hn::Rebind<std::int16_t, D> kD16;

// Stores the bytes of the batch's colours as register codes: the components that the program reads.
HWY_INLINE void colors_to_codes(LaneBatch& batch, std::size_t count, const DrawContext& context,
                                const VertexColors& from) {
  for (int k = 0; k < from.components; ++k) {
    if (!context.program->reads().contains(from.reg, k)) continue;
    s9* const to = batch.registers(from.reg, k);
    const int shift = 8 * k, byte_shift = context.state.profile.byte_shift;
    for (std::size_t i = 0; i < count; i += kLaneCount) {
      const V color = hn::Load(kD, lanes_of(batch.color.data()) + i);
      const V byte = hn::And(hn::ShiftRightSame(color, shift), hn::Set(kD, 0xFF));
      hn::StoreU(hn::DemoteTo(kD16, hn::ShiftRightSame(byte, byte_shift)), kD16, to + i);
    }
  }
}

// Stores the combiners' results as bytes, see to_byte; components that nothing reads as 0.
HWY_INLINE void output_to_colors(LaneBatch& batch, std::size_t count, const DrawContext& context) {
  constexpr hn::Repartition<s9, D> codes;
  constexpr hn::RebindToUnsigned<decltype(codes)> d16;
  constexpr hn::Half<decltype(d16)> half;
  constexpr hn::RebindToUnsigned<D> words;
  const HardwareProfile& profile = context.state.profile;
  const int shift = profile.byte_shift;
  const std::array<bool, 4> wanted = context.wanted_color;
  const auto below_one = hn::Set(codes, static_cast<s9>(profile.one - 1));
  for (std::size_t i = 0; i < count; i += 2 * kLaneCount) {
    // The bytes in lanes of 16 bits, whose high bytes are unspecified.
    const auto bytes = [&](std::size_t k) HWY_ATTR {
      if (!wanted[k]) return hn::Zero(d16);
      const auto code = hn::Load(codes, batch.out.plane[k].data() + i);
      auto wide = code;
      if (shift != 0) wide = hn::Or(hn::ShiftLeftSame(code, shift), hn::ShiftRightSame(code, 8 - 2 * shift));
      return hn::BitCast(d16, hn::Or(wide, hn::VecFromMask(codes, hn::Gt(code, below_one))));
    };
    const auto pairs = [&](std::size_t low, std::size_t high) HWY_ATTR {
      return hn::Or(hn::And(bytes(low), hn::Set(d16, 0xFF)), hn::ShiftLeft<8>(bytes(high)));
    };
    const auto low = pairs(kRed, kGreen), high = pairs(kBlue, kAlpha);
    const auto put = [&](hn::Vec<decltype(half)> a, hn::Vec<decltype(half)> b, std::size_t at) HWY_ATTR {
      const auto color = hn::Or(hn::PromoteTo(words, a), hn::ShiftLeft<16>(hn::PromoteTo(words, b)));
      hn::Store(color, words, batch.color.data() + at);
    };
    put(hn::LowerHalf(half, low), hn::LowerHalf(half, high), i);
    put(hn::UpperHalf(half, low), hn::UpperHalf(half, high), i + kLaneCount);
  }
}

// The fragment operations of one facing, for the fragments of a batch.
struct BatchOperations {
  const LaneDraw<D>& draw;
  const LaneFragments& fragments;
  bool by_stencil;             // LanePass::draws_by_stencil
  const std::uint8_t* culled;  // culled_fragments()
};

// The fragments of `mask`, from i on, that are not culled.
HWY_INLINE M not_culled(const std::uint8_t* culled, std::size_t i, M mask) {
  if (culled == nullptr) return mask;
  const hn::Rebind<std::uint8_t, D> d8;
  return hn::And(mask, hn::Eq(hn::PromoteTo(kD, hn::LoadU(d8, culled + i)), hn::Zero(kD)));
}

// The operations on fragments from i on, the lanes of `mask`, whose pixels hold `stored`.
HWY_INLINE LaneResult<D> operate(const BatchOperations& batch, std::size_t i, M mask, V color, V stored) {
  const LaneDraw<D>& draw = batch.draw;
  const V alpha = hn::BitCast(kD, hn::ShiftRight<24>(hn::BitCast(hn::RebindToUnsigned<D>(), color)));
  mask = not_culled(batch.culled, i, mask);
  if (!draw.operations.are_tests_final) {
    return apply_lanes(kD, draw, mask, hn::LoadU(kD, lanes_of(batch.fragments.depth.data()) + i), alpha, stored);
  }
  if (batch.by_stencil) mask = hn::And(mask, stencil_passes(kD, draw, stored));
  mask = alpha_passes(kD, draw, mask, alpha);
  if (!draw.operations.stencil_write) return {stored, mask};
  const V bits = hn::Set(kD, 0xFF);
  const V value = stencil_lanes(kD, draw.side.depth_pass, draw.side, hn::And(stored, bits));
  return {hn::IfThenElse(mask, hn::Or(hn::AndNot(bits, stored), value), stored), mask};
}

// A vector of the batch's colours as they are stored in the pixels from `at` on.
HWY_INLINE V stored_colors(const LaneOperations& operations, V colors, const std::int32_t* at) {
  return stored_colors(kD, operations, colors, operations.blends ? hn::LoadU(kD, at) : colors);
}

// A vector of a span's fragments.
struct SpanPart {
  std::size_t place;  // of the first one's pixel
  std::size_t first;  // fragment
  std::size_t count;  // fragments left in the span; may exceed a vector
};

// Calls visit(part) for a span's vectors.
template <class Visit>
HWY_INLINE void for_parts(const LaneFragments::Span span, const Visit& visit) {
  std::size_t i = 0;
  do {
    visit(SpanPart{span.place + i, span.first + i, span.count - i});
    i += kLaneCount;
  } while (HWY_UNLIKELY(i < span.count));
}

HWY_INLINE V load_stored(const TilePlanes& tile, const SpanPart& part) {
  return hn::LoadU(kD, lanes_of(tile.depth_stencil.data()) + part.place);
}

// 1 for each fragment that a stage culls or a colour key kills, else 0; null if none does.
HWY_INLINE const std::uint8_t* culled_fragments(const LanePass& pass) {
  if (pass.context.kills_by_key) return pass.batch->keyed.data();
  const bool culls = pass.context.stages && pass.context.stages->culls();
  return culls ? pass.batch->stages->culled() : nullptr;
}

// Draws the spans [first, end). kChanges: colours are blended, or not stored as they are.
template <bool kChanges>
HWY_INLINE void operate_on_spans_of(TilePlanes& tile, const LaneFragments& f, const LanePass& pass,
                                    const LaneDraw<D>& draw, std::size_t first, std::size_t end) {
  const LaneOperations& operations = draw.operations;
  const std::int32_t* const batch_colors = lanes_of(pass.batch->color.data());
  const bool by_stencil = pass.draws_by_stencil();
  const std::uint8_t* const culled = culled_fragments(pass);
  const bool writes = operations.depth_write || operations.stencil_write;
  if (operations.are_tests_final && !operations.alpha && !writes) {
    if (!operations.color) return;  // nothing is written
    const bool draws_all = !by_stencil && culled == nullptr;
    const auto draw_part = [&](const SpanPart& part) HWY_ATTR {
      std::int32_t* const to = lanes_of(tile.color.data()) + part.place;
      V color = hn::LoadU(kD, batch_colors + part.first);
      if constexpr (kChanges) color = stored_colors(operations, color, to);
      // Some processors store masked vectors slowly.
      if (draws_all && part.count >= kLaneCount) return hn::StoreU(color, kD, to);
      M mask = not_culled(culled, part.first, hn::FirstN(kD, part.count));
      if (by_stencil) mask = hn::And(mask, stencil_passes(kD, draw, load_stored(tile, part)));
      store_where(mask, color, kD, to);
    };
    for (std::size_t s = first; s < end; ++s) for_parts(f.span[s], draw_part);
    return;
  }
  const auto draw_part = [&](const SpanPart& part) HWY_ATTR {
    const V color = hn::LoadU(kD, batch_colors + part.first);
    const LaneResult<D> result =
        operate({draw, f, by_stencil, culled}, part.first, hn::FirstN(kD, part.count), color, load_stored(tile, part));
    if (writes) hn::StoreU(result.depth_stencil, kD, lanes_of(tile.depth_stencil.data()) + part.place);
    if (operations.color) {
      std::int32_t* const to = lanes_of(tile.color.data()) + part.place;
      store_where(result.drawn, kChanges ? stored_colors(operations, color, to) : color, kD, to);
    }
  };
  for (std::size_t s = first; s < end; ++s) for_parts(f.span[s], draw_part);
}

HWY_NOINLINE void operate_on_changing_spans(TilePlanes& tile, const LaneFragments& f, const LanePass& pass,
                                            const LaneDraw<D>& draw, std::size_t first, std::size_t end) {
  operate_on_spans_of<true>(tile, f, pass, draw, first, end);
}

// The usual way stays small: all of it is compiled into its callers.
HWY_INLINE void operate_on_spans(TilePlanes& tile, const LaneFragments& f, const LanePass& pass,
                                 const LaneDraw<D>& draw, std::size_t first, std::size_t end) {
  const bool changes = !draw.operations.store.is_exact || draw.operations.blends;
  if (HWY_UNLIKELY(changes)) return operate_on_changing_spans(tile, f, pass, draw, first, end);
  operate_on_spans_of<false>(tile, f, pass, draw, first, end);
}

// True if spans are worth a vector each: gather instructions are faster below this mean length.
HWY_INLINE bool has_long_spans(const LaneFragments& f) {
  constexpr std::size_t kShort = 3;
  return f.count >= kShort * f.spans;
}

// The places of the fragments of `mask`, from i on; the other lanes have that of a word behind the planes.
HWY_INLINE V places_from(const LaneFragments& f, std::size_t i, M mask) {
  return hn::IfThenElse(mask, hn::LoadU(kD, lanes_of(f.place.data()) + i), hn::Set(kD, kTilePixels));
}

// Draws fragments at any places, a full vector at a time.
HWY_INLINE void operate_on_places(TilePlanes& tile, const LaneFragments& f, const LanePass& pass,
                                  const LaneDraw<D>& draw) {
  const LaneBatch& batch = *pass.batch;
  const LaneOperations& operations = draw.operations;
  std::int32_t* const stored = lanes_of(tile.depth_stencil.data());
  std::int32_t* const colors = lanes_of(tile.color.data());
  for (std::size_t i = 0; i < f.count; i += kLaneCount) {
    const auto mask = hn::FirstN(kD, f.count - i);
    const V place = places_from(f, i, mask);
    const V color = hn::LoadU(kD, lanes_of(batch.color.data()) + i);
    const LaneResult<D> result = operate({draw, f, pass.draws_by_stencil(), culled_fragments(pass)}, i, mask, color,
                                         hn::GatherIndex(kD, stored, place));
    if (operations.depth_write || operations.stencil_write) {
      hn::ScatterIndex(result.depth_stencil, kD, stored, place);
    }
    if (operations.color) {
      const V there = hn::GatherIndex(kD, colors, place);
      const V after = stored_colors(kD, operations, color, there);
      hn::ScatterIndex(hn::IfThenElse(result.drawn, after, there), kD, colors, place);
    }
  }
}

HWY_INLINE void fill_color_register(LaneFragments& f, LaneBatch& batch, const DrawContext& context,
                                    const VertexColors& from) {
  if (!context.reads[static_cast<std::size_t>(from.reg)]) return;
  if (context.shades_flat(from.colors)) {
    return fill_flat_codes(f, batch, context, from, [&](const LaneFragments::Run& run) {
      const std::uint32_t primitive = run.primitive->primitive;
      return from.reg == Register::primary ? context.flat_primary(primitive) : context.flat_secondary(primitive);
    });
  }
  if (have_equal_corners(f, context, from.colors)) {
    return fill_flat_codes(f, batch, context, from,
                           [&](const LaneFragments::Run& run) { return from.colors[run.corners->vertex[0]]; });
  }
  find_shares(f, batch, context);
  fill_smooth_colors(f, batch, context, from.colors);
  colors_to_codes(batch, f.count, context, from);
}

// Runs the texture-shader stages: texture registers, culled fragments, replaced depths.
HWY_NOINLINE void run_stages(LaneFragments& f, LaneBatch& batch, const DrawContext& context) {
  FragmentStages& stages = *batch.stages;
  find_shares(f, batch, context);
  const std::array<const Shares*, 3> shares{&f.weight, &batch.dx.share, &batch.dy.share};
  for (std::size_t unit = 0; unit < kTextureStages; ++unit) {
    for (std::size_t kind = 0; kind < stages.kinds(); ++kind) {
      StageLanes to{};
      for (std::size_t k = 0; k < 4; ++k) {
        if (stages.needs(unit, k)) to[k] = stages.at(kind, unit, k).data();
      }
      fill_stage_coordinates(f, *shares[kind], context, unit, to);
    }
    if (context.draws_points) place_stage_points(f, batch, context, unit);
  }
  stages.run(f.count, batch.registers);
  for (std::size_t i = 0; i < f.count && context.stages->replaces_depth(); ++i) f.depth[i] = stages.depth(i);
}

// Samples the textures of units that have no stages.
HWY_INLINE void fill_textures(LaneFragments& f, LaneBatch& batch, const DrawContext& context) {
  if (context.kills_by_key) std::fill_n(batch.keyed.begin(), f.count, std::uint8_t{0});
  for (std::size_t unit = 0; unit < context.samplers.size(); ++unit) {
    if (!context.reads_unit[unit]) continue;
    find_shares(f, batch, context);
    const TextureSampler& sampler = *context.samplers[unit];
    const int components = sampler.needs_r() ? 3 : 2;
    const VertexCoordinates at_vertex = context.coordinates(unit);
    fill_coordinates(f, f.weight, batch.coordinate, at_vertex, components);
    const bool one_change = f.has_one_change && !context.reads_q(unit);
    if (sampler.needs_derivatives()) {
      fill_coordinates(f, batch.dx.share, batch.dx.coordinate, at_vertex, components, one_change);
      fill_coordinates(f, batch.dy.share, batch.dy.coordinate, at_vertex, components, one_change);
    }
    if (context.reads_q(unit)) {
      divide_coordinates(f, batch, context.arrays.texture_q[unit], components, sampler.needs_derivatives());
    }
    if (HWY_UNLIKELY(context.draws_points)) place_points(f, batch, context, unit, sampler.needs_derivatives());
    sample(batch, f.count, context, unit, one_change);
  }
}

// The same for the fragments that a key kills alone.
HWY_NOINLINE void find_keyed(LaneFragments& f, LaneBatch& batch, const DrawContext& context) {
  fill_textures(f, batch, context);
}

// Fills the registers that the program reads.
HWY_INLINE void fill_registers(LaneFragments& f, LaneBatch& batch, const DrawContext& context) {
  refill_constants(batch, context);
  const VertexArrays& arrays = context.arrays;
  fill_color_register(f, batch, context, {Register::primary, arrays.vertex_colors, 4});
  if (!arrays.secondary_colors.empty()) {
    const bool has_alpha = context.state.profile.secondary_alpha.value != SecondaryAlpha::one;
    fill_color_register(f, batch, context, {Register::secondary, arrays.secondary_colors, has_alpha ? 4 : 3});
  }
  if (HWY_UNLIKELY(context.state.fog.enabled && !arrays.fog_factors.empty()) &&
      context.reads[static_cast<std::size_t>(Register::fog)]) {
    find_shares(f, batch, context);
    fill_fog(f, batch, context);
  }
  context.stages ? run_stages(f, batch, context) : fill_textures(f, batch, context);
}

// Finds the colours that the combiners give, or primary colours if there is no program.
HWY_INLINE void find_colors(LaneFragments& f, LaneBatch& batch, const DrawContext& context) {
  if (context.state.program) {
    fill_registers(f, batch, context);
    context.program->run(batch.registers, f.count, batch.out);
    output_to_colors(batch, f.count, context);
  } else if (context.shades_flat(context.arrays.vertex_colors)) {
    fill_flat_colors(f, batch, context);
  } else {
    find_shares(f, batch, context);
    fill_smooth_colors(f, batch, context, context.arrays.vertex_colors);
  }
}

// Multiplies alpha of smoothed primitives by the coverage (rule 47). The compiler vectorizes the inner loop.
HWY_INLINE void cover(const LaneFragments& f, LaneBatch& batch, const PipelineState& state, std::uint32_t rounding) {
  for (std::size_t r = 0; r < f.runs; ++r) {
    const SetupKind kind = f.run[r].primitive->kind;
    const bool is_smooth = kind == SetupKind::line ? state.line_smooth : state.polygon_smooth;
    if (!is_smooth || kind == SetupKind::point) continue;
    for (std::size_t i = f.run[r].first; i < f.run[r + 1].first; ++i) {
      const std::uint32_t color = batch.color[i], alpha = ((color >> 24) * f.coverage[i] + rounding) / 255;
      batch.color[i] = (color & 0xFFFFFF) | alpha << 24;
    }
  }
}

// Sends fragments through the combiners and the fragment operations.
HWY_NOINLINE void finish(TilePlanes& tile, const LanePass& pass, LaneFragments& f) {
  const bool needs_color = pass.operations.needs_color();
  pass.batch->left = tile.left;
  pass.batch->bottom = tile.bottom;
  if (!(needs_color && pass.context.state.program)) {
    if (pass.context.stages_decide) run_stages(f, *pass.batch, pass.context);
    if (pass.context.kills_by_key) find_keyed(f, *pass.batch, pass.context);
  }
  if (needs_color) find_colors(f, *pass.batch, pass.context);
  if (needs_color && pass.operations.smooths) {
    cover(f, *pass.batch, pass.context.state, pass.operations.coverage_rounding);
  }
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

// True if any fragment passes the stencil test.
HWY_INLINE bool any_passes_stencil(const TilePlanes& tile, const LanePass& pass, const LaneFragments& f) {
  const LaneDraw<D> draw(kD, pass.operations, true);
  if (has_long_spans(f)) {
    M passing = hn::FirstN(kD, 0);
    const auto test_part = [&](const SpanPart& part) HWY_ATTR {
      passing = hn::Or(passing, hn::And(hn::FirstN(kD, part.count), stencil_passes(kD, draw, load_stored(tile, part))));
    };
    for (std::size_t s = 0; s < f.spans; ++s) {
      for_parts(f.span[s], test_part);
      if (!hn::AllFalse(kD, passing)) return true;
    }
    return false;
  }
  for (std::size_t i = 0; i < f.count; i += kLaneCount) {
    const auto mask = hn::FirstN(kD, f.count - i);
    const V stored = hn::GatherIndex(kD, lanes_of(tile.depth_stencil.data()), places_from(f, i, mask));
    if (!hn::AllFalse(kD, hn::And(mask, stencil_passes(kD, draw, stored)))) return true;
  }
  return false;
}

void draw_batch(TilePlanes& tile, const LanePass& pass, LaneFragments& f) {
  if (!pass.draws_by_stencil() || any_passes_stencil(tile, pass, f)) finish(tile, pass, f);
}

#endif

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {

HWY_EXPORT(draw_batch);

void draw_batch(TilePlanes& tile, const LanePass& pass, LaneFragments& f) {
  HWY_DYNAMIC_DISPATCH(draw_batch)(tile, pass, f);
}

}  // namespace ninebit
#endif
