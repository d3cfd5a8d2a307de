#include "src/gl_layer/calls/paletted_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "src/gl_layer/driver/log.h"

namespace ninebit::gl_layer {
namespace {

double number_at(const unsigned char* at, GLenum type, bool swap) {
  std::array<unsigned char, 4> bytes{};
  const std::size_t size = component_bytes(type);
  std::copy_n(at, size, bytes.begin());
  if (swap) std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  const auto as = [&](auto value) {
    std::memcpy(&value, bytes.data(), sizeof(value));
    return static_cast<double>(value);
  };
  switch (type) {
    case GL_UNSIGNED_BYTE:
      return as(GLubyte{});
    case GL_BYTE:
      return as(GLbyte{});
    case GL_UNSIGNED_SHORT:
      return as(GLushort{});
    case GL_SHORT:
      return as(GLshort{});
    case GL_UNSIGNED_INT:
      return as(GLuint{});
    case GL_INT:
      return as(GLint{});
    default:
      return as(GLfloat{});
  }
}

// The numbers of an array of pixels, as the pixel store says where they are.
std::vector<double> read_numbers(const void* pixels, GLenum type, std::size_t components,
                                 const std::array<int, 3>& size) {
  const auto side = [&](std::size_t i) { return static_cast<std::size_t>(std::max(size[i], 0)); };
  std::vector<double> numbers(components * side(0) * side(1) * side(2));
  if (driver_integer(GL_PIXEL_UNPACK_BUFFER_BINDING) != 0) {
    log_once("indices and palettes are not read from buffer objects: they are 0");
    return numbers;
  }
  if (pixels == nullptr) return numbers;
  const auto value = [](GLenum name) { return static_cast<std::size_t>(driver_integer(name)); };
  const std::size_t bytes = component_bytes(type), pixel = bytes * components;
  const std::size_t row_length = value(GL_UNPACK_ROW_LENGTH), image_height = value(GL_UNPACK_IMAGE_HEIGHT);
  const std::size_t alignment = std::max(value(GL_UNPACK_ALIGNMENT), bytes);
  const std::size_t row = (pixel * (row_length != 0 ? row_length : side(0)) + alignment - 1) / alignment * alignment;
  const std::size_t image = row * (image_height != 0 ? image_height : side(1));
  const bool swap = driver_integer(GL_UNPACK_SWAP_BYTES) != 0;
  const auto* const begin = static_cast<const unsigned char*>(pixels) + value(GL_UNPACK_SKIP_IMAGES) * image +
                            value(GL_UNPACK_SKIP_ROWS) * row + value(GL_UNPACK_SKIP_PIXELS) * pixel;
  std::size_t at = 0;
  for (std::size_t z = 0; z < side(2); ++z) {
    for (std::size_t y = 0; y < side(1); ++y) {
      for (std::size_t i = 0; i < side(0) * components; ++i) {
        numbers[at++] = number_at(begin + z * image + y * row + i * bytes, type, swap);
      }
    }
  }
  return numbers;
}

// The largest number of a type, which stands for 1.
double largest(GLenum type) {
  if (type == GL_FLOAT) return 1;
  const bool is_signed = type == GL_BYTE || type == GL_SHORT || type == GL_INT;
  return std::ldexp(1.0, static_cast<int>(8 * component_bytes(type)) - (is_signed ? 1 : 0)) - 1;
}

}  // namespace

int bits_of(GLenum format) {
  constexpr int kBits[]{1, 2, 4, 8, 12, 16};
  return kBits[format - GL_COLOR_INDEX1_EXT];
}

std::size_t component_bytes(GLenum type) {
  switch (type) {
    case GL_UNSIGNED_BYTE:
    case GL_BYTE:
      return 1;
    case GL_UNSIGNED_SHORT:
    case GL_SHORT:
      return 2;
    case GL_UNSIGNED_INT:
    case GL_INT:
    case GL_FLOAT:
      return 4;
    default:
      return 0;
  }
}

std::vector<std::uint16_t> read_indices(const GivenPixels& given, GLenum format) {
  const int shift = driver_integer(GL_INDEX_SHIFT), offset = driver_integer(GL_INDEX_OFFSET);
  const long long mask = (1LL << bits_of(format)) - 1;
  const std::vector<double> numbers = read_numbers(given.pixels, given.type, 1, given.size);
  std::vector<std::uint16_t> indices;
  indices.reserve(numbers.size());
  for (const double number : numbers) {
    const auto shifted = static_cast<long long>(std::floor(std::ldexp(number, shift)));
    indices.push_back(static_cast<std::uint16_t>((shifted + offset) & mask));
  }
  return indices;
}

std::vector<std::size_t> components_of_colors(GLenum format) {
  switch (format) {
    case GL_RED:
      return {0};
    case GL_GREEN:
      return {1};
    case GL_BLUE:
      return {2};
    case GL_ALPHA:
      return {3};
    case GL_LUMINANCE:
      return {4};
    case GL_LUMINANCE_ALPHA:
      return {4, 3};
    case GL_RGB:
      return {0, 1, 2};
    case GL_BGR:
      return {2, 1, 0};
    case GL_RGBA:
      return {0, 1, 2, 3};
    case GL_BGRA:
      return {2, 1, 0, 3};
    default:
      return {};
  }
}

GLenum palette_base(GLenum internal) {
  if (internal == GL_RGBA || (internal >= GL_RGBA2 && internal <= GL_RGBA16)) return GL_RGBA;
  if (internal == GL_RGB || internal == GL_R3_G3_B2 || (internal >= GL_RGB4 && internal <= GL_RGB16)) return GL_RGB;
  if (internal == GL_ALPHA || (internal >= GL_ALPHA4 && internal <= GL_ALPHA16)) return GL_ALPHA;
  if (internal == GL_LUMINANCE || (internal >= GL_LUMINANCE4 && internal <= GL_LUMINANCE16)) return GL_LUMINANCE;
  const bool is_both =
      internal == GL_LUMINANCE_ALPHA || (internal >= GL_LUMINANCE4_ALPHA4 && internal <= GL_LUMINANCE16_ALPHA16);
  if (is_both) return GL_LUMINANCE_ALPHA;
  return internal >= GL_INTENSITY && internal <= GL_INTENSITY16 ? GLenum{GL_INTENSITY} : GLenum{GL_NONE};
}

PaletteColor kept_color(const std::array<double, 4>& color, GLenum base) {
  PaletteColor out{};
  for (std::size_t i = 0; i < 4; ++i) {
    out[i] = static_cast<std::uint8_t>(std::lround(std::clamp(color[i], 0.0, 1.0) * 255));
  }
  const std::uint8_t first = out[0];
  if (base == GL_RGB) out[3] = 255;
  if (base == GL_ALPHA) out[0] = out[1] = out[2] = 0;
  if (base == GL_LUMINANCE) out = {first, first, first, 255};
  if (base == GL_LUMINANCE_ALPHA) out = {first, first, first, out[3]};
  if (base == GL_INTENSITY) out = {first, first, first, first};
  return out;
}

std::vector<PaletteColor> read_colors(GLsizei count, GLenum format, GLenum type, const void* data, GLenum base) {
  const std::vector<std::size_t> components = components_of_colors(format);
  const std::vector<double> numbers = read_numbers(data, type, components.size(), {count, 1, 1});
  std::vector<PaletteColor> colors;
  for (std::size_t at = 0; at < numbers.size(); at += components.size()) {
    std::array<double, 4> color{0, 0, 0, 1};
    for (std::size_t i = 0; i < components.size(); ++i) {
      const double value = numbers[at + i] / largest(type);
      if (components[i] < 4) {
        color[components[i]] = value;
      } else {
        color[0] = color[1] = color[2] = value;
      }
    }
    colors.push_back(kept_color(color, base));
  }
  return colors;
}

}  // namespace ninebit::gl_layer
