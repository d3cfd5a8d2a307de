// `ninebit bench frame`: the time of a frame of index cube shadows and of its five passes.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/bench/generated_scene.h"
#include "src/bench/llvmpipe_frame.h"
#include "src/bench/timing.h"
#include "src/shadow/index_cube/index_cube_renderer.h"
#include "src/tools/bench/bench.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/common/technique_flags.h"

namespace ninebit::tools {
namespace {

struct FrameFlags {
  BenchFlags bench;
  SceneFlags scene;
  std::uint32_t triangles = 100'000;
  std::string rival;
};

constexpr std::size_t kFewestFrames = 3;

// Milliseconds of each frame and of each of its passes.
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

// Draws frames for `seconds`, after a first frame that is not counted.
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

// The same for the rival; its last picture is then compared with ours.
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

// The measured objects: a scene, its renderer, and the rival that --rival names.
struct FrameBench {
  RenderSettings settings;
  int threads = 1;
  std::optional<Scene> scene{};
  std::optional<IndexCubeRenderer> renderer{};
  double setup_ms = 0.0;
  std::unique_ptr<bench::LlvmpipeFrame> rival{};  // nullptr: none
};

// Loads or generates the scene and sets up its renderer.
Status set_up(const FrameFlags& flags, FrameBench& frame) {
  auto scene = flags.scene.file.empty()
                   ? complete_scene_of(flags.scene, frame.settings, bench::generated_scene(flags.triangles))
                   : load_scene(flags.scene, frame.settings);
  if (!scene) return scene.error();
  frame.scene.emplace(std::move(scene).value());
  const auto start = bench::Clock::now();
  auto renderer = IndexCubeRenderer::make(*frame.scene, frame.settings);
  if (!renderer) return renderer.error();
  frame.setup_ms = 1e3 * bench::seconds_since(start);
  frame.renderer.emplace(std::move(renderer).value());
  return {};
}

// The median of each pass.
Json passes_json(const FrameTimes& times) {
  return {{"maps", bench::spread_of(times.maps).median},
          {"depth", bench::spread_of(times.depth).median},
          {"compare", bench::spread_of(times.compare).median},
          {"lit", bench::spread_of(times.lit).median},
          {"shadow", bench::spread_of(times.shadow).median}};
}

std::string text_of(const FrameBench& frame, const FrameTimes& times, const RivalTimes& rival) {
  const RenderSettings& settings = frame.settings;
  const bench::Spread total = bench::spread_of(times.total);
  std::string text = fmt::format("{}: {} triangles, {}x{}, six faces of {} x {}, {} threads, {} frames\n",
                                 frame.scene->name, frame.scene->triangles.size(), settings.width, settings.height,
                                 settings.map_size, settings.map_size, frame.threads, times.total.size());
  text += fmt::format("{:.2f} ms per frame (median; {:.2f} to {:.2f})\n", total.median, total.min, total.max);
  const Json passes = passes_json(times);
  for (const auto& [name, ms] : passes.items()) text += fmt::format("  {:<8} {:9.2f} ms\n", name, ms.get<double>());
  if (!frame.rival) return text;
  const bench::Spread theirs = bench::spread_of(rival.total);
  return text + fmt::format(
                    "{}: {:.2f} ms per frame ({:.2f} to {:.2f}), {:.2f} times ours; {} of {} shadow pixels "
                    "differ\n",
                    rival.renderer, theirs.median, theirs.min, theirs.max, theirs.median / total.median,
                    rival.shadow_pixels_that_differ, frame.renderer->rendering().frame.stencil().size());
}

Json json_of(const FrameFlags& flags, const FrameBench& frame, const FrameTimes& times, const RivalTimes& rival) {
  const bench::Spread total = bench::spread_of(times.total);
  Json out{{"command", "bench frame"},
           {"version", NINEBIT_VERSION},
           {"profile", flags.bench.common.profile},
           {"scene", flags.scene.file.empty() ? "generated" : flags.scene.file},
           {"triangles", frame.scene->triangles.size()},
           {"threads", frame.threads},
           {"size", {frame.settings.width, frame.settings.height}},
           {"map_size", frame.settings.map_size},
           {"ms_per_frame", json_of(total)},
           {"passes", passes_json(times)},
           {"frames", times.total.size()},
           {"setup_ms", frame.setup_ms}};
  if (!frame.rival) return out;
  const bench::Spread theirs = bench::spread_of(rival.total);
  out["rival"] = {{"name", flags.rival},
                  {"renderer", rival.renderer},
                  {"threads", frame.threads},
                  {"ms_per_frame", json_of(theirs)},
                  {"ratio", theirs.median / total.median},
                  {"shadow_pixels_that_differ", rival.shadow_pixels_that_differ}};
  return out;
}

int bench_frame(const FrameFlags& flags) {
  const CommonFlags& common = flags.bench.common;
  const ThreadLimit limit(common.threads);
  const OnGivenTarget on(flags.bench);
  FrameBench frame{.settings = settings_of(flags.scene, common), .threads = thread_count(common)};
  std::optional<ProgressLine> line(std::in_place, common.quiet);
  line->step("loading", 0.0);
  if (Status ready = set_up(flags, frame); !ready) return line.reset(), report(ready.error());
  // Created before measuring, so that a machine without the rival reports it at once.
  if (!flags.rival.empty()) {
    auto made = bench::LlvmpipeFrame::make(*frame.scene, frame.settings, *frame.renderer, frame.threads);
    if (!made) {
      line.reset();
      say_error(fmt::format("--rival {} is not available: {}", flags.rival, made.error().text()));
      return kWrongUsage;
    }
    frame.rival = std::move(*made);
  }
  FrameTimes times;
  RivalTimes rival;
  const double seconds = flags.bench.time_limit();
  Status done = measure(*frame.renderer, seconds, *line, times);
  if (done && frame.rival) done = measure_rival(*frame.rival, frame.renderer->rendering(), seconds, *line, rival);
  line.reset();
  if (!done) return report(done.error());
  warn_of_unused_order(frame.settings, frame.renderer->rendering().index_order);
  return common.json ? answer(json_of(flags, frame, times, rival)) : answer(text_of(frame, times, rival));
}

}  // namespace

void add_bench_frame(CLI::App& bench, int& exit_code) {
  CLI::App* verb = bench.add_subcommand("frame", "Measure the time of a frame of index cube shadows and of its passes");
  verb->footer(
      "Examples:\n"
      "  ninebit bench frame scenes/index_room.gltf\n"
      "  ninebit bench frame --triangles 1000000 --rival llvmpipe --json");
  auto flags = std::make_shared<FrameFlags>();
  add_bench_flags(*verb, flags->bench);
  CLI::Option* file = add_scene_file(*verb, "scene", flags->scene);
  verb->add_option("--triangles", flags->triangles, "Without a scene: generate one with at most this many triangles")
      ->capture_default_str()
      ->check(whole_in_range(bench::kFewestTriangles, bench::kMostTriangles))
      ->excludes(file);
  CLI::Option* rival = verb->add_option("--rival", flags->rival,
                                        "Also draw the frame with Mesa's llvmpipe, with the same number of threads")
                           ->check(CLI::IsMember({"llvmpipe"}));
  add_target_flag(*verb, flags->bench);
  add_scene_flags(*verb, flags->scene);
  // The rival's shaders do not implement these.
  for (const char* flag : {"--light-facing", "--index-format", "--index-order", "--index-scales", "--style"}) {
    rival->excludes(verb->get_option(flag));
  }
  verb->callback([flags, &exit_code] { exit_code = bench_frame(*flags); });
}

}  // namespace ninebit::tools
