// The batch evaluator: compiles a program once to a short list of vector operations and runs them over batches of
// fragments.
//
// It gives the bits of the reference in evaluate.h. docs/numerics.md, "Batches", explains how a program is compiled and
// why the bits are the same.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/registers.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// A set of register components, such as texture0's blue.
class ComponentSet {
 public:
  // For both functions `reg` is one of the first kRegisterCount, and `component` is kRed to kAlpha.
  constexpr void add(Register reg, int component) { bits_ |= bit(reg, component); }
  // Whether the component was added.
  [[nodiscard]] constexpr bool contains(Register reg, int component) const {
    return (bits_ & bit(reg, component)) != 0;
  }
  friend constexpr bool operator==(const ComponentSet&, const ComponentSet&) = default;

 private:
  static constexpr std::uint64_t bit(Register reg, int component) {
    return std::uint64_t{1} << (static_cast<unsigned>(reg) * 4U + static_cast<unsigned>(component));
  }
  std::uint64_t bits_ = 0;
};

// The outputs that a caller wants of a batch. Values on which no wanted output depends are not computed.
struct BatchOutputs {
  std::array<bool, 4> color{true, true, true, true};  // red, green, blue, alpha of the final combiner's colour
  bool registers = false;                             // all registers as the last general combiner leaves them
};

// The codes that a batch's registers hold when run() begins. Bytes, as textures and colours are, are not negative:
// programs that know it run faster.
enum class BatchInputs : std::uint8_t { any_codes, not_negative };

namespace detail {
struct VectorCode;
}

// Immutable: one object may run in any number of threads at once. Copies share their operations.
class BatchProgram {
 public:
  // For integer arithmetic: components of constant0 and constant1 that are in `varying_constants` are read from the
  // batch instead of from the program, one value for each fragment, in every stage and in the final combiner.
  explicit BatchProgram(const Program& program, const BatchOutputs& outputs = {},
                        const ComponentSet& varying_constants = {}, BatchInputs inputs = BatchInputs::any_codes);

  // The components that run() reads before it writes them. The others need not be filled.
  [[nodiscard]] const ComponentSet& reads() const { return reads_; }

  // Whether run() leaves the registers as they were: integer arithmetic, and BatchOutputs::registers is false.
  [[nodiscard]] bool keeps_registers() const { return keeps_registers_; }

  // Evaluates the first `count` (at most kBatchSize) fragments. Their registers hold codes in [lowest, one],
  // or in [0, one] for `not_negative`.
  // On return the wanted components of `out` hold the colours, codes in [0, one]; the others are unspecified.
  // `registers` then holds the registers after the last general combiner, if they are wanted. If not, it is unchanged
  // with integer arithmetic and unspecified with another one. Lanes from `count` on may be overwritten with unspecified
  // values. Integer arithmetic runs on the machine's best SIMD target, chosen at run time; real numbers run one
  // fragment at a time.
  void run(RegisterBatch& registers, std::size_t count, OutputBatch& out) const;

  // The vector operations as text, one a line, in the order in which they run; empty for real numbers.
  [[nodiscard]] std::string describe() const;

 private:
  Program program_;
  ComponentSet reads_;
  bool keeps_registers_ = false;
  std::shared_ptr<const detail::VectorCode> code_;  // none for real numbers
};

// Returns the name of the SIMD target that batches run on, such as "AVX2".
[[nodiscard]] const char* simd_target();

}  // namespace ninebit
