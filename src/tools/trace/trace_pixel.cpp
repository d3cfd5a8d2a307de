#include "src/tools/trace/trace_pixel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "ninebit/effect/effect_json.h"
#include "ninebit/language/trace_json.h"
#include "src/tools/common/flag_values.h"
#include "src/tools/common/scene_textures.h"
#include "src/tools/draw/draw_files.h"
#include "src/tools/input/file_kind.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {

namespace {

std::string state_of(const Surface& frame, const glm::ivec2& pixel) {
  const std::size_t at =
      static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(frame.width()) + static_cast<std::size_t>(pixel.x);
  if (frame.depth()[at] == max_depth(frame.format())) return "background";
  return frame.stencil()[at] == 0 ? "lit" : "shadowed";
}

// Without a program there is nothing to trace in the pass.
void choose(std::size_t pass, bool other_program, TracedPixel& pixel) {
  choose_pass(pixel, pass);
  pixel.pass = pass;
  if (!pixel.passes[pass].program && !other_program) pixel.fragment.reset();
}

}  // namespace

Status choose_pass_named(const std::string& name, bool other_program, TracedPixel& pixel) {
  std::string names;
  for (std::size_t i = 0; i < pixel.passes.size(); ++i) {
    if (pixel.passes[i].name == name) {
      choose(i, other_program, pixel);
      return {};
    }
    names += (names.empty() ? "one of " : ", ") + pixel.passes[i].name;
  }
  return Diagnostic{.message = fmt::format("--pass {}: there is no such pass; expected {}", printable(name),
                                           names.empty() ? "none, as nothing was drawn at the pixel" : names)};
}

Status render_pixels(const SceneFlags& flags, const Scene& scene, RenderSettings settings, const GroundTruthScene* rays,
                     bool other_program, const Progress& progress, const std::function<void(RenderedPixel)>& take) {
  settings.evidence = rays != nullptr;
  auto rendering = render_scene(flags, scene, settings, progress);
  if (!rendering) return rendering.error();
  for (std::size_t i = 0; i < settings.pixels.size(); ++i) {
    const glm::ivec2& at = settings.pixels[i];
    RenderedPixel out;
    TracedPixel& pixel = out.traced;
    pixel.x = at.x;
    pixel.y = settings.height - 1 - at.y;
    pixel.file = flags.file;
    pixel.technique = flags.technique;
    pixel.size = fmt::format("{}x{}", settings.width, settings.height);
    pixel.state = state_of(rendering->frame, at);
    pixel.passes = rendering->probed[i];
    pixel.index_order = rendering->index_order;
    for (const SceneObject& object : scene.objects) pixel.objects.push_back(object.name);
    pixel.object_of = scene.triangle_object;
    if (const ProbedPass* const decided = deciding_pass(*rendering, i)) {
      choose(static_cast<std::size_t>(decided - rendering->probed[i].data()), other_program, pixel);
    }
    if (rays != nullptr) {
      const auto judged = judge_pixel(*rays, settings, *rendering, at.x, at.y);
      if (!judged) return judged.error();
      out.truth = *judged;
    }
    take(std::move(out));
  }
  return {};
}

Result<RenderedPixel> load_pixel(const SceneFlags& flags, const CommonFlags& common, bool ground_truth,
                                 const glm::ivec2& pixel, bool other_program) {
  const ThreadLimit limit(common.threads);
  RenderSettings settings = settings_of(flags, common);
  settings.pixels = {pixel};
  ProgressLine line(common.quiet);
  line.step("loading", 0.0);
  const auto loaded = load_drawn_scene(flags, settings);
  if (!loaded) return loaded.error();
  warn_of_ignored(flags.file, loaded->ignored);
  std::optional<GroundTruthScene> rays;
  if (ground_truth) {
    auto made = GroundTruthScene::make(loaded->scene);
    if (!made) return made.error();
    rays.emplace(std::move(*made));
  }
  const auto step = [&](std::string_view pass, double done) { return line.step(pass, 0.1 + 0.9 * done); };
  RenderedPixel found;
  const Status rendered = render_pixels(flags, loaded->scene, settings, rays ? &*rays : nullptr, other_program, step,
                                        [&](RenderedPixel one) { found = std::move(one); });
  if (!rendered) return rendered.error();
  return found;
}

