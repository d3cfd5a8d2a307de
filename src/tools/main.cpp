// The ninebit program. Each verb is a file of its own; verbs.cpp dispatches to them.
#include <new>

#include "src/system/process.h"
#include "src/tools/common/usage.h"
#include "src/tools/input/program.h"
#include "src/tools/verbs.h"

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
