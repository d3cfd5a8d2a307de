#include "ninebit/texture_shader/stage_operation.h"

#include <array>

namespace ninebit {
namespace {

using enum TextureOperation;
using Target = StageTarget;
using Input = StageInput;

constexpr std::array<TextureOperationInfo, 24> kOperations{{
    {none, "none", "NONE", 0, "nop", "", "NONE", 0x00, Target::none, Input::none, 0, 3, 0},
    {texture_1d, "texture_1d", "TEXTURE_1D", 0x0DE0, "texture_1d", "tex", "PROJECT2D", 0x01, Target::one_dimensional,
     Input::none, 0, 3, 0},
    {texture_2d, "texture_2d", "TEXTURE_2D", 0x0DE1, "texture_2d", "tex", "PROJECT2D", 0x01, Target::two_dimensional,
     Input::none, 0, 3, 0},
    {texture_rectangle, "texture_rectangle", "TEXTURE_RECTANGLE_NV", 0x84F5, "texture_rectangle", "tex", "PROJECT2D",
     0x01, Target::rectangle, Input::none, 0, 3, 0},
    {texture_3d, "texture_3d", "TEXTURE_3D", 0x806F, "texture_3d", "tex", "PROJECT3D", 0x02, Target::three_dimensional,
     Input::none, 0, 3, 0},
    {texture_cube_map, "texture_cube_map", "TEXTURE_CUBE_MAP_ARB", 0x8513, "texture_cube_map", "tex", "CUBEMAP", 0x03,
     Target::cube_map, Input::none, 0, 3, 0},
    {pass_through, "pass_through", "PASS_THROUGH_NV", 0x86E6, "pass_through", "texcoord", "PASSTHRU", 0x04,
     Target::none, Input::none, 0, 3, 0},
    {cull_fragment, "cull_fragment", "CULL_FRAGMENT_NV", 0x86E7, "cull_fragment", "texkill", "CLIPPLANE", 0x05,
     Target::none, Input::none, 0, 3, 0},
    {offset_2d, "offset_2d", "OFFSET_TEXTURE_2D_NV", 0x86E8, "offset_2d", "texbem", "BUMPENVMAP", 0x06,
     Target::two_dimensional, Input::offset, 1, 3, 0},
    {offset_2d_scale, "offset_2d_scale", "OFFSET_TEXTURE_2D_SCALE_NV", 0x86E2, "offset_2d_scale", "texbeml",
     "BUMPENVMAP_LUM", 0x07, Target::two_dimensional, Input::luminance, 1, 3, 0},
    {offset_rectangle, "offset_rectangle", "OFFSET_TEXTURE_RECTANGLE_NV", 0x864C, "offset_rectangle", "texbem",
     "BUMPENVMAP", 0x06, Target::rectangle, Input::offset, 1, 3, 0},
    {offset_rectangle_scale, "offset_rectangle_scale", "OFFSET_TEXTURE_RECTANGLE_SCALE_NV", 0x864D,
     "offset_rectangle_scale", "texbeml", "BUMPENVMAP_LUM", 0x07, Target::rectangle, Input::luminance, 1, 3, 0},
    {dependent_ar, "dependent_ar", "DEPENDENT_AR_TEXTURE_2D_NV", 0x86E9, "dependent_ar", "texreg2ar", "DPNDNT_AR", 0x0F,
     Target::two_dimensional, Input::alpha_red, 1, 3, 0},
    {dependent_gb, "dependent_gb", "DEPENDENT_GB_TEXTURE_2D_NV", 0x86EA, "dependent_gb", "texreg2gb", "DPNDNT_GB", 0x10,
     Target::two_dimensional, Input::green_blue, 1, 3, 0},
    {dot_product, "dot_product", "DOT_PRODUCT_NV", 0x86EC, "", "texm3x3pad", "DOTPRODUCT", 0x11, Target::none,
     Input::normal, 1, 3, 0},
    {dot_product_2d, "dot_product_2d", "DOT_PRODUCT_TEXTURE_2D_NV", 0x86EE, "dot_product_2d_2of2", "texm3x2tex",
     "DOT_ST", 0x09, Target::two_dimensional, Input::normal, 2, 3, 1},
    {dot_product_rectangle, "dot_product_rectangle", "DOT_PRODUCT_TEXTURE_RECTANGLE_NV", 0x864E,
     "dot_product_rectangle_2of2", "texm3x2tex", "DOT_ST", 0x09, Target::rectangle, Input::normal, 2, 3, 1},
    {dot_product_3d, "dot_product_3d", "DOT_PRODUCT_TEXTURE_3D_NV", 0x86EF, "dot_product_3d_3of3", "texm3x3tex",
     "DOT_STR_3D", 0x0D, Target::three_dimensional, Input::normal, 3, 3, 2},
    {dot_product_cube_map, "dot_product_cube_map", "DOT_PRODUCT_TEXTURE_CUBE_MAP_NV", 0x86F0,
     "dot_product_cube_map_3of3", "texm3x3tex", "DOT_STR_CUBE", 0x0E, Target::cube_map, Input::normal, 3, 3, 2},
    {dot_product_depth_replace, "dot_product_depth_replace", "DOT_PRODUCT_DEPTH_REPLACE_NV", 0x86ED,
     "dot_product_depth_replace_2of2", "texm3x2depth", "DOT_ZW", 0x0A, Target::none, Input::normal, 2, 3, 1},
    {dot_product_diffuse_cube_map, "dot_product_diffuse_cube_map", "DOT_PRODUCT_DIFFUSE_CUBE_MAP_NV", 0x86F1,
     "dot_product_cube_map_and_reflect_cube_map_eye_from_qs_2of3", "texm3x3diff", "DOT_RFLCT_DIFF", 0x0B,
     Target::cube_map, Input::normal, 2, 2, 1},
    {dot_product_reflect_cube_map, "dot_product_reflect_cube_map", "DOT_PRODUCT_REFLECT_CUBE_MAP_NV", 0x86F2,
     "dot_product_reflect_cube_map_eye_from_qs_3of3", "texm3x3vspec", "DOT_RFLCT_SPEC", 0x0C, Target::cube_map,
     Input::normal, 3, 3, 2},
    {dot_product_const_eye_reflect_cube_map, "dot_product_const_eye_reflect_cube_map",
     "DOT_PRODUCT_CONST_EYE_REFLECT_CUBE_MAP_NV", 0x86F3, "dot_product_reflect_cube_map_const_eye_3of3", "texm3x3spec",
     "DOT_RFLCT_SPEC_CONST", 0x12, Target::cube_map, Input::normal, 3, 3, 2},
    {brdf, "brdf", "", 0, "", "texbrdf", "BRDF", 0x08, Target::three_dimensional, Input::none, 2, 3, 0},
}};

static_assert([] {
  for (std::size_t i = 0; i < kOperations.size(); ++i) {
    if (kOperations[i].operation != static_cast<TextureOperation>(i)) return false;
  }
  return true;
}());

}  // namespace

std::span<const TextureOperationInfo> texture_operations() {
  return kOperations;
}

const TextureOperationInfo& info_of(TextureOperation operation) {
  return kOperations[static_cast<std::size_t>(operation)];
}

std::optional<TextureOperation> texture_operation_called(std::string_view name) {
  for (const TextureOperationInfo& info : kOperations) {
    if (info.name == name) return info.operation;
  }
  return std::nullopt;
}

}  // namespace ninebit
