#include "src/tools/common/given_pictures.h"

#include <array>
#include <memory>
#include <type_traits>
#include <utility>
#include <variant>

#include "ninebit/frame/pictures.h"
#include "src/frame/drawn_passes.h"
#include "src/system/parallel/parallel_loop.h"
#include "src/tools/input/host.h"

namespace ninebit::tools {
namespace {

template <class Sample>
constexpr char kind_of() {
  if constexpr (std::is_same_v<Sample, std::uint8_t>) return 'B';
  if constexpr (std::is_same_v<Sample, std::uint32_t>) return 'I';
  if constexpr (std::is_same_v<Sample, s9>) return 'h';
  if constexpr (std::is_same_v<Sample, Half>) return 'e';
  return 'f';
}

// Samples with the top row first, which the array owns.
template <class Sample>
void give_samples(std::string name, std::vector<Sample> samples, int width, int height, int channels) {
  static_assert(sizeof(Sample) <= 4);
  auto owner = std::make_shared<const std::vector<Sample>>(std::move(samples));
  const auto size = static_cast<std::ptrdiff_t>(sizeof(Sample));
  HostArray array{.name = std::move(name),
                  .kind = kind_of<Sample>(),
                  .shape = {height, width},
                  .strides = {size * width * channels, size * channels},
                  .first = owner->data(),
                  .owner = owner};
  if (channels > 1) {
    array.shape.push_back(channels);
    array.strides.push_back(size);
  }
  host()->give(std::move(array));
}

bool is_face(const Layer& layer) {
  return layer.channel.starts_with('+') || layer.channel.starts_with('-');
}

// A plane with its lowest row first, as an upright copy.
template <class Samples>
void give_plane(std::string name, const Samples& plane, int width, int height) {
  if (plane.empty()) return;
  std::vector<typename Samples::value_type> upright;
  upright.reserve(plane.size());
  for (int row = height - 1; row >= 0; --row) {
    const auto* const from = plane.data() + std::ptrdiff_t{row} * width;
    upright.insert(upright.end(), from, from + width);
  }
  give_samples(std::move(name), std::move(upright), width, height, 1);
}

// A cube map's face: its first row is t = 0, which is on top.
void give_index_map(const Rendering& rendering) {
  std::array<std::vector<std::uint32_t>, 6> numbers;
  parallel_for(rendering.index_map.size(), [&](std::size_t f) {
    numbers[f].resize(rendering.index_map[f].texels());
    rendering.index_map[f].read_numbers(rendering.codes, 0, numbers[f]);
  });
  for (std::size_t f = 0; f < rendering.index_map.size(); ++f) {
    const int size = rendering.index_map[f].size;
    give_samples(std::string("index_map.") + kCubeFaceNames[f], std::move(numbers[f]), size, size, 1);
  }
}

}  // namespace

void give_picture(std::string name, Image8 image) {
  if (host() == nullptr) return;
  give_samples(std::move(name), std::move(image.pixels), image.width, image.height, image.channels);
}

void give_surface(const Surface& surface, int n) {
  if (host() == nullptr) return;
  Image8 color = surface_picture(surface, 4);
  give_picture("color", n > 1 ? averaged(color, n) : std::move(color));
  give_plane("depth", surface.depth(), surface.width(), surface.height());
  give_plane("stencil", surface.stencil(), surface.width(), surface.height());
}

void give_layers(const std::deque<Layer>& layers) {
  if (host() == nullptr) return;
  for (const Layer& layer : layers) {
    const std::string name = layer.part + '.' + layer.channel;
    const auto give = [&](const auto& samples) {
      if (is_face(layer)) {
        give_samples(name, std::vector(samples), layer.width, layer.height, 1);
      } else {
        give_plane(name, samples, layer.width, layer.height);
      }
    };
    std::visit(give, layer.samples);
  }
}

void give_rendering(const Rendering& rendering, int supersample) {
  if (host() == nullptr) return;
  give_surface(rendering.frame, supersample);
  if (!rendering.index_map.empty()) give_index_map(rendering);
  give_layers(rendering.maps);
  give_layers(rendering.layers);
  for (const NamedPicture& picture : rendering.pictures) {
    give_picture(picture.file.substr(0, picture.file.rfind('.')), as_shown(picture.image, rendering, supersample));
  }
}

}  // namespace ninebit::tools
