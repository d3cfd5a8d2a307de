// A profile's results for the rows of measured tables of texture-shader stages and of texel formats.
#pragma once

#include <string>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::tools {

class MeasuredRow;

// s, t, r, q as a colour, shown by its alpha over what the table states.
[[nodiscard]] std::vector<int> run_pass_through(const MeasuredRow& row, const HardwareProfile& profile);

// The cell of a checkerboard that an offset texture reads: 0 or 1.
[[nodiscard]] std::vector<int> run_offset(const MeasuredRow& row, const HardwareProfile& profile);

// A component of an offset texture's texel, times the luminance.
[[nodiscard]] std::vector<int> run_luminance(const MeasuredRow& row, const HardwareProfile& profile);

// The colour that a cube map has where dot products, or the eye that they reflect, look.
[[nodiscard]] std::vector<int> run_dot_cube(const MeasuredRow& row, const HardwareProfile& profile);

// The cell of a checkerboard that the dot products of a filtered texel of 16 bits read: 0 or 1.
[[nodiscard]] std::vector<int> run_hilo_dots(const MeasuredRow& row, const HardwareProfile& profile);

// The quotient of two dot products as a depth code of 16 bits.
[[nodiscard]] std::vector<int> run_depth_replace(const MeasuredRow& row, const HardwareProfile& profile);

// The colour of a cube map in a direction.
[[nodiscard]] std::vector<int> run_cube_map(const MeasuredRow& row, const HardwareProfile& profile);

// The last of three layers that CULL_FRAGMENT leaves: 1 to 3, or 0.
[[nodiscard]] std::vector<int> run_cull(const MeasuredRow& row, const HardwareProfile& profile);

// A texel of Y, U and V as red, green and blue.
[[nodiscard]] std::vector<int> run_yuv(const MeasuredRow& row, const HardwareProfile& profile);

// A texel of a word, shown by its alpha over what the table states.
[[nodiscard]] std::vector<int> run_texel_word(const MeasuredRow& row, const HardwareProfile& profile);

// The fault of a row's words, or of a profile without texture shaders; empty: none.
[[nodiscard]] std::string wrong_stages(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_dot_cube(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_cull(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_texel_word(const MeasuredRow& row, const HardwareProfile& profile);

}  // namespace ninebit::tools
