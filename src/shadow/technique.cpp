#include "ninebit/shadow/technique.h"

#include <algorithm>
#include <array>
#include <vector>

#include "ninebit/shadow/depth_cube.h"
#include "ninebit/shadow/index_cube.h"
#include "ninebit/shadow/light_cookie.h"
#include "ninebit/shadow/reflective.h"
#include "ninebit/shadow/shadow_map.h"
#include "ninebit/shadow/shadow_volume.h"

namespace ninebit {
namespace {

constexpr std::array kTechniques{
    Technique{"index-cube",
              "index cube shadow mapping: polygon indices compared by two general combiners",
              {.point = true},
              &render_index_cube},
    Technique{"depth-cube",
              "depth cube shadow mapping: distances to the light, compared in one or two passes a cube-map face",
              {.point = true},
              &render_depth_cube},
    Technique{"shadow-map",
              "projective shadow map: depth from the light, drawn with a polygon offset",
              {.point = false, .spot = true, .directional = true},
              &render_shadow_map},
    Technique{"shadow-volume",
              "shadow volumes: infinite volumes of the silhouettes, counted in the stencil buffer",
              {.point = true, .spot = true, .directional = true},
              &render_shadow_volume},
    Technique{"reflective",
              "reflective shadow maps: one bounce of diffuse light gathered from what the light sees",
              {.point = false, .spot = true, .directional = true},
              &render_reflective},
    Technique{"light-cookie",
              "a point light that shines as a cube map says, with index cube shadows or without",
              {.point = true},
              &render_light_cookie},
};

}  // namespace

std::span<const Technique> techniques() {
  return kTechniques;
}

const ProbedPass* deciding_pass(const Rendering& rendering, std::size_t number) {
  if (number >= rendering.probed.size()) return nullptr;
  const std::vector<ProbedPass>& passes = rendering.probed[number];
  const ProbedPass *changed = nullptr, *judged = nullptr, *written = nullptr;
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const ProbedFragment* const fragment = deciding_fragment(passes[i]);
    const auto drawn = std::find_if(rendering.drawn.begin(), rendering.drawn.end(),
                                    [&](const DrawnPass& pass) { return pass.name == passes[i].name; });
    if (drawn == rendering.drawn.end() || !drawn->marks_shadows) {
      if (fragment != nullptr && fragment->fate == FragmentFate::written) written = &passes[i];
      continue;
    }
    if (fragment != nullptr) judged = &passes[i];
    if (i + 1 < passes.size() && passes[i + 1].stencil != passes[i].stencil) changed = &passes[i];
  }
  if (written == nullptr) return nullptr;  // the background, where volumes may reach
  return changed != nullptr ? changed : judged != nullptr ? judged : written;
}

const Technique* find_technique(std::string_view name) {
  for (const Technique& technique : kTechniques) {
    if (technique.name == name) return &technique;
  }
  return nullptr;
}

}  // namespace ninebit
