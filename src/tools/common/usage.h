// The message after wrong usage.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace ninebit::tools {

// One sentence: what is wrong with the arguments, what was expected or possibly meant, and the help to read.
[[nodiscard]] std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace ninebit::tools
