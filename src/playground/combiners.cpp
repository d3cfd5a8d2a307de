// Records the inputs and results of a pass's combiners, for another machine that computes the same.
#include <algorithm>
#include <utility>

#include "ninebit/language/glsl.h"
#include "src/playground/drawing.h"

namespace ninebit::playground {
namespace {

// Each pixel has 69 bytes.
constexpr std::size_t kMostRecordedPixels = std::size_t{1} << 20;

// Codes as pairs of bytes, the low one first; four components a pixel, rows from the lowest.
void append_codes(const std::array<std::vector<s9>, 4>& planes, std::vector<std::uint8_t>& bytes) {
  for (std::size_t i = 0; i < planes[0].size(); ++i) {
    for (const std::vector<s9>& plane : planes) {
      const auto code = static_cast<std::uint16_t>(plane[i]);
      bytes.push_back(static_cast<std::uint8_t>(code & 255U));
      bytes.push_back(static_cast<std::uint8_t>(code >> 8U));
    }
  }
}

// The pixels of the pass's target.
std::size_t pixels_of_pass(const Effect& effect, const EffectPass& pass) {
  int width = effect.width, height = effect.height;
  for (const EffectTarget& target : effect.targets) {
    if (target.name != pass.target) continue;
    width = target.width * sample_columns(target.samples);
    height = target.height * sample_rows(target.samples);
  }
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

}  // namespace

Reply Engine::combiners(Request& request) {
  request.allow({"effect", "files", "choices", "profile", "size", "name", "time", "frame", "pass"});
  RequestedEffect asked = requested_effect(request);
  if (asked.refused) return *asked.refused;
  const auto& passes = asked.what.effect.passes;
  const int pass = request.number("pass", 0, static_cast<int>(passes.size()) - 1);
  if (request.failed()) return request.refused();
  if (auto refused = choose_drawn_profile(request, asked.what)) return *refused;
  const EffectPass& chosen = passes[static_cast<std::size_t>(pass)];
  if (chosen.program.empty()) return refusal("pass " + json::in_quotes(chosen.name) + " has no program");
  if (const std::size_t pixels = pixels_of_pass(asked.what.effect, chosen); pixels > kMostRecordedPixels) {
    return refusal("the pass draws " + std::to_string(pixels) + " pixels; at most " +
                   std::to_string(kMostRecordedPixels) + " are recorded");
  }
  KeptDrawing own;
  const Drawn drawn = draw_effect(asked.what, shelf_, {.recorded_pass = static_cast<std::size_t>(pass)}, own);
  if (drawn.refused) return *drawn.refused;
  const CombinerRecord& record = own.renderer->recorded();
  const auto glsl = emit_glsl(*record.program, GlslVersion::es_300);
  if (!glsl) return refusal(glsl.error());
  Json names = Json::array();
  for (const Register reg : kRecordedRegisters) names.push_back(short_name(reg));
  for (const auto& planes : record.inputs) append_codes(planes, bytes_);
  for (std::size_t i = 0; i < record.drawn.size(); ++i) {
    for (const auto& plane : record.output) bytes_.push_back(plane[i]);
  }
  for (const bool there : record.drawn) bytes_.push_back(there ? 1 : 0);
  Json out{{"width", record.width}, {"height", record.height}, {"registers", std::move(names)}};
  out["pass"] = chosen.name;
  out["glsl"] = *glsl;
  out["byte_shift"] = asked.what.profile.profile().byte_shift.value;
  out["drawn"] = std::count(record.drawn.begin(), record.drawn.end(), true);
  out["bytes"] = bytes_.size();
  return out;
}

}  // namespace ninebit::playground
