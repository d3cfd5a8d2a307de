// A fuzzer: this source is compiled once for each check of checks.h, NINEBIT_FUZZ_CHECK.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "combiner_tests/fuzz/checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string wrong = ninebit::fuzz::NINEBIT_FUZZ_CHECK({reinterpret_cast<const char*>(data), size});
  if (wrong.empty()) return 0;
  std::fprintf(stderr, "%s\n", wrong.c_str());
  std::abort();
}
