#include "src/tools/trace/trace_effect.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ninebit/effect/effect_json.h"
#include "src/tools/common/pixel_flag.h"
#include "src/tools/draw/draw_files.h"
#include "src/tools/input/file_kind.h"

namespace ninebit::tools {
namespace {

Result<Effect> effect_in(const std::string& file, bool allow_outside) {
  auto parsed = read_effect(file, {.allow_outside = allow_outside});
  if (parsed) return std::move(*parsed);
  const Diagnostic other = explained_by_kind({}, file, FileRole::effect);
  if (!other.message.empty()) return other;
  for (std::size_t i = 1; i < parsed.faults().size(); ++i) (void)report_fault(parsed.faults()[i]);
  const TextFault& first = parsed.faults()[0];
  return Diagnostic{.message = first.message, .file = first.file, .line = first.line};
}

}  // namespace

Result<TracedEffect> draw_pixel(const std::string& file, const std::string& pixel, bool allow_outside,
                                const CommonFlags& common, const HardwareProfile* given) {
  const ThreadLimit limit(common.threads);
  const auto effect = effect_in(file, allow_outside);
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
  auto renderer = EffectRenderer::make(*effect, *traced.profile, effect_readers(allow_outside, warnings),
                                       {.layers = false, .pixel = *at});
  if (!renderer) return renderer.error();
  Status drawn = renderer->draw([&](std::string_view pass, double done) { return line.step(pass, done); });
  if (!drawn) return drawn.error();
  traced.pixel = pixel_of_effect(*effect, *renderer, at->x, effect->height - 1 - at->y, file);
  return traced;
}

}  // namespace ninebit::tools
