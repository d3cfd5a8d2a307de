// Values and layouts: Cxbx-Reloaded, XbPixelShader.cpp; xemu, hw/xbox/nv2a/pgraph/psh.h.
#include "src/language/xbox/xbox_macros.h"

#include <algorithm>
#include <string>

namespace ninebit::xbox {
namespace {

constexpr Constant kConstants[] = {
    {"PS_REGISTER_ZERO", 0x00},
    {"PS_REGISTER_DISCARD", 0x00},
    {"PS_REGISTER_C0", 0x01},
    {"PS_REGISTER_C1", 0x02},
    {"PS_REGISTER_FOG", 0x03},
    {"PS_REGISTER_V0", 0x04},
    {"PS_REGISTER_V1", 0x05},
    {"PS_REGISTER_T0", 0x08},
    {"PS_REGISTER_T1", 0x09},
    {"PS_REGISTER_T2", 0x0a},
    {"PS_REGISTER_T3", 0x0b},
    {"PS_REGISTER_R0", 0x0c},
    {"PS_REGISTER_R1", 0x0d},
    {"PS_REGISTER_V1R0_SUM", 0x0e},
    {"PS_REGISTER_EF_PROD", 0x0f},
    {"PS_REGISTER_ONE", 0x20},
    {"PS_REGISTER_NEGATIVE_ONE", 0x40},
    {"PS_REGISTER_ONE_HALF", 0xa0},
    {"PS_REGISTER_NEGATIVE_ONE_HALF", 0x80},
    {"PS_CHANNEL_RGB", 0x00},
    {"PS_CHANNEL_BLUE", 0x00},
    {"PS_CHANNEL_ALPHA", 0x10},
    {"PS_INPUTMAPPING_UNSIGNED_IDENTITY", 0x00},
    {"PS_INPUTMAPPING_UNSIGNED_INVERT", 0x20},
    {"PS_INPUTMAPPING_EXPAND_NORMAL", 0x40},
    {"PS_INPUTMAPPING_EXPAND_NEGATE", 0x60},
    {"PS_INPUTMAPPING_HALFBIAS_NORMAL", 0x80},
    {"PS_INPUTMAPPING_HALFBIAS_NEGATE", 0xa0},
    {"PS_INPUTMAPPING_SIGNED_IDENTITY", 0xc0},
    {"PS_INPUTMAPPING_SIGNED_NEGATE", 0xe0},
    {"PS_FINALCOMBINERSETTING_CLAMP_SUM", 0x80},
    {"PS_FINALCOMBINERSETTING_COMPLEMENT_V1", 0x40},
    {"PS_FINALCOMBINERSETTING_COMPLEMENT_R0", 0x20},
    {"PS_COMBINEROUTPUT_IDENTITY", 0x00},
    {"PS_COMBINEROUTPUT_BIAS", 0x08},
    {"PS_COMBINEROUTPUT_SHIFTLEFT_1", 0x10},
    {"PS_COMBINEROUTPUT_SHIFTLEFT_1_BIAS", 0x18},
    {"PS_COMBINEROUTPUT_SHIFTLEFT_2", 0x20},
    {"PS_COMBINEROUTPUT_SHIFTRIGHT_1", 0x30},
    {"PS_COMBINEROUTPUT_AB_BLUE_TO_ALPHA", 0x80},
    {"PS_COMBINEROUTPUT_CD_BLUE_TO_ALPHA", 0x40},
    {"PS_COMBINEROUTPUT_AB_MULTIPLY", 0x00},
    {"PS_COMBINEROUTPUT_AB_DOT_PRODUCT", 0x02},
    {"PS_COMBINEROUTPUT_CD_MULTIPLY", 0x00},
    {"PS_COMBINEROUTPUT_CD_DOT_PRODUCT", 0x01},
    {"PS_COMBINEROUTPUT_AB_CD_SUM", 0x00},
    {"PS_COMBINEROUTPUT_AB_CD_MUX", 0x04},
    {"PS_COMBINERCOUNT_MUX_LSB", 0x0000},
    {"PS_COMBINERCOUNT_MUX_MSB", 0x0001},
    {"PS_COMBINERCOUNT_SAME_C0", 0x0000},
    {"PS_COMBINERCOUNT_UNIQUE_C0", 0x0010},
    {"PS_COMBINERCOUNT_SAME_C1", 0x0000},
    {"PS_COMBINERCOUNT_UNIQUE_C1", 0x0100},
    {"PS_COMPAREMODE_S_LT", 0x00},
    {"PS_COMPAREMODE_S_GE", 0x01},
    {"PS_COMPAREMODE_T_LT", 0x00},
    {"PS_COMPAREMODE_T_GE", 0x02},
    {"PS_COMPAREMODE_R_LT", 0x00},
    {"PS_COMPAREMODE_R_GE", 0x04},
    {"PS_COMPAREMODE_Q_LT", 0x00},
    {"PS_COMPAREMODE_Q_GE", 0x08},
    {"PS_GLOBALFLAGS_NO_TEXMODE_ADJUST", 0x0000},
    {"PS_GLOBALFLAGS_TEXMODE_ADJUST", 0x0001},
    {"PS_TEXTUREMODES_NONE", 0x00},
    {"PS_TEXTUREMODES_PROJECT2D", 0x01},
    {"PS_TEXTUREMODES_PROJECT3D", 0x02},
    {"PS_TEXTUREMODES_CUBEMAP", 0x03},
    {"PS_TEXTUREMODES_PASSTHRU", 0x04},
    {"PS_TEXTUREMODES_CLIPPLANE", 0x05},
    {"PS_TEXTUREMODES_BUMPENVMAP", 0x06},
    {"PS_TEXTUREMODES_BUMPENVMAP_LUM", 0x07},
    {"PS_TEXTUREMODES_BRDF", 0x08},
    {"PS_TEXTUREMODES_DOT_ST", 0x09},
    {"PS_TEXTUREMODES_DOT_ZW", 0x0a},
    {"PS_TEXTUREMODES_DOT_RFLCT_DIFF", 0x0b},
    {"PS_TEXTUREMODES_DOT_RFLCT_SPEC", 0x0c},
    {"PS_TEXTUREMODES_DOT_STR_3D", 0x0d},
    {"PS_TEXTUREMODES_DOT_STR_CUBE", 0x0e},
    {"PS_TEXTUREMODES_DPNDNT_AR", 0x0f},
    {"PS_TEXTUREMODES_DPNDNT_GB", 0x10},
    {"PS_TEXTUREMODES_DOTPRODUCT", 0x11},
    {"PS_TEXTUREMODES_DOT_RFLCT_SPEC_CONST", 0x12},
    {"PS_DOTMAPPING_ZERO_TO_ONE", 0x00},
    {"PS_DOTMAPPING_MINUS1_TO_1_D3D", 0x01},
    {"PS_DOTMAPPING_MINUS1_TO_1_GL", 0x02},
    {"PS_DOTMAPPING_MINUS1_TO_1", 0x03},
    {"PS_DOTMAPPING_HILO_1", 0x04},
    {"PS_DOTMAPPING_HILO_HEMISPHERE_D3D", 0x05},
    {"PS_DOTMAPPING_HILO_HEMISPHERE_GL", 0x06},
    {"PS_DOTMAPPING_HILO_HEMISPHERE", 0x07},
};

using Argument = Macro::Argument;
constexpr Argument kInputs[] = {{24, 0xff}, {16, 0xff}, {8, 0xff}, {0, 0xff}};
constexpr Argument kOutputs[] = {{4, 0xf}, {0, 0xf}, {8, 0xf}, {12, 0xff}};
constexpr Argument kCount[] = {{0, 0xff}, {8, 0x111}};
constexpr Argument kModes[] = {{0, 0x1f}, {5, 0x1f}, {10, 0x1f}, {15, 0x1f}};
constexpr Argument kDots[] = {{Macro::kUnused, 0x7}, {0, 0x7}, {4, 0x7}, {8, 0x7}};
constexpr Argument kCompares[] = {{0, 0xf}, {4, 0xf}, {8, 0xf}, {12, 0xf}};
constexpr Argument kTextures[] = {{Macro::kUnused, 0x3}, {Macro::kUnused, 0x3}, {16, 0x1}, {20, 0x2}};
constexpr Argument kConstantPlaces[] = {{0, 0xf, true},  {4, 0xf, true},  {8, 0xf, true},  {12, 0xf, true},
                                        {16, 0xf, true}, {20, 0xf, true}, {24, 0xf, true}, {28, 0xf, true}};
constexpr Argument kFinalConstants[] = {{0, 0xf, true}, {4, 0xf, true}, {8, 0x1}};
constexpr Argument kArgb[] = {{24, 0xff}, {16, 0xff}, {8, 0xff}, {0, 0xff}};
constexpr Argument kRgba[] = {{16, 0xff}, {8, 0xff}, {0, 0xff}, {24, 0xff}};
constexpr Argument kRgb[] = {{16, 0xff}, {8, 0xff}, {0, 0xff}};

constexpr Macro kMacros[] = {
    {"PS_COMBINERINPUTS", kInputs},
    {"PS_COMBINEROUTPUTS", kOutputs},
    {"PS_COMBINERCOUNT", kCount},
    {"PS_TEXTUREMODES", kModes},
    {"PS_DOTMAPPING", kDots},
    {"PS_COMPAREMODE", kCompares},
    {"PS_INPUTTEXTURE", kTextures},
    {"PS_CONSTANTMAPPING", kConstantPlaces},
    {"PS_FINALCOMBINERCONSTANTS", kFinalConstants},
    // Direct3D's colours, in which constants are often written.
    {"D3DCOLOR_ARGB", kArgb},
    {"D3DCOLOR_RGBA", kRgba},
    {"D3DCOLOR_XRGB", kRgb, 0xff000000},
};

template <class Table>
auto find_in(const Table& table, std::string_view name) -> decltype(std::begin(table)) {
  const auto found =
      std::find_if(std::begin(table), std::end(table), [&](const auto& one) { return one.name == name; });
  return found == std::end(table) ? nullptr : found;
}

}  // namespace

const Constant* find_constant(std::string_view name) {
  return find_in(kConstants, name);
}

const Macro* find_macro(std::string_view name) {
  return find_in(kMacros, name);
}

bool accepts(const Macro::Argument& argument, std::int64_t value) {
  return argument.masked || (value >= 0 && value <= argument.most);
}

std::uint32_t bits_of(const Macro::Argument& argument, std::int64_t value) {
  if (argument.shift == Macro::kUnused) return 0;
  return (static_cast<std::uint32_t>(value) & (argument.masked ? argument.most : 0xffffffffU)) << argument.shift;
}

std::vector<std::string_view> macro_names() {
  std::vector<std::string_view> names;
  for (const Macro& macro : kMacros) names.push_back(macro.name);
  for (const Constant& constant : kConstants) names.push_back(constant.name);
  return names;
}

}  // namespace ninebit::xbox
