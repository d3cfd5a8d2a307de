// `ninebit compare`: techniques, or settings of one, side by side on one page.
#include <fmt/format.h>

#include <memory>
#include <utility>

#include "ninebit/image/staged_files.h"
#include "src/tools/common/output_file.h"
#include "src/tools/common/scene_textures.h"
#include "src/tools/compare/compare_points.h"
#include "src/tools/input/host.h"

namespace ninebit::tools {
namespace {

std::string light_in_words(const Light& light) {
  const glm::vec3& at = light.kind == LightKind::directional ? light.direction : light.position;
  return fmt::format("{} light {} {:.4g}, {:.4g}, {:.4g}", light_kind_name(light.kind),
                     light.kind == LightKind::directional ? "along" : "at", at.x, at.y, at.z);
}

// Parts of the scene that any of the points ignores.
std::vector<std::string> ignored_by_points(const ComparedPoints& compared, const Scene& scene,
                                           std::vector<std::string> ignored) {
  for (const ComparedPoint& point : compared.points) {
    RenderSettings settings = settings_of(point.scene, point.common);
    settings.evidence = true;
    for (std::string& part : ignored_materials(scene, point.scene.technique, settings)) {
      if (std::find(ignored.begin(), ignored.end(), part) == ignored.end()) ignored.push_back(std::move(part));
    }
  }
  return ignored;
}

// Reads the scene, and chooses the techniques by its light if there is no --vary.
Status load_compared(const CompareFlags& flags, Comparison& out, std::optional<Scene>& scene, bool& usage) {
  SceneFlags first = out.compared.points.empty() ? flags.scene : out.compared.points[0].scene;
  if (out.compared.points.empty()) first.light_kinds = light_kinds_of(flags);
  auto drawn = load_drawn_scene(first, settings_of(first, flags.common), true);
  if (!drawn) return drawn.error();
  const Light& light = drawn->scene.lights[0];
  if (flags.vary.empty()) {
    auto points = technique_points(flags, light.kind);
    if (!points) {
      usage = true;
      return points.error();
    }
    out.compared = std::move(*points);
  }
  out.light = light_in_words(light);
  out.triangles = drawn->scene.triangles.size();
  out.ignored = ignored_by_points(out.compared, drawn->scene, std::move(drawn->ignored));
  warn_of_ignored(flags.scene.file, out.ignored, flags.common.quiet);
  scene.emplace(std::move(drawn->scene));
  return {};
}

const Diagnostic kInterruptedComparison{.message = "interrupted", .fault = Fault::cancelled};

// Renders all points: the progress line from 0.05 to 0.95.
Status draw_compared(const Scene& scene, ProgressLine& line, Comparison& out) {
  const auto rays = GroundTruthScene::make(scene);
  if (!rays) return rays.error();
  const auto count = static_cast<double>(out.compared.points.size());
  bool any = false;
  for (const ComparedPoint& point : out.compared.points) {
    const auto done = static_cast<double>(out.rows.size());
    const Progress progress = [&](std::string_view, double share) {
      return line.step(point.name, 0.05 + 0.9 * (done + share) / count);
    };
    auto row = compared_row(point, scene, *rays, progress);
    if (!row) return row.error();
    any = any || row->refused.empty();
    out.rows.push_back(std::move(*row));
  }
  if (any || out.rows.empty()) return {};
  return Diagnostic{.message = fmt::format("nothing can be drawn: {}", out.rows[0].refused)};
}

Status write_compared(const CompareFlags& flags, const Comparison& comparison, ProgressLine& line, StagedFiles& files) {
  if (!line.step("writing", 0.95)) return kInterruptedComparison;
  if (Status done = write_staged(files, "index.html", compare_page(flags, comparison)); !done) return done;
  const std::string report = json_text(compare_json(flags, comparison));
  if (Status done = write_staged(files, "report.json", report); !done) return done;
  if (ProgressLine::stopped()) return kInterruptedComparison;
  return files.commit();
}

Status run_comparison(const CompareFlags& flags, Comparison& out, std::vector<std::filesystem::path>& written,
                      bool& usage) {
  ProgressLine line(flags.common.quiet);
  line.step("loading", 0.0);
  std::optional<Scene> scene;
  if (Status loaded = load_compared(flags, out, scene, usage); !loaded) return loaded;
  // Opened before rendering, so that an unwritable folder is reported without a long wait.
  auto opened = open_folder(flags.folder);
  if (!opened) return opened.error();
  std::optional<StagedFiles>& files = *opened;
  if (Status drawn = draw_compared(*scene, line, out); !drawn) {
    Diagnostic fault = drawn.error();
    if (fault.file.empty() && fault.fault == Fault::invalid_input) fault.file = flags.scene.file;
    return fault;
  }
  if (host() != nullptr) host()->give("page", compare_page(flags, out));
  if (!files) return {};
  if (Status done = write_compared(flags, out, line, *files); !done) return done;
  written = files->files();
  return {};
}

std::string summary_of(const Comparison& comparison) {
  std::string text = fmt::format("{}\n", comparison.light);
  std::size_t widest = 0;
  for (const ComparedPoint& point : comparison.compared.points) widest = std::max(widest, point.name.size());
  for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
    const ComparedRow& row = comparison.rows[i];
    text += fmt::format("{:<{}}  ", comparison.compared.points[i].name, widest);
    if (!row.refused.empty()) {
      text += fmt::format("not drawn: {}\n", row.refused);
    } else if (!row.errors) {
      text += fmt::format("no shadows drawn, {:.0f} ms\n", total_ms(row.times));
    } else {
      text += fmt::format("{} wrong pixels ({} falsely lit, {} falsely shadowed), {:.0f} ms\n",
                          row.errors->false_lit + row.errors->false_shadowed, row.errors->false_lit,
                          row.errors->false_shadowed, total_ms(row.times));
    }
  }
  for (const LeftOut& one : comparison.compared.left_out) {
    text += fmt::format("left out: {} ({})\n", one.technique, one.reason);
  }
  return text;
}

int compare(const CompareFlags& flags, ComparedPoints points) {
  const ThreadLimit limit(flags.common.threads);
  const RenderSettings settings = settings_of(flags.scene, flags.common);
  Comparison comparison{.compared = std::move(points), .width = settings.width, .height = settings.height};
  std::vector<std::filesystem::path> written;
  bool usage = false;
  if (Status done = run_comparison(flags, comparison, written, usage); !done) {
    if (!usage) return report(done.error());
    return wrong_usage("compare", done.error().message);
  }
  if (!flags.common.quiet) {
    for (const auto& file : written) say_written(file);
  }
  if (!flags.common.json) {
    if (!flags.common.quiet) say(summary_of(comparison));
    return kDone;
  }
  Json object = compare_json(flags, comparison);
  object["files"] = Json::array();
  for (const auto& file : written) object["files"].push_back(file.string());
  return answer(object);
}

// Checks that need all flags to be parsed. Throws CLI::ValidationError.
ComparedPoints checked_points(const CLI::App& verb, const CompareFlags& flags) {
  if (!flags.vary.empty()) return varied_points(flags);
  if (verb.get_option("--technique")->count() > 0) {
    throw CLI::ValidationError("--technique names one technique; expected --vary FLAG=VALUE,VALUE with it");
  }
  const RenderSettings settings = settings_of(flags.scene, flags.common);
  const auto pixels = static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
  if (pixels * techniques().size() > kMostComparedPixels) {
    throw CLI::ValidationError(fmt::format("--size {}: more than {} pixels in all pictures; expected a smaller size",
                                           flags.scene.size, kMostComparedPixels));
  }
  return {};
}

}  // namespace

