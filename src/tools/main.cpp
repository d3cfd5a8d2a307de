// The ninebit program. Each verb is a file of its own; verbs.cpp dispatches to them.
#include <cstdint>
#include <new>

#include "src/system/memory.h"
#include "src/system/process.h"
#include "src/tools/common/fault_answer.h"
#include "src/tools/input/program.h"
#include "src/tools/verbs.h"

// When libhwy is loaded, it measures the clock of its benchmarks for 3 ms, half of a short run, by this function. Its
// own is replaced by the program's, because no benchmark of Highway runs here. Where Highway is linked otherwise, or
// lacks the function, nothing calls this one.
namespace hwy::platform {
std::uint64_t TimerResolution();
std::uint64_t TimerResolution() {
  return 1;
}
}  // namespace hwy::platform

int main(int argc, char** argv) {
  using namespace ninebit::tools;
  ninebit::posix::guard_streams();
  ninebit::posix::keep_memory_for_errors();
  int exit_code = kOutOfMemory;
  try {
    exit_code = run_verb(argc, argv);
    answer_with_faults(argc, argv, exit_code);
  } catch (const std::bad_alloc&) {  // even for the message
  }
  return exit_code;
}
