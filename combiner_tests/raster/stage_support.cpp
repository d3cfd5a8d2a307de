#include "combiner_tests/raster/stage_support.h"

#include <cmath>

#include "combiner_tests/support/random_stages.h"
#include "combiner_tests/support/special_floats.h"

namespace ninebit::test {
namespace {

// A texture for an operation, most often of the kind that it reads.
TextureTarget target_for(Random& random, TextureOperation operation) {
  constexpr std::array kStageTargets{TextureTarget::texture_1d, TextureTarget::texture_2d, TextureTarget::rectangle,
                                     TextureTarget::texture_3d, TextureTarget::cube_map};
  const auto place = static_cast<std::size_t>(info_of(operation).target);
  return place == 0 || random.one_in(12) ? kStageTargets[static_cast<std::size_t>(random.below(5))]
                                         : kStageTargets[place - 1];
}

void choose_operations(Random& random, TextureOperation wanted, StageCase& c) {
  const TextureOperationInfo& info = info_of(wanted);
  const int place = random.between(info.first, info.last);
  for (int i = 0; i < kTextureStages; ++i) {
    TextureStage& stage = c.state.stage[static_cast<std::size_t>(i)];
    stage.operation = random_stage_operation(random, i);
    if (i == 0 && random.one_in(2)) stage.operation = TextureOperation::texture_2d;
    if (i < place && i >= place - info.dots_before) stage.operation = TextureOperation::dot_product;
    if (i == place) stage.operation = wanted;
    if (i == 3 && wanted == TextureOperation::dot_product_diffuse_cube_map) {
      stage.operation = random.pick(
          {TextureOperation::dot_product_reflect_cube_map, TextureOperation::dot_product_const_eye_reflect_cube_map});
    }
    const bool chained = info.dots_before > 0 && i > 0 && !random.one_in(10);
    stage.previous = i == 0 || chained ? 0 : random.below(i);
    do {
      stage.mapping = static_cast<DotMapping>(random.below(8));
    } while (stage.mapping == DotMapping::hilo_hemisphere_d3d || stage.mapping == DotMapping::hilo_hemisphere_gl);
    for (CullMode& mode : stage.cull) mode = random.pick({CullMode::kills_negative, CullMode::kills_not_negative});
    for (float& entry : stage.matrix) entry = random.real_f(-2, 2);
    stage.scale = random.pick({1.0F, 0.0F, random.real_f(-2, 3)});
    stage.bias = random.pick({0.0F, random.real_f(-1, 1)});
    for (float& e : stage.eye) e = random.real_f(-1, 1);
  }
}

void choose_texture(Random& random, std::size_t unit, StageCase& c) {
  if (random.one_in(25)) return;
  const bool is_gl = c.state.rules == StageRules::open_gl;
  const TextureTarget target = target_for(random, c.state.stage[unit].operation);
  InternalFormat format = random.pick({InternalFormat::rgba8, InternalFormat::rgba8, InternalFormat::rgb8,
                                       InternalFormat::luminance8, InternalFormat::luminance8_alpha8,
                                       InternalFormat::alpha8, InternalFormat::intensity8, InternalFormat::hilo16});
  const bool offsets = unit < 3 && info_of(c.state.stage[unit + 1].operation).input <= StageInput::luminance &&
                       info_of(c.state.stage[unit + 1].operation).input != StageInput::none;
  if (is_gl && (offsets || random.one_in(4))) {
    format = random.pick({InternalFormat::dsdt8, InternalFormat::dsdt8_mag8, InternalFormat::dsdt8_mag8_intensity8});
  }
  const int width = 1 << random.below(5);
  const bool square = target == TextureTarget::cube_map, one_row = target == TextureTarget::texture_1d;
  const int height = square ? width : one_row ? 1 : 1 << random.below(5);
  Sampler sampler;
  const bool mipmaps = c.has_mipmaps && target != TextureTarget::rectangle;
  sampler.min_filter = random.pick({MinFilter::nearest, MinFilter::linear});
  if (mipmaps && random.one_in(2)) sampler.min_filter = kMinFilters[static_cast<std::size_t>(random.below(6))];
  sampler.mag_filter = mipmaps                                   ? random.pick({MagFilter::nearest, MagFilter::linear})
                       : sampler.min_filter == MinFilter::linear ? MagFilter::linear
                                                                 : MagFilter::nearest;
  for (Wrap* const wrap : {&sampler.wrap_s, &sampler.wrap_t, &sampler.wrap_r}) {
    *wrap = static_cast<Wrap>(random.below(static_cast<int>(Wrap::clamp_to_border) + 1));
  }
  for (float& border : sampler.border_color) border = random.real_f(0, 1);
  if (random.one_in(2)) {
    for (bool& is_signed : sampler.is_signed) is_signed = random.one_in(2);
  }
  c.textures[unit] = random_texture(random, target, format, width, height, mipmaps);
  c.units.texture[unit] = &c.textures[unit];
  c.units.sampler[unit] = sampler;
}

}  // namespace

float random_stage_number(Random& random) {
  switch (random.below(12)) {
    case 0:
      return random.pick({0.0F, -0.0F, 1.0F, -1.0F, kInfinity, -kInfinity, kNan});
    case 1:
      return std::ldexp(random.real_f(-1, 1), random.between(-140, 127));
    case 2:
      return static_cast<float>(random.between(-4096, 8192)) / 4096.0F;
    default:
      return random.real_f(-2, 2);
  }
}

std::unique_ptr<StageCase> random_stages(Random& random, TextureOperation operation, bool has_mipmaps) {
  auto made = std::make_unique<StageCase>();
  StageCase& c = *made;
  c.has_mipmaps = has_mipmaps;
  c.state.enabled = true;
  c.state.rules = random.one_in(3) ? StageRules::open_gl : StageRules::nv2a;
  c.state.converts_yuv = random.one_in(8);
  if (random.one_in(3)) {
    c.profile.stage_byte.value = StageByte::nearest;
    c.profile.negative_stage_number.value = NegativeNumber::size;
    c.profile.cull_zero.value = CullZero::by_sign;
    c.profile.dot_divisors.value = DotDivisors::even;
    c.profile.dependent_divisor.value = 256;
    c.profile.ahead_mapping.value = AheadMapping::of_diffuse;
  }
  choose_operations(random, operation, c);
  for (std::size_t unit = 0; unit < kTextureStages; ++unit) choose_texture(random, unit, c);
  return made;
}

oracle::StageQuestion stage_question(const StageCase& c) {
  using Samplers = std::array<std::optional<TextureSampler>, kTextureStages>;
  const auto samplers = std::make_shared<Samplers>();
  oracle::StageQuestion question;
  question.state = c.state;
  question.profile = c.profile;
  for (std::size_t u = 0; u < kTextureStages; ++u) {
    if (c.units.texture[u] == nullptr) continue;
    question.textures[u] = stage_texture(c.textures[u], c.units.sampler[u]);
    (*samplers)[u] = TextureSampler::make(c.profile, c.textures[u], c.units.sampler[u], TexelUse::stages);
  }
  question.fetch = [samplers](int unit, std::array<float, 3> at) {
    TextureCoordinates coordinates;
    const float zero = 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
      coordinates.value[k] = &at[k];
      coordinates.dx[k] = coordinates.dy[k] = &zero;
    }
    const Bytes4 bytes = (*samplers)[static_cast<std::size_t>(unit)]->bytes(coordinates, 0);
    return std::array<int, 4>{bytes[0], bytes[1], bytes[2], bytes[3]};
  };
  return question;
}

}  // namespace ninebit::test
