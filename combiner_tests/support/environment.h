// What the environment asks of a run of random cases.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace ninebit::test {

// The number that a variable holds, or another where there is none.
inline std::uint64_t number_from_environment(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 0);
}

// The indices from 0 to a number, or the one that a variable names.
struct CaseRange {
  CaseRange(const char* variable, std::uint64_t count)
      : is_whole(std::getenv(variable) == nullptr),
        first(number_from_environment(variable, 0)),
        end(is_whole ? count : first + 1) {}
  bool is_whole;
  std::uint64_t first, end;
};

}  // namespace ninebit::test