namespace {

std::string polygon_text(const TracedPixel& pixel, std::uint32_t polygon) {
  const std::uint32_t object = pixel.object_of[polygon];
  return fmt::format("polygon {} of object {} '{}'", polygon + 1, object + 1, printable(pixel.objects[object]));
}

// Why a pixel that should be in shadow is so.
std::string shadow_text(const TracedPixel& pixel, const JudgedPixel& truth) {
  if (truth.occluder) return polygon_text(pixel, *truth.occluder) + " lies between it and the light";
  return truth.turned_away ? "its polygon faces away from the light" : "the spot light does not reach it";
}

// The rules are in docs/techniques/ground-truth.md.
std::string cause_text(const TracedPixel& pixel, const JudgedPixel& truth) {
  const std::string fetched =
      truth.fetched ? polygon_text(pixel, *truth.fetched) : std::string("no polygon: the map was cleared there");
  switch (truth.cause) {
    case ErrorCause::truncation:
      return fmt::format("its texel names {}, and the two indices are different, but compare equal", fetched);
    case ErrorCause::joint:
      return fmt::format("its texel names {}, a neighbour on the same surface", fetched);
    case ErrorCause::vanished:
      return "its polygon owns no texel of the map";
    case ErrorCause::shared:
      return "the polygon that casts the shadow has the same index";
    case ErrorCause::acne:
      return fmt::format("its texel holds {}, the same surface, which shadows it", fetched);
    case ErrorCause::detached:
      return fmt::format("its texel holds {}, which casts the shadow, but the comparison lets light through", fetched);
    case ErrorCause::sampling:
      return fmt::format("its texel holds {}: the texel's centre does not see what the pixel's ray sees", fetched);
    case ErrorCause::none:
      break;
  }
  return {};
}

}  // namespace

std::string truth_text(const TracedPixel& pixel, const JudgedPixel& truth) {
  if (truth.truth == PixelTruth::background) return "truth: background\n";
  const bool shadowed = truth.truth == PixelTruth::shadowed;
  std::string text = fmt::format("truth: {}, as {}\n", shadowed ? "shadowed" : "lit",
                                 shadowed ? shadow_text(pixel, truth) : "nothing lies between it and the light");
  if (truth.cause == ErrorCause::none) return text + "the pixel is right\n";
  return text + fmt::format("the pixel is wrong ({}): {}\n", name_of(truth.cause), cause_text(pixel, truth));
}

Json truth_json(const JudgedPixel& truth) {
  constexpr std::array<const char*, 3> states{"background", "lit", "shadowed"};
  const auto number = [](std::optional<std::uint32_t> polygon) { return polygon ? Json(*polygon + 1) : Json(); };
  return {{"state", states[static_cast<std::size_t>(truth.truth)]},
          {"cause", name_of(truth.cause)},
          {"polygon", number(truth.shown)},
          {"fetched", number(truth.fetched)},
          {"occluder", number(truth.occluder)}};
}

std::string fragment_text(const TracedPixel& pixel, const ProbedFragment& f) {
  return fmt::format("{}: depth {}{} against stored {}, {}", polygon_text(pixel, f.primitive), f.depth,
                     f.stages && f.stages->depth ? " (replaced)" : "", f.stored_depth, text_of_fate(f.fate));
}

std::string stages_text(const TextureShaderResult& result) {
  std::string text;
  for (std::size_t i = 0; i < result.stage.size(); ++i) {
    text += fmt::format("  texture stage {}: {}\n", i, stage_text(result.stage[i]));
  }
  if (result.is_culled) text += "  the fragment is culled\n";
  if (result.depth) text += fmt::format("  its depth becomes {}\n", *result.depth);
  return text;
}

