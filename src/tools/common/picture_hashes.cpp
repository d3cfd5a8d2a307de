#include "src/tools/common/picture_hashes.h"

#include <map>
#include <variant>
#include <vector>

#include "src/system/hashing/openssl.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit::tools {
namespace {

std::vector<std::uint8_t> samples_of(const IndexMapFace& face, int component) {
  const Plane<const std::uint8_t> plane = face.plane(component);  // rows without gaps
  std::vector<std::uint8_t> samples(face.texels());
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = plane.data[static_cast<std::ptrdiff_t>(i) * plane.step];
  return samples;
}

std::string color_hash(const Rendering& rendering) {
  Sha256 hash;
  for (int c = 0; c < 4; ++c) hash.add(rendering.frame.color(c));
  return hash.finish();
}

std::string stencil_hash(const Rendering& rendering) {
  Sha256 hash;
  hash.add(rendering.frame.stencil());
  return hash.finish();
}

std::string index_map_hash(const Rendering& rendering) {
  Sha256 hash;
  for (const IndexMapFace& face : rendering.index_map) {
    for (int c = 0; c < 4; ++c) {
      if (face.plane(c)) hash.add(samples_of(face, c));
    }
  }
  return hash.finish();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> picture_hashes(const Rendering& rendering) {
  std::vector<std::pair<std::string, std::string>> out{{"color", {}}, {"stencil", {}}};
  std::vector<std::string (*)(const Rendering&)> hashes{&color_hash, &stencil_hash};
  if (!rendering.index_map.empty()) {
    out.emplace_back("index_map", std::string());
    hashes.push_back(&index_map_hash);
  }
  parallel_for(out.size(), [&](std::size_t i) { out[i].second = hashes[i](rendering); });
  std::map<std::string, Sha256> maps;  // of all planes of a name
  for (const Layer& map : rendering.maps) {
    std::visit([&](const auto& samples) { maps[map.part].add(samples); }, map.samples);
  }
  for (auto& [name, hash] : maps) out.emplace_back(name, hash.finish());
  return out;
}

}  // namespace ninebit::tools
