#include "src/raster/lanes/lane_inputs.h"

#include <algorithm>
#include <cstring>

#include "src/raster/fragment/sprite_place.h"
#include "src/raster/surface/tile_size.h"

namespace ninebit {
namespace {

// Calls visit(i, at) for the fragments of a run of points.
template <class Visit>
void for_sprites(const LaneFragments& f, std::size_t r, const LaneBatch& batch, const DrawContext& context,
                 const Visit& visit) {
  const SetupPrimitive& point = *f.run[r].primitive;
  const int eighths = eighths_of(context.state.point_size);
  for (std::size_t i = f.run[r].first; i < f.run[r + 1].first; ++i) {
    const auto place = static_cast<int>(f.place[i]);
    visit(i, sprite_place(point, eighths, batch.left + place % kTileSize, batch.bottom + place / kTileSize));
  }
}

}  // namespace

void place_points(const LaneFragments& f, LaneBatch& batch, const DrawContext& context, std::size_t unit,
                  bool changes) {
  const float change = sprite_change(eighths_of(context.state.point_size));
  for (std::size_t r = 0; r < f.runs; ++r) {
    if (f.run[r].primitive->kind != SetupKind::point) continue;
    const auto fill = [&](LaneFragments::Lanes<float>& lanes, float value) {
      std::fill(&lanes[f.run[r].first], &lanes[f.run[r + 1].first], value);
    };
    if (changes) fill(batch.dx.coordinate[0], context.point_change[unit]);
    if (!has_sprites(context.state, unit)) continue;
    for_sprites(f, r, batch, context, [&](std::size_t i, const SpritePlace& at) {
      batch.coordinate[0][i] = at.s;
      batch.coordinate[1][i] = at.t;
    });
    fill(batch.coordinate[2], 0.0F);
    if (!changes) continue;
    for (LaneBatch::Changes* const by : {&batch.dx, &batch.dy}) {
      for (auto& lanes : by->coordinate) fill(lanes, 0.0F);
    }
    fill(batch.dx.coordinate[0], change);
    fill(batch.dy.coordinate[1], -change);
  }
}

void place_stage_points(const LaneFragments& f, LaneBatch& batch, const DrawContext& context, std::size_t unit) {
  FragmentStages& stages = *batch.stages;
  const float change = sprite_change(eighths_of(context.state.point_size));
  for (std::size_t r = 0; r < f.runs; ++r) {
    if (f.run[r].primitive->kind != SetupKind::point) continue;
    const float width = context.point_change[unit];
    for (std::size_t i = f.run[r].first; i < f.run[r + 1].first && stages.kinds() > 1 && width != 0.0F; ++i) {
      stages.at(1, unit, 0)[i] = width * stages.at(0, unit, 3)[i];
    }
    if (!has_sprites(context.state, unit)) continue;
    for_sprites(f, r, batch, context, [&](std::size_t i, const SpritePlace& at) {
      const auto values = sprite_coordinates(at, change);
      for (std::size_t kind = 0; kind < stages.kinds(); ++kind) {
        for (std::size_t k = 0; k < 4; ++k) {
          if (stages.needs(unit, k)) stages.at(kind, unit, k)[i] = values[kind][k];
        }
      }
    });
  }
}

void unclip(const LaneFragments& f, std::array<LaneFragments::Lanes<float>, 3>& shares) {
  for (std::size_t r = 0; r < f.runs; ++r) {
    const LaneFragments::Run& run = f.run[r];
    if (run.weights == nullptr) continue;
    const glm::mat3& m = *run.weights;
    for (std::size_t i = run.first; i < f.run[r + 1].first; ++i) {
      const std::array<float, 3> w{shares[0][i], shares[1][i], shares[2][i]};
      for (int k = 0; k < 3; ++k) {
        shares[static_cast<std::size_t>(k)][i] = (w[0] * m[0][k] + w[1] * m[1][k]) + w[2] * m[2][k];
      }
    }
  }
}

void fill_flat_colors(const LaneFragments& f, LaneBatch& batch, const DrawContext& context) {
  for (std::size_t r = 0; r < f.runs; ++r) {
    const LaneFragments::Run& run = f.run[r];
    const ColorBytes color = context.flat_primary(run.primitive->primitive);
    std::uint32_t word = 0;
    std::memcpy(&word, color.data(), sizeof(word));
    std::fill_n(batch.color.begin() + static_cast<std::ptrdiff_t>(run.first), f.run[r + 1].first - run.first, word);
  }
}

void refill_constants(LaneBatch& batch, const DrawContext& context) {
  const auto fill = [&](Register reg, int component) {
    std::fill_n(batch.registers(reg, component), kBatchSize, context.initial[reg][static_cast<std::size_t>(component)]);
  };
  if (batch.has_constants) {
    for (const RegisterComponent& c : context.refilled) fill(c.reg, c.component);
    return;
  }
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (int k = 0; k < 4; ++k) fill(static_cast<Register>(r), k);
  }
  batch.has_constants = true;
}

void sample(LaneBatch& batch, std::size_t count, const DrawContext& context, std::size_t unit, bool one_change) {
  TextureCoordinates coordinates;
  coordinates.one_change = one_change;
  for (std::size_t k = 0; k < 3; ++k) {
    coordinates.value[k] = batch.coordinate[k].data();
    coordinates.dx[k] = batch.dx.coordinate[k].data();
    coordinates.dy[k] = batch.dy.coordinate[k].data();
  }
  const Register reg = texture_register(static_cast<int>(unit));
  context.samplers[unit]->sample(coordinates, count,
                                 {batch.registers(reg, kRed), batch.registers(reg, kGreen), batch.registers(reg, kBlue),
                                  batch.registers(reg, kAlpha)},
                                 batch.keyed.data());
  if (unit == 0) {
    std::copy_n(batch.registers(reg, kAlpha), count, batch.registers(Register::spare0, kAlpha));
  }
}

}  // namespace ninebit
