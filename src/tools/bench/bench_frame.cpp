// `ninebit bench frame`: the five passes of index cube shadows, frame after frame.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "src/bench/generated_scene.h"
#include "src/bench/llvmpipe_frame.h"
#include "src/bench/timing.h"
#include "src/shadow/index_cube/index_cube_renderer.h"
#include "src/tools/bench/bench.h"
#include "src/tools/common/scene_flags.h"

namespace ninebit::tools {
namespace {

struct FrameFlags {
  BenchFlags bench;
  SceneFlags scene;
  std::uint32_t triangles = 100'000;
  std::string rival;
};

constexpr std::size_t kFewestFrames = 3;

// Milliseconds of each frame, and of each of its passes.
struct FrameTimes {
  std::vector<double> total, maps, depth, compare, lit, shadow;
};

Status draw_frame(IndexCubeRenderer& renderer, FrameTimes& times) {
  Status status;
  const double maps = 1e3 * bench::seconds_of([&] { status = renderer.draw_maps(); });
  if (!status) return status;
  const double camera = 1e3 * bench::seconds_of([&] { status = renderer.draw_camera(); });
  if (!status) return status;
  const PassTimes& pass = renderer.rendering().times;
  times.total.push_back(maps + camera);
  times.maps.push_back(maps);
  times.depth.push_back(pass.camera);
  times.compare.push_back(pass.compare);
  times.lit.push_back(pass.lit);
  times.shadow.push_back(pass.shadow);
  return {};
}

// Draws frames for that long, the first one, which is not counted, aside.
Status measure(IndexCubeRenderer& renderer, double seconds, ProgressLine& line, FrameTimes& times) {
  FrameTimes first;
  if (Status drawn = draw_frame(renderer, first); !drawn) return drawn;
  const auto start = bench::Clock::now();
  while (times.total.size() < kFewestFrames || bench::seconds_since(start) < seconds) {
    if (!line.step("frames", bench::seconds_since(start) / seconds)) {
      return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    }
    if (Status drawn = draw_frame(renderer, times); !drawn) return drawn;
  }
  return {};
}

struct RivalTimes {
  std::string renderer;
  std::vector<double> total;  // milliseconds of each frame
  std::uint64_t shadow_pixels_that_differ = 0;
};

// The same for the rival, whose last picture is then compared with ours.
Status measure_rival(bench::LlvmpipeFrame& rival, const Rendering& ours, double seconds, ProgressLine& line,
                     RivalTimes& times) {
  times.renderer = rival.renderer();
  rival.draw();
  const auto start = bench::Clock::now();
  while (times.total.size() < kFewestFrames || bench::seconds_since(start) < seconds) {
    if (!line.step("frames of the rival", bench::seconds_since(start) / seconds)) {
      return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    }
    times.total.push_back(1e3 * bench::seconds_of([&] { rival.draw(); }));
  }
  const auto stencil = rival.stencil();
  if (!stencil) return stencil.error();
  for (std::size_t i = 0; i < stencil->size(); ++i) {
    if (stencil->at(i) != ours.frame.stencil()[i]) ++times.shadow_pixels_that_differ;
  }
  return {};
}

Json json_of(const bench::Spread& spread) {
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

// Everything that one run of the verb measures.
struct FrameRun {
  RenderSettings settings;
  Scene scene;
  double setup_ms = 0.0;
  FrameTimes times;
  std::optional<RivalTimes> rival;  // with --rival
  std::size_t pixels = 0;
  int threads = 1;
  bool rival_is_missing = false;
};

struct PassTime {
  const char* name;
  double ms;  // the median
};

std::vector<PassTime> pass_times(const FrameTimes& times) {
  return {{"maps", bench::spread_of(times.maps).median},
          {"depth", bench::spread_of(times.depth).median},
          {"compare", bench::spread_of(times.compare).median},
          {"lit", bench::spread_of(times.lit).median},
          {"shadow", bench::spread_of(times.shadow).median}};
}

Status measure_frames(const FrameFlags& flags, FrameRun& run, ProgressLine& line) {
  line.step("loading", 0.0);
  auto scene = flags.scene.file.empty()
                   ? complete_scene_of(flags.scene, run.settings, bench::generated_scene(flags.triangles))
                   : load_scene(flags.scene, run.settings, flags.bench.common.quiet);
  if (!scene) return scene.error();
  run.scene = std::move(*scene);
  const auto start = bench::Clock::now();
  auto renderer = IndexCubeRenderer::make(run.scene, run.settings);
  if (!renderer) return renderer.error();
  run.setup_ms = 1e3 * bench::seconds_since(start);

  // Before the measurement: a machine without the rival must not cost the time of one.
  std::unique_ptr<bench::LlvmpipeFrame> rival;
  if (!flags.rival.empty()) {
    auto made = bench::LlvmpipeFrame::make(run.scene, run.settings, *renderer, run.threads);
    if (!made) {
      run.rival_is_missing = true;
      return Diagnostic{.message = fmt::format("--rival {} is not available: {}", flags.rival, made.error().text())};
    }
    rival = std::move(*made);
  }

  if (Status done = measure(*renderer, flags.bench.time_limit(), line, run.times); !done) return done;
  run.pixels = renderer->rendering().frame.stencil().size();
  if (!rival) return {};
  return measure_rival(*rival, renderer->rendering(), flags.bench.time_limit(), line, run.rival.emplace());
}

std::string text_of(const FrameRun& run) {
  const bench::Spread total = bench::spread_of(run.times.total);
  const int map_size = run.settings.map_size;
  std::string text = fmt::format("{}: {} triangles, {}x{}, six faces of {} x {}, {} threads, {} frames\n",
                                 run.scene.name, run.scene.triangles.size(), run.settings.width, run.settings.height,
                                 map_size, map_size, run.threads, run.times.total.size());
  text += fmt::format("{:.2f} ms a frame (median; {:.2f} to {:.2f})\n", total.median, total.min, total.max);
  for (const PassTime& pass : pass_times(run.times)) text += fmt::format("  {:<8} {:9.2f} ms\n", pass.name, pass.ms);
  if (run.rival) {
    const bench::Spread theirs = bench::spread_of(run.rival->total);
    text += fmt::format("{}: {:.2f} ms a frame ({:.2f} to {:.2f}), {:.2f} times ours; {} of {} shadow pixels differ\n",
                        run.rival->renderer, theirs.median, theirs.min, theirs.max, theirs.median / total.median,
                        run.rival->shadow_pixels_that_differ, run.pixels);
  }
  return text;
}

Json json_of(const FrameFlags& flags, const FrameRun& run) {
  const bench::Spread total = bench::spread_of(run.times.total);
  Json passes = Json::object();
  for (const PassTime& pass : pass_times(run.times)) passes[pass.name] = pass.ms;
  Json out{{"command", "bench frame"},
           {"version", NINEBIT_VERSION},
           {"profile", flags.bench.common.profile},
           {"scene", flags.scene.file.empty() ? "generated" : flags.scene.file},
           {"triangles", run.scene.triangles.size()},
           {"threads", run.threads},
           {"size", {run.settings.width, run.settings.height}},
           {"map_size", run.settings.map_size},
           {"ms_per_frame", json_of(total)},
           {"passes", std::move(passes)},
           {"frames", run.times.total.size()},
           {"setup_ms", run.setup_ms}};
  if (run.rival) {
    const bench::Spread theirs = bench::spread_of(run.rival->total);
    out["rival"] = {{"name", flags.rival},
                    {"renderer", run.rival->renderer},
                    {"threads", run.threads},
                    {"ms_per_frame", json_of(theirs)},
                    {"ratio", theirs.median / total.median},
                    {"shadow_pixels_that_differ", run.rival->shadow_pixels_that_differ}};
  }
  return out;
}

int bench_frame(const FrameFlags& flags) {
  const CommonFlags& common = flags.bench.common;
  const ThreadLimit limit(common.threads);
  FrameRun run;
  run.settings = settings_of(flags.scene, common);
  run.threads = thread_count(common);
  std::optional<ProgressLine> line(std::in_place, common.quiet);
  const Status done = measure_frames(flags, run, *line);
  line.reset();
  if (run.rival_is_missing) {
    say_error(done.error().message);
    return kWrongUsage;
  }
  if (!done) return report(done.error());
  return common.json ? answer(json_of(flags, run)) : answer(text_of(run));
}

}  // namespace

void add_bench_frame(CLI::App& bench, int& exit_code) {
  CLI::App* verb = bench.add_subcommand("frame", "Milliseconds a frame of index cube shadows");
  verb->footer(
      "Examples:\n"
      "  ninebit bench frame scenes/index_room.gltf\n"
      "  ninebit bench frame --triangles 1000000 --rival llvmpipe --json");
  auto flags = std::make_shared<FrameFlags>();
  add_bench_flags(*verb, flags->bench);
  CLI::Option* file = add_scene_file(*verb, "scene", flags->scene);
  verb->add_option("--triangles", flags->triangles, "Without a scene: a generated one of at most so many triangles")
      ->capture_default_str()
      ->check(CLI::Range(bench::kFewestTriangles, bench::kMostTriangles))
      ->excludes(file);
  CLI::Option* rival =
      verb->add_option("--rival", flags->rival, "Also draw the same frame by Mesa's llvmpipe, with as many threads")
          ->check(CLI::IsMember({"llvmpipe"}));
  add_scene_flags(*verb, flags->scene);
  // What the rival's shaders do not know.
  for (const char* flag : {"--light-facing", "--index-format", "--style"}) rival->excludes(verb->get_option(flag));
  verb->callback([flags, &exit_code] { exit_code = bench_frame(*flags); });
}

}  // namespace ninebit::tools
