// The fragments of a program's error study.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/study/program_error.h"

namespace ninebit {

class Fragments {
 public:
  // Reports the errors of program_error_study about its inputs.
  [[nodiscard]] static Result<Fragments> of(const HardwareProfile& profile, ProgramInputs inputs);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const std::vector<RegisterComponent>& components() const { return inputs_.components; }
  // True if the fragments are all combinations of their components' values.
  [[nodiscard]] bool all() const { return !inputs_.codes; }

  // The lowest value of a component among all combinations, and its number of values.
  [[nodiscard]] int lowest(std::size_t component) const;
  [[nodiscard]] std::size_t values(std::size_t component) const {
    return static_cast<std::size_t>(one_ - lowest(component) + 1);
  }

  // The constants that are fixed, in a program.
  void put_fixed_constants(Program& program) const;

  // The code of a component of a fragment.
  [[nodiscard]] s9 code(std::size_t fragment, std::size_t component) const;
  // "primary.r 3, tex0.r 255".
  [[nodiscard]] std::string text(std::size_t fragment) const;
  // A fragment's registers before the first stage, including constants that are among the components.
  [[nodiscard]] RegisterFile registers(std::size_t fragment) const;
  [[nodiscard]] bool have_constants() const;
  // Puts a fragment's constants into a program.
  void put_constants(std::size_t fragment, Program& program) const;

 private:
  Fragments(const HardwareProfile& profile, ProgramInputs inputs);

  ProgramInputs inputs_;
  int lowest_, one_;
  RegisterFile defaults_;  // with the components that are fixed
  bool has_own_alpha_ = false;
  std::size_t count_ = 0;
};

}  // namespace ninebit
