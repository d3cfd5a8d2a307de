// `ninebit verify` of what a pack's runner wrote: which groups differ, and which mistake explains that.
#pragma once

#include <string>

#include "src/tools/input/program.h"

namespace ninebit::tools {

struct VectorResultsFlags {
  const CommonFlags* common = nullptr;
  bool profile_given = false;  // whether --profile is on the command line; else the pack says it
  std::string results;         // the runner's file
  std::string pack;            // vectors.txt or its folder; empty: vectors.txt beside the results
  int most = 20;               // fragments to list
};

// Whether a file begins as a runner's results do. False if it is not a regular file or cannot be read.
[[nodiscard]] bool begins_as_vector_results(const std::string& file);

// Prints the verdict. Returns the exit code.
[[nodiscard]] int verify_vector_results(const VectorResultsFlags& flags);

}  // namespace ninebit::tools
