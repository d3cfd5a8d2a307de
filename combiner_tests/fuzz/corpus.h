// The kept corpora, for the tests that replay them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "combiner_tests/fuzz/checks.h"

namespace ninebit::fuzz {

// Every file of combiner_tests/fuzz/corpus/NAME goes through its check. Some must be accepted, and some not: else the
// corpus shows little.
inline void replay(const std::string& name, Check check, bool (*accepted)(std::string_view bytes)) {
  namespace fs = std::filesystem;
  int good = 0, bad = 0;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(NINEBIT_SOURCE_DIR "/combiner_tests/fuzz/corpus/" + name)) {
    std::ifstream in(entry.path(), std::ios::binary);
    ASSERT_TRUE(in) << entry.path();
    const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    EXPECT_EQ(check(bytes), "") << entry.path();
    ++(accepted(bytes) ? good : bad);
  }
  EXPECT_GE(good, 5);
  EXPECT_GE(bad, 5);
}

}  // namespace ninebit::fuzz
