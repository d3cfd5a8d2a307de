// A side of a question, ready to run: its program, and where its registers come from.
#pragma once

#include <array>
#include <cstdint>

#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/program.h"
#include "ninebit/study/equivalence.h"

namespace ninebit::proof {

// A register component as one number, and sets of them.
inline constexpr int kComponents = static_cast<int>(kRegisterCount) * 4;
using ComponentMask = std::uint64_t;

constexpr int index_of(Register r, int component) {
  return static_cast<int>(r) * 4 + component;
}
constexpr Register register_at(int index) {
  return static_cast<Register>(index / 4);
}
constexpr ComponentMask mask_of(int index) {
  return ComponentMask{1} << static_cast<unsigned>(index);
}

// What a register component holds before the first general combiner.
struct Source {
  int input = -1;  // the component that names the input; -1: a code
  s9 code = 0;     // then
};

struct Subject {
  explicit Subject(const ProofSubject& from);

  [[nodiscard]] bool is_integer() const { return profile.arithmetic == Arithmetic::integer; }
  // What the program shows of the target, with these inputs, by the reference.
  [[nodiscard]] int evaluate(const ProofTarget& target, const std::array<std::uint8_t, kComponents>& bytes) const;
  // A value of the target as it is compared: a colour's byte.
  [[nodiscard]] int shown(const ProofTarget& target, s9 code) const {
    return target.reg ? code : to_byte(profile, code);
  }

  HardwareProfile profile;
  Program program;
  std::array<Source, kComponents> start{};
};

// The program's first `count` general combiners, as one that ends with registers.
[[nodiscard]] Program head_of(const Program& program, int count);
// The rest after them, with the final combiner.
[[nodiscard]] Program tail_of(const Program& program, int count);
// What a batch must give to show the target.
[[nodiscard]] BatchOutputs outputs_for(const ProofTarget& target);

}  // namespace ninebit::proof
