#include "combiner_tests/raster/texture_support.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "combiner_tests/support/special_floats.h"

namespace ninebit::test {
namespace {

// Half floats that are numbers, most of them between 0 and 1.
Half random_half(Random& random) {
  const auto sign = static_cast<std::uint16_t>(random.one_in(8) ? 0x8000 : 0);
  const int exponent = random.one_in(8) ? random.below(31) : random.between(8, 14);
  return {static_cast<std::uint16_t>(sign | (exponent << 10) | random.below(1024))};
}

TextureSamples random_image(Random& random, InternalFormat format, int width, int height, int depth) {
  const std::array<bool, 4> stored = stored_components(format);
  const auto count = static_cast<std::size_t>(width * height * depth) *
                     static_cast<std::size_t>(std::count(stored.begin(), stored.end(), true));
  TextureSamples image{.width = width, .height = height, .depth = depth};
  if (is_depth(format)) {
    std::vector<std::uint32_t> codes(count);
    for (std::uint32_t& code : codes) {
      code = static_cast<std::uint32_t>(random.next()) & (format == InternalFormat::depth16 ? 0xFFFFU : 0xFFFFFFU);
    }
    image.samples = std::move(codes);
  } else if (format == InternalFormat::rgba16f) {
    std::vector<Half> halves(count);
    for (Half& half : halves) half = random_half(random);
    image.samples = std::move(halves);
  } else if (format == InternalFormat::rgba32f) {
    std::vector<float> reals(count);
    for (float& real : reals) {
      real = random.one_in(8) ? std::ldexp(random.real_f(-1, 1), random.between(-60, 60)) : random.real_f(-0.2, 1.2);
    }
    image.samples = std::move(reals);
  } else {
    std::vector<std::uint8_t> bytes(count);
    for (std::uint8_t& byte : bytes) byte = random.byte();
    image.samples = std::move(bytes);
  }
  return image;
}

}  // namespace

Texture random_texture(Random& random, TextureTarget target, InternalFormat format, int width, int height,
                       bool with_levels) {
  std::vector<std::vector<TextureSamples>> faces(target == TextureTarget::cube_map ? 6 : 1);
  for (std::vector<TextureSamples>& levels : faces) {
    int depth = target == TextureTarget::texture_3d ? 1 << random.below(4) : 1;
    for (int w = width, h = height;; w = std::max(w / 2, 1), h = std::max(h / 2, 1), depth = std::max(depth / 2, 1)) {
      levels.push_back(random_image(random, format, w, h, depth));
      if (!with_levels || (w == 1 && h == 1 && depth == 1)) break;
    }
  }
  return make_texture(target, format, std::move(faces)).value();
}

Texture texture_of_levels(int size, const std::vector<std::uint8_t>& values) {
  std::vector<TextureSamples> levels;
  for (const std::uint8_t value : values) {
    levels.push_back({size, size, std::vector<std::uint8_t>(static_cast<std::size_t>(size * size), value)});
    size /= 2;
  }
  return make_texture(TextureTarget::texture_2d, InternalFormat::luminance8, {std::move(levels)}).value();
}

Texture cube_of_places(int size) {
  std::vector<std::vector<TextureSamples>> faces;
  for (int face = 0; face < 6; ++face) {
    std::vector<std::uint8_t> bytes;
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < size * size; ++i) {
        bytes.push_back(static_cast<std::uint8_t>(k == 0 ? i % size : k == 1 ? i / size : face));
      }
    }
    faces.push_back({{size, size, std::move(bytes)}});
  }
  return make_texture(TextureTarget::cube_map, InternalFormat::rgb8, std::move(faces)).value();
}

float random_coordinate(Random& random, int size) {
  switch (random.below(8)) {
    case 0:
    case 1: {  // an edge or a middle of a texel, or a neighbouring float
      const auto place = static_cast<float>(random.between(-3 * size, 5 * size)) / (2.0F * static_cast<float>(size));
      return random.pick({place, std::nextafter(place, kInfinity), std::nextafter(place, -kInfinity)});
    }
    case 2: {  // a step of the weights
      const auto step = static_cast<float>(random.between(-512 * size, 1024 * size));
      const float place = step / (512.0F * static_cast<float>(size));
      return random.pick({place, std::nextafter(place, kInfinity), std::nextafter(place, -kInfinity)});
    }
    case 3:
      return random.pick({0.0F, -0.0F, 1.0F, -1.0F, 0.5F, 2.0F, std::numeric_limits<float>::denorm_min(),
                          -std::numeric_limits<float>::denorm_min(), std::nextafter(1.0F, 0.0F)});
    case 4:
      return std::ldexp(random.real_f(-2, 2), random.between(-130, 127));
    case 5:
      if (random.one_in(4)) {
        return random.pick({kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()});
      }
      return random.real_f(-40, 40);
    default:
      return random.real_f(-0.5, 1.5);
  }
}

float random_change(Random& random) {
  if (random.one_in(12)) {
    return random.pick({0.0F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), 1e38F,
                        std::numeric_limits<float>::denorm_min()});
  }
  if (random.one_in(4)) return std::ldexp(random.one_in(2) ? 1.0F : -1.0F, random.between(-10, 3));
  return std::ldexp(random.real_f(-1, 1), random.between(-10, 3));
}

oracle::TextureQuestion texture_question(const HardwareProfile& profile, const Texture& texture,
                                         const Sampler& sampler) {
  return {.weight_bits = profile.texture_weight_bits,
          .cuts_weights = profile.texture_weight_narrowing.value == Narrowing::toward_zero,
          .rounds_each = profile.texture_filter_rounding.value == FilterRounding::each_blend,
          .cuts_bias = profile.texture_bias_narrowing.value == Narrowing::toward_zero,
          .texture = &texture,
          .sampler = sampler};
}

void CoordinateArrays::push(const std::array<float, 3>& v, const std::array<float, 3>& x,
                            const std::array<float, 3>& y) {
  for (std::size_t k = 0; k < 3; ++k) {
    value[k].push_back(v[k]);
    dx[k].push_back(x[k]);
    dy[k].push_back(y[k]);
  }
}

TextureCoordinates CoordinateArrays::view(std::size_t first) const {
  const auto arrays = [&](const std::array<std::vector<float>, 3>& v) {
    return std::array<const float*, 3>{v[0].data() + first, v[1].data() + first, v[2].data() + first};
  };
  return {arrays(value), arrays(dx), arrays(dy)};
}

CodeArrays::CodeArrays(std::size_t count) {
  for (std::vector<s9>& codes : plane) codes.assign(count, s9{-999});
}

std::array<s9*, 4> CodeArrays::at(std::size_t first) {
  return {plane[0].data() + first, plane[1].data() + first, plane[2].data() + first, plane[3].data() + first};
}

Texel texel_at(const TextureSampler& sampler, const std::array<float, 3>& coordinate, const std::array<float, 3>& dx,
               const std::array<float, 3>& dy) {
  CoordinateArrays arrays;
  arrays.push(coordinate, dx, dy);
  return sampler.texel(arrays.view(), 0);
}

}  // namespace ninebit::test
