// Small functions of every idiom of C: each is read as a compiler runs it, or refused; never otherwise.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "combiner_tests/support/temp_folder.h"
#include "ninebit/language/source_code.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

const std::string kFolder = NINEBIT_SOURCE_DIR "/combiner_tests/language/idioms/";

TEST(SourceIdioms, AreRightOrRefused) {
  std::istringstream table(test::read_bytes(kFolder + "expected.csv"));
  int right = 0, all = 0;
  for (std::string line; std::getline(table, line);) {
    if (line.empty() || line[0] == '#' || line.starts_with("file,")) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::string name;
    ColorF expected{};
    words >> name >> expected[0] >> expected[1] >> expected[2] >> expected[3];
    ASSERT_TRUE(words) << line;
    ++all;
    const std::string text = test::read_bytes(kFolder + name);
    const auto found = parse_source_code({text, name}, {}, profiles::nv2a);
    if (!found) continue;
    ++right;
    // OpenGL clamps.
    for (float& channel : expected) channel = std::clamp(channel, 0.0F, 1.0F);
    EXPECT_EQ(found->constant0, expected) << text;
  }
  EXPECT_EQ(all, 45);
  EXPECT_GE(right, 45);
}

}  // namespace
}  // namespace ninebit
