// The room of the article, in which many tests draw.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "combiner_tests/support/random.h"
#include "ninebit/raster/texture.h"
#include "ninebit/scene/scene_io.h"

namespace ninebit::test {

// Complete: with a camera, and a light of one of these kinds.
inline Scene index_room(const LightKinds& lights = {}) {
  auto read = read_scene(NINEBIT_SOURCE_DIR "/scenes/index_room.gltf");
  if (!read) throw std::runtime_error(read.error().text());
  SceneSetup setup;
  setup.light_kinds = lights;
  auto scene = complete_scene(std::move(*read), setup, 4.0F / 3.0F);
  if (!scene) throw std::runtime_error(scene.error().text());
  return std::move(*scene);
}

// A cube map of noise, for the light in it.
inline std::shared_ptr<const Texture> noisy_cookie() {
  constexpr int kSize = 8;
  Random random(5);
  std::vector<std::vector<TextureSamples>> faces(6);
  for (std::vector<TextureSamples>& face : faces) {
    std::vector<std::uint8_t> samples(kSize * kSize * 4);
    for (std::uint8_t& s : samples) s = random.byte();
    face.push_back({kSize, kSize, std::move(samples)});
  }
  return std::make_shared<Texture>(
      make_texture(TextureTarget::cube_map, InternalFormat::rgba8, std::move(faces)).value());
}

}  // namespace ninebit::test
