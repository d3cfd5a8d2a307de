// The fragments of a program's error study.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/study/program_error.h"

namespace ninebit {

class Fragments {
 public:
  // Reports the errors of program_error_study about its inputs. Combinations of no components are one fragment.
  [[nodiscard]] static Result<Fragments> of(const HardwareProfile& profile, ProgramInputs inputs);
  // Whether these components have more combinations of values than a study runs.
  [[nodiscard]] static bool too_many(const HardwareProfile& profile, const std::vector<RegisterComponent>& components);

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
  // The names of the components: "primary.r, tex0.r"; "none" if there are none.
  [[nodiscard]] std::string names() const;
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

// Fragments, and the components of the colour that are measured over them.
struct MeasuredColor {
  Fragments fragments;
  std::array<bool, 4> components{};
  // The numbers of these components, 0 to 3.
  [[nodiscard]] std::vector<std::size_t> measured() const;
};

// How the inputs are run. Usually all fragments measure the whole colour. If they are too many combinations, each
// component of the colour is measured over the combinations of those inputs that it depends on; components of the
// colour with the same inputs share them. Reports inputs that are still too many.
[[nodiscard]] Result<std::vector<MeasuredColor>> measured_colors(const HardwareProfile& profile, const Program& program,
                                                                 const ProgramInputs& inputs);

}  // namespace ninebit
