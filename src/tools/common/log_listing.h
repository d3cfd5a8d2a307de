// The combiner set-ups of a log of register writes, as a table and as JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "ninebit/language/register_log.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// One line a set-up, under a heading. `frame`: the log was read for this frame, and set-ups that have no draw in it are
// left out.
[[nodiscard]] std::string log_table(const RegisterLog& log, std::optional<std::uint32_t> frame, const std::string& name,
                                    const HardwareProfile& profile);

// The answer of `convert --json` with a row for each set-up.
[[nodiscard]] Json log_json(const RegisterLog& log, std::optional<std::uint32_t> frame, const std::string& name,
                            const HardwareProfile& profile, const std::string& profile_name);

// The number of the only set-up that has a draw in the frame that the log was read for; a Diagnostic lists them if
// there are several, or none.
[[nodiscard]] Result<std::size_t> only_setup(const RegisterLog& log, std::uint32_t frame, const std::string& name);

}  // namespace ninebit::tools
