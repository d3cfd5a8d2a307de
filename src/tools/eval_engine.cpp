#include "src/tools/eval_engine.h"

#include <algorithm>

namespace ninebit::tools {
namespace {

std::size_t index_of(int component) {
  return static_cast<std::size_t>(component);
}

// Copies `count` fragments of all registers and outputs.
void copy(const RegisterBatch& from, std::size_t from_row, RegisterBatch& to, std::size_t to_row, std::size_t count) {
  for (std::size_t i = 0; i < kRegisterCount; ++i) {
    const auto reg = static_cast<Register>(i);
    for (int c = 0; c < 4; ++c) std::copy_n(from(reg, c) + from_row, count, to(reg, c) + to_row);
  }
}

}  // namespace

void replace_constant(Program& program, const EvalColumn& column, s9 code) {
  const std::size_t i = index_of(column.component);
  const bool first = column.reg == Register::constant0;
  for (ProgramStage& stage : program.general) (first ? stage.constant0 : stage.constant1)[i] = code;
  (first ? program.constant0 : program.constant1)[i] = code;
}

EvalRunner::EvalRunner(const CombinerState& state, const HardwareProfile& profile, const EvalRows& rows,
                       EvalEngine engine)
    : program_(normalize(state, profile)),
      engine_(engine),
      constant0_(detail::constant_codes(profile, state.constant0)),
      constant1_(detail::constant_codes(profile, state.constant1)) {
  for (const Register reg : {Register::constant0, Register::constant1}) {
    for (int c = 0; c < 4; ++c) (rows.has({reg, c}) ? constants_ : own_constants_).push_back({reg, c});
  }
}

void EvalRunner::set_constants(const EvalBatch& batch, std::size_t row) {
  for (const EvalColumn& column : constants_) {
    replace_constant(program_, column, batch.registers(column.reg, column.component)[row]);
  }
}

bool EvalRunner::same_constants(const EvalBatch& batch, std::size_t row, std::size_t other) const {
  return std::all_of(constants_.begin(), constants_.end(), [&](const EvalColumn& column) {
    const s9* const plane = batch.registers(column.reg, column.component);
    return plane[row] == plane[other];
  });
}

void EvalRunner::run(EvalBatch& batch) {
  for (const EvalColumn& column : own_constants_) {
    const Rgba9& own = column.reg == Register::constant0 ? constant0_ : constant1_;
    std::fill_n(batch.registers(column.reg, column.component), kBatchSize, own[index_of(column.component)]);
  }
  engine_ == EvalEngine::simd ? run_simd(batch) : run_reference(batch);
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

// A batch has one set of constants; rows with others are evaluated run by run.
void EvalRunner::run_simd(EvalBatch& batch) {
  std::size_t first = 0;
  while (first < batch.count) {
    std::size_t last = first + 1;
    if (constants_.empty()) last = batch.count;
    while (last < batch.count && same_constants(batch, first, last)) ++last;
    set_constants(batch, first);
    const std::size_t count = last - first;
    if (count == batch.count) {
      evaluate(program_, batch.registers, count, batch.out);
      return;
    }
    copy(batch.registers, first, part_, 0, count);
    evaluate(program_, part_, count, part_out_);
    copy(part_, 0, batch.registers, first, count);
    for (std::size_t c = 0; c < 4; ++c)
      std::copy_n(part_out_.plane[c].data(), count, batch.out.plane[c].data() + first);
    first = last;
  }
}

}  // namespace ninebit::tools
