// What the three parts of `ninebit bench` share.
#pragma once

#include <string>

#include "src/tools/input/program.h"

namespace ninebit::tools {

// How long to measure.
struct BenchFlags {
  CommonFlags common;
  double seconds = 1.0;
  bool quick = false;

  // For each thing that is measured.
  [[nodiscard]] double time_limit() const { return quick ? 0.01 : seconds; }
};

// Adds the common flags, --seconds and --quick.
void add_bench_flags(CLI::App& verb, BenchFlags& flags);

// The threads that --threads stands for.
[[nodiscard]] int thread_count(const CommonFlags& flags);

// "1" where only one thread is to be measured, else 1 and their number.
[[nodiscard]] std::vector<int> one_and_all_threads(const CommonFlags& flags);

void add_bench_combiner(CLI::App& bench, int& exit_code);
void add_bench_raster(CLI::App& bench, int& exit_code);
void add_bench_frame(CLI::App& bench, int& exit_code);

}  // namespace ninebit::tools
