#include "src/raster/fragment/fragment_batch.h"

#include <algorithm>

#include "ninebit/numerics/fixed9.h"
#include "src/raster/fragment/fog.h"
#include "src/raster/rules/one_fragment.h"

namespace ninebit {
namespace {

std::array<float, 3> eight_bit_weights(const std::array<float, 3>& share, bool is_line) {
  constexpr one_fragment::Numbers o{};
  const auto weights = is_line ? one_fragment::eight_bit_line_weights(o, share[0], share[1], share[2])
                               : one_fragment::eight_bit_weights(o, share[0], share[2]);
  return {weights.first, weights.second, weights.third};
}

}  // namespace

bool FragmentBatch::has_smooth_colors() const {
  return !context_.shades_flat();
}

ColorBytes FragmentBatch::smooth_color(std::span<const ColorBytes> colors, std::size_t i) const {
  const bool affine = context_.state.profile.color_interpolation.value == ColorInterpolation::affine;
  const WeightPlanes& weight = affine ? weights_.affine() : weights_.perspective();
  const std::array<std::uint32_t, 3>& v = place_[i].corners->vertex;
  const ColorBytes &a = colors[v[0]], &b = colors[v[1]], &c = colors[v[2]];
  std::array<float, 3> share{weight[0][i], weight[1][i], weight[2][i]};
  if (context_.state.profile.color_weights.value == ColorWeights::eight_bits) {
    share = eight_bit_weights(share, place_[i].primitive->kind == SetupKind::line);
  }
  ColorBytes bytes;
  for (std::size_t k = 0; k < 4; ++k) {
    const float value = (share[0] * static_cast<float>(a[k]) + share[1] * static_cast<float>(b[k])) +
                        share[2] * static_cast<float>(c[k]);
    bytes[k] = static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
  }
  return bytes;
}

void FragmentBatch::fill_primary() {
  const std::span<const ColorBytes> colors = context_.arrays.vertex_colors;
  const bool flat = context_.shades_flat(colors);
  for (std::size_t i = 0; i < count_; ++i) {
    color_[i] = flat ? context_.flat_primary(fragment_[i].primitive) : smooth_color(colors, i);
  }
}

void FragmentBatch::fill_secondary() {
  const HardwareProfile& profile = context_.state.profile;
  const std::span<const ColorBytes> colors = context_.arrays.secondary_colors;
  const bool flat = context_.shades_flat(colors);
  const int components = profile.secondary_alpha.value == SecondaryAlpha::one ? 3 : 4;
  for (std::size_t i = 0; i < count_; ++i) {
    const ColorBytes color = flat ? context_.flat_secondary(fragment_[i].primitive) : smooth_color(colors, i);
    for (int k = 0; k < components; ++k) {
      registers_(Register::secondary, k)[i] = from_byte(profile, color[static_cast<std::size_t>(k)]);
    }
  }
}

void FragmentBatch::fill_fog() {
  const HardwareProfile& profile = context_.state.profile;
  const Fog& fog = context_.state.fog;
  const std::span<const float> values = context_.arrays.fog_factors;
  const auto at_vertex = [&](std::uint32_t v) { return fog_at_vertex(fog, values[v]); };
  s9* const codes = registers_(Register::fog, kAlpha);
  for (std::size_t i = 0; i < count_; ++i) {
    const std::array<std::uint32_t, 3>& v = place_[i].corners->vertex;
    const float x = interpolate(weights_.perspective(), i, at_vertex(v[0]), at_vertex(v[1]), at_vertex(v[2]));
    codes[i] = from_byte(profile, fog_byte(profile, fog, x));
  }
}

// (s, t, r) / q, and the change of s/q: (s' - (s/q) q') / q.
void FragmentBatch::divide_coordinates(std::size_t unit, std::size_t components, std::size_t kinds) {
  const std::span<const float> at_vertex = context_.arrays.texture_q[unit];
  const std::array<const WeightPlanes*, 3> weights{&weights_.perspective(), &weights_.dx(), &weights_.dy()};
  for (std::size_t i = 0; i < count_; ++i) {
    const std::array<std::uint32_t, 3>& v = place_[i].corners->vertex;
    const float a = at_vertex[v[0]], b = at_vertex[v[1]], c = at_vertex[v[2]];
    const float q = interpolate(*weights[0], i, a, b, c);
    for (std::size_t k = 0; k < components; ++k) coordinates_[0][k][i] /= q;
    for (std::size_t kind = 1; kind < kinds; ++kind) {
      const float change = interpolate(*weights[kind], i, a, b, c);
      for (std::size_t k = 0; k < components; ++k) {
        float& value = coordinates_[kind][k][i];
        value = (value - coordinates_[0][k][i] * change) / q;
      }
    }
  }
}

void FragmentBatch::fill_texture(std::size_t unit) {
  const TextureSampler& sampler = *context_.samplers[unit];
  const VertexCoordinates at_vertex = context_.coordinates(unit);
  const std::size_t components = sampler.needs_r() ? 3 : 2;
  const std::array<const WeightPlanes*, 3> weights{&weights_.perspective(), &weights_.dx(), &weights_.dy()};
  const std::size_t kinds = sampler.needs_derivatives() ? 3 : 1;
  for (std::size_t i = 0; i < count_; ++i) {
    const std::array<glm::vec3, 3> corner = at_vertex.of(place_[i].corners->vertex);
    const glm::vec3 a = corner[0], b = corner[1], c = corner[2];
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      for (std::size_t k = 0; k < components; ++k) {
        const auto n = static_cast<int>(k);
        coordinates_[kind][k][i] = interpolate(*weights[kind], i, a[n], b[n], c[n]);
      }
    }
  }
  if (context_.reads_q(unit)) divide_coordinates(unit, components, kinds);
  for (std::size_t i = 0; i < count_ && kinds > 1; ++i) {
    if (place_[i].primitive->kind == SetupKind::point) coordinates_[1][0][i] = context_.point_change[unit];
  }
  for (std::size_t i = 0; i < count_; ++i) {
    if (!is_sprite(i, unit)) continue;
    const int eighths = eighths_of(context_.state.point_size);
    const SpritePlace at = sprite_place(*place_[i].primitive, eighths, fragment_[i].x, fragment_[i].y);
    const std::array<std::array<float, 4>, 3> values = sprite_coordinates(at, sprite_change(eighths));
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      for (std::size_t k = 0; k < components; ++k) coordinates_[kind][k][i] = values[kind][k];
    }
  }
  TextureCoordinates coordinates;
  for (std::size_t k = 0; k < components; ++k) {
    coordinates.value[k] = coordinates_[0][k].data();
    coordinates.dx[k] = coordinates_[1][k].data();
    coordinates.dy[k] = coordinates_[2][k].data();
  }
  const Register reg = texture_register(static_cast<int>(unit));
  sampler.sample(coordinates, count_,
                 {registers_(reg, kRed), registers_(reg, kGreen), registers_(reg, kBlue), registers_(reg, kAlpha)},
                 keyed_.data());
}

