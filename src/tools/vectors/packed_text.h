// A text as a gzip file.
#pragma once

#include <string>
#include <string_view>

namespace ninebit::tools {

// The bytes of a gzip file (RFC 1952) with this text, without a name or a time. The same text gives the same bytes.
[[nodiscard]] std::string packed_text(std::string_view text);

// The C files of packs: runner.c and stage_runner.c beside this file.
extern const std::string_view kRunnerText;
extern const std::string_view kStageRunnerText;

}  // namespace ninebit::tools
