#include "src/frame/texture_units.h"

#include <array>

#include "ninebit/combiner/batch_program.h"

namespace ninebit {

int texture_units_read(const Program& program) {
  constexpr std::array kRegisters{Register::texture0, Register::texture1, Register::texture2, Register::texture3};
  const ComponentSet reads = BatchProgram(program).reads();
  int count = 0;
  for (const Register reg : kRegisters) {
    bool read = false;
    for (int c = 0; c < 4; ++c) read = read || reads.contains(reg, c);
    count += read ? 1 : 0;
  }
  return count;
}

}  // namespace ninebit
