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

int bench_frame(const FrameFlags& flags) {
  const CommonFlags& common = flags.bench.common;
  const ThreadLimit limit(common.threads);
  const RenderSettings settings = settings_of(flags.scene, common);
  std::optional<ProgressLine> line(std::in_place, common.quiet);
  line->step("loading", 0.0);
  const auto scene = flags.scene.file.empty()
                         ? complete_scene_of(flags.scene, settings, bench::generated_scene(flags.triangles))
                         : load_scene(flags.scene, settings, common.quiet);
  if (!scene) return line.reset(), report(scene.error());
  const auto start = bench::Clock::now();
  auto renderer = IndexCubeRenderer::make(*scene, settings);
  if (!renderer) return line.reset(), report(renderer.error());
  const double setup_ms = 1e3 * bench::seconds_since(start);

  // Before the work, so that a machine without it says so at once.
  std::unique_ptr<bench::LlvmpipeFrame> rival;
  if (!flags.rival.empty()) {
    auto made = bench::LlvmpipeFrame::make(*scene, settings, *renderer, thread_count(common));
    if (!made) {
      line.reset();
      say_error(fmt::format("--rival {} is not available: {}", flags.rival, made.error().text()));
      return kWrongUsage;
    }
    rival = std::move(*made);
  }

  FrameTimes times;
  if (Status done = measure(*renderer, flags.bench.time_limit(), *line, times); !done) {
    return line.reset(), report(done.error());
  }
  RivalTimes rival_times;
  if (rival) {
    const double seconds = flags.bench.time_limit();
    if (Status done = measure_rival(*rival, renderer->rendering(), seconds, *line, rival_times); !done) {
      return line.reset(), report(done.error());
    }
  }
  line.reset();

  const bench::Spread total = bench::spread_of(times.total);
  const Json passes{{"maps", bench::spread_of(times.maps).median},
                    {"depth", bench::spread_of(times.depth).median},
                    {"compare", bench::spread_of(times.compare).median},
                    {"lit", bench::spread_of(times.lit).median},
                    {"shadow", bench::spread_of(times.shadow).median}};
  const int threads = thread_count(common);
  if (!common.json) {
    std::string text = fmt::format("{}: {} triangles, {}x{}, six faces of {} x {}, {} threads, {} frames\n",
                                   scene->name, scene->triangles.size(), settings.width, settings.height,
                                   settings.map_size, settings.map_size, threads, times.total.size());
    text += fmt::format("{:.2f} ms a frame (median; {:.2f} to {:.2f})\n", total.median, total.min, total.max);
    for (const auto& [name, ms] : passes.items()) text += fmt::format("  {:<8} {:9.2f} ms\n", name, ms.get<double>());
    if (rival) {
      const bench::Spread theirs = bench::spread_of(rival_times.total);
      text +=
          fmt::format("{}: {:.2f} ms a frame ({:.2f} to {:.2f}), {:.2f} times ours; {} of {} shadow pixels differ\n",
                      rival_times.renderer, theirs.median, theirs.min, theirs.max, theirs.median / total.median,
                      rival_times.shadow_pixels_that_differ, renderer->rendering().frame.stencil().size());
    }
    return answer(text);
  }
  Json out{{"command", "bench frame"},
           {"version", NINEBIT_VERSION},
           {"profile", common.profile},
           {"scene", flags.scene.file.empty() ? "generated" : flags.scene.file},
           {"triangles", scene->triangles.size()},
           {"threads", threads},
           {"size", {settings.width, settings.height}},
           {"map_size", settings.map_size},
           {"ms_per_frame", json_of(total)},
           {"passes", passes},
           {"frames", times.total.size()},
           {"setup_ms", setup_ms}};
  if (rival) {
    const bench::Spread theirs = bench::spread_of(rival_times.total);
    out["rival"] = {{"name", flags.rival},
                    {"renderer", rival_times.renderer},
                    {"threads", threads},
                    {"ms_per_frame", json_of(theirs)},
                    {"ratio", theirs.median / total.median},
                    {"shadow_pixels_that_differ", rival_times.shadow_pixels_that_differ}};
  }
  return answer(out);
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
