// Counts the pairs of different indices that compare equal.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/program.h"
#include "ninebit/study/index_steps.h"
#include "src/study/digits/digit_classes.h"

namespace ninebit {

// Counts for one program in one format; prepared once for all steps.
class FalseMatchCounter {
 public:
  enum class Way {
    fastest,
    every_combination  // evaluates every combination of classes, even if their order decides most: to check `fastest`
  };

  // `profile` must outlive the counter. Reports the errors of DigitClasses::of.
  [[nodiscard]] static Result<FalseMatchCounter> prepare(const Program& program, const HardwareProfile& profile,
                                                         StudyFormat format, const GoOn& go_on, Way way = Way::fastest);

  // Counts over all indices whose digits hold these values, which are different. `separate`: each digit is compared
  // separately, with the other digits 0 in both indices. Reports too many cases to count one by one, and
  // Fault::cancelled.
  [[nodiscard]] Result<FalseMatches> count(std::span<const std::uint8_t> values, bool separate,
                                           const GoOn& go_on) const;

 private:
  using Classes = std::vector<std::vector<PairClass>>;
  struct Found;
  class Batches;

  FalseMatchCounter(const Program& program, const HardwareProfile& profile, StudyFormat format,
                    std::optional<DigitSum> sum, DigitClasses classes)
      : program_(program),
        profile_(&profile),
        format_(format),
        sum_(std::move(sum)),
        classes_(std::move(classes)),
        batch_(program, {.color = {false, false, false, true}, .registers = false}) {}

  // The pairs that compare equal among the combinations of classes.
  [[nodiscard]] Result<Found> found_among(const Classes& classes, const GoOn& go_on) const;
  [[nodiscard]] Found found_in_order(const Classes& classes) const;
  [[nodiscard]] bool comes_out_equal(const DigitBytes& own, const DigitBytes& other) const;

  Program program_;
  const HardwareProfile* profile_;
  StudyFormat format_;
  std::optional<DigitSum> sum_;
  DigitClasses classes_;
  BatchProgram batch_;
};

// The values of a digit: 0, step, 2 step, … up to 255.
[[nodiscard]] std::vector<std::uint8_t> values_of_step(int step);

}  // namespace ninebit
