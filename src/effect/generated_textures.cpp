#include "ninebit/effect/generated_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace ninebit {
namespace {

constexpr int kAttenuationSize = 128;
constexpr int kSquares = 8;
constexpr std::uint8_t kDark = 51;

Status check_size(int size) {
  const bool power_of_two = size > 0 && (size & (size - 1)) == 0;
  if (power_of_two && size <= kMaxSurfaceSize) return {};
  return Diagnostic{.message = "texture size " + std::to_string(size) +
                               " is out of range; expected a power of two from 1 to " +
                               std::to_string(kMaxSurfaceSize)};
}

// Planes of bytes, one per stored component, filled by texel(x, y, component).
template <class Texel>
TextureSamples filled(int width, int height, std::size_t components, const Texel& texel) {
  TextureSamples samples{.width = width, .height = height};
  std::vector<std::uint8_t> bytes;
  bytes.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * components);
  for (std::size_t c = 0; c < components; ++c) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) bytes.push_back(texel(x, y, c));
    }
  }
  samples.samples = std::move(bytes);
  return samples;
}

// The middle of texel i of n, from -1 to 1.
double middle(int i, int n) {
  return (2.0 * i + 1.0) / n - 1.0;
}

std::uint8_t byte_of(double x) {
  return static_cast<std::uint8_t>(std::floor(std::clamp(x, 0.0, 1.0) * 255.0 + 0.5));
}

using BytePlanes = std::array<Plane<const std::uint8_t>, 4>;

// The mean of a texel's stored colours, 0 to 1; of an alpha texture, its alpha.
class Heights {
 public:
  Heights(const TextureImage& image, const std::array<bool, 4>& stored)
      : planes_(std::get<BytePlanes>(image.planes)), width_(image.width), height_(image.height) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (stored[c]) components_.push_back(c);
    }
    if (components_.empty()) components_.push_back(kAlpha);
  }

  // The position repeats at the borders.
  [[nodiscard]] double at(int x, int y) const {
    double sum = 0.0;
    for (const std::size_t c : components_) sum += planes_[c].at((x + width_) % width_, (y + height_) % height_);
    return sum / (255.0 * static_cast<double>(components_.size()));
  }

 private:
  const BytePlanes& planes_;
  int width_, height_;
  std::vector<std::size_t> components_;
};

}  // namespace

std::uint8_t range_compressed(double x) {
  return std::isnan(x) ? std::uint8_t{0} : byte_of((x + 1.0) / 2.0);
}

Result<Texture> normalization_cube_map(int size) {
  if (Status checked = check_size(size); !checked) return checked.error();
  std::vector<std::vector<TextureSamples>> faces;
  for (const CubeFace face : kCubeFaces) {
    const CubeFaceAxes& axes = cube_face_axes(face);
    faces.push_back({filled(size, size, 3, [&](int x, int y, std::size_t c) {
      std::array<double, 3> direction{};
      double squares = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        direction[i] = axes.major[i] + axes.s[i] * middle(x, size) + axes.t[i] * middle(y, size);
        squares += direction[i] * direction[i];
      }
      return range_compressed(direction[c] / std::sqrt(squares));
    })});
  }
  return make_texture(TextureTarget::cube_map, InternalFormat::rgb8, std::move(faces));
}

Result<Texture> checkerboard(int size) {
  if (Status checked = check_size(size); !checked) return checked.error();
  const int side = std::max(1, size / kSquares);
  return make_texture(TextureTarget::texture_2d, InternalFormat::rgb8,
                      {{filled(size, size, 3, [&](int x, int y, std::size_t) {
                        return (x / side + y / side) % 2 == 0 ? std::uint8_t{255} : kDark;
                      })}});
}

Result<Texture> gradient() {
  return make_texture(TextureTarget::texture_2d, InternalFormat::luminance8,
                      {{filled(256, 1, 1, [](int x, int, std::size_t) { return static_cast<std::uint8_t>(x); })}});
}

Result<Texture> attenuation() {
  return make_texture(TextureTarget::texture_2d, InternalFormat::luminance8,
                      {{filled(kAttenuationSize, kAttenuationSize, 1, [](int x, int y, std::size_t) {
                        const double across = middle(x, kAttenuationSize), up = middle(y, kAttenuationSize);
                        return byte_of(1.0 - across * across - up * up);
                      })}});
}

namespace {

Status check_heights(const Texture& heights, const char* what) {
  if (heights.target != TextureTarget::texture_2d) {
    return Diagnostic{.message = std::string(what) + " is made from a 2D texture, not from one of another kind"};
  }
  if (heights.faces[0].empty() || !std::holds_alternative<BytePlanes>(heights.faces[0][0].planes)) {
    return Diagnostic{.message = std::string(what) + " is made from a texture of bytes with a level 0"};
  }
  return {};
}

Status check_slopes(const Texture& heights, double steepness, const char* what) {
  if (!(steepness > 0.0) || !std::isfinite(steepness)) {
    return Diagnostic{.message = "steepness " + std::to_string(steepness) + " is out of range; expected more than 0"};
  }
  return check_heights(heights, what);
}

struct Slope {
  double ds, dt;
};

Slope slope_at(const Heights& height, int x, int y, double steepness) {
  return {(height.at(x + 1, y) - height.at(x - 1, y)) * steepness / 2.0,
          (height.at(x, y + 1) - height.at(x, y - 1)) * steepness / 2.0};
}

std::array<double, 3> normal_at(const Heights& height, int x, int y, double steepness) {
  const Slope slope = slope_at(height, x, y, steepness);
  const double length = std::sqrt(slope.ds * slope.ds + slope.dt * slope.dt + 1.0);
  return {-slope.ds / length, slope.dt / length, 1.0 / length};
}

// A number times a scale, to the nearest whole number, as two's complement.
std::uint32_t nearest_word(double x, double scale) {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(x * scale + 0.5)));
}

