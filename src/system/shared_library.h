// Shared libraries loaded at run time.
#pragma once

#include <filesystem>
#include <string>

namespace ninebit::posix {

// A shared library that stays loaded until the program ends; nullptr: library_error() says why. find_symbol() gives
// nullptr for what it does not have.
[[nodiscard]] void* load_library(const std::filesystem::path& file);
[[nodiscard]] void* find_symbol(void* library, const char* name);
[[nodiscard]] std::string library_error();

}  // namespace ninebit::posix
