// The operations of texture-shader stages as one table: their names in each language, where they may stand, what they
// read and what they give. Readers, printers, checks and evaluation walk this table.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The operation of a stage; GL_SHADER_OPERATION_NV of NV_texture_shader and NV_texture_shader2, and the NV2A's BRDF.
enum class TextureOperation : std::uint8_t {
  none,
  texture_1d,
  texture_2d,
  texture_rectangle,
  texture_3d,
  texture_cube_map,
  pass_through,
  cull_fragment,
  offset_2d,
  offset_2d_scale,
  offset_rectangle,
  offset_rectangle_scale,
  dependent_ar,
  dependent_gb,
  dot_product,
  dot_product_2d,
  dot_product_rectangle,
  dot_product_3d,
  dot_product_cube_map,
  dot_product_depth_replace,
  dot_product_diffuse_cube_map,
  dot_product_reflect_cube_map,
  dot_product_const_eye_reflect_cube_map,
  brdf
};

// The kind of texture that a stage reads.
enum class StageTarget : std::uint8_t {
  none,
  one_dimensional,
  two_dimensional,
  rectangle,
  three_dimensional,
  cube_map
};

// The values that a stage reads of an earlier stage.
enum class StageInput : std::uint8_t {
  none,        // coordinates alone
  offset,      // ds and dt: blue and green as signed bytes
  luminance,   // the same, and red as the luminance
  alpha_red,   // alpha and red as coordinates
  green_blue,  // green and blue as coordinates
  normal       // the factor of a dot product, by the stage's DotMapping
};

// One operation. Names that a language does not have are empty.
struct TextureOperationInfo {
  TextureOperation operation;  // the row's place in the table
  std::string_view name;       // in JSON and messages
  std::string_view gl;         // OpenGL's enumerant, without GL_
  std::uint16_t gl_value;      // its number; 0: none
  std::string_view ts10;       // the line of !!TS1.0; of a chain of dot products its last line
  std::string_view direct3d;   // the instruction of ps.1.0 to 1.3 and xps.1.1
  std::string_view xbox;       // of PSTextureModes, without PS_TEXTUREMODES_
  std::uint8_t word;           // the NV2A's stage program, five bits of NV097_SET_SHADER_STAGE_PROGRAM
  StageTarget target;          // of the texture that it reads
  StageInput input;            // what it reads of the stage that its `previous` names
  std::uint8_t first, last;    // the stages that it may stand on
  std::uint8_t dots_before;    // how many stages right before it must be dot products
};

// All operations, in the order of TextureOperation.
[[nodiscard]] std::span<const TextureOperationInfo> texture_operations();

// The row of one operation, which must be an enumerator.
[[nodiscard]] const TextureOperationInfo& info_of(TextureOperation operation);

// The operation of that name (column `name`); empty: none.
[[nodiscard]] std::optional<TextureOperation> texture_operation_called(std::string_view name);

}  // namespace ninebit
