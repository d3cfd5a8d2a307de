#include "ninebit/combiner/batch_program.h"

#include <utility>

#include "src/combiner/batch_kernels.h"
#include "src/combiner/batch_plan.h"
#include "src/combiner/real_batch.h"

namespace ninebit {
namespace {

ComponentSet all_that_varies() {
  ComponentSet all;
  for (std::size_t r = static_cast<std::size_t>(Register::fog); r < kRegisterCount; ++r) {
    for (int c = 0; c < 4; ++c) all.add(static_cast<Register>(r), c);
  }
  return all;
}

}  // namespace

BatchProgram::BatchProgram(const Program& program, const BatchOutputs& outputs, const ComponentSet& varying_constants,
                           BatchInputs inputs)
    : program_(program) {
  if (program.datapath.arithmetic != Arithmetic::integer) {
    reads_ = all_that_varies();
    return;
  }
  detail::VectorCode code = detail::compile_batch(program, outputs, varying_constants, inputs);
  detail::prepare_vector_code(code);
  code_ = std::make_shared<const detail::VectorCode>(std::move(code));
  reads_ = code_->reads;
  keeps_registers_ = !outputs.registers;
}

void BatchProgram::run(RegisterBatch& registers, std::size_t count, OutputBatch& out) const {
  if (!code_) return evaluate_real_batch(program_, registers, count, out);
  detail::run_vector_code(*code_, registers, count, out);
}

}  // namespace ninebit
