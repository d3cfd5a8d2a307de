// Every technique in processes of their own: the same hashes in each.
#include <gtest/gtest.h>

#include <cstdlib>
#include <utility>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

const std::vector<std::pair<std::string, Words>> kTechniques{
    {"index-cube", {}},
    {"depth-cube", {}},
    {"shadow-map", {}},
    {"shadow-volume", {}},
    {"reflective", {"--light-type", "directional", "--samples", "10"}},
    {"light-cookie", {"--cookie", NINEBIT_SOURCE_DIR "/scenes/cookies/labels.dds"}}};

// While it lives, memory that a child of glibc allocates holds the complement of this byte.
class ChildMemoryHolds {
 public:
  explicit ChildMemoryHolds(int byte) {
    ::setenv("GLIBC_TUNABLES", ("glibc.malloc.perturb=" + std::to_string(byte)).c_str(), 1);
  }
  ~ChildMemoryHolds() { ::unsetenv("GLIBC_TUNABLES"); }
  ChildMemoryHolds(const ChildMemoryHolds&) = delete;
  ChildMemoryHolds& operator=(const ChildMemoryHolds&) = delete;
};

// What a process does with any memory, format, size and number of threads is asked in one process by
// combiner_tests/shadow/technique_table_test.cpp.
TEST(TechniqueTable, ProcessesPrintTheSameHashes) {
  const TempFolder folder;
  for (const auto& [technique, flags] : kTechniques) {
    SCOPED_TRACE(technique);
    const Words words = small_render(
        kRoom, folder / "out",
        Words{"--size", "150x70", "--technique", technique, "--depth-stencil", "d15s1", "--json", "--quiet"} + flags);
    std::vector<Json> answers;
    for (const auto& [threads, memory] : {std::pair("1", 0x5A), std::pair("3", 0xA5)}) {
      const ChildMemoryHolds holds(memory);
      answers.push_back(json_of(ninebit(words + Words{"--threads", threads})));
      ASSERT_TRUE(answers.back().is_object());
    }
    EXPECT_EQ(answers[1].at("hash"), answers[0].at("hash"));
    EXPECT_EQ(answers[1].at("pixels"), answers[0].at("pixels"));
  }
}

TEST(TechniqueTable, FormatsThatATechniqueCannotUseAreRefused) {
  const TempFolder folder;
  expect_error(ninebit(small_render(kRoom, folder / "out", {"--depth-stencil", "d16"})), 3,
               {"d16 has no stencil bits", "expected one of d24s8, d15s1, f24s8, w24s8, wf24s8"});
  expect_error(
      ninebit(small_render(kRoom, folder / "out", {"--technique", "shadow-volume", "--depth-stencil", "w24s8"})), 3,
      {"shadow volumes reach infinity", "the W buffer w24s8 cannot hold them"});
}

}  // namespace
}  // namespace tools_test
