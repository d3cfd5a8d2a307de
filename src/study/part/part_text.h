// The lines of a part: what study_part.h's files are made of.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/study/study_part.h"

namespace ninebit {

// How long a line may be, so that a file of anything else costs little memory: JSON takes up to 100 times its bytes.
inline constexpr std::size_t kMaxPartLine = std::size_t{1} << 20;

// What a message quotes of a part, which can hold anything: at most 400 bytes, '?' for control characters.
[[nodiscard]] std::string quotable(std::string text);

// Each with its newline; the first ends in the hash of itself, as those of units do.
[[nodiscard]] std::string header_line(const PartHeader& header);
[[nodiscard]] std::string unit_line(const FinishedUnit& unit);
[[nodiscard]] std::string end_line(std::size_t units, std::string_view hash_of_all_before);

// Lines without their newline. Report, as a sentence without file or line, what is wrong.
[[nodiscard]] Result<PartHeader> parse_header_line(std::string_view line);
[[nodiscard]] Result<FinishedUnit> parse_unit_line(std::string_view line);
[[nodiscard]] bool is_end_line(std::string_view line);
[[nodiscard]] Status check_end_line(std::string_view line, std::size_t units, std::string_view hash_of_all_before);

}  // namespace ninebit
