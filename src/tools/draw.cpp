// `ninebit draw`: one's own combiner program on textures and a mesh, or an effect of several passes.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <utility>

#include "ninebit/effect/effect_renderer.h"
#include "ninebit/image/image_io.h"
#include "ninebit/image/staged_files.h"
#include "ninebit/numerics/profile_fields.h"
#include "ninebit/shadow/picture_files.h"
#include "src/system/hashing/openssl.h"
#include "src/tools/common/given_pictures.h"
#include "src/tools/common/program_file.h"
#include "src/tools/draw/draw_files.h"
#include "src/tools/draw/draw_flags.h"
#include "src/tools/draw/draw_sizes.h"
#include "src/tools/input/host.h"

namespace ninebit::tools {
namespace {

using Clock = std::chrono::steady_clock;

// How two pictures differ: pixels with any difference, and the largest difference of a component.
struct Difference {
  std::uint64_t pixels = 0;
  int max = 0;
  Image8 image{};
};

// The result of `draw`.
struct Drawn {
  std::optional<EffectRenderer> renderer{};
  std::optional<Difference> difference{};
  std::vector<std::string> warnings{};
  std::vector<std::filesystem::path> files{};
  double load_ms = 0.0, draw_ms = 0.0, total_ms = 0.0;
};

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Calls visit(to, from, component): the place in an upright RGBA picture and in the surface's plane.
template <class Visit>
void for_each_sample(const Surface& surface, const Visit& visit) {
  const auto width = static_cast<std::size_t>(surface.width()), height = static_cast<std::size_t>(surface.height());
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      for (std::size_t c = 0; c < 4; ++c) visit(4 * (y * width + x) + c, (height - 1 - y) * width + x, c);
    }
  }
}

Image8 picture_of(const Surface& surface) {
  Image8 image{surface.width(), surface.height(), 4, {}};
  image.pixels.resize(surface.color(0).size() * 4);
  for_each_sample(surface, [&](std::size_t to, std::size_t from, std::size_t c) {
    image.pixels[to] = surface.color(static_cast<int>(c))[from];
  });
  return image;
}

// The picture of differences is grey: the largest of a pixel's four components, times 16.
Difference compare(const Surface& a, const Surface& b) {
  Difference out{.image = {a.width(), a.height(), 1, {}}};
  std::vector<int> largest(a.color(0).size());
  for_each_sample(a, [&](std::size_t to, std::size_t from, std::size_t c) {
    const int component = static_cast<int>(c);
    int& pixel = largest[to / 4];
    pixel = std::max(pixel, std::abs(int{a.color(component)[from]} - int{b.color(component)[from]}));
  });
  for (const int d : largest) {
    out.pixels += d != 0 ? 1U : 0U;
    out.max = std::max(out.max, d);
    out.image.pixels.push_back(static_cast<std::uint8_t>(std::min(16 * d, 255)));
  }
  return out;
}

Result<EffectRenderer> draw_under(const Effect& effect, const HardwareProfile& profile, const EffectReaders& readers,
                                  const EffectOptions& options, const Progress& progress) {
  auto renderer = EffectRenderer::make(effect, profile, readers, options);
  if (!renderer) return renderer;
  if (Status drawn = renderer->draw(progress); !drawn) return drawn.error();
  return renderer;
}

bool is_arithmetic(const ProfileChoice& difference) {
  return !difference.own_profile && difference.name == kArithmetic;  // a profile of one's own may have that name
}

