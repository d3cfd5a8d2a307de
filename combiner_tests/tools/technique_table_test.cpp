// Every technique with every depth-stencil format in processes of their own: the same hashes in each.
#include <gtest/gtest.h>

#include <array>
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

// Two processes, of which neither the threads nor the memory that they find are the same.
constexpr std::array kProcesses{std::pair("1", 0x5A), std::pair("3", 0xA5)};

TEST(TechniqueTable, ProcessesPrintTheSameHashes) {
  const TempFolder folder;
  for (const auto& [technique, flags] : kTechniques) {
    for (const std::string format : {"d24s8", "d15s1", "f24s8", "w24s8"}) {
      SCOPED_TRACE(technique + ' ' + format);
      const Words words = small_render(
          kRoom, folder / "out",
          Words{"--size", "150x70", "--technique", technique, "--depth-stencil", format, "--json", "--quiet"} + flags);
      if (technique == "shadow-volume" && format == "w24s8") {
        expect_error(
            ninebit({"render", kRoom, "-o", folder / "out", "--technique", technique, "--depth-stencil", format}), 3,
            {"shadow volumes reach infinity", "the W buffer w24s8 cannot hold them"});
        continue;
      }
      std::vector<Json> answers;
      for (const auto& [threads, memory] : kProcesses) {
        const ChildMemoryHolds holds(memory);
        answers.push_back(json_of(ninebit(words + Words{"--threads", threads})));
        ASSERT_TRUE(answers.back().is_object());
      }
      EXPECT_EQ(answers[1].at("hash"), answers[0].at("hash"));
      EXPECT_EQ(answers[1].at("pixels"), answers[0].at("pixels"));
    }
    expect_error(
        ninebit(small_render(kRoom, folder / "out", Words{"--technique", technique, "--depth-stencil", "d16"} + flags)),
        3, {"d16 has no stencil bits", "expected one of d24s8, d15s1, f24s8, w24s8, wf24s8"});
  }
}

TEST(TechniqueTable, StudiesOfShadowsCountTheSamePixels) {
  for (const std::string technique : {"index-cube", "shadow-map"}) {
    std::vector<Json> rows;
    for (const auto& [threads, memory] : kProcesses) {
      const ChildMemoryHolds holds(memory);
      const Json answer =
          json_of(ninebit({"study", "shadows", kRoom, "--json", "--quiet", "--size", "80x60", "--technique", technique,
                           "--map-sizes", "32,64", "--depth-stencil", "d15s1", "--threads", threads}));
      ASSERT_TRUE(answer.is_object()) << technique;
      rows.push_back(answer.at("rows"));
      ASSERT_FALSE(rows.back().empty());
    }
    EXPECT_EQ(rows[1], rows[0]) << technique;
  }
}

}  // namespace
}  // namespace tools_test
