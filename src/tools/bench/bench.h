// Shared by the parts of `ninebit bench`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/bench/combiner_rate.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

struct BenchFlags {
  CommonFlags common;
  double seconds = 1.0;
  bool quick = false;
  std::string target{};  // a SIMD target; empty: the best of the processor

  // Seconds, for each measured row.
  [[nodiscard]] double time_limit() const { return quick ? 0.01 : seconds; }
};

// Adds the common flags, --seconds and --quick.
void add_bench_flags(CLI::App& verb, BenchFlags& flags);
// Adds --target.
void add_target_flag(CLI::App& verb, BenchFlags& flags);

// The rasterizer runs on --target while it lives, if that was given.
class OnGivenTarget {
 public:
  explicit OnGivenTarget(const BenchFlags& flags) {
    if (!flags.target.empty()) on_.emplace(flags.target);
  }

 private:
  std::optional<bench::OnSimdTarget> on_{};
};

// The number of threads: --threads, or all of the machine if it is 0.
[[nodiscard]] int thread_count(const CommonFlags& flags);

// {1} if thread_count is 1, else {1, thread_count}.
[[nodiscard]] std::vector<int> one_and_all_threads(const CommonFlags& flags);

void add_bench_combiner(CLI::App& bench, int& exit_code);
void add_bench_raster(CLI::App& bench, int& exit_code);
void add_bench_frame(CLI::App& bench, int& exit_code);
void add_bench_draw(CLI::App& bench, int& exit_code);
void add_bench_effect(CLI::App& bench, int& exit_code);

}  // namespace ninebit::tools
