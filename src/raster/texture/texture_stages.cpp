#include "ninebit/raster/texture_stages.h"

#include <algorithm>

#include "src/texture_shader/stage_lanes.h"
#include "src/texture_shader/stage_walk.h"

namespace ninebit {
namespace {

StageTarget target_of(TextureTarget target) {
  switch (target) {
    case TextureTarget::texture_1d:
      return StageTarget::one_dimensional;
    case TextureTarget::texture_2d:
      return StageTarget::two_dimensional;
    case TextureTarget::rectangle:
      return StageTarget::rectangle;
    case TextureTarget::texture_3d:
      return StageTarget::three_dimensional;
    case TextureTarget::cube_map:
      break;
  }
  return StageTarget::cube_map;
}

constexpr std::size_t kPlaces = 3;  // a fragment and its neighbours

}  // namespace

StageTexture stage_texture(const Texture& texture, const Sampler& sampler) {
  StageTexture seen{.target = target_of(texture.target), .format = base_format(texture.format)};
  if (seen.format == TextureFormat::depth && sampler.comparison != DepthComparison::none) {
    seen.format = TextureFormat::depth_comparison;
  }
  const std::array<bool, 4> is_signed = signed_components(texture, sampler);
  // Luminance, intensity and depth are stored in red, and a register has them in several components.
  const std::array<bool, 4> stored = stored_components(texture.format);
  for (std::size_t k = 0; k < 4; ++k)
    seen.is_signed[k] = is_signed[stored[k] || k == 3 ? k : 0] && (stored[k] || (k < 3 && stored[0]));
  if (seen.format == TextureFormat::intensity) seen.is_signed[3] = is_signed[0];
  return seen;
}

// The domain of a batch. Its memory is large, and not initialized.
class TextureStages::Batch {
 public:
  // Three arrays of coordinates at each place.
  using At = std::array<std::array<const float*, 3>, kPlaces>;

  Batch(const TextureStages& stages, const StageBatch& given, std::size_t count, const StageOutputs& to)
      : stages_(stages), given_(given), count_(count), to_(to), places_(stages.needs_derivatives_ ? kPlaces : 1) {
    std::fill_n(zero_.begin(), count, 0.0F);
    std::fill_n(one_.begin(), count, 1.0F);
    if (to.killed != nullptr) std::fill_n(to.killed, count, std::uint8_t{0});
    if (places_ == 1) return;
    neighbours_.resize(2 * kTextureStages * 4);
    for (int unit = 0; unit < kTextureStages; ++unit) {
      for (int k = 0; k < 4; ++k) find_neighbours(static_cast<std::size_t>(unit), static_cast<std::size_t>(k));
    }
  }

  At projected(int i) { return divided(i); }
  [[nodiscard]] At coordinates(int i) const {
    At at{};
    for (std::size_t p = 0; p < places_; ++p) at[p] = {given(p, i, 0), given(p, i, 1), given(p, i, 2)};
    return at;
  }

  At offset(int i, const TextureStage& stage) {
    const auto& by = texel(stage.previous);
    const auto& m = stage.matrix;
    return filled(2, [&](std::size_t p, std::size_t k, float* out) {
      stage_lanes::offset(given(p, i, k), {by[kBlue].data(), by[kGreen].data(), m[k], m[k + 2]}, count_, out);
    });
  }

  At dependent(int, const TextureStage& stage, int first, int second) {
    const auto& from = texel(stage.previous);
    const auto divisor = static_cast<float>(stages_.program_.choices.dependent_divisor);
    return filled(2, [&](std::size_t, std::size_t k, float* out) {
      stage_lanes::dependent(from[static_cast<std::size_t>(k == 0 ? first : second)].data(), divisor, count_, out);
    });
  }

  void dot(int i, const TextureStage& stage) {
    const auto& from = texel(stage.previous);
    const stage_lanes::Texels texels{from[0].data(), from[1].data(), from[2].data(), from[3].data()};
    for (std::size_t p = 0; p < places_; ++p) {
      stage_lanes::dot(stage.mapping, stages_.program_.choices.divisors,
                       {given(p, i, 0), given(p, i, 1), given(p, i, 2)}, texels, count_, dots_[p][index(i)].data());
    }
  }

  [[nodiscard]] At dots(int first, int number) const {
    At at{};
    for (std::size_t p = 0; p < places_; ++p) {
      for (int k = 0; k < number; ++k) at[p][index(k)] = dots_[p][index(first + k)].data();
      if (number < 3) at[p][2] = zero_.data();
    }
    return at;
  }

  At reflected(int i, const TextureStage& stage, bool is_constant) {
    const At d = dots(i - 2, 3);
    if (is_constant) {
      for (std::size_t k = 0; k < 3; ++k) std::fill_n(eye_[k].begin(), count_, stage.eye[k]);
    }
    At at{};
    for (std::size_t p = 0; p < places_; ++p) {
      const stage_lanes::Three eye = is_constant
                                         ? stage_lanes::Three{eye_[0].data(), eye_[1].data(), eye_[2].data()}
                                         : stage_lanes::Three{given(p, i - 2, 3), given(p, i - 1, 3), given(p, i, 3)};
      stage_lanes::reflect(d[p], eye, count_, {at_[p][0].data(), at_[p][1].data(), at_[p][2].data()});
      at[p] = {at_[p][0].data(), at_[p][1].data(), at_[p][2].data()};
    }
    return at;
  }

