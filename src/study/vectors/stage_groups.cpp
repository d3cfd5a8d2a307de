#include "src/study/vectors/stage_groups.h"

#include <algorithm>
#include <array>

namespace ninebit::vectors {
namespace {

using Op = TextureOperation;

TextureStage& stage_of(StageVectorProgram& p, int i) {
  return p.state.stage[static_cast<std::size_t>(i)];
}

// A number in [low, high).
float between(VectorRandom& random, float low, float high) {
  constexpr int kSteps = 1 << 16;
  return low + (high - low) * (static_cast<float>(random.below(kSteps)) / static_cast<float>(kSteps));
}

// Gives every unit that a stage reads a texture of its kind.
void add_pictures(Maker& m, StageVectorProgram& p) {
  for (std::size_t i = 0; i < p.picture.size(); ++i) {
    const StageTarget target = info_of(p.state.stage[i].operation).target;
    if (target == StageTarget::two_dimensional) p.picture[i] = static_cast<std::size_t>(m.random.below(2));
    if (target == StageTarget::three_dimensional) p.picture[i] = 2;
    if (target == StageTarget::cube_map) p.picture[i] = 3;
    if (target == StageTarget::one_dimensional) p.picture[i] = 4;
    if (target == StageTarget::rectangle) p.picture[i] = 5;
  }
}

void set_numbers(Maker& m, TextureStage& stage) {
  for (float& entry : stage.matrix) entry = between(m.random, -0.5F, 0.5F);
  stage.scale = between(m.random, 0.0F, 2.0F);
  stage.bias = between(m.random, 0.0F, 0.75F);  // no picture decides numbers below 0
  for (float& component : stage.eye) component = between(m.random, -1.0F, 1.0F);
}

// An operation that reads no other stage, on each of the stages in turn.
template <Op kOperation>
void alone(Maker& m, StageVectorProgram& p) {
  stage_of(p, m.of(kTextureStages)).operation = kOperation;
  add_pictures(m, p);
}

void signed_texels(Maker& m, StageVectorProgram& p) {
  const int stage = m.of(kTextureStages), flags = 1 + m.of(15);
  stage_of(p, stage).operation = Op::texture_2d;
  add_pictures(m, p);
  for (std::size_t k = 0; k < 4; ++k) p.is_signed[static_cast<std::size_t>(stage)][k] = (flags >> k & 1) != 0;
}

void cull(Maker& m, StageVectorProgram& p) {
  TextureStage& stage = stage_of(p, m.of(kTextureStages));
  stage.operation = Op::cull_fragment;
  for (CullMode& mode : stage.cull) mode = static_cast<CullMode>(m.of(2));
}

// An operation on stage 1, 2 or 3 that reads stage 0.
template <Op kOperation>
void reads_stage_0(Maker& m, StageVectorProgram& p) {
  TextureStage& stage = stage_of(p, 1 + m.of(3));
  stage_of(p, 0).operation = Op::texture_2d;
  stage.operation = kOperation;
  set_numbers(m, stage);
  add_pictures(m, p);
}

// Stage 2 or 3 reads any stage before it.
void other_stage(Maker& m, StageVectorProgram& p) {
  const int last = 2 + m.of(2);
  for (int i = 0; i < last; ++i) stage_of(p, i).operation = Op::texture_2d;
  stage_of(p, last).operation = m.of(2) == 0 ? Op::dependent_gb : Op::dependent_ar;
  stage_of(p, last).previous = m.random.below(last);
  add_pictures(m, p);
}

// A chain of dot products of stage 0's texel up to stage `last`.
void chain(Maker& m, StageVectorProgram& p, int length, int last, Op operation, DotMapping mapping) {
  stage_of(p, 0).operation = Op::texture_2d;
  for (int i = last - length + 1; i <= last; ++i) {
    stage_of(p, i).operation = i == last ? operation : Op::dot_product;
    stage_of(p, i).mapping = mapping;
  }
  set_numbers(m, stage_of(p, last));
  add_pictures(m, p);
}

template <DotMapping kMapping>
void dot_2d(Maker& m, StageVectorProgram& p) {
  chain(m, p, 2, 2 + m.of(2), Op::dot_product_2d, kMapping);
}
template <Op kOperation, DotMapping kMapping>
void three_dots(Maker& m, StageVectorProgram& p) {
  chain(m, p, 3, 3, kOperation, kMapping);
}

constexpr std::array kMappings{DotMapping::zero_to_one, DotMapping::minus1_to_1_d3d, DotMapping::minus1_to_1_gl,
                               DotMapping::minus1_to_1, DotMapping::hilo_1,          DotMapping::hilo_hemisphere};

template <Op kOperation>
void three_dots_of_any_mapping(Maker& m, StageVectorProgram& p) {
  chain(m, p, 3, 3, kOperation, m.of(std::span<const DotMapping>(kMappings)));
}

void depth_replace(Maker& m, StageVectorProgram& p) {
  constexpr std::array kPositive{DotMapping::zero_to_one, DotMapping::hilo_1};
  chain(m, p, 2, 2 + m.of(2), Op::dot_product_depth_replace, m.of(std::span<const DotMapping>(kPositive)));
}

void diffuse(Maker& m, StageVectorProgram& p) {
  const bool is_constant = m.of(2) == 1;
  three_dots_of_any_mapping<Op::dot_product_reflect_cube_map>(m, p);
  stage_of(p, 2).operation = Op::dot_product_diffuse_cube_map;
  if (is_constant) stage_of(p, 3).operation = Op::dot_product_const_eye_reflect_cube_map;
  add_pictures(m, p);
}

// A matrix that moves rectangles by several texels.
template <Op kOperation>
void moves_rectangle(Maker& m, StageVectorProgram& p) {
  reads_stage_0<kOperation>(m, p);
  for (TextureStage& stage : p.state.stage) {
    if (stage.operation != kOperation) continue;
    for (float& entry : stage.matrix) entry *= 16.0F;
  }
}

void dot_rectangle(Maker& m, StageVectorProgram& p) {
  chain(m, p, 2, 2 + m.of(2), Op::dot_product_rectangle, DotMapping::zero_to_one);
}

void yuv(Maker& m, StageVectorProgram& p) {
  alone<Op::texture_2d>(m, p);
  p.state.converts_yuv = true;
}

// A stage that is not part of a chain; it reads any texel before it.
void set_simple(Maker& m, StageVectorProgram& p, int i) {
  constexpr std::array kSimple{Op::texture_2d,   Op::texture_3d,      Op::texture_cube_map, Op::pass_through,
                               Op::texture_2d,   Op::cull_fragment,   Op::offset_2d,        Op::dependent_ar,
                               Op::dependent_gb, Op::offset_2d_scale, Op::offset_2d};
  TextureStage& stage = stage_of(p, i);
  // Stage 0 reads nothing before it, and always gives a texel.
  stage.operation = kSimple[static_cast<std::size_t>(m.random.below(i == 0 ? 5 : static_cast<int>(kSimple.size())))];
  for (CullMode& mode : stage.cull) mode = static_cast<CullMode>(m.random.below(2));
  set_numbers(m, stage);
}

void combined(Maker& m, StageVectorProgram& p) {
  for (int i = 0; i < kTextureStages; ++i) set_simple(m, p, i);
  constexpr std::array kCubes{Op::dot_product_cube_map, Op::dot_product_reflect_cube_map,
                              Op::dot_product_const_eye_reflect_cube_map, Op::dot_product_3d};
  const Op cube = kCubes[static_cast<std::size_t>(m.random.below(4))];
  const DotMapping any = kMappings[static_cast<std::size_t>(m.random.below(6))];
  const DotMapping positive = m.random.one_in(2) ? DotMapping::zero_to_one : DotMapping::hilo_1;
  const int form = m.random.below(6);
  const auto set = [&](int i, Op operation, DotMapping mapping) {
    stage_of(p, i).operation = operation;
    stage_of(p, i).mapping = mapping;
  };
  if (form == 0) {
    const DotMapping mapping = cube == Op::dot_product_3d ? positive : any;
    for (int i = 1; i < 3; ++i) set(i, Op::dot_product, mapping);
    set(3, cube, mapping);
  } else if (form < 3) {
    set(form, Op::dot_product, positive);
    set(form + 1, m.random.one_in(3) ? Op::dot_product_depth_replace : Op::dot_product_2d, positive);
  }
  for (int i = 2; i < kTextureStages; ++i) {
    const int from = m.random.below(i);
    const bool gives = info_of(stage_of(p, from).operation).target != StageTarget::none;
    stage_of(p, i).previous = gives ? from : 0;
  }
  add_pictures(m, p);
  for (auto& flags : p.is_signed) {
    if (!m.random.one_in(4)) continue;
    for (bool& is_signed : flags) is_signed = m.random.one_in(2);
  }
  p.state.converts_yuv = m.random.one_in(8);
  // Settings that no operation reads are reset, so that equal programs have equal words.
  p.state = only_used(p.state);
}

constexpr StageGroup kTextureShaderGroups[] = {
    {"texture-2d", "16", "a 2D texture at s / q, t / q; other stages are off", 4, alone<Op::texture_2d>},
    {"texture-3d", "", "a 3D texture at s / q, t / q, r / q", 4, alone<Op::texture_3d>},
    {"texture-cube-map", "41", "a cube map; q is not read", 4, alone<Op::texture_cube_map>},
    {"signed-texels", "15", "components that are two's complement, as the combiners read them", 4, signed_texels},
    {"pass-through", "33", "s, t, r, q as a colour", 4, alone<Op::pass_through>},
    {"cull-fragment", "42", "fragments killed by the signs of s, t, r, q", 6, cull},
    {"dependent-ar", "37", "a texture at alpha and red", 4, reads_stage_0<Op::dependent_ar>},
    {"dependent-gb", "37", "a texture at green and blue", 4, reads_stage_0<Op::dependent_gb>},
    {"other-stage-input", "37", "the stage whose texel is read", 4, other_stage},
    {"offset-2d", "34", "s and t, moved by signed bytes times a matrix", 8, reads_stage_0<Op::offset_2d>},
    {"offset-2d-scale", "34, 35", "the same, times a luminance", 8, reads_stage_0<Op::offset_2d_scale>},
    {"dot-product-2d", "36", "two dot products as coordinates, bytes from 0 to 1", 4, dot_2d<DotMapping::zero_to_one>},
    {"dot-mapping-hilo-1", "36", "dot products of two words of 16 bits, and 1", 6, dot_2d<DotMapping::hilo_1>},
    {"dot-product-3d", "36", "three dot products in a 3D texture", 4,
     three_dots<Op::dot_product_3d, DotMapping::zero_to_one>},
    {"dot-product-cube-map", "36", "three dot products in a cube map, bytes from 0 to 1", 4,
     three_dots<Op::dot_product_cube_map, DotMapping::zero_to_one>},
    {"dot-mapping-minus1-to-1-d3d", "36", "(v - 128) / 127", 6,
     three_dots<Op::dot_product_cube_map, DotMapping::minus1_to_1_d3d>},
    {"dot-mapping-minus1-to-1-gl", "36", "(2 s + 1) / 255, s in two's complement", 6,
     three_dots<Op::dot_product_cube_map, DotMapping::minus1_to_1_gl>},
    {"dot-mapping-minus1-to-1", "36", "s / 127", 6, three_dots<Op::dot_product_cube_map, DotMapping::minus1_to_1>},
    {"dot-mapping-hilo-hemisphere", "36", "two signed words of 16 bits, and what is left of a unit vector", 8,
     three_dots<Op::dot_product_cube_map, DotMapping::hilo_hemisphere>},
    {"dot-product-depth-replace", "39", "the quotient of two dot products as the depth", 6, depth_replace},
    {"dot-product-reflect-cube-map", "38", "the eye, from q of stages 1 to 3, reflected", 8,
     three_dots_of_any_mapping<Op::dot_product_reflect_cube_map>},
    {"dot-product-const-eye-reflect-cube-map", "38", "a constant eye, reflected", 8,
     three_dots_of_any_mapping<Op::dot_product_const_eye_reflect_cube_map>},
    {"dot-product-diffuse-cube-map", "38", "stage 3's dot product, computed ahead", 8, diffuse},
    {"yuv", "40", "colours from Y, U and V", 4, yuv},
    {"texture-1d", "", "a 1D texture at s / q", 4, alone<Op::texture_1d>},
    {"texture-rectangle", "", "a rectangle at s / q, t / q, which count texels", 4, alone<Op::texture_rectangle>},
    {"offset-rectangle", "34", "a rectangle, moved by texels", 4, moves_rectangle<Op::offset_rectangle>},
    {"offset-rectangle-scale", "34, 35", "the same, times a luminance", 4, moves_rectangle<Op::offset_rectangle_scale>},
    {"dot-product-rectangle", "36", "two dot products, which count a rectangle's texels", 4, dot_rectangle},
    {"combined", "", "several operations", 40, combined},
};

}  // namespace

std::span<const StageGroup> stage_groups_of_packs() {
  return kTextureShaderGroups;
}

TextureShaderState stage_state() {
  TextureShaderState state;
  state.enabled = true;
  state.rules = StageRules::nv2a;
  state.depth_unit = DepthUnit::codes;
  return state;
}

std::vector<StagePicture> stage_pictures(std::uint64_t seed) {
  std::vector<StagePicture> pictures{
      {StageTarget::two_dimensional, 64, 64, 1, {}},  {StageTarget::two_dimensional, 64, 32, 1, {}},
      {StageTarget::three_dimensional, 16, 8, 8, {}}, {StageTarget::cube_map, 32, 32, 6, {}},
      {StageTarget::one_dimensional, 64, 1, 1, {}},   {StageTarget::rectangle, 48, 20, 1, {}}};
  constexpr std::array kEdges{0, 1, 127, 128, 129, 254, 255, 64};
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    StagePicture& picture = pictures[i];
    VectorRandom random(seed ^ 0x7E9E15, i);
    for (int n = 0; n < picture.width * picture.height * picture.depth; ++n) {
      Bytes4& texel = picture.texels.emplace_back();
      for (std::uint8_t& byte : texel) {
        const int edge = kEdges[static_cast<std::size_t>(random.below(8))], any = random.below(256);
        byte = static_cast<std::uint8_t>(random.one_in(4) ? edge : any);
      }
      if (i > 0) continue;
      const int x = n % 64, y = n / 64;
      texel[0] = static_cast<std::uint8_t>(4 * x + y % 4);
      texel[1] = static_cast<std::uint8_t>(4 * y + x % 4);
    }
  }
  return pictures;
}

