// The domain of one fragment for the walk through a stage (stage_walk.h). A class that derives from it may hide
// members: a walk over that class breaks these rules and no others.
#pragma once

#include <cmath>
#include <cstdint>

#include "ninebit/texture_shader/evaluate_stages.h"
#include "src/texture_shader/stage_walk.h"

namespace ninebit::one_fragment {

#define NINEBIT_STAGE_RULE inline
#include "src/texture_shader/stage_rules.inl"
#undef NINEBIT_STAGE_RULE

// Rule 36: a texel as the factor of a dot product.
inline StageFactor factor_of(DotMapping mapping, DotDivisors divisors, const Bytes4& texel) {
  const auto read = [&]<DotMapping kMapping>() {
    return stage_factor<kMapping>(divisors, texel[0], texel[1], texel[2], texel[3]);
  };
  switch (mapping) {
    case DotMapping::minus1_to_1_d3d:
      return read.operator()<DotMapping::minus1_to_1_d3d>();
    case DotMapping::minus1_to_1_gl:
      return read.operator()<DotMapping::minus1_to_1_gl>();
    case DotMapping::minus1_to_1:
      return read.operator()<DotMapping::minus1_to_1>();
    case DotMapping::hilo_1:
      return read.operator()<DotMapping::hilo_1>();
    case DotMapping::hilo_hemisphere:
      return read.operator()<DotMapping::hilo_hemisphere>();
    case DotMapping::zero_to_one:
    case DotMapping::hilo_hemisphere_d3d:
    case DotMapping::hilo_hemisphere_gl:
      break;
  }
  return read.operator()<DotMapping::zero_to_one>();
}

// Numbers of three are of the fragment and of its neighbours.
class Fragment {
 public:
  using At = TexturePlace;
  using Three = std::array<float, 3>;
  using Four = std::array<float, 4>;

  Fragment(const TextureShaderProgram& program, const StageInputs& inputs, const FetchTexel& fetch,
           TextureShaderResult& result)
      : program_(program), given_{&inputs.at, &inputs.right, &inputs.above}, fetch_(fetch), result_(result) {}

  [[nodiscard]] At projected(int i) const {
    return places([&](std::size_t p) {
      const Four& c = given(p, i);
      return Three{c[0] / c[3], c[1] / c[3], c[2] / c[3]};
    });
  }
  [[nodiscard]] At coordinates(int i) const {
    return places([&](std::size_t p) { return Three{given(p, i)[0], given(p, i)[1], given(p, i)[2]}; });
  }

  At offset(int i, const TextureStage& stage) {
    const Bytes4& by = read(i, stage);
    const auto& m = stage.matrix;
    return places([&](std::size_t p) {
      const auto moved = [&](std::size_t k) {
        return offset_coordinate(given(p, i)[k], m[k], by[kBlue], m[k + 2], by[kGreen]);
      };
      return Three{moved(0), moved(1), 0.0F};
    });
  }

  At dependent(int i, const TextureStage& stage, int first, int second) {
    const Bytes4& texel = read(i, stage);
    const auto divisor = static_cast<float>(program_.choices.dependent_divisor);
    const auto at = [&](int k) { return static_cast<float>(texel[static_cast<std::size_t>(k)]) / divisor; };
    return places([&](std::size_t) { return Three{at(first), at(second), 0.0F}; });
  }

  void dot(int i, const TextureStage& stage) {
    const StageFactor n = factor_of(stage.mapping, program_.choices.divisors, read(i, stage));
    values(i).normal = std::array{n.number.x / n.over, n.number.y / n.over, n.number.z / n.over};
    for (std::size_t p = 0; p < 3; ++p) {
      const Four& c = given(p, i);
      dots_[p][static_cast<std::size_t>(i)] = stage_dot({c[0], c[1], c[2]}, n.number) / n.over;
    }
    values(i).dot = dots_[0][static_cast<std::size_t>(i)];
  }

  [[nodiscard]] At dots(int first, int count) const {
    return places([&](std::size_t p) {
      Three at{};
      for (int k = 0; k < count; ++k) at[static_cast<std::size_t>(k)] = dots_[p][static_cast<std::size_t>(first + k)];
      return at;
    });
  }

