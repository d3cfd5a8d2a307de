// How often an index comparison takes two different indices for the same one: by step, format, profile and program.
//
// Nothing is sampled. Two indices come out equal or not by their digits (the channels that hold an index), and after
// the first general combiner most pairs of digits can no longer be told apart: a class of pairs is evaluated once and
// counted as often as it has members. docs/study.md tells how, and why the counts are those of all pairs.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

// A form of the article's program.
struct IndexVariant {
  std::string_view name;
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

struct FalseMatches {
  std::uint64_t codes = 0;          // indices of this format and step, number 0 included
  std::uint64_t pairs = 0;          // ordered pairs of two different ones
  std::uint64_t false_matches = 0;  // those whose alpha leaves the final combiner as byte 0
};

// Counts over all pairs. primary holds one index, texture0 the other. `step` is 1 to 255. Reports a program whose second
// stage sees digits mixed by the first, where the pairs are more than can be counted one by one; and
// Fault::cancelled where go_on says no.
[[nodiscard]] Result<FalseMatches> count_false_matches(const Program& program, const HardwareProfile& profile,
                                                       StudyFormat format, int step, bool separate = false,
                                                       const GoOn& go_on = {});

struct IndexStepRow {
  std::string profile;
  StudyFormat format = StudyFormat::channel;
  std::string variant;
  int step = 1;
  FalseMatches count;
};

// The smallest step of the rows with that profile, format and variant from which on no step loses a pair; empty if the
// largest step still loses some.
[[nodiscard]] std::optional<int> smallest_safe_step(std::span<const IndexStepRow> rows, std::string_view profile,
                                                    StudyFormat format, std::string_view variant);

}  // namespace ninebit
