// The technique's outputs: maps, pictures and facts.
#include <algorithm>
#include <string>
#include <utility>

#include "src/frame/cube_cross.h"
#include "src/frame/drawn_passes.h"
#include "src/shadow/depth_cube/depth_cube_renderer.h"

namespace ninebit {

void DepthCubeRenderer::finish() {
  frame_.finish();
  add_picture();
  add_facts();
  keep_maps();
}

// Shows the map in grey, near surfaces dark: the luminance, the high byte, or the distance divided by the far plane's.
void DepthCubeRenderer::add_picture() {
  const auto grey = [this](std::size_t face, std::size_t texel) -> std::array<std::uint8_t, 3> {
    std::uint8_t level = 255;
    if (uses_floats()) {
      const float part = faces_[face].distance[texel] / range_.far_plane;
      level = static_cast<std::uint8_t>(std::min(part, 1.0F) * 255.0F);
    } else {
      level = code_.code_bits == 16 ? faces_[face].alpha[texel] : faces_[face].luminance[texel];
    }
    return {level, level, level};
  };
  rendering().pictures.push_back({"depth_cube.png", cube_cross(settings().map_size, grey)});
}

void DepthCubeRenderer::keep_maps() {
  const int size = settings().map_size;
  for (std::size_t f = 0; f < 6; ++f) {
    Layer& layer = rendering().maps.emplace_back(Layer{"depth_cube", kCubeFaceNames[f], size, size, {}});
    Face& face = faces_[f];
    if (uses_floats()) {
      layer.samples = std::move(face.distance);
    } else if (code_.code_bits == 8) {
      layer.samples = std::move(face.luminance);
    } else {
      auto& codes = layer.samples.emplace<std::vector<std::uint32_t>>(face.luminance.size());
      for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = face.alpha[i] * 256U + face.luminance[i];
    }
  }
}

void DepthCubeRenderer::add_facts() {
  std::vector<Fact>& facts = rendering().facts;
  facts.push_back({"depth_bits", uses_floats() ? std::string("float") : std::to_string(code_.code_bits)});
  if (uses_floats()) {
    facts.push_back({"bias", double{bias_}});
  } else {
    facts.push_back({"distance_near", double{code_.low}});
    facts.push_back({"distance_far", double{code_.high}});
    facts.push_back({"distance_step", code_.code_step()});
    facts.push_back({"bias", code_.bias()});
  }
  int units = 0, stages = 0;
  for (const DepthCubeComparison& comparison : passes_.comparisons) {
    units = std::max(units, texture_units_read(*comparison.state.program));
    stages = std::max(stages, comparison.state.program->num_general_combiners);
  }
  facts.push_back({"comparison_passes", std::uint64_t{passes_.comparisons.size() * faces_.size()}});
  facts.push_back({"texture_units", static_cast<std::uint64_t>(units)});
  facts.push_back({"general_combiners", static_cast<std::uint64_t>(stages)});
}

}  // namespace ninebit
