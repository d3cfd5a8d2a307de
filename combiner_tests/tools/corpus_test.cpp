// The fuzzer's corpus of tables for `eval`, replayed without libFuzzer.
#include "combiner_tests/fuzz/corpus.h"

#include <gtest/gtest.h>

#include "ninebit/numerics/hardware_profile.h"
#include "src/tools/input/eval_table.h"

namespace ninebit::fuzz {
namespace {

TEST(Corpus, Csv) {
  // A header that is good, whatever the rows are.
  replay("csv", check_csv, [](std::string_view text) {
    return tools::read_header({text.substr(0, text.find('\n')), 1}, "", profiles::nv2a).ok();
  });
}

}  // namespace
}  // namespace ninebit::fuzz
