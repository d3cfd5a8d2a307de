#include "src/tools/trace/trace_effect.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ninebit/effect/effect_json.h"
#include "src/tools/common/pixel_flag.h"
#include "src/tools/draw/draw_files.h"

namespace ninebit::tools {
namespace {

Result<Effect> effect_in(const std::string& file) {
  auto parsed = read_effect(file);
  if (parsed) return std::move(*parsed.value);
  for (std::size_t i = 1; i < parsed.faults.size(); ++i) say_error(parsed.faults[i].text());
  const TextFault& first = parsed.faults[0];
  return Diagnostic{.message = first.message, .file = first.file, .line = first.line};
}

// Moves the fragments of the rectangle's passes behind the mesh's polygons.
void number_rectangles(const Effect& effect, const Scene& scene, TracedPixel& pixel) {
  const bool has_mesh = !effect.scene.mesh.empty();
  const auto first = static_cast<std::uint32_t>(has_mesh ? scene.triangles.size() : 0);
  if (has_mesh) {
    for (const SceneObject& object : scene.objects) pixel.objects.push_back(object.name);
    pixel.object_of = scene.triangle_object;
  }
  pixel.object_of.insert(pixel.object_of.end(), 2, static_cast<std::uint32_t>(pixel.objects.size()));
  pixel.objects.emplace_back("rectangle");
  for (ProbedPass& pass : pixel.passes) {
    const auto from = std::find_if(effect.passes.begin(), effect.passes.end(),
                                   [&](const EffectPass& p) { return p.name == pass.name; });
    if (from->geometry == EffectGeometry::mesh) continue;
    for (ProbedFragment& fragment : pass.fragments) fragment.primitive += first;
  }
}

bool is_drawn(const TracedPixel& pixel) {
  return std::any_of(pixel.passes.begin(), pixel.passes.end(), [](const ProbedPass& pass) {
    return std::any_of(pass.fragments.begin(), pass.fragments.end(),
                       [](const ProbedFragment& f) { return f.fate == FragmentFate::written; });
  });
}

}  // namespace

Result<TracedEffect> draw_pixel(const std::string& file, const std::string& pixel, const CommonFlags& common,
                                const HardwareProfile* given) {
  const ThreadLimit limit(common.threads);
  const auto effect = effect_in(file);
  if (!effect) return effect.error();
  const auto chosen = effect_profile(*effect, file, given);
  if (!chosen) return chosen.error();
  TracedEffect traced{.pixel = {}, .profile = *chosen != nullptr ? *chosen : &profile_of(common)};
  RenderSettings size;
  size.width = effect->width;
  size.height = effect->height;
  const auto at = window_pixel("--pixel", pixel, size);
  if (!at) return at.error();
  ProgressLine line(common.quiet);
  line.step("loading", 0.0);
  std::vector<std::string> warnings;
  auto renderer =
      EffectRenderer::make(*effect, *traced.profile, effect_readers(false, warnings), {.layers = false, .pixel = *at});
  if (!renderer) return renderer.error();
  Status drawn = renderer->draw([&](std::string_view pass, double done) { return line.step(pass, done); });
  if (!drawn) return drawn.error();
  TracedPixel& out = traced.pixel;
  out.x = at->x;
  out.y = effect->height - 1 - at->y;
  out.file = file;
  out.size = fmt::format("{}x{}", effect->width, effect->height);
  out.passes = renderer->probed();
  number_rectangles(*effect, renderer->scene(), out);
  out.state = is_drawn(out) ? "drawn" : "not drawn";
  choose_fragment(out, false);
  return traced;
}

}  // namespace ninebit::tools