// Draws the effect and, with --difference, once more under the other profile.
Status draw_all(const DrawFlags& flags, bool is_effect, const HardwareProfile& profile, Effect& effect, Drawn& done) {
  ProgressLine line(flags.common.quiet);
  const auto progress = [&](std::string_view pass, double share) { return line.step(pass, 0.9 * share); };
  line.step("loading", 0.0);
  const auto start = Clock::now();
  const EffectReaders readers = effect_readers(flags.allow_outside, flags.defines, done.warnings);
  if (!is_effect) keep_sizes(flags, profile, readers, effect, done.warnings);
  auto renderer = EffectRenderer::make(effect, profile, readers, {.layers = flags.layers});
  if (!renderer) return renderer.error();
  done.load_ms = milliseconds_since(start);
  const auto loaded = Clock::now();
  if (Status drawn = renderer->draw(progress); !drawn) return drawn;
  done.draw_ms = milliseconds_since(loaded);
  done.warnings.insert(done.warnings.end(), renderer->warnings().begin(), renderer->warnings().end());
  done.renderer.emplace(std::move(*renderer));
  if (flags.difference.name.empty()) return {};
  std::vector<std::string> again;
  const HardwareProfile rival =
      is_arithmetic(flags.difference) ? with_exact_combiners(profile) : profile_of(flags.difference);
  const auto other = draw_under(effect, rival, effect_readers(flags.allow_outside, flags.defines, again), {}, progress);
  if (!other) return other.error();
  done.difference = compare(done.renderer->picture(), other->picture());
  return {};
}

Status write_files(const DrawFlags& flags, Drawn& done) {
  const std::filesystem::path output(flags.output);
  auto files = StagedFiles::open(output.parent_path());
  if (!files) return files.error();
  // "picture.difference.png" beside "picture.png"; the folder is named as it was given.
  const auto stage = [&](const char* ending) {
    done.files.push_back(std::filesystem::path(output).replace_filename(output.stem().string() + ending));
    return files->stage(done.files.back().filename().string());
  };
  Status s;
  if (writes(flags, "picture")) s = write_png(stage(".png"), picture_of(done.renderer->picture()));
  if (s && done.difference && writes(flags, "difference")) {
    s = write_png(stage(".difference.png"), done.difference->image);
  }
  if (s && flags.layers && writes(flags, "layers")) s = write_layers(done.renderer->layers(), stage(".layers.exr"));
  if (!s) {
    Diagnostic fault = s.error();
    fault.file = done.files.back().string();
    return fault;
  }
  return files->commit();
}

std::string color_hash(const Surface& surface, int first, int last) {
  Sha256 hash;
  for (int c = first; c <= last; ++c) hash.add(surface.color(c));
  return hash.finish();
}

Json draw_json(const DrawFlags& flags, const Effect& effect, const HardwareProfile& profile, bool is_effect,
               const Drawn& done) {
  const Surface& picture = done.renderer->picture();
  Json files = Json::array(), passes = Json::array();
  for (const auto& file : done.files) files.push_back(file.string());
  for (std::size_t i = 0; i < effect.passes.size(); ++i) {
    passes.push_back({{"name", effect.passes[i].name}, {"time_ms", done.renderer->pass_times()[i]}});
  }
  Json out{{"command", "draw"}, {"version", NINEBIT_VERSION}, {is_effect ? "effect" : "program", flags.file}};
  out["profile"] = profile.name;
  out["size"] = {picture.width(), picture.height()};
  out["passes"] = std::move(passes);
  out["warnings"] = done.warnings;
  out["time_ms"] = {{"load", done.load_ms}, {"draw", done.draw_ms}, {"total", done.total_ms}};
  out["files"] = std::move(files);
  out["hash"] = {{"color", color_hash(picture, 0, 3)}};
  if (!picture.stencil().empty()) {
    Sha256 stencil;
    stencil.add(picture.stencil());
    out["hash"]["stencil"] = stencil.finish();
  }
  if (done.difference) out["difference"] = {{"pixels", done.difference->pixels}, {"max", done.difference->max}};
  return out;
}

int print_answer(const DrawFlags& flags, const Effect& effect, const HardwareProfile& profile, bool is_effect,
                 const Drawn& done) {
  for (const std::string& warning : done.warnings) say_warning(warning);
  if (!flags.common.quiet) {
    for (const auto& file : done.files) say_written(file);
  }
  if (flags.common.json) return answer(draw_json(flags, effect, profile, is_effect, done));
  std::string text =
      fmt::format("{} pass{}, {:.0f} ms\n", effect.passes.size(), effect.passes.size() == 1 ? "" : "es", done.total_ms);
  if (done.difference) {
    text +=
        fmt::format("{} pixels differ {}, by {} at most\n", done.difference->pixels,
                    is_arithmetic(flags.difference) ? "with exact combiners" : "under profile " + flags.difference.name,
                    done.difference->max);
  }
  return answer(text);
}

