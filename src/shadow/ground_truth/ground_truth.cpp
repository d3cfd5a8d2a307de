#include "ninebit/shadow/ground_truth.h"

#include <algorithm>
#include <array>

#include "ninebit/frame/pictures.h"
#include "src/frame/camera_frame.h"
#include "src/frame/packed_map.h"
#include "src/shadow/ground_truth/judge.h"

namespace ninebit {

namespace {

constexpr int kBandRows = 64;  // rows between two calls of the progress function

}  // namespace

Result<GroundTruth> measure(const GroundTruthScene& scene, const RenderSettings& settings, const Rendering& rendering,
                            const Progress& progress) {
  if (Status good = check_rendering(settings, rendering); !good) return good.error();
  Judge judge(scene.rays(), settings, rendering);
  for (int y = 0; y < settings.height; y += kBandRows) {
    if (progress && !progress("ground truth", static_cast<double>(y) / settings.height)) {
      return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    }
    judge.judge_rows(y, std::min(y + kBandRows, settings.height));
  }
  return judge.finish();
}

Result<JudgedPixel> judge_pixel(const GroundTruthScene& scene, const RenderSettings& settings,
                                const Rendering& rendering, int x, int y) {
  if (Status good = check_rendering(settings, rendering); !good) return good.error();
  if (x < 0 || y < 0 || x >= settings.width || y >= settings.height) {
    return Diagnostic{.message = "the pixel is outside of the rendering"};
  }
  return Judge(scene.rays(), settings, rendering).judged(x, y);
}

namespace {

using Rgb = std::array<std::uint8_t, 3>;
constexpr Rgb kFalseLit{255, 176, 0};
constexpr Rgb kFalseShadowed{70, 150, 255};
constexpr int kFalselyLit = 128;

template <class Value>
void add_plane(Rendering& rendering, const char* name, const std::vector<Value>& values) {
  auto& plane =
      add_layer<std::uint8_t>(rendering.layers, name, name, rendering.frame.width(), rendering.frame.height());
  std::transform(values.begin(), values.end(), plane.begin(), [](Value v) { return static_cast<std::uint8_t>(v); });
}

}  // namespace

Image8 error_picture(const Rendering& rendering, const GroundTruth& truth) {
  Image8 image = color_picture(rendering);
  for (std::size_t i = 0; i < truth.cause.size(); ++i) {
    std::uint8_t* const pixel = &image.pixels[upright_index(i, image.width, image.height) * 3];
    const int grey = (pixel[0] + pixel[1] + pixel[2]) / 6;
    Rgb shown;
    shown.fill(static_cast<std::uint8_t>(grey));
    if (truth.cause[i] != ErrorCause::none) {
      shown = truth.truth[i] == PixelTruth::shadowed ? kFalseLit : kFalseShadowed;
    }
    std::copy(shown.begin(), shown.end(), pixel);
  }
  return image;
}

Image8 cause_plane(const GroundTruth& truth, int width, int height) {
  Image8 image{.width = width, .height = height, .channels = 1, .pixels = {}};
  image.pixels.resize(truth.cause.size());
  for (std::size_t i = 0; i < truth.cause.size(); ++i) {
    if (truth.cause[i] == ErrorCause::none) continue;
    const int lit = truth.truth[i] == PixelTruth::shadowed ? kFalselyLit : 0;
    image.pixels[upright_index(i, width, height)] = static_cast<std::uint8_t>(static_cast<int>(truth.cause[i]) + lit);
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
