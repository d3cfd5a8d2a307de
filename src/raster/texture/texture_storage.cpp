// Textures that own their samples, and mip-maps made by a box filter.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>

#include "ninebit/raster/sampler.h"
#include "ninebit/raster/texture.h"

namespace ninebit {
namespace {

std::size_t plane_count(InternalFormat format) {
  const std::array<bool, 4> stored = stored_components(format);
  return static_cast<std::size_t>(std::count(stored.begin(), stored.end(), true));
}

// 32 bits may not hold the number before complaint_about has checked it.
std::uint64_t texels_of(const TextureSamples& image) {
  return static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height) *
         static_cast<std::uint64_t>(image.depth);
}

// The view of an image's samples.
TextureImage view_of(InternalFormat format, const TextureSamples& image) {
  const std::array<bool, 4> stored = stored_components(format);
  const auto plane_size = static_cast<std::size_t>(texels_of(image));
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
        return TextureImage{image.width, image.height, planes, image.depth};
      },
      image.samples);
}

// True for bytes of several components, which are kept texel by texel, four bytes each: vectors read a texel's
// components at once.
bool are_kept_in_words(InternalFormat format) {
  const std::array<bool, 4> stored = stored_components(format);
  return stored[1] && stored[2];
}

constexpr std::size_t kWordBytes = 4;

using Faces = std::vector<std::vector<TextureSamples>>;

// A texture that owns the samples, which are right for the format.
Texture keep_words(TextureTarget target, InternalFormat format, const Faces& faces) {
  std::size_t texels = 0;
  for (const auto& levels : faces) {
    for (const TextureSamples& image : levels) {
      texels += static_cast<std::size_t>(texels_of(image));
    }
  }
  Texture texture{.target = target, .format = format};
  // Words, because vectors read them aligned.
  const auto kept = std::make_shared<std::vector<std::uint32_t>>(texels);
  auto* next = reinterpret_cast<std::uint8_t*>(kept->data());
  const std::size_t components = plane_count(format);
  const std::array<bool, 4> stored = stored_components(format);
  for (std::size_t face = 0; face < faces.size(); ++face) {
    for (const TextureSamples& image : faces[face]) {
      const auto& samples = *std::get_if<std::vector<std::uint8_t>>(&image.samples);
      const std::size_t count = samples.size() / components;
      std::array<Plane<const std::uint8_t>, 4> planes{};
      auto from = samples.begin();
      for (std::size_t k = 0; k < kWordBytes; ++k) {
        planes[k] = {next + k, image.width * static_cast<std::ptrdiff_t>(kWordBytes), kWordBytes};
        for (std::size_t i = 0; i < count && stored[k]; ++i) next[kWordBytes * i + k] = *from++;
      }
      texture.faces[face].push_back({image.width, image.height, planes, image.depth});
      next += kWordBytes * count;
    }
  }
  texture.storage = kept;
  return texture;
}

// Samples of another type than the format's are kept as they are; check_texture reports them.
Texture keep(TextureTarget target, InternalFormat format, Faces faces) {
  const auto are_bytes = [](const TextureSamples& image) {
    return std::holds_alternative<std::vector<std::uint8_t>>(image.samples);
  };
  const bool all_bytes = std::all_of(faces.begin(), faces.end(), [&](const std::vector<TextureSamples>& levels) {
    return std::all_of(levels.begin(), levels.end(), are_bytes);
  });
  if (are_kept_in_words(format) && all_bytes) return keep_words(target, format, faces);
  Texture texture{.target = target, .format = format};
  const auto kept = std::make_shared<const Faces>(std::move(faces));
  for (std::size_t face = 0; face < kept->size(); ++face) {
    for (const TextureSamples& image : (*kept)[face]) texture.faces[face].push_back(view_of(format, image));
  }
  texture.storage = kept;
  return texture;
}

