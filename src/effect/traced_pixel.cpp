#include "src/effect/traced_pixel.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "ninebit/language/trace_json.h"

namespace ninebit {
namespace {

using AnswerJson = nlohmann::ordered_json;

// Adds the objects, and moves the fragments of the rectangle's passes behind the mesh's polygons.
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

bool has_written_fragment(const TracedPixel& pixel) {
  return std::any_of(pixel.passes.begin(), pixel.passes.end(), [](const ProbedPass& pass) {
    return std::any_of(pass.fragments.begin(), pass.fragments.end(),
                       [](const ProbedFragment& f) { return f.fate == FragmentFate::written; });
  });
}

AnswerJson pixel_answer(const TracedPixel& pixel) {
  AnswerJson passes = AnswerJson::array();
  for (const ProbedPass& pass : pixel.passes) {
    AnswerJson fragments = AnswerJson::array();
    for (const ProbedFragment& f : pass.fragments) {
      const std::uint32_t object = pixel.object_of[f.primitive];
      fragments.push_back({{"polygon", f.primitive + 1},
                           {"object", object + 1},
                           {"object_name", pixel.objects[object]},
                           {"depth", f.depth},
                           {"depth_met", f.stored_depth},
                           {"stencil_met", f.stored_stencil},
                           {"depth_passes", f.depth_passes},
                           {"fate", text_of_fate(f.fate)},
                           {"color", f.color}});
      if (!f.stages) continue;
      fragments.back()["depth_replaced"] = f.stages->depth.has_value();
      fragments.back()["stages"] = AnswerJson::parse(print_json_stages(*f.stages))["stages"];
    }
    passes.push_back({{"name", pass.name}, {"has_program", pass.program.has_value()}, {"fragments", fragments}});
  }
  return {{"file", pixel.file},
          {"technique", pixel.technique.empty() ? AnswerJson() : AnswerJson(pixel.technique)},
          {"pixel", {pixel.x, pixel.y}},
          {"state", pixel.state},
          {"passes", std::move(passes)},
          {"pass", pixel.pass ? AnswerJson(pixel.passes[*pixel.pass].name) : AnswerJson()},
          {"fragment", pixel.fragment ? AnswerJson(*pixel.fragment) : AnswerJson()}};
}

}  // namespace

std::string_view text_of_fate(FragmentFate fate) {
  switch (fate) {
    case FragmentFate::alpha_failed:
      return "alpha test failed";
    case FragmentFate::stencil_failed:
      return "stencil test failed";
    case FragmentFate::depth_failed:
      return "depth test failed";
    case FragmentFate::culled:
      return "culled by the texture shader";
    case FragmentFate::written:
      return "written";
  }
  return "";
}

TracedPixel pixel_of_effect(const Effect& effect, const EffectRenderer& renderer, int x, int y, std::string file) {
  TracedPixel out;
  out.x = x;
  out.y = y;
  out.file = std::move(file);
  out.size = std::to_string(effect.width) + "x" + std::to_string(effect.height);
  out.passes = renderer.probed();
  number_rectangles(effect, renderer.scene(), out);
  out.state = has_written_fragment(out) ? "drawn" : "not drawn";
  for (std::size_t i = 0; i < out.passes.size(); ++i) {
    if (out.passes[i].program && deciding_fragment(out.passes[i]) != nullptr) choose_pass(out, i);
  }
  return out;
}

bool choose_pass(TracedPixel& pixel, std::size_t pass) {
  const ProbedPass& chosen = pixel.passes[pass];
  const ProbedFragment* const decided = deciding_fragment(chosen);
  pixel.pass.reset();
  pixel.fragment.reset();
  if (decided == nullptr) return false;
  pixel.pass = pass;
  pixel.fragment = static_cast<std::size_t>(decided - chosen.fragments.data());
  return true;
}

AnswerJson trace_answer(const TraceHeading& heading, const Program* program, const Trace* traced) {
  AnswerJson out{{"command", "trace"}, {"version", NINEBIT_VERSION}, {"profile", heading.profile}};
  out["program"] = heading.program.empty() ? AnswerJson() : AnswerJson(heading.program);
  if (heading.pixel != nullptr) {
    out[heading.pixel->technique.empty() ? "effect" : "scene"] = pixel_answer(*heading.pixel);
  }
  if (heading.stages != nullptr) out["texture_shader"] = AnswerJson::parse(print_json_stages(*heading.stages));
  if (program != nullptr && traced != nullptr) out.update(AnswerJson::parse(print_json_trace(*program, *traced)));
  return out;
}

}  // namespace ninebit
