// Writes and parses the lines of a part (study_part.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/study/study.h"
#include "ninebit/study/study_part.h"
#include "src/system/hashing/openssl.h"

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

// A row's value as JSON; std::monostate becomes null.

inline nlohmann::ordered_json json_value(const StudyValue& value) {
  return std::visit(
      [](const auto& v) -> nlohmann::ordered_json {
        if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::monostate>) {
          return nullptr;
        } else {
          return v;
        }
      },
      value);
}

// The state of a part on disk: its contents, and the place where a run resumes it.

struct PartState {
  StudyPart part;                  // without a header if no line is complete
  std::uintmax_t whole_bytes = 0;  // offset of the end of the last complete line
  std::unique_ptr<Sha256> hash;    // of the complete lines
};

// Reads a part, which may end in an incomplete line. `study_of` as in read_part.
[[nodiscard]] Result<PartState> read_part_state(const std::filesystem::path& file, const StudyOfPart& study_of);

// The reason why a part does not belong to the study of `expected`; empty if it does. Shard indices are not compared.
[[nodiscard]] std::string why_foreign(const PartHeader& part, const PartHeader& expected);

// The number of units in a complete part.
[[nodiscard]] std::size_t units_of(const PartHeader& header);

}  // namespace ninebit