// hilo16 of the words HI and LO that words(x, y) gives.
template <class Words>
Result<Texture> hilo_texture(const TextureImage& image, const Words& words) {
  const auto byte = [&](int x, int y, std::size_t c) {
    const std::array<std::uint32_t, 2> hi_lo = words(x, y);
    const std::uint32_t word = c == kRed || c == kAlpha ? hi_lo[0] : hi_lo[1];
    return static_cast<std::uint8_t>(c == kRed || c == kBlue ? word & 255U : word >> 8U & 255U);
  };
  return make_texture(TextureTarget::texture_2d, InternalFormat::hilo16,
                      {{filled(image.width, image.height, 4, byte)}});
}

}  // namespace

Result<Texture> normal_map(const Texture& heights, double steepness) {
  if (Status checked = check_slopes(heights, steepness, "a normal map"); !checked) return checked.error();
  const TextureImage& image = heights.faces[0][0];
  const Heights height(image, stored_components(heights.format));
  return make_texture(TextureTarget::texture_2d, InternalFormat::rgb8,
                      {{filled(image.width, image.height, 3, [&](int x, int y, std::size_t c) {
                        return range_compressed(normal_at(height, x, y, steepness)[c]);
                      })}});
}

Result<Texture> signed_normal_map(const Texture& heights, double steepness) {
  if (Status checked = check_slopes(heights, steepness, "a normal map"); !checked) return checked.error();
  const TextureImage& image = heights.faces[0][0];
  const Heights height(image, stored_components(heights.format));
  return make_texture(TextureTarget::texture_2d, InternalFormat::rgb8,
                      {{filled(image.width, image.height, 3, [&](int x, int y, std::size_t c) {
                        return static_cast<std::uint8_t>(nearest_word(normal_at(height, x, y, steepness)[c], 127.0));
                      })}});
}

Result<Texture> hilo_normal_map(const Texture& heights, double steepness) {
  if (Status checked = check_slopes(heights, steepness, "a normal map"); !checked) return checked.error();
  const TextureImage& image = heights.faces[0][0];
  const Heights height(image, stored_components(heights.format));
  return hilo_texture(image, [&](int x, int y) {
    const std::array<double, 3> normal = normal_at(height, x, y, steepness);
    return std::array{nearest_word(normal[0], 32767.0), nearest_word(normal[1], 32767.0)};
  });
}

Result<Texture> hilo_height_map(const Texture& heights) {
  if (Status checked = check_heights(heights, "a height map"); !checked) return checked.error();
  const TextureImage& image = heights.faces[0][0];
  const Heights height(image, stored_components(heights.format));
  return hilo_texture(image, [&](int x, int y) {
    return std::array{nearest_word(height.at(x, y), 65535.0), std::uint32_t{0}};
  });
}

Result<Texture> offset_map(const Texture& heights, double steepness) {
  if (Status checked = check_slopes(heights, steepness, "an offset map"); !checked) return checked.error();
  const TextureImage& image = heights.faces[0][0];
  const Heights height(image, stored_components(heights.format));
  // Green, dt, is stored before blue, ds.
  return make_texture(TextureTarget::texture_2d, InternalFormat::dsdt8,
                      {{filled(image.width, image.height, 2, [&](int x, int y, std::size_t c) {
                        const Slope slope = slope_at(height, x, y, steepness);
                        const double number = std::clamp(c == 0 ? slope.dt : slope.ds, -1.0, 1.0);
                        return static_cast<std::uint8_t>(nearest_word(number, 127.0));
                      })}});
}

Result<Texture> retargeted(const Texture& texture, TextureTarget target) {
  if (Status checked = check_heights(texture, "a texture of another kind"); !checked) return checked.error();
  const TextureImage& image = texture.faces[0][0];
  const auto& planes = std::get<BytePlanes>(image.planes);
  std::vector<std::size_t> components;
  for (std::size_t c = 0; c < 4; ++c) {
    if (stored_components(texture.format)[c]) components.push_back(c);
  }
  const bool is_volume = target == TextureTarget::texture_3d;
  if (is_volume && image.height % image.width != 0) {
    return Diagnostic{.message = "a 3D texture is made from squares, one below the other; the picture is " +
                                 std::to_string(image.width) + " x " + std::to_string(image.height)};
  }
  const int rows = target == TextureTarget::texture_1d ? 1 : image.height;
  TextureSamples samples = filled(image.width, rows, components.size(),
                                  [&](int x, int y, std::size_t c) { return planes[components[c]].at(x, y); });
  if (is_volume) {
    samples.depth = image.height / image.width;
    samples.height = image.width;
  }
  return make_texture(target, texture.format, {{std::move(samples)}});
}

}  // namespace ninebit
