// `ninebit render`: renders a scene with shadows by one of the techniques.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <utility>

#include "ninebit/shadow/picture_files.h"
#include "src/tools/common/flag_values.h"
#include "src/tools/common/given_pictures.h"
#include "src/tools/common/output_file.h"
#include "src/tools/common/scene_textures.h"
#include "src/tools/common/technique_flags.h"
#include "src/tools/input/host.h"
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
  settings.width *= flags.supersample;
  settings.height *= flags.supersample;
  if (settings.width > kMaxSurfaceSize || settings.height > kMaxSurfaceSize) {
    return Diagnostic{.message =
                          fmt::format("--supersample {}: the frame has {} x {} samples; expected at most {} a side",
                                      flags.supersample, settings.width, settings.height, kMaxSurfaceSize)};
  }
  if (flags.turntable > 0 &&
      (flags.ground_truth || settings.layers || !flags.pick.empty() || flags.check_order || !flags.only.empty())) {
    return Diagnostic{.message =
                          "--turntable writes colour pictures alone; expected it without --ground-truth, "
                          "--layers, --pick, --check-order and --only"};
  }
  if (flags.folder.empty() && !flags.only.empty()) {
    return Diagnostic{.message = "--only names files; expected it with --output"};
  }
  if (flags.pick.empty()) return settings;
  if (flags.scene.technique != "index-cube") {
    return Diagnostic{.message = fmt::format("--pick requires technique index-cube, not {}", flags.scene.technique)};
  }
  if (flags.supersample > 1) {
    return Diagnostic{.message =
                          "--pick reads one pixel, which has several samples with --supersample; expected one flag"};
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

const Diagnostic kInterruptedRun{.message = "interrupted", .fault = Fault::cancelled};

// Adds the manifest, makes the staged files appear, and removes those of an earlier run that are not among them.
Status commit(const RenderFlags& flags, const std::vector<std::string>& names, StagedFiles& files,
              FinishedRender& done) {
  if (Status written = write_manifest(names, files); !written) return written;
  const std::vector<std::string> earlier = earlier_files(flags.folder);
  if (ProgressLine::stopped()) return kInterruptedRun;
  if (Status committed = files.commit(); !committed) return committed;
  done.files = files.files();
  done.removed = remove_earlier(flags.folder, earlier, names);
  return {};
}

Status write(const RenderFlags& flags, StagedFiles& files, ProgressLine& line, FinishedRender& done) {
  if (!line.step("writing", 0.9)) return kInterruptedRun;
  const auto names = chosen_files(*done.rendering, flags.only);
  if (!names) {
    done.wrong_only = true;
    return names.error();
  }
  const RenderedFiles chosen{.only = *names, .supersample = flags.supersample};
  if (Status written = write_rendering(*done.rendering, files, chosen); !written) return written;
  return commit(flags, *names, files, done);
}

// Renders and writes the frames of --turntable.
Status turn(const RenderFlags& flags, StagedFiles* files, ProgressLine& line, FinishedRender& done) {
  const auto step = [&](std::string_view frame, double share) { return line.step(frame, 0.1 + 0.9 * share); };
  if (Status drawn = draw_turntable(flags, files, step, done); !drawn) return drawn;
  if (files == nullptr) return {};
  std::vector<std::string> names;
  for (const auto& [name, hash] : done.frames) names.push_back(name);
  return commit(flags, names, *files, done);
}

// Loads, renders, judges and writes.
Status run(const RenderFlags& flags, FinishedRender& done) {
  const auto start = Clock::now();
  ProgressLine line(flags.common.quiet);
  line.step("loading", 0.0);
  auto scene = load_drawn_scene(flags.scene, done.settings);
  if (!scene) return scene.error();
  warn_of_ignored(flags.scene.file, scene->ignored);
  done.scene.emplace(std::move(scene->scene));
  done.ignored = std::move(scene->ignored);
  // Opened before rendering, so that an unwritable folder is reported without a long wait.
  auto opened = open_folder(flags.folder);
  if (!opened) return opened.error();
  std::optional<StagedFiles>& files = *opened;
  done.load_ms = milliseconds(Clock::now() - start);
  if (flags.turntable > 0) {
    Status turned = turn(flags, files ? &*files : nullptr, line, done);
    done.total_ms = milliseconds(Clock::now() - start);
    return turned;
  }
  if (Status drawn = draw(flags, line, done); !drawn) return drawn;
  const auto rendered = Clock::now();
  if (files) {
    if (Status written = write(flags, *files, line, done); !written) return written;
  }
  const auto end = Clock::now();
  done.write_ms = milliseconds(end - rendered);
  done.total_ms = milliseconds(end - start);
  return {};
}

void print_warnings(const RenderFlags& flags, const FinishedRender& done) {
  warn_of_unused_order(done.settings, done.rendering->index_order);
  if (!flags.check_order || done.settings.index.order == IndexOrder::neighbour) return;
  say_warning("--check-order has no effect without --index-order neighbour");
}

// Prints the files, the summary and the answer. Returns the exit code.
int print_answer(const RenderFlags& flags, const FinishedRender& done) {
  if (!flags.common.quiet) {
    for (const auto& file : done.files) say_written(file);
    for (const auto& file : done.removed) say(fmt::format("removed {}, of an earlier run\n", file.string()));
  }
  if (flags.common.json) return answer(render_json(flags, done));
  return answer(summary_text(flags, done) + (done.rendering->picked ? pick_text(flags, done) : ""));
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
    return wrong_usage("render", settings.error().message);
  }
  FinishedRender done{.settings = *settings};
  if (Status finished = run(flags, done); !finished) {
    if (!done.wrong_only) return report(finished.error());
    return wrong_usage("render", finished.error().message);
  }
  print_warnings(flags, done);
  const int printed = print_answer(flags, done);
  give_rendering(*done.rendering, flags.supersample);
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
      ->required(host() == nullptr)
      ->type_name("DIR");
  flags->scene_options = add_scene_flags(*verb, flags->scene);
  flags->scene_options.push_back(verb->get_option("--profile"));
  verb->add_flag("--layers", flags->scene.settings.layers,
                 "Also write layers.exr with every intermediate value (default: off)");
  verb->add_option("--supersample", flags->supersample,
                   "Draw N x N samples for each pixel and average them, to nearest; that a GeForce 2 did so is assumed")
      ->capture_default_str()
      ->type_name("N")
      ->check(CLI::IsMember(std::vector<std::string>{"1", "2", "4"}));
  verb->add_option("--turntable", flags->turntable,
                   "Write N pictures from all around: the camera turns about the point that it looks at (default: off)")
      ->type_name("N")
      ->check(whole_in_range(2, kMostFrames));
  verb->add_option("--only", flags->only,
                   "Files to write, by their names without ending, such as color,shadow (default: all)")
      ->type_name("LIST");
  add_pixel_flag(*verb, "--pick", flags->pick,
                 "Print which polygon and object is visible at this pixel, by its index (default: off)");
  verb->add_flag("--ground-truth", flags->ground_truth,
                 "Compare each pixel with ray casting: count errors by cause, write error.png (default: off)");
  verb->add_flag("--check-order", flags->check_order,
                 "With --index-order neighbour: exit with 1 if there are false neighbours (default: off)");
  group_scene_flags(*verb);
  verb->callback([flags, &exit_code] { exit_code = render(*flags); });
}

}  // namespace ninebit::tools
