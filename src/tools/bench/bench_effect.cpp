// `ninebit bench draw` and `ninebit bench effect`: pixels per second of programs of combiners and of effects of the
// gallery on a rectangle, beside the same in GLSL on llvmpipe.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>

#include "src/bench/combiner_rate.h"
#include "src/bench/effect_workloads.h"
#include "src/bench/llvmpipe_effect.h"
#include "src/bench/timing.h"
#include "src/tools/bench/bench.h"
#include "src/tools/common/scene_flags.h"

namespace ninebit::tools {
namespace {

constexpr std::size_t kFewestPictures = 3;

struct EffectFlags {
  BenchFlags bench;
  std::string rival;
};

// One effect: milliseconds of its pictures, and of the rival's, drawn in turn.
struct EffectRow {
  std::string name;
  bench::Spread ours{};
  std::optional<bench::Spread> rival{};
  int largest_difference = 0;  // between the last pictures, in a component
};

int largest_difference(const Surface& ours, const std::vector<std::uint8_t>& theirs) {
  int largest = 0;
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    const int byte = ours.color(static_cast<int>(i % 4))[i / 4];
    largest = std::max(largest, std::abs(byte - int{theirs[i]}));
  }
  return largest;
}

Result<EffectRow> measure_effect(const bench::EffectWorkload& workload, const EffectFlags& flags,
                                 bench::LlvmpipeEffect* rival, ProgressLine& line) {
  auto renderer = EffectRenderer::make(workload.effect, workload.profile, bench::workload_readers());
  if (!renderer) return renderer.error();
  if (rival != nullptr) {
    if (Status ready = rival->prepare(workload); !ready) return ready.error();
    rival->draw();
  }
  if (Status drawn = renderer->draw(); !drawn) return drawn.error();
  std::vector<double> ours, theirs;
  const auto start = bench::Clock::now();
  while (ours.size() < kFewestPictures || bench::seconds_since(start) < flags.bench.time_limit()) {
    if (!line.step(workload.name, 0.0)) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    Status drawn;
    ours.push_back(1e3 * bench::seconds_of([&] { drawn = renderer->draw(); }));
    if (!drawn) return drawn.error();
    if (rival != nullptr) theirs.push_back(1e3 * bench::seconds_of([&] { rival->draw(); }));
  }
  EffectRow row{.name = workload.name, .ours = bench::spread_of(std::move(ours))};
  if (rival == nullptr) return row;
  row.rival = bench::spread_of(std::move(theirs));
  const auto picture = rival->picture();
  if (!picture) return picture.error();
  row.largest_difference = largest_difference(renderer->picture(), *picture);
  return row;
}

double mpixels(const bench::Spread& spread, double pixels) {
  return pixels / spread.median / 1e3;
}

// The thing that a verb measures: "effect" or "program".
struct Measured {
  std::string verb, what;
  std::vector<bench::EffectWorkload> workloads{};
  int side = 0;
};

std::string effects_text(const Measured& measured, const std::vector<EffectRow>& rows, int threads,
                         const std::string& renderer) {
  const int side = measured.side;
  const double pixels = static_cast<double>(side) * side;
  std::string text = fmt::format("{0} x {0} pixels, {1} thread{2}{3}\n", side, threads, threads == 1 ? "" : "s",
                                 renderer.empty() ? "" : "; rival: " + renderer);
  text += fmt::format("{:<17} {:>9} {:>9} {:>12} {:>7} {:>10}\n", measured.what, "ms", "Mpixel/s", "rival's", "ratio",
                      "difference");
  for (const EffectRow& row : rows) {
    text += fmt::format("{:<17} {:>9.3f} {:>9.1f}", row.name, row.ours.median, mpixels(row.ours, pixels));
    if (row.rival) {
      text += fmt::format(" {:>12.1f} {:>7.2f} {:>10}", mpixels(*row.rival, pixels),
                          row.rival->median / row.ours.median, row.largest_difference);
    }
    text += '\n';
  }
  return text;
}

Json spread_json(const bench::Spread& spread) {
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

Json effects_json(const EffectFlags& flags, const Measured& measured, const std::vector<EffectRow>& rows,
                  const std::string& renderer) {
  const int side = measured.side;
  const double pixels = static_cast<double>(side) * side;
  Json list = Json::array();
  for (const EffectRow& row : rows) {
    Json one{{measured.what, row.name}, {"ms", spread_json(row.ours)}, {"mpixels_per_s", mpixels(row.ours, pixels)}};
    if (row.rival) {
      one["rival"] = {{"ms", spread_json(*row.rival)},
                      {"mpixels_per_s", mpixels(*row.rival, pixels)},
                      {"ratio", row.rival->median / row.ours.median},
                      {"largest_difference", row.largest_difference}};
    }
    list.push_back(std::move(one));
  }
  Json out{{"command", "bench " + measured.verb},         {"version", NINEBIT_VERSION},
           {"profile", flags.bench.common.profile},       {"size", {side, side}},
           {"threads", thread_count(flags.bench.common)}, {"rows", std::move(list)}};
  if (!renderer.empty()) out["rival"] = {{"name", flags.rival}, {"renderer", renderer}};
  return out;
}

int bench_rectangles(const EffectFlags& flags, const Measured& measured) {
  const CommonFlags& common = flags.bench.common;
  const ThreadLimit limit(common.threads);
  std::unique_ptr<bench::LlvmpipeEffect> rival;
  if (!flags.rival.empty()) {
    auto made = bench::LlvmpipeEffect::make(thread_count(common));
    if (!made) {
      say_error(fmt::format("--rival {} is not available: {}", flags.rival, made.error().text()));
      return kWrongUsage;
    }
    rival = std::move(*made);
  }
  const OnGivenTarget on(flags.bench);
  std::optional<ProgressLine> line(std::in_place, common.quiet);
  std::vector<EffectRow> rows;
  for (const bench::EffectWorkload& workload : measured.workloads) {
    auto row = measure_effect(workload, flags, rival.get(), *line);
    if (!row) return line.reset(), report(row.error());
    rows.push_back(std::move(*row));
  }
  line.reset();
  const std::string renderer = rival ? rival->renderer() : "";
  if (common.json) return answer(effects_json(flags, measured, rows, renderer));
  return answer(effects_text(measured, rows, thread_count(common), renderer));
}

int side_of(const EffectFlags& flags) {
  return flags.bench.quick ? 64 : 1024;
}

int bench_effect(const EffectFlags& flags) {
  const int side = side_of(flags);
  return bench_rectangles(
      flags, {"effect", "effect", bench::effect_workloads(side, side, profile_of(flags.bench.common)), side});
}

int bench_draw(const EffectFlags& flags) {
  const int side = side_of(flags);
  auto workloads = bench::program_workloads(side, side, profile_of(flags.bench.common));
  if (!workloads) return report(workloads.error());
  return bench_rectangles(flags, {"draw", "program", std::move(*workloads), side});
}

void add_rectangles(CLI::App& verb, int (*measure)(const EffectFlags&), int& exit_code) {
  auto flags = std::make_shared<EffectFlags>();
  add_bench_flags(verb, flags->bench);
  verb.add_option("--rival", flags->rival,
                  "Also draw them in GLSL with Mesa's llvmpipe, with the same number of threads")
      ->check(CLI::IsMember({"llvmpipe"}));
  add_target_flag(verb, flags->bench);
  verb.callback([=, &exit_code] { exit_code = measure(*flags); });
}

}  // namespace

void add_bench_effect(CLI::App& bench, int& exit_code) {
  CLI::App* verb =
      bench.add_subcommand("effect", "Measure effects of the gallery on a rectangle, in pixels per second");
  verb->footer(
      "Examples:\n"
      "  ninebit bench effect --rival llvmpipe\n"
      "  ninebit bench effect --target AVX2");
  add_rectangles(*verb, &bench_effect, exit_code);
}

void add_bench_draw(CLI::App& bench, int& exit_code) {
  CLI::App* verb =
      bench.add_subcommand("draw", "Measure programs of combiners on a textured rectangle, in pixels per second");
  verb->footer(
      "Example: ninebit bench draw --rival llvmpipe\n"
      "The rival runs the program as `ninebit convert --to glsl` prints it.");
  add_rectangles(*verb, &bench_draw, exit_code);
}

}  // namespace ninebit::tools