// A copy of an image's samples.
TextureSamples samples_of(InternalFormat format, const TextureImage& image) {
  const std::array<bool, 4> stored = stored_components(format);
  TextureSamples copy{.width = image.width, .height = image.height, .depth = image.depth};
  std::visit(
      [&](const auto& planes) {
        using T = std::remove_const_t<std::remove_pointer_t<decltype(planes[0].data)>>;
        std::vector<T> samples;
        for (std::size_t k = 0; k < 4; ++k) {
          for (int y = 0; y < image.height * image.depth && stored[k]; ++y) {
            for (int x = 0; x < image.width; ++x) samples.push_back(planes[k].at(x, y));
          }
        }
        copy.samples = std::move(samples);
      },
      image.planes);
  return copy;
}

// The error in an image's samples, or empty.
std::string complaint_about(TextureTarget target, InternalFormat format, const TextureSamples& image) {
  const bool any_side = target == TextureTarget::rectangle;
  const int longest = target == TextureTarget::texture_3d ? kMax3dTextureSize : kMaxSurfaceSize;
  for (const int side : {image.width, image.height, image.depth}) {
    if (side >= 1 && side <= longest) continue;
    return "a texture image is " + std::to_string(image.width) + " x " + std::to_string(image.height) +
           (image.depth == 1 ? "" : " x " + std::to_string(image.depth)) + "; each side must be " +
           (any_side ? "" : "a power of two ") + "from 1 to " + std::to_string(longest);
  }
  const std::uint64_t needed = texels_of(image) * plane_count(format);
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

// The eight texels of the previous level that a texel stands for, s first, then t, then r.
template <class T>
using Octet = std::array<T, 8>;

// If the image has one layer, both halves are equal.
float mean(const Octet<float>& of) {
  const float near = ((of[0] + of[1]) + (of[2] + of[3])) * 0.25F;
  const float far = ((of[4] + of[5]) + (of[6] + of[7])) * 0.25F;
  return near == far ? near : (near + far) * 0.5F;
}
Half mean(const Octet<Half>& of) {
  Octet<float> floats{};
  std::transform(of.begin(), of.end(), floats.begin(), [](Half half) { return float_of(half); });
  return half_of(mean(floats));
}
template <class T>
T mean(const Octet<T>& of) {
  return static_cast<T>((std::accumulate(of.begin(), of.end(), std::uint32_t{0}) + 4) / 8);  // codes have 24 bits
}

// The mean of codes in two's complement with this sign bit, which are shifted to unsigned codes and back. 0: unsigned.
template <class T>
T signed_mean(Octet<T> of, T sign) {
  for (T& code : of) code = static_cast<T>(code ^ sign);
  return static_cast<T>(mean(of) ^ sign);
}

// The means of the octets of an image's next level. `read`(x, y, z) reads a texel of the image; where that is one texel
// wide, high or deep, the same texel stands for both of a pair.
template <class T, class Read>
std::vector<T> means(const TextureImage& image, const TextureSamples& next, const Read& read, T sign) {
  std::vector<T> all;
  all.reserve(static_cast<std::size_t>(texels_of(next)));
  for (int z = 0; z < next.depth; ++z) {
    for (int y = 0; y < next.height; ++y) {
      for (int x = 0; x < next.width; ++x) {
        Octet<T> of{};
        for (int i = 0; i < 8; ++i) {
          of[static_cast<std::size_t>(i)] =
              read(std::min(2 * x + (i & 1), image.width - 1), std::min(2 * y + (i >> 1 & 1), image.height - 1),
                   std::min(2 * z + (i >> 2), image.depth - 1));
        }
        if constexpr (std::is_integral_v<T>) {
          all.push_back(signed_mean(of, sign));
        } else {
          all.push_back(mean(of));
        }
      }
    }
  }
  return all;
}

// Adds the means of 16-bit words whose bytes are in two components.
void add_words(const TextureImage& image, const TextureSamples& next, std::array<std::size_t, 2> high_and_low,
               bool is_signed, std::array<std::vector<std::uint8_t>, 4>& bytes) {
  const auto& planes = *std::get_if<std::array<Plane<const std::uint8_t>, 4>>(&image.planes);
  const std::size_t high = high_and_low[0], low = high_and_low[1];
  const auto read = [&](int x, int y, int z) {
    const int row = y + image.height * z;
    return static_cast<std::uint16_t>(256 * planes[high].at(x, row) + planes[low].at(x, row));
  };
  for (const std::uint16_t word : means<std::uint16_t>(image, next, read, is_signed ? 0x8000 : 0)) {
    bytes[high].push_back(static_cast<std::uint8_t>(word >> 8U));
    bytes[low].push_back(static_cast<std::uint8_t>(word & 0xFFU));
  }
}

// The next level of an image.
TextureSamples next_level(InternalFormat format, const TextureImage& image, const std::array<bool, 4>& is_signed) {
  const std::array<bool, 4> stored = stored_components(format);
  TextureSamples next{.width = std::max(image.width / 2, 1),
                      .height = std::max(image.height / 2, 1),
                      .depth = std::max(image.depth / 2, 1)};
  if (has_words(format)) {
    std::array<std::vector<std::uint8_t>, 4> bytes;
    add_words(image, next, {kAlpha, kRed}, is_signed[kAlpha], bytes);
    add_words(image, next, {kGreen, kBlue}, is_signed[kGreen], bytes);
    std::vector<std::uint8_t> samples;
    for (const auto& plane : bytes) samples.insert(samples.end(), plane.begin(), plane.end());
    next.samples = std::move(samples);
    return next;
  }
  std::visit(
      [&](const auto& planes) {
        using T = std::remove_const_t<std::remove_pointer_t<decltype(planes[0].data)>>;
        std::vector<T> samples;
        for (std::size_t k = 0; k < 4; ++k) {
          if (!stored[k]) continue;
          const auto read = [&](int x, int y, int z) { return planes[k].at(x, y + image.height * z); };
          T sign{};
          if constexpr (std::is_same_v<T, std::uint8_t>) sign = is_signed[k] ? 0x80 : 0;
          const std::vector<T> plane = means<T>(image, next, read, sign);
          samples.insert(samples.end(), plane.begin(), plane.end());
        }
        next.samples = std::move(samples);
      },
      image.planes);
  return next;
}

}  // namespace

