#include "src/combiner/given_registers.h"

#include "ninebit/combiner/initial_registers.h"

namespace ninebit {

RegisterFile default_registers(const HardwareProfile& profile) {
  RegisterFile file = initial_registers(profile, {});
  file[Register::spare0][kAlpha] = file[Register::texture0][kAlpha];
  return file;
}

void replace_constant(Program& program, Register constant, int component, s9 code) {
  const auto i = static_cast<std::size_t>(component);
  const bool first = constant == Register::constant0;
  for (ProgramStage& stage : program.general) (first ? stage.constant0 : stage.constant1)[i] = code;
  (first ? program.constant0 : program.constant1)[i] = code;
}

}  // namespace ninebit
