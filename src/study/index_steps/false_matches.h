// Counting the pairs of indices that a comparison takes for equal.
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

// One program's comparisons in one format; made once for all steps.
class FalseMatchCounter {
 public:
  enum class Way {
    fastest,
    every_combination  // of classes is evaluated, also where their order tells most results: to judge the fast way
  };

  // `profile` must live as long. Reports what DigitClasses::of does.
  [[nodiscard]] static Result<FalseMatchCounter> prepare(const Program& program, const HardwareProfile& profile,
                                                         StudyFormat format, const GoOn& go_on, Way way = Way::fastest);

  // Counts where each digit holds any of these values, which differ from each other. `separate`: each digit has a
  // comparison of its own, the others being 0 in both indices. Reports more cases than can be counted one by one, and
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

  // What comes out equal among the combinations of classes.
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

// The values of a digit with a step: 0, step, 2 step, … up to 255.
[[nodiscard]] std::vector<std::uint8_t> values_of_step(int step);

}  // namespace ninebit