  void fetch(int i, const At& at) {
    const TextureSampler& sampler = *stages_.sampler_[index(i)];
    TextureCoordinates places{.value = at[0], .dx = {}, .dy = {}};
    if (sampler.needs_derivatives()) {
      for (std::size_t p = 1; p < kPlaces; ++p) {
        for (std::size_t k = 0; k < 3; ++k) {
          float* const change = changes_[p - 1][k].data();
          for (std::size_t n = 0; n < count_; ++n) change[n] = at[p][k][n] - at[0][k][n];
          (p == 1 ? places.dx : places.dy)[k] = change;
        }
      }
    }
    auto& to = texel_[index(i)];
    sampler.sample(places, count_, {to[0].data(), to[1].data(), to[2].data(), to[3].data()}, to_.killed);
    is_fetched_[index(i)] = true;
  }

  void scale(int i, const TextureStage& stage) {
    const s9* const luminance = texel(stage.previous)[kRed].data();
    for (std::size_t k = 0; k < 3; ++k) {
      stage_lanes::scale(stages_.program_.choices, luminance, stage.scale, stage.bias, count_,
                         texel_[index(i)][k].data());
    }
  }

  void pass(int i) {
    for (std::size_t k = 0; k < 4; ++k) {
      stage_lanes::bytes_of(stages_.program_.choices, given(0, i, k), count_, texel_[index(i)][k].data());
    }
  }

  void cull(int i, const TextureStage& stage) {
    const CullZero zero = stages_.program_.choices.cull_zero;
    for (std::size_t k = 0; k < 4; ++k) stage_lanes::cull(stage.cull[k], zero, given(0, i, k), count_, to_.killed);
  }

  void replace_depth(int i) {
    stage_lanes::divide(dots_[0][index(i - 1)].data(), dots_[0][index(i)].data(), count_, to_.depth);
  }

  void nothing(int i) { fill(i, 0); }
  void off(int i) { fill(i, stages_.program_.choices.off_alpha); }

  // The codes of all stages.
  void finish() {
    for (int i = 0; i < kTextureStages; ++i) {
      auto& from = texel_[index(i)];
      if (stages_.program_.converts_yuv && is_fetched_[index(i)]) {
        stage_lanes::convert_yuv(count_, {from[0].data(), from[1].data(), from[2].data()});
      }
      const ProgramTextureStage& stage = stages_.program_.stage[index(i)];
      for (std::size_t k = 0; k < 4; ++k) {
        s9* const to = to_.codes[index(i)][k];
        if (to == nullptr) continue;
        if (!stage.is_visible[k]) {
          std::fill_n(to, count_, s9{0});
        } else if (!stage.is_signed[k] && stages_.profile_.byte_shift == 0) {
          std::copy_n(from[k].data(), count_, to);
        } else {
          for (std::size_t n = 0; n < count_; ++n) {
            to[n] = texel_byte_code(stages_.profile_, static_cast<std::uint8_t>(from[k][n]), stage.is_signed[k]);
          }
        }
      }
    }
  }

 private:
  using Floats = std::array<float, kBatchSize>;
  using TexelPlanes4 = std::array<std::array<s9, kBatchSize>, 4>;

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] const TexelPlanes4& texel(int i) const { return texel_[index(i)]; }

  [[nodiscard]] bool has_q(int unit) const { return given_.value[index(unit)][3] != nullptr; }
  [[nodiscard]] const float* given(std::size_t p, int unit, std::size_t k) const {
    if (k == 3 && !has_q(unit)) return one_.data();
    return p == 0 ? given_.value[index(unit)][k] : neighbours_[((p - 1) * kTextureStages + index(unit)) * 4 + k].data();
  }

  void find_neighbours(std::size_t unit, std::size_t k) {
    if (!stages_.reads_[unit][k] || given_.value[unit][k] == nullptr) return;
    const float* const value = given_.value[unit][k];
    for (std::size_t p = 1; p < kPlaces; ++p) {
      const float* const change = (p == 1 ? given_.dx : given_.dy)[unit][k];
      Floats& to = neighbours_[((p - 1) * kTextureStages + unit) * 4 + k];
      for (std::size_t n = 0; n < count_; ++n) to[n] = value[n] + change[n];
    }
  }

  // Places whose first `number` coordinates `find` writes; the others are 0.
  At filled(std::size_t number, const auto& find) {
    At at{};
    for (std::size_t p = 0; p < places_; ++p) {
      for (std::size_t k = 0; k < 3; ++k) {
        Floats& to = at_[p][k];
        if (k < number) {
          find(p, k, to.data());
        } else {
          std::fill_n(to.begin(), count_, 0.0F);
        }
        at[p][k] = to.data();
      }
    }
    return at;
  }

