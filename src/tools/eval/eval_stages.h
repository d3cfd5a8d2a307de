// Tables for programs with texture-shader stages: coordinates and texels by row, one fragment at a time.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/program_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/texture_shader/evaluate_stages.h"
#include "ninebit/texture_shader/stage_program.h"
#include "src/texture_shader/given_stages.h"
#include "src/tools/input/csv_lines.h"
#include "src/tools/input/eval_table.h"

namespace ninebit::tools {

// A column of such a table: a coordinate or a byte of a texel; or a register's code, not of textures, which the stages
// give.
struct StageColumn {
  std::optional<GivenComponent> given{};  // empty: it is a code
  EvalColumn code{};
};

// Whether a header has a column of texture-shader stages.
[[nodiscard]] bool has_stage_columns(std::string_view header);

// Evaluates the rows of a table. A unit's texture has one texel, which is read wherever its stage reads it.
class EvalStages {
 public:
  // Reports the first fault of the header, and a program that compile() refuses. Textures are of the kinds that the
  // operations read; one that an offset reads has the format DSDT_MAG.
  [[nodiscard]] static Result<EvalStages> make(const TextProgram& program, const HardwareProfile& profile,
                                               const CsvLine& header, const std::string& file);

  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

  // The names of the results: the colour, the textures as the combiners read them, whether the fragment is culled, its
  // replaced depth, and where each texture is read.
  [[nodiscard]] static std::vector<std::string> result_names();
  // One row's results by these names; empty: there is none.
  [[nodiscard]] Result<std::vector<std::string>> evaluate(const CsvLine& line, const std::string& file) const;

 private:
  EvalStages() = default;

  HardwareProfile profile_{};
  TextureShaderProgram stages_{};
  Program program_{};
  std::vector<StageColumn> columns_{};
  std::vector<std::string> warnings_{};
};

}  // namespace ninebit::tools
