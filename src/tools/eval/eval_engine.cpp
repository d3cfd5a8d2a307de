#include "src/tools/eval/eval_engine.h"

#include <algorithm>

#include "ninebit/combiner/normalize.h"
#include "src/combiner/given_registers.h"

namespace ninebit::tools {
namespace {

std::size_t index_of(int component) {
  return static_cast<std::size_t>(component);
}

// The constants that are columns of the rows.
ComponentSet varying_constants(const EvalRows& rows) {
  ComponentSet varying;
  for (const Register reg : {Register::constant0, Register::constant1}) {
    for (int c = 0; c < 4; ++c) {
      if (rows.has({reg, c})) varying.add(reg, c);
    }
  }
  return varying;
}

}  // namespace

EvalRunner::EvalRunner(const CombinerState& state, const HardwareProfile& profile, const EvalRows& rows,
                       EvalEngine engine)
    : program_(normalize(state, profile)),
      batch_program_(program_, {.registers = true}, varying_constants(rows)),
      engine_(engine),
      constant0_(detail::constant_codes(profile, state.constant0)),
      constant1_(detail::constant_codes(profile, state.constant1)) {
  for (const Register reg : {Register::constant0, Register::constant1}) {
    for (int c = 0; c < 4; ++c) (rows.has({reg, c}) ? constants_ : own_constants_).push_back({reg, c});
  }
}

void EvalRunner::set_constants(const EvalBatch& batch, std::size_t row) {
  for (const EvalColumn& column : constants_) {
    replace_constant(program_, column.reg, column.component, batch.registers(column.reg, column.component)[row]);
  }
}

void EvalRunner::run(EvalBatch& batch) {
  for (const EvalColumn& column : own_constants_) {
    const Rgba9& own = column.reg == Register::constant0 ? constant0_ : constant1_;
    std::fill_n(batch.registers(column.reg, column.component), kBatchSize, own[index_of(column.component)]);
  }
  // In real numbers, a batch program cannot vary constants by row.
  const bool by_row =
      engine_ == EvalEngine::reference || (!constants_.empty() && program_.datapath.arithmetic != Arithmetic::integer);
  by_row ? run_reference(batch) : batch_program_.run(batch.registers, batch.count, batch.out);
}

void EvalRunner::run_reference(EvalBatch& batch) {
  for (std::size_t row = 0; row < batch.count; ++row) {
    set_constants(batch, row);
    RegisterFile file;
    for (std::size_t i = 0; i < kRegisterCount; ++i) {
      for (int c = 0; c < 4; ++c) file.value[i][index_of(c)] = batch.registers(static_cast<Register>(i), c)[row];
    }
    const EvaluatedFragment result = evaluate_fragment(program_, file);
    for (std::size_t i = 0; i < kRegisterCount; ++i) {
      for (int c = 0; c < 4; ++c)
        batch.registers(static_cast<Register>(i), c)[row] = result.registers.value[i][index_of(c)];
    }
    for (std::size_t c = 0; c < 4; ++c) batch.out.plane[c][row] = result.color[c];
  }
}

}  // namespace ninebit::tools
