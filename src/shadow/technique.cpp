#include "ninebit/shadow/technique.h"

#include <array>

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

const ProbedFragment* deciding_fragment(const ProbedPass& pass) {
  const ProbedFragment* decided = nullptr;
  for (const ProbedFragment& fragment : pass.fragments) {
    const bool outranked = decided != nullptr && decided->fate == FragmentFate::written;
    if (fragment.fate == FragmentFate::written || (fragment.depth_passes && !outranked)) decided = &fragment;
  }
  return decided;
}

const Technique* find_technique(std::string_view name) {
  for (const Technique& technique : kTechniques) {
    if (technique.name == name) return &technique;
  }
  return nullptr;
}

}  // namespace ninebit
