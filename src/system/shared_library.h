// Shared libraries loaded at run time.
#pragma once

#include <filesystem>
#include <string>

namespace ninebit::posix {

// Loads a shared library, which stays loaded until the program ends; on failure it returns nullptr, and library_error()
// returns the reason. find_symbol() returns nullptr for a symbol that the library does not have.
[[nodiscard]] void* load_library(const std::filesystem::path& file);
[[nodiscard]] void* find_symbol(void* library, const char* name);
[[nodiscard]] std::string library_error();

}  // namespace ninebit::posix
