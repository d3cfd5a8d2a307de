// A side of a question, ready to run: its program, and where its registers come from.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/program.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/study/equivalence.h"

namespace ninebit::proof {

// A register component, or that of a constant that is not set, as one number, and sets of them. Const0 and const1 have
// the numbers of their registers; the other constants come after the registers.
inline constexpr int kRegisterComponents = static_cast<int>(kRegisterCount) * 4;
inline constexpr int kComponents = kRegisterComponents + (static_cast<int>(kConstantNames) - 2) * 4;
using ComponentMask = std::bitset<static_cast<std::size_t>(kComponents)>;

constexpr int index_of(Register r, int component) {
  return static_cast<int>(r) * 4 + component;
}
constexpr int index_of(ConstantName name, int component) {
  const int of = name < 2 ? static_cast<int>(Register::constant0) + name : static_cast<int>(kRegisterCount) + name - 2;
  return of * 4 + component;
}
constexpr Register register_at(int index) {
  return static_cast<Register>(index / 4);
}
inline ComponentMask mask_of(int index) {
  return ComponentMask{}.set(static_cast<std::size_t>(index));
}
inline bool has(const ComponentMask& mask, int index) {
  return mask[static_cast<std::size_t>(index)];
}
inline bool is_constant(int index) {
  return index >= kRegisterComponents ||
         (index >= index_of(Register::constant0, 0) && index < index_of(Register::fog, 0));
}
// The input that a component names.
[[nodiscard]] ProofInput input_at(int index, std::uint8_t byte);

// The value of a component before the first general combiner.
struct Source {
  int input = -1;  // the component that names the input; -1: a code
  s9 code = 0;     // then
};

struct ProofSide {
  explicit ProofSide(const ProofSubject& from, const std::vector<ProofInput>& fixed = {});

  [[nodiscard]] bool is_integer() const { return profile.arithmetic == Arithmetic::integer; }
  // The target's value as the program shows it, with these inputs, by the reference.
  [[nodiscard]] int evaluate(const ProofTarget& target, const std::array<std::uint8_t, kComponents>& bytes) const;
  // A value of the target as it is compared: a colour's byte.
  [[nodiscard]] int shown(const ProofTarget& target, s9 code) const {
    return target.reg ? code : to_byte(profile, code);
  }

  // Whether it is run one fragment after another: batches have integers, and two constants that vary.
  [[nodiscard]] bool runs_in_rows() const;

  HardwareProfile profile;
  Program program;
  std::vector<int> components;  // that hold something: registers, and the constants that are not set
  std::array<Source, kComponents> start{};
};

// The program's first `count` general combiners, as one that ends with registers.
[[nodiscard]] Program first_combiners(const Program& program, int count);
// The rest after them, with the final combiner.
[[nodiscard]] Program later_combiners(const Program& program, int count);
// The outputs of a batch that show the target.
[[nodiscard]] BatchOutputs outputs_for(const ProofTarget& target);

// A part of a side's program over batches of cases, where constants that are not set vary, too.
class SideBatch {
 public:
  // `side` must outlive it. Without a program run() does nothing.
  SideBatch(const ProofSide& side, const std::optional<Program>& program, const BatchOutputs& outputs);

  // The values of one of the side's components, one a case.
  [[nodiscard]] s9* plane(int index);
  // Runs the cases; registers change only if `outputs` has them, or for real numbers.
  void run(std::size_t count, OutputBatch& out);

 private:
  void run_in_rows(std::size_t count, OutputBatch& out);

  const ProofSide& side_;
  std::optional<Program> program_;
  BatchOutputs outputs_;
  std::optional<BatchProgram> batch_;  // none if cases are run one after another
  std::array<std::optional<ConstantName>, 2> varying_{};
  std::unique_ptr<RegisterBatch> registers_;
  std::vector<std::array<s9, kBatchSize>> constants_;  // of side_.components past the registers
};

// Which register components a value depends on.

// By component after a general combiner: the components at the start of the flow that it depends on.
using ComponentFlow = std::array<ComponentMask, kComponents>;

// Through the general combiners [from, to). A product with a factor that is always 0 depends on nothing.
[[nodiscard]] ComponentFlow flow_through(const Program& program, int from, int to);

// The components before general combiner `from` that the target depends on; after the last one if `from` is their
// number.
[[nodiscard]] ComponentMask reads_of(const Program& program, int from, const ProofTarget& target);

}  // namespace ninebit::proof
