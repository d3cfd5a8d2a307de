// A fuzzer: this source is compiled once for each check of checks.h, NINEBIT_FUZZ_CHECK.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "combiner_tests/fuzz/checks.h"

namespace {

// Seconds of processor time: libFuzzer's own limit counts those that go by, and a busy machine has several for one of
// ours. Where fifteen fuzzers share two cores, processor time, too, is more than twice that of one alone.
constexpr double kMostSeconds = 20;

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const double begin = processor_seconds();
  std::string wrong = ninebit::fuzz::NINEBIT_FUZZ_CHECK({reinterpret_cast<const char*>(data), size});
  const double seconds = processor_seconds() - begin;
  if (wrong.empty() && seconds > kMostSeconds) wrong = "takes " + std::to_string(seconds) + " s of processor time";
  if (wrong.empty()) return 0;
  std::fprintf(stderr, "%s\n", wrong.c_str());
  std::abort();
}
