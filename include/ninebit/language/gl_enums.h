// The enumerants of NV_register_combiners and NV_register_combiners2 under their GL names, and conversions between them
// and the combiner's enumerations.
#pragma once

#ifdef GL_VERSION_1_1
#error "ninebit's GL names and the macros of <GL/gl.h> exclude each other: include only one of them in a source file"
#endif

#include <optional>

#include "ninebit/combiner/registers.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {
namespace gl {

// OpenGL's types, as its own headers have them.
using GLenum = unsigned int;
using GLboolean = unsigned char;
using GLint = int;
using GLfloat = float;

// They have the smallest type, so that they convert to every other without loss: GL programs also write GL_FALSE for
// "none".
inline constexpr GLboolean GL_FALSE = 0;
inline constexpr GLboolean GL_TRUE = 1;

// Core names that the extensions reuse. GL_ONE is not a register; it is defined so that a call with it can be parsed
// and refused.
inline constexpr GLenum GL_NONE = 0;
inline constexpr GLenum GL_ZERO = 0;
inline constexpr GLenum GL_ONE = 1;
inline constexpr GLenum GL_FOG = 0x0B60;
inline constexpr GLenum GL_BLUE = 0x1905;
inline constexpr GLenum GL_ALPHA = 0x1906;
inline constexpr GLenum GL_RGB = 0x1907;
inline constexpr GLenum GL_TEXTURE0_ARB = 0x84C0;
inline constexpr GLenum GL_TEXTURE1_ARB = 0x84C1;
inline constexpr GLenum GL_TEXTURE2_ARB = 0x84C2;
inline constexpr GLenum GL_TEXTURE3_ARB = 0x84C3;
inline constexpr GLenum GL_TEXTURE0 = GL_TEXTURE0_ARB;
inline constexpr GLenum GL_TEXTURE1 = GL_TEXTURE1_ARB;
inline constexpr GLenum GL_TEXTURE2 = GL_TEXTURE2_ARB;
inline constexpr GLenum GL_TEXTURE3 = GL_TEXTURE3_ARB;

// The cull modes of texture shaders.
inline constexpr GLenum GL_LESS = 0x0201;
inline constexpr GLenum GL_GEQUAL = 0x0206;

// Return values of glGetError.
inline constexpr GLenum GL_NO_ERROR = 0;
inline constexpr GLenum GL_INVALID_ENUM = 0x0500;
inline constexpr GLenum GL_INVALID_VALUE = 0x0501;
inline constexpr GLenum GL_INVALID_OPERATION = 0x0502;

// NV_register_combiners.
inline constexpr GLenum GL_REGISTER_COMBINERS_NV = 0x8522;
inline constexpr GLenum GL_VARIABLE_A_NV = 0x8523;
inline constexpr GLenum GL_VARIABLE_B_NV = 0x8524;
inline constexpr GLenum GL_VARIABLE_C_NV = 0x8525;
inline constexpr GLenum GL_VARIABLE_D_NV = 0x8526;
inline constexpr GLenum GL_VARIABLE_E_NV = 0x8527;
inline constexpr GLenum GL_VARIABLE_F_NV = 0x8528;
inline constexpr GLenum GL_VARIABLE_G_NV = 0x8529;
inline constexpr GLenum GL_CONSTANT_COLOR0_NV = 0x852A;
inline constexpr GLenum GL_CONSTANT_COLOR1_NV = 0x852B;
inline constexpr GLenum GL_PRIMARY_COLOR_NV = 0x852C;
inline constexpr GLenum GL_SECONDARY_COLOR_NV = 0x852D;
inline constexpr GLenum GL_SPARE0_NV = 0x852E;
inline constexpr GLenum GL_SPARE1_NV = 0x852F;
inline constexpr GLenum GL_DISCARD_NV = 0x8530;
inline constexpr GLenum GL_E_TIMES_F_NV = 0x8531;
inline constexpr GLenum GL_SPARE0_PLUS_SECONDARY_COLOR_NV = 0x8532;
inline constexpr GLenum GL_UNSIGNED_IDENTITY_NV = 0x8536;
inline constexpr GLenum GL_UNSIGNED_INVERT_NV = 0x8537;
inline constexpr GLenum GL_EXPAND_NORMAL_NV = 0x8538;
inline constexpr GLenum GL_EXPAND_NEGATE_NV = 0x8539;
inline constexpr GLenum GL_HALF_BIAS_NORMAL_NV = 0x853A;
inline constexpr GLenum GL_HALF_BIAS_NEGATE_NV = 0x853B;
inline constexpr GLenum GL_SIGNED_IDENTITY_NV = 0x853C;
inline constexpr GLenum GL_SIGNED_NEGATE_NV = 0x853D;
inline constexpr GLenum GL_SCALE_BY_TWO_NV = 0x853E;
inline constexpr GLenum GL_SCALE_BY_FOUR_NV = 0x853F;
inline constexpr GLenum GL_SCALE_BY_ONE_HALF_NV = 0x8540;
inline constexpr GLenum GL_BIAS_BY_NEGATIVE_ONE_HALF_NV = 0x8541;
inline constexpr GLenum GL_COMBINER_INPUT_NV = 0x8542;
inline constexpr GLenum GL_COMBINER_MAPPING_NV = 0x8543;
inline constexpr GLenum GL_COMBINER_COMPONENT_USAGE_NV = 0x8544;
inline constexpr GLenum GL_COMBINER_AB_DOT_PRODUCT_NV = 0x8545;
inline constexpr GLenum GL_COMBINER_CD_DOT_PRODUCT_NV = 0x8546;
inline constexpr GLenum GL_COMBINER_MUX_SUM_NV = 0x8547;
inline constexpr GLenum GL_COMBINER_SCALE_NV = 0x8548;
inline constexpr GLenum GL_COMBINER_BIAS_NV = 0x8549;
inline constexpr GLenum GL_COMBINER_AB_OUTPUT_NV = 0x854A;
inline constexpr GLenum GL_COMBINER_CD_OUTPUT_NV = 0x854B;
inline constexpr GLenum GL_COMBINER_SUM_OUTPUT_NV = 0x854C;
inline constexpr GLenum GL_MAX_GENERAL_COMBINERS_NV = 0x854D;
inline constexpr GLenum GL_NUM_GENERAL_COMBINERS_NV = 0x854E;
inline constexpr GLenum GL_COLOR_SUM_CLAMP_NV = 0x854F;
inline constexpr GLenum GL_COMBINER0_NV = 0x8550;
inline constexpr GLenum GL_COMBINER1_NV = 0x8551;
inline constexpr GLenum GL_COMBINER2_NV = 0x8552;
inline constexpr GLenum GL_COMBINER3_NV = 0x8553;
inline constexpr GLenum GL_COMBINER4_NV = 0x8554;
inline constexpr GLenum GL_COMBINER5_NV = 0x8555;
inline constexpr GLenum GL_COMBINER6_NV = 0x8556;
inline constexpr GLenum GL_COMBINER7_NV = 0x8557;

// NV_register_combiners2.
inline constexpr GLenum GL_PER_STAGE_CONSTANTS_NV = 0x8535;

// NV_texture_shader. The operations have their enumerants in texture_operations() (stage_operation.h).
inline constexpr GLenum GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV = 0x86D9;
inline constexpr GLenum GL_SHADER_CONSISTENT_NV = 0x86DD;
inline constexpr GLenum GL_TEXTURE_SHADER_NV = 0x86DE;
inline constexpr GLenum GL_SHADER_OPERATION_NV = 0x86DF;
inline constexpr GLenum GL_CULL_MODES_NV = 0x86E0;
inline constexpr GLenum GL_OFFSET_TEXTURE_MATRIX_NV = 0x86E1;
inline constexpr GLenum GL_OFFSET_TEXTURE_SCALE_NV = 0x86E2;
inline constexpr GLenum GL_OFFSET_TEXTURE_BIAS_NV = 0x86E3;
inline constexpr GLenum GL_PREVIOUS_TEXTURE_INPUT_NV = 0x86E4;
inline constexpr GLenum GL_CONST_EYE_NV = 0x86E5;

// The enumerant of each enumerator. A texture register gives GL_TEXTURE0_ARB + unit.
[[nodiscard]] GLenum to_enum(Register reg);
[[nodiscard]] GLenum to_enum(InputMapping mapping);
[[nodiscard]] GLenum to_enum(ComponentUsage usage);
[[nodiscard]] GLenum to_enum(Scale scale);
[[nodiscard]] GLenum to_enum(Bias bias);
[[nodiscard]] GLenum to_enum(PortionName portion);
[[nodiscard]] GLenum to_enum(Variable variable);

// The enumerator of an enumerant; empty if the enumerant is of another kind. validate.h checks whether a profile has it
// (a third texture unit, a sixth general combiner) and whether it is allowed where it is used.
[[nodiscard]] std::optional<Register> to_register(GLenum value);
[[nodiscard]] std::optional<InputMapping> to_input_mapping(GLenum value);
[[nodiscard]] std::optional<ComponentUsage> to_component_usage(GLenum value);
[[nodiscard]] std::optional<Scale> to_scale(GLenum value);
[[nodiscard]] std::optional<Bias> to_bias(GLenum value);
[[nodiscard]] std::optional<PortionName> to_portion(GLenum value);
[[nodiscard]] std::optional<Variable> to_variable(GLenum value);

// GL_COMBINER0_NV + i as i, 0 to 7; empty for other values.
[[nodiscard]] std::optional<int> to_stage(GLenum value);

}  // namespace gl
}  // namespace ninebit