  At divided(int i) {
    const std::size_t number = stages_.sampler_[index(i)]->needs_r() ? 3 : 2;
    if (!has_q(i)) {
      At at{};
      for (std::size_t p = 0; p < places_; ++p)
        at[p] = {given(p, i, 0), given(p, i, 1), number == 3 ? given(p, i, 2) : zero_.data()};
      return at;
    }
    return filled(number, [&](std::size_t p, std::size_t k, float* out) {
      stage_lanes::divide(given(p, i, k), given(p, i, 3), count_, out);
    });
  }

  void fill(int i, std::uint8_t alpha) {
    for (std::size_t k = 0; k < 4; ++k) std::fill_n(texel_[index(i)][k].begin(), count_, k == 3 ? s9{alpha} : s9{0});
  }

  const TextureStages& stages_;
  const StageBatch& given_;
  std::size_t count_;
  const StageOutputs& to_;
  std::size_t places_;
  std::array<bool, kTextureStages> is_fetched_{};
  std::vector<Floats> neighbours_;  // if there are derivatives
  alignas(64) std::array<TexelPlanes4, kTextureStages> texel_;
  alignas(64) std::array<std::array<Floats, kTextureStages>, kPlaces> dots_;
  alignas(64) std::array<std::array<Floats, 3>, kPlaces> at_;
  alignas(64) std::array<std::array<Floats, 3>, 2> changes_;
  alignas(64) std::array<Floats, 3> eye_;
  alignas(64) Floats zero_, one_;
};

Result<TextureStages> TextureStages::make(const HardwareProfile& profile, const TextureShaderState& state,
                                          const StageUnits& units) {
  TextureStages made;
  made.profile_ = profile;
  StageTextures textures;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    if (units.texture[i] == nullptr) continue;
    made.sampler_[i] = TextureSampler::make(profile, *units.texture[i], units.sampler[i], TexelUse::stages);
    if (made.sampler_[i]) textures[i] = stage_texture(*units.texture[i], units.sampler[i]);
  }
  auto program = compile(state, textures, profile);
  if (!program) return program.error();
  made.program_ = *std::move(program);
  made.find_reads();
  return made;
}

void TextureStages::find_reads() {
  for (int i = 0; i < kTextureStages; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const ProgramTextureStage& stage = program_.stage[at];
    if (!stage.inconsistent.empty()) continue;
    const TextureOperation operation = stage.state.operation;
    const TextureOperationInfo& info = info_of(operation);
    std::array<bool, 4>& reads = reads_[at];
    const bool all = operation == TextureOperation::pass_through || operation == TextureOperation::cull_fragment;
    const bool fetches = info.target != StageTarget::none;
    const bool dependent = operation == TextureOperation::dependent_ar || operation == TextureOperation::dependent_gb;
    const bool is_plain = fetches && info.input == StageInput::none;
    const bool moves = info.input == StageInput::offset || info.input == StageInput::luminance;
    const bool has_r = has_dot_product(operation) || (is_plain && sampler_[at]->needs_r());
    reads[0] = reads[1] = all || ((fetches || has_dot_product(operation)) && !dependent) || moves;
    reads[2] = all || has_r;
    reads[3] = reads[3] || all || (is_plain && info.target != StageTarget::cube_map);
    if (operation == TextureOperation::dot_product_reflect_cube_map) reads_[1][3] = reads_[2][3] = reads_[3][3] = true;
    if (fetches && sampler_[at]->needs_derivatives()) needs_derivatives_ = true;
    culls_ = culls_ || operation == TextureOperation::cull_fragment || (fetches && sampler_[at]->kills());
    replaces_depth_ = replaces_depth_ || operation == TextureOperation::dot_product_depth_replace;
  }
  // A diffuse cube map reads the coordinates of the stage after it, even where that stage is inconsistent.
  const ProgramTextureStage& before = program_.stage[2];
  if (before.inconsistent.empty() && before.state.operation == TextureOperation::dot_product_diffuse_cube_map) {
    reads_[3][0] = reads_[3][1] = reads_[3][2] = true;
  }
}

TextureShaderResult TextureStages::evaluate(const StageInputs& inputs) const {
  bool is_keyed = false;
  TextureShaderResult result = ninebit::evaluate(program_, profile_, inputs, [&](int unit, const TexturePlace& place) {
    std::array<float, 3> dx{}, dy{};
    TextureCoordinates at;
    for (std::size_t k = 0; k < 3; ++k) {
      dx[k] = place.right[k] - place.at[k];
      dy[k] = place.above[k] - place.at[k];
      at.value[k] = &place.at[k];
      at.dx[k] = &dx[k];
      at.dy[k] = &dy[k];
    }
    const TextureSampler& sampler = *sampler_[static_cast<std::size_t>(unit)];
    is_keyed = is_keyed || sampler.kills(at, 0);
    return sampler.bytes(at, 0);
  });
  result.is_culled = result.is_culled || is_keyed;
  return result;
}

void TextureStages::run(const StageBatch& batch, std::size_t count, const StageOutputs& to) const {
  Batch domain(*this, batch, count, to);
  for (int i = 0; i < kTextureStages; ++i) walk_stage(program_, i, domain);
  domain.finish();
}

}  // namespace ninebit
