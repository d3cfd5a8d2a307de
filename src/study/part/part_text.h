// Writes and parses the lines of a part (study_part.h).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/study/study_part.h"

namespace ninebit {

// The maximum length of a line in bytes. It bounds the memory for a file that is not a part: parsed JSON takes up to
// 100 times the bytes of its text.
inline constexpr std::size_t kMaxPartLine = std::size_t{1} << 20;

// Text from a part for a message: at most 400 bytes, with '?' for control characters.
[[nodiscard]] std::string quotable(std::string text);

// Each line includes its newline. The header line and the unit lines end in their own hash.
[[nodiscard]] std::string header_line(const PartHeader& header);
[[nodiscard]] std::string unit_line(const FinishedUnit& unit);
[[nodiscard]] std::string end_line(std::size_t units, std::string_view hash_of_all_before);

// These take lines without their newline. Error messages contain neither file nor line number.
[[nodiscard]] Result<PartHeader> parse_header_line(std::string_view line);
[[nodiscard]] Result<FinishedUnit> parse_unit_line(std::string_view line);
[[nodiscard]] bool is_end_line(std::string_view line);
[[nodiscard]] Status check_end_line(std::string_view line, std::size_t units, std::string_view hash_of_all_before);

}  // namespace ninebit