int draw(const DrawFlags& flags) {
  const auto start = Clock::now();
  const ThreadLimit limit(flags.common.threads);
  if (flags.output.empty() && !flags.only.empty())
    return wrong_usage("draw", "--only names files; expected it with --output");
  if (!flags.output.empty() && std::filesystem::path(flags.output).extension() != ".png") {
    return wrong_usage("draw", fmt::format("--output {}: expected a file whose name ends in .png", flags.output));
  }
  if (Status checked = check_files(flags); !checked) return wrong_usage("draw", checked.error().message);
  DrawnFile file = read_effect_file(flags.file, {.allow_outside = flags.allow_outside, .moment = flags.moment});
  if (file.exit_code != kDone) return file.exit_code;
  const bool is_effect = file.effect.has_value();
  Drawn done;
  if (is_effect) {
    if (Status changed = override_effect(flags, *file.effect); !changed)
      return wrong_usage("draw", changed.error().message);
    done.warnings = unused_moment(flags.moment_options, file.effect->moves, flags.file);
    if (!file.file.note().empty()) done.warnings.push_back(file.file.note());
  } else {
    for (const CLI::Option* const option : flags.moment_options) {
      if (option->count() == 0) continue;
      return wrong_usage("draw", fmt::format("{} {} has no effect with a program; expected an effect file",
                                             option->get_name(), option->results()[0]));
    }
    auto effect = effect_of(flags);
    if (!effect) return wrong_usage("draw", effect.error().message);
    file.effect.emplace(std::move(*effect));
  }
  const auto profile =
      effect_profile(*file.effect, flags.file, flags.profile->count() != 0 ? &profile_of(flags.common) : nullptr);
  if (!profile) return report(profile.error());
  const HardwareProfile& chosen = *profile != nullptr ? **profile : profile_of(flags.common);
  if (Status drawn = draw_all(flags, is_effect, chosen, *file.effect, done); !drawn) {
    Diagnostic fault = drawn.error();
    if (fault.file.empty() && is_effect) fault.file = flags.file;
    return report(fault);
  }
  if (!flags.output.empty()) {
    if (Status written = write_files(flags, done); !written) return report(written.error());
  }
  done.total_ms = milliseconds_since(start);
  for (std::string& warning : done.warnings) warning = with_shown_names(std::move(warning));
  const int printed = print_answer(flags, *file.effect, chosen, is_effect, done);
  give_surface(done.renderer->picture());
  if (done.difference) give_picture("difference", std::move(done.difference->image));
  give_layers(done.renderer->layers());
  return printed;
}

}  // namespace

void add_draw(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("draw", "Draw a combiner program on textures and a mesh, or an effect");
  verb->footer(
      "Without --mesh, a rectangle fills the picture. Sources of coordinates: uv, screen, projected, position,\n"
      "from-light, light-vector, view-vector, half-vector, normal, reflection, tangent-light-vector,\n"
      "tangent-half-vector, point-sprite, constant:S,T[,R[,Q]]. Sources of colours: the vectors, range-compressed, and "
      "color, "
      "secondary-color, lambert,\n"
      "index[:FORMAT,STEP], constant:R,G,B[,A].\n"
      "Examples:\n"
      "  ninebit draw dot3.gl --tex0 normals:bricks.png --primary tangent-light-vector -o bricks.png\n"
      "  ninebit draw dot3.gl --mesh sphere:96 --tex0 normals:bricks.png --primary tangent-light-vector -o ball.png\n"
      "  ninebit draw scenes/effects/index_cube.json -o room.png");
  auto flags = std::make_shared<DrawFlags>();
  add_common_flags(*verb, flags->common);
  flags->profile = verb->get_option("--profile");
  verb->add_option("program", flags->file, "Program in any form, an effect file, or a ZIP archive with one")
      ->required()
      ->type_name("PROGRAM|EFFECT.json");
  verb->add_option("-o,--output", flags->output, "Picture to write")
      ->required(host() == nullptr)
      ->type_name("FILE.png");
  add_define_flag(*verb, flags->defines);
  add_draw_flags(*verb, *flags);
  verb->callback([flags, &exit_code] { exit_code = draw(*flags); });
}

}  // namespace ninebit::tools
