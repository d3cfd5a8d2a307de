// `ninebit render`: a scene's shadows, drawn by one of the techniques.
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "ninebit/scene/scene_io.h"
#include "ninebit/shadow/pictures.h"
#include "ninebit/shadow/technique.h"
#include "src/tools/program.h"
#include "src/tools/sha256.h"

namespace ninebit::tools {
namespace {

struct RenderFlags {
  CommonFlags common;
  std::string scene;
  std::string folder;
  std::string technique = "index-cube";
  std::string size = "1024x768";
  std::string index_format = "rgb";
  std::string index_scope = "polygon";
  std::string cull = "none";
  std::string camera, look_at, light, floor = "auto";
  std::optional<double> fov;
  RenderSettings settings;
};

// The whole text as numbers between separators; empty where it is anything else.
template <class T>
std::optional<std::vector<T>> numbers(const std::string& text, char separator) {
  std::vector<T> out;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    T value{};
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{}) return std::nullopt;
    out.push_back(value);
    if (next == end) return out;
    if (*next != separator) return std::nullopt;
    at = next + 1;
  }
}

std::string check_size(const std::string& text) {
  const auto n = numbers<int>(text, 'x');
  if (n && n->size() == 2 && n->at(0) >= 1 && n->at(1) >= 1 && std::max(n->at(0), n->at(1)) <= kMaxSurfaceSize)
    return {};
  return fmt::format("'{}' is no picture size; expected WIDTHxHEIGHT, each from 1 to {}", text, kMaxSurfaceSize);
}

std::string check_map_size(const std::string& text) {
  const auto n = numbers<int>(text, ',');
  if (n && n->size() == 1 && n->at(0) >= 1 && n->at(0) <= kMaxSurfaceSize && (n->at(0) & (n->at(0) - 1)) == 0)
    return {};
  return fmt::format("'{}' is no map size; expected a power of two from 1 to {}", text, kMaxSurfaceSize);
}

std::string check_point(const std::string& text) {
  const auto n = numbers<float>(text, ',');
  if (n && n->size() == 3 && std::isfinite(n->at(0)) && std::isfinite(n->at(1)) && std::isfinite(n->at(2))) return {};
  return fmt::format("'{}' is no point; expected X,Y,Z", text);
}

std::string check_floor(const std::string& text) {
  const auto n = numbers<float>(text, ',');
  if (text == "auto" || text == "none" || (n && n->size() == 1 && std::isfinite(n->at(0)))) return {};
  return fmt::format("'{}' is no floor; expected auto, none or a height", text);
}

std::string check_fov(const std::string& text) {
  const auto n = numbers<float>(text, ',');
  if (n && n->size() == 1 && n->at(0) >= 0.01F && n->at(0) <= 170.0F) return {};
  return fmt::format("'{}' is no field of view; expected degrees from 0.01 to 170", text);
}

std::string check_scene(const std::string& text) {
  return text.empty() ? "the file name is empty" : "";
}

std::optional<glm::vec3> point(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto n = numbers<float>(text, ',');
  return glm::vec3(n->at(0), n->at(1), n->at(2));
}

SceneSetup setup_of(const RenderFlags& flags) {
  SceneSetup setup;
  setup.camera = point(flags.camera);
  setup.look_at = point(flags.look_at);
  setup.light = point(flags.light);
  if (flags.fov) setup.fov_degrees = static_cast<float>(*flags.fov);
  if (flags.floor == "none") {
    setup.floor = FloorChoice::none;
  } else if (flags.floor != "auto") {
    setup.floor = FloorChoice::at_height;
    setup.floor_height = numbers<float>(flags.floor, ',')->at(0);
  }
  return setup;
}

Json hashes(const Rendering& rendering) {
  Sha256 color, stencil, index_map;
  for (int c = 0; c < 4; ++c) color.add(rendering.frame.color(c));
  stencil.add(rendering.frame.stencil());
  for (const IndexMapFace& face : rendering.index_map) {
    for (const auto& plane : face.color) index_map.add(plane);
  }
  return {{"color", color.finish()}, {"stencil", stencil.finish()}, {"index_map", index_map.finish()}};
}

double milliseconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double, std::milli>(d).count();
}

