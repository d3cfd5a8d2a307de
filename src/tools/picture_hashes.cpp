#include "src/tools/picture_hashes.h"

#include <map>
#include <variant>

#include "src/study/sha256.h"

namespace ninebit::tools {

std::vector<std::pair<std::string, std::string>> picture_hashes(const Rendering& rendering) {
  Sha256 color, stencil, index_map;
  for (int c = 0; c < 4; ++c) color.add(rendering.frame.color(c));
  stencil.add(rendering.frame.stencil());
  for (const IndexMapFace& face : rendering.index_map) {
    for (const auto& plane : face.color) index_map.add(plane);
  }
  std::vector<std::pair<std::string, std::string>> out{{"color", color.finish()}, {"stencil", stencil.finish()}};
  if (!rendering.index_map.empty()) out.emplace_back("index_map", index_map.finish());
  std::map<std::string, Sha256> maps;  // all planes of one name together
  for (const Layer& map : rendering.maps) {
    std::visit([&](const auto& samples) { maps[map.part].add(samples); }, map.samples);
  }
  for (auto& [name, hash] : maps) out.emplace_back(name, hash.finish());
  return out;
}

}  // namespace ninebit::tools
