#include "src/raster/fragment_batch.h"

#include <algorithm>

namespace ninebit {
namespace {

constexpr ColorBytes kWhite{255, 255, 255, 255};

bool shades_flat(const DrawContext& context) {
  return context.state.shade_model == ShadeModel::flat || context.arrays.vertex_colors.empty();
}

}  // namespace

ColorBytes flat_color(const TriangleArrays& arrays, std::uint32_t primitive) {
  if (!arrays.triangle_colors.empty()) return arrays.triangle_colors[primitive];
  if (!arrays.vertex_colors.empty()) return arrays.vertex_colors[arrays.triangles[primitive].z];
  return kWhite;
}

bool has_flat_result(const DrawContext& context) {
  if (!context.target.captures.empty()) return false;
  if (!context.operations.writes_color() && !context.operations.needs_alpha()) return true;
  return !context.state.program && shades_flat(context);
}

void FragmentBatch::normalize_weights() {
  for (std::size_t i = 0; i < count_; ++i) {
    const float sum = (weight_[0][i] + weight_[1][i]) + weight_[2][i];
    for (auto& weight : weight_) weight[i] /= sum;
  }
  for (std::size_t i = 0; i < count_; ++i) {
    if (corners_[i] == nullptr) continue;
    const glm::mat3& m = *corners_[i];
    const std::array<float, 3> w{weight_[0][i], weight_[1][i], weight_[2][i]};
    for (int k = 0; k < 3; ++k) {
      weight_[static_cast<std::size_t>(k)][i] = (w[0] * m[0][k] + w[1] * m[1][k]) + w[2] * m[2][k];
    }
  }
}

void FragmentBatch::fill_primary() {
  const TriangleArrays& arrays = context_.arrays;
  const bool flat = shades_flat(context_);
  for (std::size_t i = 0; i < count_; ++i) {
    ColorBytes& bytes = primary_[i];
    if (flat) {
      bytes = flat_color(arrays, fragment_[i].primitive);
    } else {
      const glm::uvec3 v = arrays.triangles[fragment_[i].primitive];
      const ColorBytes &a = arrays.vertex_colors[v.x], &b = arrays.vertex_colors[v.y], &c = arrays.vertex_colors[v.z];
      for (std::size_t k = 0; k < 4; ++k) {
        const float value = (weight_[0][i] * static_cast<float>(a[k]) + weight_[1][i] * static_cast<float>(b[k])) +
                            weight_[2][i] * static_cast<float>(c[k]);
        bytes[k] = static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
      }
    }
  }
}

void FragmentBatch::fill_texture(int unit) {
  const HardwareProfile& profile = context_.state.profile;
  const Register reg = texture_register(unit);
  const auto u = static_cast<std::size_t>(unit);
  const CubeMap& map = *context_.textures[u];
  const std::span<const glm::vec3> coordinates = context_.arrays.texture_coordinates[u];
  for (std::size_t i = 0; i < count_; ++i) {
    const glm::uvec3 v = context_.arrays.triangles[fragment_[i].primitive];
    const glm::vec3 &a = coordinates[v.x], &b = coordinates[v.y], &c = coordinates[v.z];
    std::array<float, 3> r;
    for (int k = 0; k < 3; ++k) {
      r[static_cast<std::size_t>(k)] = (weight_[0][i] * a[k] + weight_[1][i] * b[k]) + weight_[2][i] * c[k];
    }
    const CubeMap::Texel texel = map.nearest(r[0], r[1], r[2]);
    const auto& face = map.faces[static_cast<std::size_t>(texel.face)];
    for (int k = 0; k < 3; ++k) {
      registers_(reg, k)[i] = from_byte(profile, face[static_cast<std::size_t>(k)].at(texel.x, texel.y));
    }
  }
}

void FragmentBatch::fill_initial_registers() {
  const HardwareProfile& profile = context_.state.profile;
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (int k = 0; k < 4; ++k) {
      std::fill_n(registers_(static_cast<Register>(r), k), count_,
                  context_.initial.value[r][static_cast<std::size_t>(k)]);
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    s9* const codes = registers_(Register::primary, static_cast<int>(k));
    for (std::size_t i = 0; i < count_; ++i) codes[i] = from_byte(profile, primary_[i][k]);
  }
  for (std::size_t unit = 0; unit < context_.textures.size(); ++unit) {
    if (context_.textures[unit] != nullptr) fill_texture(static_cast<int>(unit));
  }
}

void FragmentBatch::capture(std::size_t i) const {
  const Fragment& f = fragment_[i];
  if (!context_.operations.depth_passes(f)) return;
  for (const RegisterCapture& c : context_.target.captures) {
    if (!c.plane) continue;
    c.plane.at(f.x, f.y) =
        c.reg ? registers_(*c.reg, c.component)[i] : out_.plane[static_cast<std::size_t>(c.component)][i];
  }
}

ColorBytes FragmentBatch::color_of(std::size_t i) const {
  if (!context_.state.program) return primary_[i];
  ColorBytes color;
  for (std::size_t k = 0; k < 4; ++k) color[k] = to_byte(context_.state.profile, out_.plane[k][i]);
  return color;
}

void FragmentBatch::flush() {
  if (count_ == 0) return;
  const PipelineState& state = context_.state;
  normalize_weights();
  fill_primary();
  const bool captures = !context_.target.captures.empty();
  if (state.program || captures) fill_initial_registers();
  if (state.program) {
    evaluate(*state.program, registers_, count_, out_);
  } else if (captures) {
    for (int k = 0; k < 4; ++k) {
      std::copy_n(registers_(Register::primary, k), count_, out_.plane[static_cast<std::size_t>(k)].data());
    }
  }
  for (std::size_t i = 0; i < count_; ++i) {
    if (captures) capture(i);
    context_.operations.apply(fragment_[i], color_of(i));
  }
  count_ = 0;
}

ProbedFragment FragmentBatch::run_alone(const Fragment& fragment, const SetupTriangle& triangle,
                                        const SetupBlock& block, const std::array<std::int64_t, 3>& edge) {
  gather(fragment, triangle, block, edge);
  normalize_weights();
  fill_primary();
  fill_initial_registers();
  ProbedFragment probed;
  probed.primitive = fragment.primitive;
  probed.z24 = fragment.z24;
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (int k = 0; k < 4; ++k) {
      probed.registers.value[r][static_cast<std::size_t>(k)] = registers_(static_cast<Register>(r), k)[0];
    }
  }
  if (context_.state.program) evaluate(*context_.state.program, registers_, count_, out_);
  probed.color = color_of(0);
  probed.depth_passes = context_.operations.depth_passes(fragment);
  probed.fate = context_.operations.apply(fragment, probed.color);
  count_ = 0;
  return probed;
}

}  // namespace ninebit
