// The fuzzer's corpus of parts, replayed without libFuzzer.
#include "combiner_tests/fuzz/corpus.h"

#include <gtest/gtest.h>

#include "combiner_tests/fuzz/memory_file.h"
#include "ninebit/study/study_part.h"

namespace ninebit::fuzz {
namespace {

TEST(Corpus, Part) {
  replay("part", check_part,
         [](std::string_view bytes) { return read_part(MemoryFile(with_hashes(bytes)).path()).ok(); });
}

}  // namespace
}  // namespace ninebit::fuzz
