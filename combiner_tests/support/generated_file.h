// Files of the repository that a script has made.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

#include "combiner_tests/support/temp_folder.h"

namespace ninebit::test {

// Runs `script` with `arguments` by Python: it must print what the file holds.
inline void expect_makes(const std::string& script, const std::string& arguments, const std::string& file) {
  const std::string command = "/usr/bin/python3 '" + script + "' --stdout " + arguments;
  std::FILE* const pipe = popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string made;
  std::array<char, 4096> part{};
  for (std::size_t size = 0; (size = std::fread(part.data(), 1, part.size(), pipe)) > 0;) {
    made.append(part.data(), size);
  }
  ASSERT_EQ(pclose(pipe), 0) << command;
  EXPECT_GT(made.size(), 10000U);
  EXPECT_TRUE(made == read_bytes(file)) << "run " << script;
}

}  // namespace ninebit::test
