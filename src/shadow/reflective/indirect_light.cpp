#include "src/shadow/reflective/indirect_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "src/frame/shading.h"
#include "src/frame/surface_groups.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

constexpr float kSimilarCosine = 0.95F;  // of 18 degrees

// Samples between two calls of go_on: a fraction of a second.
constexpr std::size_t kSamplesBetweenQuestions = std::size_t{1} << 24;

double texels_in(float kernel) {
  return std::numbers::pi * double{kernel} * kernel;
}

// The pixel that is sampled for a block, along one axis: the block's middle, or the picture's last pixel.
int sample_place(int block, int scale, int size) {
  return std::min(block * scale + scale / 2, size - 1);
}

Diagnostic interrupted() {
  return {.message = "interrupted", .fault = Fault::cancelled};
}

}  // namespace

IndirectLight::IndirectLight(const ReflectiveMap& map, const PixelLights& lights, const VisibleSurface& surface,
                             GatherPattern pattern, float kernel)
    : map_(&map), lights_(&lights), surface_(&surface), pattern_(std::move(pattern)), kernel_(kernel) {
  if (pattern_.kind == SamplePattern::polar) {
    normalisation_ = static_cast<float>(texels_in(kernel) / pattern_.total_weight());
  }
  for (auto& plane : irradiance_) plane.assign(surface.position[0].size(), 0.0F);
}

double IndirectLight::scale_of_whole_map() const {
  return double{normalisation_} * pattern_.total_weight() / texels_in(kernel_);
}

// The position in the map is the texture coordinate of projective shadow mapping, in texels; points behind the light
// have none.
void IndirectLight::load(std::span<const std::uint32_t> pixels, Receivers& receivers) const {
  const auto size = static_cast<float>(map_->size);
  const auto width = static_cast<std::uint32_t>(surface_->width);
  for (std::size_t lane = 0; lane < pixels.size(); ++lane) {
    const std::size_t i = pixels[lane];
    const glm::vec3 position = surface_->position_at(i), normal = unit_or_zero(surface_->normal_at(i));
    for (glm::length_t c = 0; c < 3; ++c) {
      receivers.position[static_cast<std::size_t>(c)][lane] = position[c];
      receivers.normal[static_cast<std::size_t>(c)][lane] = normal[c];
    }
    const glm::vec4 clip = map_->clip_from_world * glm::vec4(position, 1.0F);
    const bool ahead = clip.w > 0.0F;
    receivers.s[lane] = ahead ? (clip.x / clip.w * 0.5F + 0.5F) * size : -2.0F * kMaxSurfaceSize;
    receivers.t[lane] = ahead ? (clip.y / clip.w * 0.5F + 0.5F) * size : -2.0F * kMaxSurfaceSize;
    const glm::vec2 turn = pattern_.kind == SamplePattern::poisson
                               ? pixel_turn(pixels[lane] % width, pixels[lane] / width)
                               : glm::vec2(1.0F, 0.0F);
    receivers.cosine[lane] = turn.x;
    receivers.sine[lane] = turn.y;
  }
}

Status IndirectLight::gather_at(std::span<const std::uint32_t> pixels, const Continue& go_on) {
  const std::size_t samples = pattern_.x.size();
  const std::size_t band = std::max(kSamplesBetweenQuestions / samples, Receivers::kCapacity);
  for (std::size_t begin = 0; begin < pixels.size(); begin += band) {
    if (!go_on(static_cast<double>(begin) / static_cast<double>(pixels.size()))) return interrupted();
    const std::span<const std::uint32_t> part = pixels.subspan(begin, std::min(band, pixels.size() - begin));
    const std::size_t chunks = (part.size() + Receivers::kCapacity - 1) / Receivers::kCapacity;
    parallel_for(chunks, [&](std::size_t chunk) {
      const std::size_t first = chunk * Receivers::kCapacity;
      const auto at = part.subspan(first, std::min(Receivers::kCapacity, part.size() - first));
      Receivers receivers;
      load(at, receivers);
      gather(*lights_, pattern_, kernel_, at.size(), receivers);
      for (std::size_t lane = 0; lane < at.size(); ++lane) {
        for (std::size_t c = 0; c < 3; ++c) irradiance_[c][at[lane]] = receivers.irradiance[c][lane] * normalisation_;
      }
    });
  }
  return {};
}

bool IndirectLight::interpolate(const std::vector<bool>& drawn, int scale, float similar_distance, std::size_t pixel) {
  // Along one axis: the samples before and after a pixel, and its position between them, from 0 to 1.
  struct Between {
    int first, second;
    float part;
  };
  const auto between = [&](int at, int size) -> Between {
    const int last = (size - 1) / scale;
    const int block = std::clamp((at - scale / 2 + scale) / scale - 1, 0, last);
    const int first = sample_place(block, scale, size), second = sample_place(std::min(block + 1, last), scale, size);
    const float part = second > first ? static_cast<float>(at - first) / static_cast<float>(second - first) : 0.0F;
    return {first, second, std::clamp(part, 0.0F, 1.0F)};
  };
  const auto width = static_cast<std::size_t>(surface_->width);
  const Between x = between(static_cast<int>(pixel % width), surface_->width);
  const Between y = between(static_cast<int>(pixel / width), surface_->height);

  const glm::vec3 position = surface_->position_at(pixel), normal = unit_or_zero(surface_->normal_at(pixel));
  std::array<float, 3> sum{};
  float weights = 0.0F;
  int usable = 0;
  for (const auto& [row, row_weight] : {std::pair{y.first, 1.0F - y.part}, std::pair{y.second, y.part}}) {
    for (const auto& [column, column_weight] : {std::pair{x.first, 1.0F - x.part}, std::pair{x.second, x.part}}) {
      const std::size_t sample = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
      if (!drawn[sample]) continue;
      const glm::vec3 away = surface_->position_at(sample) - position;
      if (glm::dot(away, away) > similar_distance * similar_distance) continue;
      if (glm::dot(unit_or_zero(surface_->normal_at(sample)), normal) < kSimilarCosine) continue;
      ++usable;
      const float weight = row_weight * column_weight;
      weights += weight;
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * irradiance_[c][sample];
    }
  }
  if (usable < 3 || !(weights > 0.0F)) return false;
  for (std::size_t c = 0; c < 3; ++c) irradiance_[c][pixel] = sum[c] / weights;
  return true;
}

