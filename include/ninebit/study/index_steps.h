// How often an index comparison takes two different indices for the same one: by step, format, profile and program.
//
// Nothing is sampled. Two indices come out equal or not by their digits (the channels that hold an index), and most
// pairs of a digit's values leave the same number behind: a class of such pairs is evaluated once and counted as often
// as it has members. docs/study/index-steps.md tells how, and why the counts are those of all pairs.
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

// What holds an index. `channel` is one 8-bit channel of an RGB colour, the other two being 0.
enum class StudyFormat : std::uint8_t { channel, rgb, luminance_alpha, luminance, alpha };
inline constexpr std::array kStudyFormats{StudyFormat::channel, StudyFormat::rgb, StudyFormat::luminance_alpha,
                                          StudyFormat::luminance, StudyFormat::alpha};

// "channel", "rgb", "la", "l", "a".
[[nodiscard]] std::string_view name_of(StudyFormat format);

// How many 8-bit channels hold an index: 3 for rgb, 2 for la, otherwise 1.
[[nodiscard]] int channels_of(StudyFormat format);

// A form of the article's program.
struct IndexVariant {
  std::string_view name;          // "both-x4"
  Scale first = Scale::by_four;   // of the differences
  Scale second = Scale::by_four;  // of their squares
  // Each digit has a comparison of its own, and the indices count as different where one of them says so. Otherwise the
  // squares are summed before they are narrowed, as the article's dot product does.
  bool separate = false;
};

// both-x4 (the article's), first-x4, second-x4, no-scale; then the same with "-separate" behind.
[[nodiscard]] std::span<const IndexVariant> index_variants();

// The article's program for a format with a variant's scales. Reports a profile that refuses it.
[[nodiscard]] Result<CombinerState> index_variant_state(const HardwareProfile& profile, StudyFormat format,
                                                        const IndexVariant& variant);

// How many pairs of indices a comparison cannot tell apart.
struct FalseMatches {
  std::uint64_t codes = 0;          // indices of this format and step, number 0 included
  std::uint64_t pairs = 0;          // ordered pairs of two different ones
  std::uint64_t false_matches = 0;  // those whose alpha leaves the final combiner as byte 0
};

// Counts over all pairs. primary holds one index, texture0 the other. `step` is 1 to 255. Reports a program whose first
// stage mixes digits, or whose classes are more than can be evaluated; and Fault::cancelled where go_on says no.
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

// The smallest step of the rows with that profile, format and variant from which on no step loses a pair; empty if the
// largest step still loses some.
[[nodiscard]] std::optional<int> smallest_safe_step(std::span<const IndexStepRow> rows, std::string_view profile,
                                                    StudyFormat format, std::string_view variant);

// A program of the caller's own in place of the variants: primary against texture 0, alpha 0 where they are equal.
struct IndexProgram {
  std::string file;                   // its name, for the question and for faults
  std::vector<CombinerState> states;  // one for each profile
};

// What the study is made over: all combinations of the lists.
struct IndexStepsOptions {
  std::vector<HardwareProfile> profiles;       // at least one
  std::shared_ptr<const void> profile_text{};  // what owns their strings, where these do not live for the whole run
  std::vector<StudyFormat> formats{kStudyFormats.begin(), kStudyFormats.end()};  // at least one
  std::vector<IndexVariant> variants{index_variants().begin(),
                                     index_variants().end()};  // not read where there is a program
  int first_step = 1, last_step = 16;                          // 1 to 255
  std::optional<IndexProgram> program{};                       // instead of the variants
  // How the question names the profiles, and the contents of files that were read; the other options are added to it.
  StudyQuestion question{.study = "index-steps", .profile = "all"};
};

// The study: a unit for each profile, format and variant, with a row {profile, format, variant, step, codes, pairs,
// false_matches} for each step. A separate comparison of a format with one channel is left out, being the same as the
// other; a program of the caller's own is the variant "program". Reports an empty list, steps out of range, a program
// that a profile refuses, and what count_false_matches reports.
[[nodiscard]] Result<std::unique_ptr<Study>> index_steps_study(IndexStepsOptions options);

}  // namespace ninebit
