// What is told to somebody who used the program wrongly.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace ninebit::tools {

// One sentence: what is wrong with the arguments, what was expected or may have been meant, and whose help to ask.
[[nodiscard]] std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace ninebit::tools