int render(RenderFlags& flags) {
  using Clock = std::chrono::steady_clock;
  std::optional<tbb::global_control> limit;
  if (flags.common.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(flags.common.threads));
  }
  set_image_threads(flags.common.threads > 0 ? flags.common.threads : tbb::this_task_arena::max_concurrency());
  RenderSettings& settings = flags.settings;
  const auto size = *numbers<int>(flags.size, 'x');
  settings.width = size[0];
  settings.height = size[1];
  settings.profile = profile_of(flags.common);
  settings.index_scope = flags.index_scope == "object" ? IndexScope::object : IndexScope::polygon;
  settings.cull_face = flags.cull == "back" ? CullFace::back : flags.cull == "front" ? CullFace::front : CullFace::none;

  const auto start = Clock::now();
  std::optional<ProgressLine> line(std::in_place, flags.common.quiet);
  line->step("loading", 0.0);
  auto read = read_scene(flags.scene);
  if (!read) return line.reset(), report(read.error());
  const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
  auto scene = complete_scene(std::move(*read), setup_of(flags), aspect);
  if (!scene) {
    Diagnostic d = scene.error();
    if (d.file.empty()) d.file = flags.scene;
    return line.reset(), report(d);
  }
  // Before the work, so that a folder that cannot be written into costs nobody a long rendering.
  auto files = StagedFiles::open(flags.folder);
  if (!files) return line.reset(), report(files.error());
  const auto loaded = Clock::now();

  const auto progress = [&](std::string_view pass, double done) { return line->step(pass, 0.1 + 0.8 * done); };
  auto rendering = find_technique(flags.technique)->render(*scene, settings, progress);
  if (!rendering) {
    Diagnostic d = rendering.error();
    if (d.file.empty()) d.file = flags.scene;
    return line.reset(), report(d);
  }

  const auto rendered = Clock::now();
  if (!line->step("writing", 0.9)) return line.reset(), report({.message = "interrupted", .fault = Fault::cancelled});
  if (Status written = write_rendering(*rendering, *files); !written) return line.reset(), report(written.error());
  if (!line->step("writing", 1.0)) return line.reset(), report({.message = "interrupted", .fault = Fault::cancelled});
  if (Status committed = files->commit(); !committed) return line.reset(), report(committed.error());
  const auto end = Clock::now();
  line.reset();

  Json names = Json::array();
  for (const auto& file : files->files()) {
    names.push_back(file.string());
    if (!flags.common.quiet) say(fmt::format("wrote {}\n", file.string()));
  }
  const Rendering& r = *rendering;
  if (!flags.common.json) {
    if (!flags.common.quiet) {
      say(fmt::format("{} triangles; pixels: {} lit, {} shadowed, {} background; {:.0f} ms\n", scene->triangles.size(),
                      r.lit, r.shadowed, r.background, milliseconds(end - start)));
    }
    return kDone;
  }
  const Json out{{"command", "render"},
                 {"version", NINEBIT_VERSION},
                 {"technique", flags.technique},
                 {"profile", flags.common.profile},
                 {"scene", flags.scene},
                 {"triangles", scene->triangles.size()},
                 {"size", {settings.width, settings.height}},
                 {"map_size", settings.map_size},
                 {"index",
                  {{"format", flags.index_format},
                   {"scope", flags.index_scope},
                   {"step", settings.index_step},
                   {"used", r.codes_used},
                   {"capacity", r.codes.capacity()}}},
                 {"pixels", {{"background", r.background}, {"lit", r.lit}, {"shadowed", r.shadowed}}},
                 {"time_ms",
                  {{"load", milliseconds(loaded - start)},
                   {"transform", r.times.transform},
                   {"maps", r.times.maps},
                   {"camera", r.times.camera},
                   {"compare", r.times.compare},
                   {"shade", r.times.shade},
                   {"write", milliseconds(end - rendered)},
                   {"total", milliseconds(end - start)}}},
                 {"files", std::move(names)},
                 {"hash", hashes(r)}};
  return answer(out.dump(2) + "\n");
}

CLI::Validator checked(std::string (*check)(const std::string&)) {
  return CLI::Validator([check](std::string& text) { return check(text); }, "");
}

}  // namespace

void add_render(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("render", "Draw a scene's shadows");
  verb->footer(
      "Examples:\n"
      "  ninebit render scenes/index_room.gltf -o out\n"
      "  ninebit render bunny.obj -o out --light 2,4,3 --index-step 1 --layers --json");
  auto flags = std::make_shared<RenderFlags>();
  add_common_flags(*verb, flags->common);
  verb->add_option("scene", flags->scene, "glTF 2.0, OBJ, PLY, OFF or 3DS file")
      ->required()
      ->type_name("FILE")
      ->check(checked(check_scene));
  verb->add_option("-o,--output", flags->folder, "Folder to write into; made if missing")->required()->type_name("DIR");

  std::vector<std::string> names;
  for (const Technique& technique : techniques()) names.emplace_back(technique.name);
  verb->add_option("--technique", flags->technique, "How shadows are drawn")
      ->capture_default_str()
      ->check(CLI::IsMember(names));
  verb->add_option("--size", flags->size, "Picture size in pixels")
      ->capture_default_str()
      ->type_name("WxH")
      ->check(checked(check_size));
  verb->add_option("--map-size", flags->settings.map_size, "Texels a side of a cube-map face, a power of two")
      ->type_name("N")
      ->capture_default_str()
      ->check(checked(check_map_size));
  verb->add_option("--index-format", flags->index_format, "What holds an index")
      ->capture_default_str()
      ->check(CLI::IsMember({"rgb"}));
  verb->add_option("--index-scope", flags->index_scope, "What gets an index of its own")
      ->capture_default_str()
      ->check(CLI::IsMember({"polygon", "object"}));
  verb->add_option("--index-step", flags->settings.index_step, "Step between indices in a channel")
      ->capture_default_str()
      ->check(CLI::Range(1, kMaxIndexStep));
  verb->add_flag("--light-facing", flags->settings.light_facing, "Shadow what faces away from the light");
  verb->add_flag("--layers", flags->settings.layers, "Write layers.exr with every intermediate value");
  verb->add_option("--camera", flags->camera, "Camera position")->type_name("X,Y,Z")->check(checked(check_point));
  verb->add_option("--look-at", flags->look_at, "Point that the camera looks at")
      ->type_name("X,Y,Z")
      ->check(checked(check_point));
  verb->add_option("--fov", flags->fov, "Vertical field of view")->type_name("DEGREES")->check(checked(check_fov));
  verb->add_option("--light", flags->light, "Light position")->type_name("X,Y,Z")->check(checked(check_point));
  verb->add_option("--floor", flags->floor, "auto, none, or the height of a floor")
      ->type_name("auto|none|HEIGHT")
      ->capture_default_str()
      ->check(checked(check_floor));
  verb->add_option("--cull", flags->cull, "Faces to leave out, in every pass")
      ->capture_default_str()
      ->check(CLI::IsMember({"none", "back", "front"}));
  verb->callback([flags, &exit_code] { exit_code = render(*flags); });
}

}  // namespace ninebit::tools
