// Indirect light for the pixels of a frame, from the pixel lights of a reflective shadow map.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/shadow/reflective.h"
#include "src/shadow/reflective/gather_pattern.h"

namespace ninebit {

// The map's texels as pixel lights, with the flux that the pattern's kind uses (render_reflective).
[[nodiscard]] PixelLights pixel_lights(const ReflectiveMap& map, const Light& light, SamplePattern pattern);

// The nearest surface at each of the camera's pixels, lowest row first.
struct VisibleSurface {
  int width = 0;
  int height = 0;
  std::array<std::vector<float>, 3> position{};  // world space
  std::array<std::vector<float>, 3> normal{};    // interpolated, of any length; 0 in the background
  std::array<std::vector<float>, 3> color{};     // the base colour

  [[nodiscard]] glm::vec3 position_at(std::size_t i) const { return {position[0][i], position[1][i], position[2][i]}; }
  [[nodiscard]] glm::vec3 normal_at(std::size_t i) const { return {normal[0][i], normal[1][i], normal[2][i]}; }
};

// Called repeatedly during the work with the share that is done (0 to 1); returning false ends it with
// Fault::cancelled.
using Continue = std::function<bool(double done)>;

class IndirectLight {
 public:
  // Map, lights and surface must outlive this. The kernel is in texels.
  IndirectLight(const ReflectiveMap& map, const PixelLights& lights, const VisibleSurface& surface,
                GatherPattern pattern, float kernel);

  // Gathers at every pixel of `drawn`; E of all others is 0. With a scale above 1 it gathers at one pixel in each block
  // of scale × scale, and interpolates each other pixel between the four such pixels around it. A pixel is gathered as
  // well if fewer than three of these four are similar: nearer than `similar_distance`, with a normal within 18
  // degrees.
  Status compute(const std::vector<bool>& drawn, int scale, float similar_distance, const Continue& go_on);

  // E of all pixels, in the pattern's scale, not clamped.
  [[nodiscard]] const std::array<std::vector<float>, 3>& irradiance() const { return irradiance_; }
  [[nodiscard]] std::uint64_t gathered() const { return gathered_; }
  [[nodiscard]] std::uint64_t interpolated() const { return interpolated_; }

  // The factor that brings the sum over all texels in the kernel, each with weight 1, to the pattern's scale.
  [[nodiscard]] double scale_of_whole_map() const;

 private:
  Status gather_at(std::span<const std::uint32_t> pixels, const Continue& go_on);
  void load(std::span<const std::uint32_t> pixels, Receivers& receivers) const;
  [[nodiscard]] bool interpolate(const std::vector<bool>& drawn, int scale, float similar_distance, std::size_t pixel);

  const ReflectiveMap* map_;
  const PixelLights* lights_;
  const VisibleSurface* surface_;
  GatherPattern pattern_;
  float kernel_;
  float normalisation_ = 1.0F;
  std::array<std::vector<float>, 3> irradiance_;
  std::uint64_t gathered_ = 0;
  std::uint64_t interpolated_ = 0;
};

}  // namespace ninebit