Status IndirectLight::compute(const std::vector<bool>& drawn, int scale, float similar_distance,
                              const Continue& go_on) {
  const int width = surface_->width, height = surface_->height;
  std::vector<bool> sampled(drawn.size(), scale == 1);
  std::vector<std::uint32_t> pixels;
  for (int y = 0; y * scale < height && scale > 1; ++y) {
    for (int x = 0; x * scale < width; ++x) {
      sampled[static_cast<std::size_t>(sample_place(y, scale, height)) * static_cast<std::size_t>(width) +
              static_cast<std::size_t>(sample_place(x, scale, width))] = true;
    }
  }
  const auto count = static_cast<std::uint32_t>(drawn.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    if (sampled[i] && drawn[i]) pixels.push_back(i);
  }
  gathered_ = pixels.size();
  const double share = scale == 1 ? 1.0 : 0.5;
  const Continue first_part = [&](double done) { return go_on(done * share); };
  if (Status done = gather_at(pixels, first_part); !done || scale == 1) return done;

  std::vector<std::vector<std::uint32_t>> left(static_cast<std::size_t>(height));
  parallel_for(left.size(), [&](std::size_t y) {
    const std::uint32_t row = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width);
    for (std::uint32_t i = row; i < row + static_cast<std::uint32_t>(width); ++i) {
      if (drawn[i] && !sampled[i] && !interpolate(drawn, scale, similar_distance, i)) left[y].push_back(i);
    }
  });
  std::uint64_t all = 0;
  for (const bool pixel : drawn) {
    if (pixel) ++all;
  }
  pixels.clear();
  for (const auto& row : left) pixels.insert(pixels.end(), row.begin(), row.end());
  gathered_ += pixels.size();
  interpolated_ = all - gathered_;
  return gather_at(pixels, [&](double done) { return go_on(0.5 + 0.5 * done); });
}

// A reflective shadow map's texels as pixel lights.

namespace {

// The cross-section of one texel's beam at a point of the world, perpendicular to the ray.
class BeamArea {
 public:
  BeamArea(const ReflectiveMap& map, const Light& light) : light_(light) {
    const glm::mat4& m = map.clip_from_world;
    const auto row_length = [&](int row) {
      const glm::vec3 v(m[0][row], m[1][row], m[2][row]);
      return std::sqrt(glm::dot(v, v));
    };
    w_row_ = glm::vec4(m[0][3], m[1][3], m[2][3], m[3][3]);
    const auto size = static_cast<float>(map.size);
    texel_ = 4.0F / (row_length(0) * row_length(1)) / (size * size);
  }

  [[nodiscard]] float operator()(const glm::vec3& at) const {
    const float w = glm::dot(w_row_, glm::vec4(at, 1.0F));
    if (light_.kind == LightKind::directional) return texel_ * w * w;
    // A plane perpendicular to the axis is not perpendicular to a ray beside the axis.
    const glm::vec3 ray = at - light_.position;
    const float distance = std::sqrt(glm::dot(ray, ray));
    return distance > 0.0F ? texel_ * w * w * (w / distance) : 0.0F;
  }

 private:
  Light light_;
  glm::vec4 w_row_{};
  float texel_ = 0.0F;
};

}  // namespace

PixelLights pixel_lights(const ReflectiveMap& map, const Light& light, SamplePattern pattern) {
  const BeamArea area(map, light);
  // A diffuse surface sends 1 / pi of its flux along its normal.
  constexpr float kPerFlux = kDiffuseLight / kFluxOfWhiteLight / std::numbers::pi_v<float>;
  PixelLights lights{.size = map.size};
  lights.values.resize(map.depth.size() * PixelLights::kStride);
  parallel_for(map.depth.size(), [&](std::size_t i) {
    if (map.depth[i] == max_depth(DepthStencilFormat::d24s8)) return;
    float* const out = &lights.values[i * PixelLights::kStride];
    for (std::size_t c = 0; c < 3; ++c) {
      out[c] = float_of(map.position[c][i]);
      out[3 + c] = float_of(map.normal[c][i]);
      out[6 + c] = float_of(map.flux[c][i]);
    }
    if (pattern != SamplePattern::polar) return;
    const float scale = kPerFlux * area({out[0], out[1], out[2]});
    for (std::size_t c = 6; c < 9; ++c) out[c] *= scale;
  });
  return lights;
}

}  // namespace ninebit
