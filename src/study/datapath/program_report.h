// The report of a program's error study.
#pragma once

#include <cstddef>
#include <span>

#include "ninebit/combiner/program.h"
#include "ninebit/study/report.h"
#include "ninebit/study/study.h"
#include "src/study/datapath/program_inputs.h"

namespace ninebit {

// The report on the rows of `done` of `units` units, without maps and files. `asked`: the inputs that were asked for,
// of which a component of the colour may depend on some only.
[[nodiscard]] StudyReport program_report(const Program& program, std::span<const RegisterComponent> asked,
                                         std::span<const MeasuredColor> colors, std::span<const StudyRow> rows,
                                         std::size_t done, std::size_t units);

// Study::draw: evaluates all fragments again. Where a component of the colour is measured over all combinations of two
// or more inputs, a map shows its error over the first two, the largest over all values of the others.
[[nodiscard]] Status draw_program(const Program& program, std::span<const MeasuredColor> colors,
                                  std::span<const StudyRow> rows, const DrawProgress& progress, StudyReport& report);

}  // namespace ninebit
