// `ninebit bench combiner|raster|frame|effect`: measures the speed of each part on this machine.
#include "src/tools/bench/bench.h"

#include "src/system/parallel/parallel_loop.h"
#include "src/tools/common/flag_values.h"

namespace ninebit::tools {

void add_bench_flags(CLI::App& verb, BenchFlags& flags) {
  add_common_flags(verb, flags.common);
  verb.add_option("--seconds", flags.seconds, "Time to measure each row")
      ->capture_default_str()
      ->check(real_in_range(0.001, 3600.0));
  verb.add_flag("--quick", flags.quick, "Run everything briefly; the numbers are not meaningful");
}

int thread_count(const CommonFlags& flags) {
  return flags.threads > 0 ? flags.threads : static_cast<int>(max_threads());
}

std::vector<int> one_and_all_threads(const CommonFlags& flags) {
  const int all = thread_count(flags);
  return all == 1 ? std::vector{1} : std::vector{1, all};
}

void add_bench(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("bench", "Measure the speed of the combiners, the rasterizer, a whole frame or effects");
  verb->require_subcommand(1);
  verb->footer("Example: ninebit bench combiner\nRun `ninebit bench BENCHMARK --help` for the flags of a benchmark.");
  add_bench_combiner(*verb, exit_code);
  add_bench_raster(*verb, exit_code);
  add_bench_frame(*verb, exit_code);
  add_bench_effect(*verb, exit_code);
}

}  // namespace ninebit::tools
