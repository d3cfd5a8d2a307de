#include "src/combiner/given_registers.h"

namespace ninebit {

RegisterFile default_registers(const HardwareProfile& profile) {
  RegisterFile file;
  for (const Register reg :
       {Register::fog, Register::texture0, Register::texture1, Register::texture2, Register::texture3}) {
    file[reg][kAlpha] = static_cast<s9>(profile.one.value);
  }
  return file;
}

void replace_constant(Program& program, Register constant, int component, s9 code) {
  const auto i = static_cast<std::size_t>(component);
  const bool first = constant == Register::constant0;
  for (ProgramStage& stage : program.general) (first ? stage.constant0 : stage.constant1)[i] = code;
  (first ? program.constant0 : program.constant1)[i] = code;
}

}  // namespace ninebit
