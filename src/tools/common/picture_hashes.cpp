#include "src/tools/common/picture_hashes.h"

#include <map>
#include <variant>
#include <vector>

#include "src/system/hashing/openssl.h"

namespace ninebit::tools {
namespace {

std::vector<std::uint8_t> samples_of(const IndexMapFace& face, int component) {
  const Plane<const std::uint8_t> plane = face.plane(component);
  std::vector<std::uint8_t> samples;
  samples.reserve(face.texels());
  for (int y = 0; y < face.size; ++y) {
    for (int x = 0; x < face.size; ++x) samples.push_back(plane.at(x, y));
  }
  return samples;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> picture_hashes(const Rendering& rendering) {
  Sha256 color, stencil, index_map;
  for (int c = 0; c < 4; ++c) color.add(rendering.frame.color(c));
  stencil.add(rendering.frame.stencil());
  for (const IndexMapFace& face : rendering.index_map) {
    for (int c = 0; c < 4; ++c) {
      if (face.plane(c)) index_map.add(samples_of(face, c));
    }
  }
  std::vector<std::pair<std::string, std::string>> out{{"color", color.finish()}, {"stencil", stencil.finish()}};
  if (!rendering.index_map.empty()) out.emplace_back("index_map", index_map.finish());
  std::map<std::string, Sha256> maps;  // of all planes of a name
  for (const Layer& map : rendering.maps) {
    std::visit([&](const auto& samples) { maps[map.part].add(samples); }, map.samples);
  }
  for (auto& [name, hash] : maps) out.emplace_back(name, hash.finish());
  return out;
}

}  // namespace ninebit::tools
