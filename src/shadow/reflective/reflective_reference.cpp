#include "src/shadow/reflective/reflective_reference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "src/frame/surface_groups.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

constexpr std::size_t kTexelsBetweenQuestions = std::size_t{1} << 24;

std::vector<std::uint32_t> grid_pixels(const VisibleSurface& surface, const std::vector<bool>& drawn) {
  std::vector<std::uint32_t> pixels;
  const int columns = std::min(kReferenceColumns, surface.width), rows = std::min(kReferenceRows, surface.height);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int y = (2 * row + 1) * surface.height / (2 * rows), x = (2 * column + 1) * surface.width / (2 * columns);
      const auto i =
          static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(surface.width) + static_cast<std::uint32_t>(x);
      if (drawn[i]) pixels.push_back(i);
    }
  }
  return pixels;
}

}  // namespace

glm::dvec3 whole_map_irradiance(const PixelLights& lights, const glm::dvec3& position, const glm::dvec3& normal) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < lights.values.size(); i += PixelLights::kStride) {
    const float* const light = &lights.values[i];
    const glm::dvec3 away = position - glm::dvec3(light[0], light[1], light[2]);
    const double leaving = glm::dot(glm::dvec3(light[3], light[4], light[5]), away);
    const double arriving = -glm::dot(normal, away);
    const double square = glm::dot(away, away);
    if (!(leaving > 0.0 && arriving > 0.0) || square < kSmallestSquare) continue;
    sum += glm::dvec3(light[6], light[7], light[8]) * (leaving * arriving / (square * square));
  }
  return sum;
}

Result<IndirectError> indirect_error(const PixelLights& lights, const VisibleSurface& surface,
                                     const std::vector<bool>& drawn, const IndirectLight& indirect,
                                     const Continue& go_on) {
  const std::vector<std::uint32_t> pixels = grid_pixels(surface, drawn);
  const std::size_t texels = lights.values.size() / PixelLights::kStride;
  const std::size_t band = std::max<std::size_t>(kTexelsBetweenQuestions / texels, 1);
  std::vector<glm::dvec3> whole(pixels.size());
  for (std::size_t begin = 0; begin < pixels.size(); begin += band) {
    if (!go_on(static_cast<double>(begin) / static_cast<double>(pixels.size()))) {
      return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    }
    parallel_for(std::min(band, pixels.size() - begin), [&](std::size_t at) {
      const std::size_t i = begin + at;
      whole[i] = whole_map_irradiance(lights, glm::dvec3(surface.position_at(pixels[i])),
                                      glm::dvec3(unit_or_zero(surface.normal_at(pixels[i]))));
    });
  }
  IndirectError error{.pixels = pixels.size()};
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const glm::dvec3 reference = whole[i] * indirect.scale_of_whole_map();
    for (std::size_t c = 0; c < 3; ++c) {
      const double expected = reference[static_cast<glm::length_t>(c)];
      const double difference = std::fabs(indirect.irradiance()[c][pixels[i]] - expected);
      error.reference_mean += expected;
      error.mean += difference;
      error.max = std::max(error.max, difference);
    }
  }
  const double values = static_cast<double>(std::max<std::size_t>(pixels.size(), 1)) * 3.0;
  error.reference_mean /= values;
  error.mean /= values;
  return error;
}

}  // namespace ninebit