  [[nodiscard]] At reflected(int i, const TextureStage& stage, bool is_constant) const {
    const At all = dots(i - 2, 3);
    return places([&](std::size_t p) {
      const Three& d = *std::array{&all.at, &all.right, &all.above}[p];
      const Three eye = is_constant ? stage.eye : Three{given(p, i - 2)[3], given(p, i - 1)[3], given(p, i)[3]};
      const StageVector to = reflected_eye({d[0], d[1], d[2]}, {eye[0], eye[1], eye[2]});
      return Three{to.x, to.y, to.z};
    });
  }

  void fetch(int i, const At& place) {
    values(i).at = place.at;
    values(i).texel = values(i).fetched = fetch_(i, place);
  }

  void scale(int i, const TextureStage& stage) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint8_t& byte = values(i).texel[k];
      const int luminance = values(i).input[kRed];
      byte = static_cast<std::uint8_t>(
          program_.choices.byte == StageByte::nearest
              ? scaled_byte<StageByte::nearest>(program_.choices.negative, byte, luminance, stage.scale, stage.bias)
              : scaled_byte<StageByte::twelve_bits>(program_.choices.negative, byte, luminance, stage.scale,
                                                    stage.bias));
    }
  }

  void pass(int i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const float c = byte_number(program_.choices.negative, given(0, i)[k]);
      values(i).texel[k] = static_cast<std::uint8_t>(program_.choices.byte == StageByte::nearest
                                                         ? stage_byte<StageByte::nearest>(c)
                                                         : stage_byte<StageByte::twelve_bits>(c));
    }
  }

  void cull(int i, const TextureStage& stage) {
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_killed = is_killing(stage.cull[k], program_.choices.cull_zero, given(0, i)[k]);
      result_.is_culled = result_.is_culled || is_killed;
    }
  }

  void replace_depth(int i) { result_.depth = *values(i - 1).dot / *values(i).dot; }

  void nothing(int i) { values(i).texel = {}; }
  void off(int i) { values(i).texel = {0, 0, 0, program_.choices.off_alpha}; }

  // The stage's texel as colours, and as the combiners read it.
  void finish(int i, const HardwareProfile& profile) {
    StageValues& at = values(i);
    const ProgramTextureStage& stage = program_.stage[static_cast<std::size_t>(i)];
    Bytes4 shown = at.texel;
    if (program_.converts_yuv && at.at) {
      const auto rgb = rgb_of_yuv(shown[0], shown[1], shown[2]);
      shown = {static_cast<std::uint8_t>(rgb.red), static_cast<std::uint8_t>(rgb.green),
               static_cast<std::uint8_t>(rgb.blue), shown[3]};
    }
    for (std::size_t k = 0; k < 4; ++k) {
      at.codes[k] = stage.is_visible[k] ? texel_byte_code(profile, shown[k], stage.is_signed[k]) : s9{0};
    }
  }

 protected:
  StageValues& values(int i) { return result_.stage[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const StageValues& values(int i) const { return result_.stage[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Four& given(std::size_t p, int i) const { return (*given_[p])[static_cast<std::size_t>(i)]; }
  [[nodiscard]] static At places(const auto& place) { return {place(0), place(1), place(2)}; }
  const Bytes4& read(int i, const TextureStage& stage) {
    values(i).input = values(stage.previous).texel;
    return values(i).input;
  }

  const TextureShaderProgram& program_;
  std::array<const StageCoordinates*, 3> given_;
  std::array<std::array<float, kTextureStages>, 3> dots_{};
  const FetchTexel& fetch_;
  TextureShaderResult& result_;
};

// Walks through all stages.
template <class D>
void walk_stages(const TextureShaderProgram& program, const HardwareProfile& profile, D& fragment) {
  for (int i = 0; i < kTextureStages; ++i) walk_stage(program, i, fragment);
  for (int i = 0; i < kTextureStages; ++i) fragment.finish(i, profile);
}

}  // namespace ninebit::one_fragment