void FragmentBatch::fill_stage_coordinate(std::size_t kind, std::size_t unit, std::size_t k) {
  const WeightPlanes& weights = *std::array{&weights_.perspective(), &weights_.dx(), &weights_.dy()}[kind];
  FragmentStages::Lanes& to = stages_->at(kind, unit, k);
  const std::span<const float> q = context_.arrays.texture_q[unit];
  const VertexCoordinates str = context_.coordinates(unit);
  const auto component = static_cast<int>(k);
  for (std::size_t i = 0; i < count_; ++i) {
    const std::array<std::uint32_t, 3>& v = place_[i].corners->vertex;
    if (k == 3) {
      to[i] = interpolate(weights, i, q[v[0]], q[v[1]], q[v[2]]);
    } else {
      const std::array<glm::vec3, 3> corner = str.of(v);
      to[i] = interpolate(weights, i, corner[0][component], corner[1][component], corner[2][component]);
    }
  }
}

void FragmentBatch::run_stages() {
  for (std::size_t unit = 0; unit < kTextureStages; ++unit) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (!stages_->needs(unit, k)) continue;
      for (std::size_t kind = 0; kind < stages_->kinds(); ++kind) fill_stage_coordinate(kind, unit, k);
    }
    for (std::size_t i = 0; i < count_ && stages_->kinds() > 1; ++i) {
      const float change = context_.point_change[unit];
      if (change == 0.0F || place_[i].primitive->kind != SetupKind::point) continue;
      stages_->at(1, unit, 0)[i] = change * stages_->at(0, unit, 3)[i];
    }
    for (std::size_t i = 0; i < count_; ++i) {
      if (!is_sprite(i, unit)) continue;
      const int eighths = eighths_of(context_.state.point_size);
      const SpritePlace at = sprite_place(*place_[i].primitive, eighths, fragment_[i].x, fragment_[i].y);
      const std::array<std::array<float, 4>, 3> values = sprite_coordinates(at, sprite_change(eighths));
      for (std::size_t kind = 0; kind < stages_->kinds(); ++kind) {
        for (std::size_t k = 0; k < 4; ++k) {
          if (stages_->needs(unit, k)) stages_->at(kind, unit, k)[i] = values[kind][k];
        }
      }
    }
  }
  stages_->run(count_, registers_);
  for (std::size_t i = 0; i < count_ && context_.stages->replaces_depth(); ++i) fragment_[i].depth = stages_->depth(i);
}