std::string pixel_text(const TracedPixel& pixel) {
  const std::string technique = pixel.technique.empty() ? "" : fmt::format("technique {}, ", pixel.technique);
  std::string text = fmt::format("pixel {},{} of {}, {}size {}: {}\n", pixel.x, pixel.y, printable(pixel.file),
                                 technique, pixel.size, pixel.state);
  for (const ProbedPass& pass : pixel.passes) {
    const auto written = std::count_if(pass.fragments.begin(), pass.fragments.end(),
                                       [](const ProbedFragment& f) { return f.fate == FragmentFate::written; });
    text += fmt::format("  pass {}: {} fragment{}, {} written\n", pass.name, pass.fragments.size(),
                        pass.fragments.size() == 1 ? "" : "s", written);
  }
  if (pixel.fragment) {
    const ProbedPass& pass = pixel.passes[*pixel.pass];
    const ProbedFragment& fragment = pass.fragments[*pixel.fragment];
    text += fmt::format("traced: pass {}, {}\n", pass.name, fragment_text(pixel, fragment));
    return fragment.stages ? text + stages_text(*fragment.stages) : text;
  }
  if (pixel.state == "background" || pixel.state == "not drawn") {
    return text + fmt::format("{}: no fragment to trace\n", pixel.state);
  }
  for (const ProbedPass& pass : pixel.passes) {
    if (const ProbedFragment* f = deciding_fragment(pass)) {
      text += fmt::format("pass {}{}: {}\n", pass.name, pass.program ? "" : ", which has no program",
                          fragment_text(pixel, *f));
    }
  }
  if (pixel.pass)
    return text + fmt::format("pass {} decided, without a program: nothing to trace\n", pixel.passes[*pixel.pass].name);
  return text + "no pass with a program drew a visible fragment: nothing to trace\n";
}

namespace {

Result<Effect> effect_in(const std::string& file, const EffectReadOptions& options) {
  auto parsed = read_effect(file, options);
  if (parsed) return std::move(*parsed);
  const Diagnostic other = explained_by_kind({}, file, FileRole::effect);
  if (!other.message.empty()) return other;
  for (std::size_t i = 1; i < parsed.faults().size(); ++i) (void)report_fault(parsed.faults()[i]);
  const TextFault& first = parsed.faults()[0];
  return Diagnostic{.message = first.message, .file = first.file, .line = first.line};
}

}  // namespace

Result<TracedEffect> draw_pixel(const std::string& file, const std::string& pixel, const EffectReadOptions& options,
                                const CommonFlags& common, const HardwareProfile* given,
                                const std::vector<std::string>& defines) {
  const ThreadLimit limit(common.threads);
  const auto opened = EffectFile::open(file);
  if (!opened) return opened.error();
  if (!opened->note().empty()) say_warning(opened->note());
  const auto effect = effect_in(opened->path(), options);
  if (!effect) return effect.error();
  const auto chosen = effect_profile(*effect, file, given);
  if (!chosen) return chosen.error();
  TracedEffect traced{
      .pixel = {}, .profile = *chosen != nullptr ? *chosen : &profile_of(common), .moves = effect->moves};
  RenderSettings size;
  size.width = effect->width;
  size.height = effect->height;
  const auto at = window_pixel("--pixel", pixel, size);
  if (!at) return at.error();
  ProgressLine line(common.quiet);
  line.step("loading", 0.0);
  std::vector<std::string> warnings;
  auto renderer =
      EffectRenderer::make(*effect, *traced.profile, effect_readers(options.allow_outside, defines, warnings),
                           {.layers = false, .pixel = *at});
  if (!renderer) return renderer.error();
  Status drawn = renderer->draw([&](std::string_view pass, double done) { return line.step(pass, done); });
  if (!drawn) return drawn.error();
  traced.pixel = pixel_of_effect(*effect, *renderer, at->x, effect->height - 1 - at->y, file);
  return traced;
}

}  // namespace ninebit::tools
