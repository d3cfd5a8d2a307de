// Lines of dumps of GL calls, as apitrace and GLIntercept write them: "1235 glCombinerParameteriNV(pname = …)".
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace ninebit::detail {

struct GlDumpLine {
  std::size_t call = 0;     // where the name of the call begins
  std::string_view name{};  // of the call
  bool sets_combiners = false;
  std::size_t end = 0;  // behind the line; text in quotes may make it longer
};

// The line of a dump that begins with the call number at this byte; empty: the number does not begin such a line.
[[nodiscard]] std::optional<GlDumpLine> gl_dump_line(std::string_view text, std::size_t number);

}  // namespace ninebit::detail
