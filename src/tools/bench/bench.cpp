// `ninebit bench combiner|raster|frame|effect`: measures the speed of each part on this machine.
#include "src/tools/bench/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/language/gl_calls.h"
#include "src/bench/combiner_rate.h"
#include "src/bench/programs.h"
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

void add_target_flag(CLI::App& verb, BenchFlags& flags) {
  verb.add_option("--target", flags.target, "SIMD target to draw on (default: the best of this processor)")
      ->check(CLI::IsMember(bench::simd_target_names()));
}

void add_bench(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "bench", "Measure the speed of the combiners, the rasterizer, a whole frame, programs or effects");
  verb->require_subcommand(1);
  verb->footer("Example: ninebit bench combiner\nRun `ninebit bench BENCHMARK --help` for the flags of a benchmark.");
  add_bench_combiner(*verb, exit_code);
  add_bench_raster(*verb, exit_code);
  add_bench_frame(*verb, exit_code);
  add_bench_draw(*verb, exit_code);
  add_bench_effect(*verb, exit_code);
}

// `ninebit bench combiner`: fragments per second, by program and engine.

namespace {

struct CombinerFlags {
  BenchFlags bench;
  bool every_target = false;
  std::string print;
};

struct CombinerRow {
  std::string program, engine, target, profile;
  int threads = 1;
  double mpixels_per_s = 0.0;
};

// The rate of a program and engine on one thread, on the first target.
double rate_of(const std::vector<CombinerRow>& rows, std::string_view program, bench::Engine engine) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const CombinerRow& r) {
    return r.program == program && r.engine == name_of(engine) && r.threads == 1;
  });
  return row->mpixels_per_s;
}

// Measures all rows of one program; returns false after an interrupt.
bool measure(const CombinerFlags& flags, const bench::MeasuredProgram& measured, double done, ProgressLine& line,
             std::vector<CombinerRow>& rows) {
  const Program program = normalize(measured.state, measured.profile);
  std::vector<std::string> targets = bench::simd_target_names();
  if (!flags.every_target) targets.resize(1);
  for (const bench::Engine engine : bench::kEngines) {
    for (const std::string& target : targets) {
      const bool simd = engine == bench::Engine::simd;
      if (!simd && target != targets[0]) continue;
      const bench::OnSimdTarget on(target);
      for (const int threads : one_and_all_threads(flags.bench.common)) {
        if (!line.step(fmt::format("{}, {}", measured.name, name_of(engine)), done)) return false;
        rows.push_back({std::string(measured.name), std::string(name_of(engine)), simd ? target : "scalar",
                        std::string(measured.profile.name), threads,
                        bench::combiner_rate(program, engine, threads, flags.bench.time_limit())});
      }
    }
  }
  return true;
}

std::string table(const std::vector<CombinerRow>& rows, const Json& ratio, double read_rate) {
  std::string text =
      fmt::format("{:<8} {:<13} {:<10} {:>7} {:>12}\n", "program", "engine", "target", "threads", "Mpixel/s");
  for (const CombinerRow& r : rows) {
    text +=
        fmt::format("{:<8} {:<13} {:<10} {:>7} {:>12.1f}\n", r.program, r.engine, r.target, r.threads, r.mpixels_per_s);
  }
  for (const auto& [program, value] : ratio.items()) {
    text += fmt::format("{}: simd is {:.0f} times as fast as scalar-float, one thread each\n", program,
                        value.get<double>());
  }
  return text + fmt::format("memory: one thread reads {:.1f} GB/s\n", read_rate);
}

int bench_combiner(const CombinerFlags& flags) {
  const auto programs = bench::measured_programs(profile_of(flags.bench.common));
  if (!programs) return report(programs.error());
  if (!flags.print.empty()) {
    for (const bench::MeasuredProgram& p : *programs) {
      if (p.name == flags.print) return answer(print_gl_calls(p.state, p.profile).value());
    }
  }
  std::optional<ProgressLine> line(std::in_place, flags.bench.common.quiet);
  std::vector<CombinerRow> rows;
  Json ratio = Json::object();
  for (std::size_t i = 0; i < programs->size(); ++i) {
    const bench::MeasuredProgram& program = programs->at(i);
    if (!measure(flags, program, static_cast<double>(i) / static_cast<double>(programs->size()), *line, rows)) {
      return line.reset(), report({.message = "interrupted", .fault = Fault::cancelled});
    }
    ratio[std::string(program.name)] =
        rate_of(rows, program.name, bench::Engine::simd) / rate_of(rows, program.name, bench::Engine::scalar_float);
  }
  constexpr std::size_t kMebi = 1 << 20;
  const double read_rate = bench::read_rate((flags.bench.quick ? 16 : 256) * kMebi, flags.bench.time_limit());
  line.reset();
  if (!flags.bench.common.json) return answer(table(rows, ratio, read_rate));
  Json list = Json::array();
  for (const CombinerRow& r : rows) {
    list.push_back({{"program", r.program},
                    {"engine", r.engine},
                    {"target", r.target},
                    {"threads", r.threads},
                    {"batch", kBatchSize},
                    {"mpixels_per_s", r.mpixels_per_s},
                    {"profile", r.profile}});
  }
  const Json out{{"command", "bench combiner"},
                 {"version", NINEBIT_VERSION},
                 {"profile", flags.bench.common.profile},
                 {"rows", std::move(list)},
                 {"ratio", ratio},
                 {"memory_read_gb_per_s", read_rate}};
  return answer(out);
}

}  // namespace

void add_bench_combiner(CLI::App& bench, int& exit_code) {
  CLI::App* verb = bench.add_subcommand("combiner", "Measure fragments per second, by program and engine");
  verb->footer(
      "Examples:\n"
      "  ninebit bench combiner --threads 2\n"
      "  ninebit bench combiner --every-target --json\n"
      "  ninebit bench combiner --print heavy > heavy.gl");
  auto flags = std::make_shared<CombinerFlags>();
  flags->bench.seconds = 0.25;
  add_bench_flags(*verb, flags->bench);
  verb->add_flag("--every-target", flags->every_target,
                 "Measure every SIMD target of this processor, not only the best");
  verb->add_option("--print", flags->print, "Print a measured program as GL calls and exit")
      ->check(CLI::IsMember({"index", "heavy", "eight", "default"}));
  verb->callback([flags, &exit_code] { exit_code = bench_combiner(*flags); });
}

}  // namespace ninebit::tools
