// Ground truth for eyes, and as layers.
#include <algorithm>
#include <array>

#include "ninebit/shadow/ground_truth.h"
#include "ninebit/shadow/pictures.h"
#include "src/shadow/camera_frame.h"

namespace ninebit {
namespace {

using Rgb = std::array<std::uint8_t, 3>;
constexpr Rgb kFalseLit{255, 176, 0};
constexpr Rgb kFalseShadowed{70, 150, 255};

template <class Value>
void add_plane(Rendering& rendering, const char* name, const std::vector<Value>& values) {
  auto& plane =
      add_layer<std::uint8_t>(rendering.layers, name, name, rendering.frame.width(), rendering.frame.height());
  std::transform(values.begin(), values.end(), plane.begin(), [](Value v) { return static_cast<std::uint8_t>(v); });
}

}  // namespace

Image8 error_picture(const Rendering& rendering, const GroundTruth& truth) {
  Image8 image = color_picture(rendering);
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t x = 0; x < width; ++x) {
      std::uint8_t* const pixel = &image.pixels[(row * width + x) * 3];
      const std::size_t i = (height - 1 - row) * width + x;
      const int grey = (pixel[0] + pixel[1] + pixel[2]) / 6;
      Rgb shown;
      shown.fill(static_cast<std::uint8_t>(grey));
      if (truth.cause[i] != ErrorCause::none) {
        shown = truth.truth[i] == PixelTruth::shadowed ? kFalseLit : kFalseShadowed;
      }
      std::copy(shown.begin(), shown.end(), pixel);
    }
  }
  return image;
}

void add_ground_truth(Rendering& rendering, const RenderSettings& settings, const GroundTruth& truth) {
  rendering.pictures.push_back({"error.png", error_picture(rendering, truth)});
  if (!settings.layers) return;
  add_plane(rendering, "truth", truth.truth);
  add_plane(rendering, "cause", truth.cause);
}

}  // namespace ninebit