void add_compare(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("compare", "Put techniques, or settings of one, side by side on one page");
  verb->footer(
      "Without --vary, all techniques that support the scene's light are compared. With --vary, all combinations of "
      "the "
      "lists, with --technique.\n"
      "Examples:\n"
      "  ninebit compare scenes/index_room.gltf -o out\n"
      "  ninebit compare scenes/index_room.gltf -o out --vary index-step=1,2,3,4\n"
      "  ninebit compare scenes/index_room.gltf -o out --technique shadow-map --vary 'polygon-offset=0,0;1,16' --vary "
      "map-size=256,512");
  auto flags = std::make_shared<CompareFlags>();
  add_common_flags(*verb, flags->common);
  add_scene_file(*verb, "scene", flags->scene)->required();
  verb->add_option("-o,--output", flags->folder, "Folder to write into; created if missing")
      ->required(host() == nullptr)
      ->type_name("DIR");
  flags->scene_options = add_scene_flags(*verb, flags->scene);
  flags->scene_options.push_back(verb->get_option("--profile"));
  verb->add_option(
          "--vary", flags->vary,
          "Compare these values of a flag, such as index-step=1-4; values that contain commas are separated by "
          "semicolons; several lists give all combinations")
      ->type_name("FLAG=LIST")
      ->allow_extra_args(false);
  // Replaces that of add_scene_flags: which technique reads a flag is checked for each of them.
  verb->parse_complete_callback([] {});
  verb->callback([flags, verb, &exit_code] {
    ComparedPoints points = checked_points(*verb, *flags);
    exit_code = compare(*flags, std::move(points));
  });
}

}  // namespace ninebit::tools