void FragmentBatch::fill_registers() {
  const auto constant = [this](Register reg, int component) {
    const s9 code = context_.initial[reg][static_cast<std::size_t>(component)];
    std::fill_n(registers_(reg, component), kBatchSize, code);
  };
  if (!has_constants_) {
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (int k = 0; k < 4; ++k) constant(static_cast<Register>(r), k);
    }
    has_constants_ = true;
  } else {
    for (const RegisterComponent& c : context_.refilled) constant(c.reg, c.component);
  }
  const HardwareProfile& profile = context_.state.profile;
  for (std::size_t k = 0; k < 4; ++k) {
    s9* const codes = registers_(Register::primary, static_cast<int>(k));
    for (std::size_t i = 0; i < count_; ++i) codes[i] = from_byte(profile, color_[i][k]);
  }
  if (!context_.arrays.secondary_colors.empty()) fill_secondary();
  if (context_.state.fog.enabled && !context_.arrays.fog_factors.empty()) fill_fog();
  if (stages_) return run_stages();
  keyed_.fill(0);
  for (std::size_t unit = 0; unit < context_.samplers.size(); ++unit) {
    if (context_.reads_unit[unit]) fill_texture(unit);
  }
  if (context_.reads_unit[0]) {
    std::copy_n(registers_(Register::texture0, kAlpha), count_, registers_(Register::spare0, kAlpha));
  }
}

// One component at a time: with the three loops nested the other way, GCC 12 (-fivopts) generates wrong code once
// functions are hidden from other libraries and therefore inlined here.
void FragmentBatch::interpolate_attributes() {
  for (std::size_t n = 0; n < attributes_.size(); ++n) {
    if (!context_.outputs.needs_attribute(static_cast<int>(n))) continue;
    const std::span<const glm::vec4> at_vertex = context_.arrays.attributes[n];
    for (std::size_t k = 0; k < 4; ++k) {
      const auto component = static_cast<int>(k);
      Lanes& values = attributes_[n][k];
      for (std::size_t i = 0; i < count_; ++i) {
        const std::array<std::uint32_t, 3>& v = place_[i].corners->vertex;
        values[i] = interpolate(weights_.perspective(), i, at_vertex[v[0]][component], at_vertex[v[1]][component],
                                at_vertex[v[2]][component]);
      }
    }
  }
}

void FragmentBatch::run_program() {
  const PipelineState& state = context_.state;
  if (!state.program) {
    for (int k = 0; k < 4; ++k) {
      std::copy_n(registers_(Register::primary, k), count_, out_.plane[static_cast<std::size_t>(k)].data());
    }
    return;
  }
  context_.program->run(registers_, count_, out_);
  for (std::size_t k = 0; k < 4; ++k) {
    if (!context_.wanted_color[k]) continue;  // its plane has no values
    for (std::size_t i = 0; i < count_; ++i) color_[i][k] = to_byte(state.profile, out_.plane[k][i]);
  }
}

void FragmentBatch::draw() {
  const OutputPlanes& outputs = context_.outputs;
  if (outputs.empty()) {
    for (std::size_t i = 0; i < count_; ++i) {
      if (!is_culled(i)) context_.operations.apply(fragment_[i], color_[i]);
    }
    return;
  }
  for (std::size_t i = 0; i < count_; ++i) {
    outcome_[i] = {};
    if (is_culled(i)) continue;
    outcome_[i].depth_passed = context_.operations.depth_passes(fragment_[i]);
    outcome_[i].drawn = context_.operations.apply(fragment_[i], color_[i]);
  }
  BatchResults results{.fragments = {fragment_.data(), count_},
                       .outcomes = {outcome_.data(), count_},
                       .registers = &registers_,
                       .output = &out_,
                       .colors = {color_.data(), count_},
                       .attributes = {}};
  for (std::size_t n = 0; n < attributes_.size(); ++n) {
    for (std::size_t k = 0; k < 4; ++k) results.attributes[n][k] = attributes_[n][k].data();
  }
  outputs.write(results);
}

void FragmentBatch::begin() {
  const bool affine =
      has_smooth_colors() && context_.state.profile.color_interpolation.value == ColorInterpolation::affine;
  weights_.compute({place_.data(), count_}, affine, context_.needs_texture_changes);
  fill_primary();
}

ProbedFragment FragmentBatch::run_alone() {
  begin();
  fill_registers();
  const UncoloredFragment& fragment = fragment_[0];
  ProbedFragment probed;
  if (stages_) probed.stages = context_.stages->evaluate(stages_->inputs(0));
  probed.primitive = fragment.primitive;
  probed.depth = fragment.depth;
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (int k = 0; k < 4; ++k) {
      probed.registers.value[r][static_cast<std::size_t>(k)] = registers_(static_cast<Register>(r), k)[0];
    }
  }
  run_program();
  probed.color = color_[0];
  probed.depth_passes = !is_culled(0) && context_.operations.depth_passes(fragment);
  probed.fate = is_culled(0) ? FragmentFate::culled : context_.operations.fate_of(fragment, color_[0]);
  if (!is_culled(0)) context_.operations.apply(fragment, color_[0]);
  count_ = 0;
  return probed;
}

void FragmentBatch::flush() {
  if (count_ == 0) return;
  begin();
  if (context_.fills_registers) {
    fill_registers();
    run_program();
  } else if (context_.stages_decide) {
    run_stages();
  }
  interpolate_attributes();
  draw();
  count_ = 0;
}

}  // namespace ninebit
