// The combiners' results for the rows of measured tables: the values of the picture, in the order of their
// columns.
#pragma once

#include <string>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::tools {

class MeasuredRow;

// A byte through a scale and bias, in one portion.
[[nodiscard]] std::vector<int> run_scale(const MeasuredRow& row, const HardwareProfile& profile);

// Red as AB or blue as CD.
[[nodiscard]] std::vector<int> run_mux(const MeasuredRow& row, const HardwareProfile& profile);

// A signed texel, as it leaves the final combiner.
[[nodiscard]] std::vector<int> run_signed_texel(const MeasuredRow& row, const HardwareProfile& profile);

// A float vertex colour, likewise.
[[nodiscard]] std::vector<int> run_vertex_color(const MeasuredRow& row, const HardwareProfile& profile);

// A float vertex colour times a texel of 255, and of 51, in the final combiner.
[[nodiscard]] std::vector<int> run_product(const MeasuredRow& row, const HardwareProfile& profile);

// A quad of the pictures of combiner programs.
[[nodiscard]] std::vector<int> run_quad(const MeasuredRow& row, const HardwareProfile& profile);

// General combiners that write nothing; the output is the register's colour, with its alpha or 1.0.
[[nodiscard]] CombinerState quad_state(Register reg, bool own_alpha);

// The fault of a row's words for a profile; empty: none.
[[nodiscard]] std::string wrong_quad(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_scale(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_mux(const MeasuredRow& row, const HardwareProfile& profile);

}  // namespace ninebit::tools