namespace {

std::array<float, 4> coordinates_of(VectorRandom& random, const TextureShaderState& state, std::size_t i) {
  const TextureStage& stage = state.stage[i];
  std::array<float, 4> at{};
  const auto fill = [&](float low, float high) {
    for (float& c : at) c = between(random, low, high);
  };
  fill(-1.0F, 1.0F);
  switch (stage.operation) {
    case Op::texture_1d:
    case Op::texture_2d:
    case Op::texture_rectangle:
    case Op::texture_3d: {
      constexpr std::array kDivisors{1.0F, 1.0F, 0.5F, 2.0F, 3.25F, -1.5F};
      const float q = kDivisors[static_cast<std::size_t>(random.below(6))];
      fill(0.0F, stage.operation == Op::texture_rectangle ? 48.0F : 1.0F);
      at = {at[0] * q, at[1] * q, at[2] * q, q};
      break;
    }
    case Op::texture_cube_map:
      at[3] *= 2.0F;
      break;
    case Op::pass_through:
      for (float& c : at) c = (static_cast<float>(random.below(4400)) + 0.5F) / 4096.0F;
      break;
    case Op::cull_fragment:
      for (std::size_t k = 0; k < 4; ++k) {
        // A component kills one fragment in eight.
        const float sign = (stage.cull[k] == CullMode::kills_negative) != random.one_in(8) ? 1.0F : -1.0F;
        at[k] = sign * between(random, 0.01F, 2.0F);
      }
      break;
    case Op::offset_2d:
    case Op::offset_2d_scale:
      fill(0.3F, 0.7F);
      at[3] = 1.0F;
      break;
    case Op::offset_rectangle:
    case Op::offset_rectangle_scale:
      fill(5.0F, 15.0F);
      at[3] = 1.0F;
      break;
    case Op::dot_product_2d:
    case Op::dot_product_3d:
      fill(0.0F, 0.5F);
      break;
    case Op::dot_product_rectangle:
      fill(0.0F, 15.0F);
      break;
    case Op::dot_product: {
      // The chain's last operation says what is wanted.
      std::size_t last = i + 1;
      while (last + 1 < state.stage.size() && state.stage[last].operation == Op::dot_product) ++last;
      const Op of = state.stage[last].operation;
      if (of == Op::dot_product_2d || of == Op::dot_product_3d) fill(0.0F, 0.5F);
      if (of == Op::dot_product_rectangle) fill(0.0F, 15.0F);
      if (of == Op::dot_product_depth_replace) fill(0.0F, 20000.0F);
      break;
    }
    case Op::dot_product_depth_replace:
      fill(0.25F, 1.0F);
      break;
    default:
      break;
  }
  return at;
}

}  // namespace

StageCoordinates random_coordinates(VectorRandom& random, const TextureShaderState& state) {
  StageCoordinates at{};
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = coordinates_of(random, state, i);
  return at;
}

}  // namespace ninebit::vectors
