// `ninebit compare`: techniques, or settings of one, side by side on one page.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "ninebit/image/staged_files.h"
#include "src/tools/common/given_pictures.h"
#include "src/tools/common/output_file.h"
#include "src/tools/common/scene_textures.h"
#include "src/tools/compare/compare_page.h"
#include "src/tools/compare/compare_points.h"
#include "src/tools/compare/compare_sheet.h"
#include "src/tools/input/host.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

std::string light_in_words(const Light& light) {
  const glm::vec3& at = light.kind == LightKind::directional ? light.direction : light.position;
  return fmt::format("{} light {} {:.4g}, {:.4g}, {:.4g}", light_kind_name(light.kind),
                     light.kind == LightKind::directional ? "along" : "at", at.x, at.y, at.z);
}

// "; it reaches all of the picture: a point light for index-cube, depth-cube", of techniques without support for a
// spot.
std::string as_point_in_words(const ComparedPoints& compared) {
  std::vector<std::string> names;
  for (const ComparedPoint& point : compared.points) {
    const std::string& name = point.scene.technique;
    if (point.as_point && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (names.empty()) return {};
  return fmt::format("; it reaches all of the picture: a point light for {}", fmt::join(names, ", "));
}

// Parts of the scene that any of the points ignores.
std::vector<std::string> ignored_by_points(const ComparedPoints& compared, const Scene& scene,
                                           std::vector<std::string> ignored) {
  for (const ComparedPoint& point : compared.points) {
    RenderSettings settings = settings_of(point);
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
  first.light_type =
      flags.scene.light_type;  // those of a spot light are not read by techniques that draw a point light
  first.light_target = flags.scene.light_target;
  first.spot_angle = flags.scene.spot_angle;
  auto drawn = load_drawn_scene(first, settings_of(first, flags.common));
  if (!drawn) return drawn.error();
  const Light& light = drawn->scene.lights[0];
  const auto& given = out.compared.points;
  const bool asks =
      flags.vary.empty() || std::any_of(given.begin(), given.end(), [](const auto& p) { return p.as_point; });
  if (light.kind == LightKind::spot && asks) {
    const auto holds = spot_holds_picture(flags, drawn->scene);
    if (!holds) return holds.error();
    out.spot_holds_picture = *holds;
  }
  if (flags.vary.empty()) {
    auto points = technique_points(flags, light.kind, out.spot_holds_picture);
    if (!points) {
      usage = true;
      return points.error();
    }
    out.compared = std::move(*points);
  }
  out.light = light_in_words(light) + (out.spot_holds_picture ? as_point_in_words(out.compared) : "");
  out.triangles = drawn->scene.triangles.size();
  out.ignored = ignored_by_points(out.compared, drawn->scene, std::move(drawn->ignored));
  warn_of_ignored(flags.scene.file, out.ignored);
  scene.emplace(std::move(drawn->scene));
  return {};
}

const Diagnostic kInterruptedComparison{.message = "interrupted", .fault = Fault::cancelled};

// Renders all points: the progress line from 0.05 to 0.95.
Status draw_compared(CompareFlags flags, const Scene& scene, ProgressLine& line, Comparison& out) {
  if (flags.makes_page()) {
    const bool are_few = out.compared.points.size() <= kMostFullyTraced;
    flags.traces = are_few ? CompareFlags::Traces::all : CompareFlags::Traces::one_of_cause;
  }
  const auto rays = GroundTruthScene::make(scene);
  if (!rays) return rays.error();
  const auto is_as_point = [](const ComparedPoint& point) { return point.as_point; };
  const bool any_as_point = std::any_of(out.compared.points.begin(), out.compared.points.end(), is_as_point);
  std::optional<Scene> point_scene;
  std::optional<GroundTruthScene> point_rays;
  if (any_as_point && out.spot_holds_picture) {
    point_scene = scene;
    point_scene->lights[0].kind = LightKind::point;
    auto made = GroundTruthScene::make(*point_scene);
    if (!made) return made.error();
    point_rays.emplace(std::move(*made));
  }
  const auto count = static_cast<double>(out.compared.points.size());
  bool any = false;
  for (const ComparedPoint& point : out.compared.points) {
    const auto done = static_cast<double>(out.rows.size());
    const Progress progress = [&](std::string_view pass, double share) {
      return line.step(fmt::format("{}: {}", point.name, pass), 0.05 + 0.9 * (done + share) / count);
    };
    if (point.as_point && !point_scene) {
      out.rows.push_back({.refused = "no support for a spot light that does not reach all of the picture"});
      continue;
    }
    auto row = point.as_point ? compared_row(flags, point, *point_scene, *point_rays, progress)
                              : compared_row(flags, point, scene, *rays, progress);
    if (!row) return row.error();
    any = any || row->refused.empty();
    out.rows.push_back(std::move(*row));
  }
  if (any || out.rows.empty()) return {};
  return Diagnostic{.message = fmt::format("nothing can be drawn: {}", out.rows[0].refused)};
}

// The outputs, opened before rendering, so that what cannot be written is reported without a long wait.
struct ComparedOutputs {
  std::optional<StagedFiles> folder{};
  std::optional<OutputFile> sheet{};
};

Result<ComparedOutputs> open_outputs(const CompareFlags& flags) {
  ComparedOutputs out;
  auto folder = open_folder(flags.folder);
  if (!folder) return folder.error();
  out.folder = std::move(*folder);
  if (flags.sheet.empty()) return out;
  auto sheet = OutputFile::open(flags.sheet);
  if (!sheet) return sheet.error();
  out.sheet.emplace(std::move(*sheet));
  return out;
}

Status write_compared(const CompareFlags& flags, const Comparison& comparison, ProgressLine& line,
                      ComparedOutputs& outputs) {
  if (!line.step("writing", 0.95)) return kInterruptedComparison;
  if (outputs.folder) {
    StagedFiles& files = *outputs.folder;
    if (Status done = write_staged(files, "index.html", compare_page(flags, comparison)); !done) return done;
    const std::string report = json_text(compare_json(flags, comparison));
    if (Status done = write_staged(files, "report.json", report); !done) return done;
  }
  if (outputs.sheet) {
    Image8 sheet = compare_sheet(flags, comparison);
    const auto png = encode_png(sheet);
    if (!png) return png.error();
    if (Status done = outputs.sheet->write(*png); !done) return done;
    give_picture("sheet", std::move(sheet));
  }
  if (ProgressLine::stopped()) return kInterruptedComparison;
  if (outputs.folder) {
    if (Status done = outputs.folder->commit(); !done) return done;
  }
  return outputs.sheet ? outputs.sheet->finish() : Status();
}

Status run_comparison(const CompareFlags& flags, Comparison& out, std::vector<std::filesystem::path>& written,
                      bool& usage) {
  ProgressLine line(flags.common.quiet);
  line.step("loading", 0.0);
  std::optional<Scene> scene;
  if (Status loaded = load_compared(flags, out, scene, usage); !loaded) return loaded;
  if (!flags.sheet.empty()) {
    if (Status fits = check_sheet(out); !fits) {
      usage = true;
      return fits;
    }
  }
  auto outputs = open_outputs(flags);
  if (!outputs) return outputs.error();
  if (Status drawn = draw_compared(flags, *scene, line, out); !drawn) {
    Diagnostic fault = drawn.error();
    if (fault.file.empty() && fault.fault == Fault::invalid_input) fault.file = flags.scene.file;
    return fault;
  }
  if (host() != nullptr) host()->give("page", compare_page(flags, out));
  if (Status done = write_compared(flags, out, line, *outputs); !done) return done;
  if (outputs->folder) written = outputs->folder->files();
  if (outputs->sheet) written.emplace_back(flags.sheet);
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
      text += worst_text(row.errors->worst);
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
  if (!flags.common.json) return answer(summary_of(comparison));
  Json object = compare_json(flags, comparison);
  object["files"] = Json::array();
  for (const auto& file : written) object["files"].push_back(file.string());
  return answer(object);
}

// Checks that need all flags to be parsed. Throws CLI::ValidationError.
ComparedPoints checked_points(const CLI::App& verb, const CompareFlags& flags) {
  if (!flags.makes_page() && flags.sheet.empty()) {
    throw CLI::RequiredError("--output or --sheet");
  }
  if (!flags.sheet.empty() && std::filesystem::path(flags.sheet).extension() != ".png") {
    throw CLI::ValidationError(
        fmt::format("--sheet {}: expected a file whose name ends in .png", printable(flags.sheet)));
  }
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
      "  ninebit compare scenes/index_room.gltf --sheet steps.png --vary index-step=1,2\n"
      "  ninebit compare scenes/index_room.gltf -o out --technique shadow-map --vary 'polygon-offset=0,0;1,16' --vary "
      "map-size=256,512");
  auto flags = std::make_shared<CompareFlags>();
  add_common_flags(*verb, flags->common);
  add_scene_file(*verb, "scene", flags->scene)->required();
  verb->add_option("-o,--output", flags->folder,
                   "Folder to write the page and its figures into; created if missing (default: only --sheet)")
      ->type_name("DIR");
  verb->add_option("--sheet", flags->sheet,
                   "Write all pictures with captions and counts as one picture, for a slide (default: none)")
      ->type_name("FILE.png");
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