Result<Texture> make_texture(TextureTarget target, InternalFormat format,
                             std::vector<std::vector<TextureSamples>> faces) {
  const std::size_t needed = Texture{.target = target, .format = format}.face_count();
  if (faces.size() != needed) {
    return Diagnostic{"a texture has " + std::to_string(faces.size()) + " faces where its target needs " +
                      std::to_string(needed)};
  }
  for (const auto& levels : faces) {
    for (const TextureSamples& image : levels) {
      if (std::string complaint = complaint_about(target, format, image); !complaint.empty()) {
        return Diagnostic{complaint};
      }
    }
  }
  Texture texture = keep(target, format, std::move(faces));
  if (Status status = check_texture(texture); !status) return status.error();
  return texture;
}

Result<Texture> with_mipmaps(const Texture& texture, const std::array<bool, 4>& is_signed) {
  if (Status status = check_texture(texture); !status) return status.error();
  if (texture.target == TextureTarget::rectangle) return Diagnostic{"rectangles have no mip-maps"};
  const std::array<bool, 4> as_signed = signed_components(texture, {.is_signed = is_signed});
  Faces faces(texture.face_count());
  for (std::size_t face = 0; face < faces.size(); ++face) {
    if (texture.faces[face].empty()) return Diagnostic{"a texture without a level 0 has no mip-maps"};
    std::vector<TextureSamples>& levels = faces[face];
    levels.push_back(samples_of(texture.format, texture.faces[face][0]));
    while (std::max({levels.back().width, levels.back().height, levels.back().depth}) > 1) {
      levels.push_back(next_level(texture.format, view_of(texture.format, levels.back()), as_signed));
    }
  }
  return keep(texture.target, texture.format, std::move(faces));
}

}  // namespace ninebit
