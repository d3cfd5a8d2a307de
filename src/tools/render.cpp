// `ninebit render`: renders a scene with shadows by one of the techniques.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <utility>

#include "ninebit/shadow/pictures.h"
#include "src/tools/common/index_order.h"
#include "src/tools/common/pixel_flag.h"
#include "src/tools/common/scene_textures.h"
#include "src/tools/render/render_answer.h"

namespace ninebit::tools {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration d) {
  return std::chrono::duration<double, std::milli>(d).count();
}

// The settings of the flags. The Diagnostic is wrong usage.
Result<RenderSettings> checked_settings(const RenderFlags& flags) {
  RenderSettings settings = settings_of(flags.scene, flags.common);
  settings.evidence = flags.ground_truth;
  if (flags.pick.empty()) return settings;
  if (flags.scene.technique != "index-cube") {
    return Diagnostic{.message = fmt::format("--pick requires technique index-cube, not {}", flags.scene.technique)};
  }
  const auto pixel = window_pixel("--pick", flags.pick, settings);
  if (!pixel) return pixel.error();
  settings.pick = *pixel;
  return settings;
}

// Compares the rendering with the ground truth and adds the error picture; does nothing if no shadows were drawn.
Status judge(FinishedRender& done, const Progress& progress) {
  if (!done.rendering->evidence) return {};
  const auto rays = GroundTruthScene::make(*done.scene);
  if (!rays) return rays.error();
  auto truth = measure(*rays, done.settings, *done.rendering, progress);
  if (!truth) return truth.error();
  add_ground_truth(*done.rendering, done.settings, *truth);
  done.truth = std::move(*truth);
  return {};
}

// Renders the loaded scene and, with --ground-truth, judges the result: the progress line from 0.1 to 0.9.
Status draw(const RenderFlags& flags, ProgressLine& line, FinishedRender& done) {
  const double judging = flags.ground_truth ? 0.4 : 0.0;
  const auto progress = [&](std::string_view pass, double share) {
    return line.step(pass, 0.1 + (0.8 - judging) * share);
  };
  auto rendering = render_scene(flags.scene, *done.scene, done.settings, progress);
  if (!rendering) return rendering.error();
  done.rendering.emplace(std::move(rendering).value());
  if (!flags.ground_truth) return {};
  return judge(done, [&](std::string_view pass, double share) { return line.step(pass, 0.5 + judging * share); });
}

Status write(StagedFiles& files, ProgressLine& line, FinishedRender& done) {
  const Diagnostic interrupted{.message = "interrupted", .fault = Fault::cancelled};
  if (!line.step("writing", 0.9)) return interrupted;
  if (Status written = write_rendering(*done.rendering, files); !written) return written;
  if (!line.step("writing", 1.0)) return interrupted;
  if (Status committed = files.commit(); !committed) return committed;
  done.files = files.files();
  return {};
}

// Loads, renders, judges and writes.
Status run(const RenderFlags& flags, FinishedRender& done) {
  const auto start = Clock::now();
  ProgressLine line(flags.common.quiet);
  line.step("loading", 0.0);
  auto scene = load_drawn_scene(flags.scene, done.settings, flags.common.quiet);
  if (!scene) return scene.error();
  done.scene.emplace(std::move(scene->scene));
  done.ignored = std::move(scene->ignored);
  // Opened before rendering, so that an unwritable folder is reported without a long wait.
  auto files = StagedFiles::open(flags.folder);
  if (!files) return files.error();
  done.load_ms = milliseconds(Clock::now() - start);
  if (Status drawn = draw(flags, line, done); !drawn) return drawn;
  const auto rendered = Clock::now();
  if (Status written = write(*files, line, done); !written) return written;
  const auto end = Clock::now();
  done.write_ms = milliseconds(end - rendered);
  done.total_ms = milliseconds(end - start);
  return {};
}

void print_warnings(const RenderFlags& flags, const FinishedRender& done) {
  const bool quiet = flags.common.quiet;
  warn_of_unused_order(flags.scene.technique, done.settings, done.rendering->index_order, quiet);
  if (quiet || !flags.check_order || done.settings.index.order == IndexOrder::neighbour) return;
  say_warning("--check-order has no effect without --index-order neighbour");
}

// Prints the files, the summary and the answer. Returns the exit code.
int print_answer(const RenderFlags& flags, const FinishedRender& done) {
  if (!flags.common.quiet) {
    for (const auto& file : done.files) say_written(file);
  }
  if (flags.common.json) return answer(render_json(flags, done));
  if (!flags.common.quiet) say(summary_text(flags, done));
  return done.rendering->picked ? answer(pick_text(flags, done)) : kDone;
}

// The exit code of --check-order.
int check_order(const RenderFlags& flags, const Rendering& rendering) {
  const std::uint64_t found = rendering.index_order.false_neighbours;
  if (found == 0) return kDone;
  say_error(fmt::format(
      "{}: the order of indices has {} false neighbours, polygons that can shadow one another but compare equal; "
      "expected 0",
      flags.scene.file, found));
  return kDifference;
}

int render(const RenderFlags& flags) {
  const ThreadLimit limit(flags.common.threads);
  const auto settings = checked_settings(flags);
  if (!settings) {
    say_error(fmt::format("{} (see: ninebit render --help)", settings.error().message));
    return kWrongUsage;
  }
  FinishedRender done{.settings = *settings};
  if (Status finished = run(flags, done); !finished) return report(finished.error());
  print_warnings(flags, done);
  const int printed = print_answer(flags, done);
  return printed == kDone && flags.check_order ? check_order(flags, *done.rendering) : printed;
}

}  // namespace

void add_render(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("render", "Render a scene with shadows");
  verb->footer(
      "Examples:\n"
      "  ninebit render scenes/index_room.gltf -o out\n"
      "  ninebit render bunny.obj -o out --light 2,4,3 --index-step 1 --layers --json");
  auto flags = std::make_shared<RenderFlags>();
  add_common_flags(*verb, flags->common);
  add_scene_file(*verb, "scene", flags->scene)->required();
  verb->add_option("-o,--output", flags->folder, "Folder to write into; created if missing")
      ->required()
      ->type_name("DIR");
  add_scene_flags(*verb, flags->scene);
  verb->add_flag("--layers", flags->scene.settings.layers, "Also write layers.exr with every intermediate value");
  add_pixel_flag(*verb, "--pick", flags->pick, "Print which polygon and object is visible at this pixel, by its index");
  verb->add_flag("--ground-truth", flags->ground_truth,
                 "Compare each pixel with ray casting: count errors by cause, write error.png");
  verb->add_flag("--check-order", flags->check_order,
                 "With --index-order neighbour: exit with 1 if there are false neighbours");
  verb->callback([flags, &exit_code] { exit_code = render(*flags); });
}

}  // namespace ninebit::tools
