// How often an index comparison finds two different indices equal: by step, format, profile and program.
//
// Nothing is sampled. The digits of two indices (the channels that hold them) decide whether they compare equal, and
// many pairs of a digit's values give the same intermediate number: each class of such pairs is evaluated once and
// weighted by its size. docs/study/index-steps.md describes the method and why the counts cover all pairs.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/study/study.h"

namespace NINEBIT_PUBLIC ninebit {

// The format that holds an index. `channel` is one 8-bit channel of an RGB colour; the other two are 0.
enum class StudyFormat : std::uint8_t { channel, rgb, luminance_alpha, luminance, alpha };
inline constexpr std::array kStudyFormats{StudyFormat::channel, StudyFormat::rgb, StudyFormat::luminance_alpha,
                                          StudyFormat::luminance, StudyFormat::alpha};

// "channel", "rgb", "la", "l", "a".
[[nodiscard]] std::string_view name_of(StudyFormat format);

// The number of 8-bit channels that hold an index: 3 for rgb, 2 for la, otherwise 1.
[[nodiscard]] int channels_of(StudyFormat format);

// A variant of the article's program.
struct IndexVariant {
  std::string_view name;          // "both-x4"
  Scale first = Scale::by_four;   // of the differences
  Scale second = Scale::by_four;  // of their squares
  // True: each digit is compared separately, and the indices differ if any digit does. False: the squares are summed
  // before narrowing, as the article's dot product does.
  bool separate = false;
};

// both-x4 (the article's), first-x4, second-x4, no-scale; then the same four with the suffix "-separate".
[[nodiscard]] std::span<const IndexVariant> index_variants();

// The article's program for a format with a variant's scales. Reports a profile that refuses it.
[[nodiscard]] Result<CombinerState> index_variant_state(const HardwareProfile& profile, StudyFormat format,
                                                        const IndexVariant& variant);

// The number of pairs of different indices that compare equal.
struct FalseMatches {
  std::uint64_t codes = 0;          // indices of this format and step, including index 0
  std::uint64_t pairs = 0;          // ordered pairs of two different indices
  std::uint64_t false_matches = 0;  // pairs whose alpha leaves the final combiner as byte 0
};

// Counts over all pairs. primary holds one index, texture0 the other. `step` is 1 to 255. Reports a program whose first
// stage mixes digits, a program with too many classes to evaluate, and Fault::cancelled if go_on returns false.
[[nodiscard]] Result<FalseMatches> count_false_matches(const Program& program, const HardwareProfile& profile,
                                                       StudyFormat format, int step, bool separate = false,
                                                       const GoOn& go_on = {});

// One row of the study.
struct IndexStepRow {
  std::string profile;                        // its name
  StudyFormat format = StudyFormat::channel;  // of the indices
  std::string variant;                        // its name
  int step = 1;                               // between indices, 1 to 255
  FalseMatches count;                         // over all pairs
};

// Among the rows with that profile, format and variant: the smallest step that has no false match and no larger step
// with one. Empty if the largest step has false matches.
[[nodiscard]] std::optional<int> smallest_safe_step(std::span<const IndexStepRow> rows, std::string_view profile,
                                                    StudyFormat format, std::string_view variant);

// The caller's own program instead of the variants: compares primary with texture 0 and gives alpha 0 if they are
// equal.
struct IndexProgram {
  std::string file;                   // its name, for the question and for error messages
  std::vector<CombinerState> states;  // one for each profile
};

// The study covers all combinations of the lists.
struct IndexStepsOptions {
  std::vector<HardwareProfile> profiles;       // at least one
  std::shared_ptr<const void> profile_text{};  // owns the profiles' strings if they do not live for the whole run
  std::vector<StudyFormat> formats{kStudyFormats.begin(), kStudyFormats.end()};  // at least one
  std::vector<IndexVariant> variants{index_variants().begin(),
                                     index_variants().end()};  // ignored if there is a program
  int first_step = 1, last_step = 16;                          // 1 to 255
  std::optional<IndexProgram> program{};                       // instead of the variants
  // Names the profiles and the contents of files that were read; the other options are added to it.
  StudyQuestion question{.study = "index-steps", .profile = "all"};
};

// The study: a unit for each profile, format and variant, with a row {profile, format, variant, step, codes, pairs,
// false_matches} for each step. Formats with one channel skip the separate variants, which would give the same counts.
// The caller's own program is the variant "program". Reports an empty list, steps out of range, a program that a
// profile refuses, and the errors of count_false_matches.
[[nodiscard]] Result<std::unique_ptr<Study>> index_steps_study(IndexStepsOptions options);

}  // namespace ninebit
