// Textures that own their samples, and mip-maps made by a box filter.
#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>

#include "ninebit/raster/texture.h"

namespace ninebit {
namespace {

std::size_t plane_count(InternalFormat format) {
  const std::array<bool, 4> stored = stored_components(format);
  return static_cast<std::size_t>(std::count(stored.begin(), stored.end(), true));
}

// The view of an image's samples.
TextureImage view_of(InternalFormat format, const TextureSamples& image) {
  const std::array<bool, 4> stored = stored_components(format);
  const std::size_t plane_size = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  return std::visit(
      [&](const auto& samples) {
        using T = typename std::decay_t<decltype(samples)>::value_type;
        std::array<Plane<const T>, 4> planes{};
        const T* next = samples.data();
        for (std::size_t k = 0; k < 4; ++k) {
          if (!stored[k]) continue;
          planes[k] = {next, image.width};
          next += plane_size;
        }
        return TextureImage{image.width, image.height, planes};
      },
      image.samples);
}

// The error in an image's samples, or empty.
std::string complaint_about(InternalFormat format, const TextureSamples& image) {
  if (image.width < 1 || image.height < 1 || image.width > kMaxSurfaceSize || image.height > kMaxSurfaceSize) {
    return "a texture image is " + std::to_string(image.width) + " x " + std::to_string(image.height) +
           "; each side must be a power of two from 1 to " + std::to_string(kMaxSurfaceSize);
  }
  const std::size_t needed =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * plane_count(format);
  const std::size_t size = std::visit([](const auto& samples) { return samples.size(); }, image.samples);
  if (size != needed) {
    return "a texture image has " + std::to_string(size) + " samples where its size and format need " +
           std::to_string(needed);
  }
  if (const auto* codes = std::get_if<std::vector<std::uint32_t>>(&image.samples)) {
    const std::uint32_t largest = format == InternalFormat::depth16 ? 0xFFFF : 0xFFFFFF;
    const auto beyond = std::find_if(codes->begin(), codes->end(), [&](std::uint32_t c) { return c > largest; });
    if (beyond != codes->end()) {
      return "a depth texture has the code " + std::to_string(*beyond) + "; the largest is " + std::to_string(largest);
    }
  }
  return {};
}

std::uint8_t mean(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
  return static_cast<std::uint8_t>((a + b + c + d + 2) / 4);
}
std::uint32_t mean(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  return (a + b + c + d + 2) / 4;  // codes have 24 bits
}
float mean(float a, float b, float c, float d) {
  return ((a + b) + (c + d)) * 0.25F;
}
Half mean(Half a, Half b, Half c, Half d) {
  return half_of(mean(float_of(a), float_of(b), float_of(c), float_of(d)));
}

// The next level of an image. Where it is one texel wide or high, the same texel stands for both of a pair.
TextureSamples next_level(InternalFormat format, const TextureImage& image) {
  const std::array<bool, 4> stored = stored_components(format);
  TextureSamples next{std::max(image.width / 2, 1), std::max(image.height / 2, 1)};
  std::visit(
      [&](const auto& planes) {
        using T = std::remove_const_t<std::remove_pointer_t<decltype(planes[0].data)>>;
        std::vector<T> samples;
        samples.reserve(static_cast<std::size_t>(next.width) * static_cast<std::size_t>(next.height) *
                        plane_count(format));
        for (std::size_t k = 0; k < 4; ++k) {
          if (!stored[k]) continue;
          for (int y = 0; y < next.height; ++y) {
            const int above = std::min(2 * y + 1, image.height - 1);
            for (int x = 0; x < next.width; ++x) {
              const int right = std::min(2 * x + 1, image.width - 1);
              samples.push_back(mean(planes[k].at(2 * x, 2 * y), planes[k].at(right, 2 * y), planes[k].at(2 * x, above),
                                     planes[k].at(right, above)));
            }
          }
        }
        next.samples = std::move(samples);
      },
      image.planes);
  return next;
}

}  // namespace

Result<Texture> make_texture(TextureTarget target, InternalFormat format,
                             std::vector<std::vector<TextureSamples>> faces) {
  Texture texture{.target = target, .format = format};
  if (faces.size() != texture.face_count()) {
    return Diagnostic{"a texture has " + std::to_string(faces.size()) + " faces where its target needs " +
                      std::to_string(texture.face_count())};
  }
  const auto kept = std::make_shared<const std::vector<std::vector<TextureSamples>>>(std::move(faces));
  for (std::size_t face = 0; face < kept->size(); ++face) {
    for (const TextureSamples& image : (*kept)[face]) {
      if (std::string complaint = complaint_about(format, image); !complaint.empty()) return Diagnostic{complaint};
      texture.faces[face].push_back(view_of(format, image));
    }
  }
  texture.storage = kept;
  if (Status status = check_texture(texture); !status) return status.error();
  return texture;
}

Result<Texture> with_mipmaps(const Texture& texture) {
  if (Status status = check_texture(texture); !status) return status.error();
  Texture result{.target = texture.target, .format = texture.format};
  struct Kept {
    std::shared_ptr<const void> level0;
    std::vector<TextureSamples> levels;
  };
  const auto kept = std::make_shared<Kept>();
  kept->level0 = texture.storage;
  for (std::size_t face = 0; face < texture.face_count(); ++face) {
    if (texture.faces[face].empty()) return Diagnostic{"a texture without a level 0 has no mip-maps"};
    std::vector<TextureImage>& levels = result.faces[face];
    levels.push_back(texture.faces[face][0]);
    while (levels.back().width > 1 || levels.back().height > 1) {
      kept->levels.push_back(next_level(texture.format, levels.back()));  // moving it leaves its samples in place
      levels.push_back(view_of(texture.format, kept->levels.back()));
    }
  }
  result.storage = kept;
  return result;
}

}  // namespace ninebit
