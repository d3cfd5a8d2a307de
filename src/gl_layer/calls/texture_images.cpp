// Texture images with pixels: the formats of NV_texture_shader become the driver's, with a pixel transfer of their own.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "src/gl_layer/calls/display_lists.h"
#include "src/gl_layer/calls/paletted_textures.h"
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/log.h"
#include "src/gl_layer/shader/texture_formats.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

namespace {

bool is_layers_transfer(GLenum pname) {
  const Context* const context = current();
  return pname >= GL_HI_SCALE_NV && pname <= GL_VIBRANCE_BIAS_NV && context != nullptr &&
         context->combiners.profile().texture_shaders;
}

void set_transfer(GLenum pname, GLfloat value) {
  Context* const context = current();
  if (context == nullptr) return;
  context->touched = true;
  if (context->open_list != nullptr) {
    if (context->list_in_begin()) return record_begin_error(*context);
    return record(*context, [=] { set_transfer(pname, value); });
  }
  if (context->outside_begin()) context->pixel_transfer[pname - GL_HI_SCALE_NV] = value;
}

// The components of a format of pixels that NV_texture_shader adds, as numbers of StagePixelTransfer; empty: others.
std::vector<std::size_t> components_of(GLenum format) {
  switch (format) {
    case GL_HILO_NV:
      return {0, 1};
    case GL_DSDT_NV:
      return {2, 3};
    case GL_DSDT_MAG_NV:
      return {2, 3, 4};
    case GL_DSDT_MAG_VIB_NV:
      return {2, 3, 4, 5};
    default:
      return {};
  }
}

// While it lives, the driver transfers the components of a new format by their own scales and biases, and maps no
// colours. In a display list, both commands go into the driver's list.
class PixelTransfer {
 public:
  explicit PixelTransfer(GLenum format) {
    const Context* const context = current();
    const std::vector<std::size_t> components = components_of(format);
    if (components.empty() || context == nullptr || context->in_begin) return;
    if (context->open_list != nullptr && context->list_in_begin()) return;
    if (driver_integer(GL_ATTRIB_STACK_DEPTH) >= driver_integer(GL_MAX_ATTRIB_STACK_DEPTH)) {
      log_once("the attribute stack is full: HILO and DSDT pixels are not scaled and biased");
      return;
    }
    found_driver.PushAttrib(GL_PIXEL_MODE_BIT);
    is_pushed_ = true;
    found_driver.PixelTransferi(GL_MAP_COLOR, GL_FALSE);
    constexpr GLenum kScales[]{GL_RED_SCALE, GL_GREEN_SCALE, GL_BLUE_SCALE, GL_ALPHA_SCALE};
    constexpr GLenum kBiases[]{GL_RED_BIAS, GL_GREEN_BIAS, GL_BLUE_BIAS, GL_ALPHA_BIAS};
    for (std::size_t i = 0; i < components.size(); ++i) {
      found_driver.PixelTransferf(kScales[i], context->pixel_transfer[components[i]]);
      found_driver.PixelTransferf(kBiases[i], context->pixel_transfer[6 + components[i]]);
    }
  }
  ~PixelTransfer() {
    if (is_pushed_) found_driver.PopAttrib();
  }
  PixelTransfer(const PixelTransfer&) = delete;
  PixelTransfer& operator=(const PixelTransfer&) = delete;

 private:
  bool is_pushed_ = false;
};

// Pixels as the driver takes them. The types with two signed and two unsigned bytes, which no driver has, become
// floats.
class Pixels {
 public:
  Pixels(GLenum of_format, GLenum of_type, const GLvoid* pixels, const std::array<GLsizei, 3>& size)
      : format(stored_pixel_format(of_format)), type(of_type), data(pixels), transfer_(of_format) {
    const bool is_packed = type == GL_UNSIGNED_INT_S8_S8_8_8_NV || type == GL_UNSIGNED_INT_8_8_S8_S8_REV_NV;
    if (!is_packed || of_format != GL_DSDT_MAG_VIB_NV) return;
    if (driver_integer(GL_PIXEL_UNPACK_BUFFER_BINDING) != 0) {
      log_once("pixels of type GL_UNSIGNED_INT_S8_S8_8_8_NV are not read from buffer objects");
      return;
    }
    type = GL_FLOAT;
    if (data == nullptr) return;
    unpack(of_type == GL_UNSIGNED_INT_S8_S8_8_8_NV, size);
    data = floats_.data();
    found_driver.PushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
    is_pushed_ = true;
    for (const int name : {GL_UNPACK_SWAP_BYTES, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
                           GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES}) {
      found_driver.PixelStorei(static_cast<GLenum>(name), 0);
    }
  }
  ~Pixels() {
    if (is_pushed_) found_driver.PopClientAttrib();
  }
  Pixels(const Pixels&) = delete;
  Pixels& operator=(const Pixels&) = delete;

  GLenum format, type;
  const GLvoid* data;

 private:
  // Words that begin with ds at the highest bits, or at the lowest.
  void unpack(bool begins_high, const std::array<GLsizei, 3>& size) {
    const auto value = [](GLenum name) { return static_cast<std::size_t>(driver_integer(name)); };
    const auto side = [&](std::size_t i) { return static_cast<std::size_t>(std::max(size[i], 0)); };
    const std::size_t row_length = value(GL_UNPACK_ROW_LENGTH), image_height = value(GL_UNPACK_IMAGE_HEIGHT);
    const std::size_t alignment = std::max<std::size_t>(value(GL_UNPACK_ALIGNMENT), 4);
    const std::size_t row = (4 * (row_length != 0 ? row_length : side(0)) + alignment - 1) / alignment * alignment;
    const std::size_t image = row * (image_height != 0 ? image_height : side(1));
    const bool swap = driver_integer(GL_UNPACK_SWAP_BYTES) != 0;
    const std::size_t skipped =
        value(GL_UNPACK_SKIP_IMAGES) * image + value(GL_UNPACK_SKIP_ROWS) * row + value(GL_UNPACK_SKIP_PIXELS) * 4;
    const auto* const begin = static_cast<const std::uint8_t*>(data) + skipped;
    floats_.reserve(4 * side(0) * side(1) * side(2));
    for (std::size_t z = 0; z < side(2); ++z) {
      for (std::size_t y = 0; y < side(1); ++y) {
        for (std::size_t x = 0; x < side(0); ++x) {
          std::uint32_t word = 0;
          std::memcpy(&word, begin + z * image + y * row + 4 * x, 4);
          for (unsigned i = 0; i < 4; ++i) {
            const auto byte = static_cast<std::uint8_t>(word >> (begins_high != swap ? 24 - 8 * i : 8 * i));
            const bool is_signed = i < 2;
            floats_.push_back(is_signed ? std::max(-1.0F, static_cast<float>(static_cast<std::int8_t>(byte)) / 127.0F)
                                        : static_cast<float>(byte) / 255.0F);
          }
        }
      }
    }
  }

  PixelTransfer transfer_;
  std::vector<float> floats_{};
  bool is_pushed_ = false;
};

}  // namespace

GLAPI void GLAPIENTRY glPixelTransferf(GLenum pname, GLfloat param) {
  is_layers_transfer(pname) ? set_transfer(pname, param) : find_driver().PixelTransferf(pname, param);
}

GLAPI void GLAPIENTRY glPixelTransferi(GLenum pname, GLint param) {
  is_layers_transfer(pname) ? set_transfer(pname, static_cast<GLfloat>(param))
                            : find_driver().PixelTransferi(pname, param);
}

GLAPI void GLAPIENTRY glTexImage1D(GLenum target, GLint level, GLint internal, GLsizei width, GLint border,
                                   GLenum format, GLenum type, const GLvoid* pixels) {
  const auto call = find_driver().TexImage1D;
  const GivenPixels given{.target = target,
                          .level = level,
                          .dimensions = 1,
                          .size = {width, 1, 1},
                          .border = border,
                          .format = format,
                          .type = type,
                          .pixels = pixels};
  if (is_index_format(internal)) return define_index_image(static_cast<GLenum>(internal), given);
  forget_index_image(target, level);
  const Pixels stored(format, type, pixels, {width, 1, 1});
  call(target, level, stored_format(internal), width, border, stored.format, stored.type, stored.data);
  mark_images_changed();
}

GLAPI void GLAPIENTRY glTexImage2D(GLenum target, GLint level, GLint internal, GLsizei width, GLsizei height,
                                   GLint border, GLenum format, GLenum type, const GLvoid* pixels) {
  const auto call = find_driver().TexImage2D;
  const GivenPixels given{.target = target,
                          .level = level,
                          .dimensions = 2,
                          .size = {width, height, 1},
                          .border = border,
                          .format = format,
                          .type = type,
                          .pixels = pixels};
  if (is_index_format(internal)) return define_index_image(static_cast<GLenum>(internal), given);
  forget_index_image(target, level);
  const Pixels stored(format, type, pixels, {width, height, 1});
  call(target, level, stored_format(internal), width, height, border, stored.format, stored.type, stored.data);
  mark_images_changed();
}

GLAPI void GLAPIENTRY glTexImage3D(GLenum target, GLint level, GLint internal, GLsizei width, GLsizei height,
                                   GLsizei depth, GLint border, GLenum format, GLenum type, const GLvoid* pixels) {
  const auto call = find_driver().TexImage3D;
  if (call == nullptr) return;
  const GivenPixels given{.target = target,
                          .level = level,
                          .dimensions = 3,
                          .size = {width, height, depth},
                          .border = border,
                          .format = format,
                          .type = type,
                          .pixels = pixels};
  if (is_index_format(internal)) return define_index_image(static_cast<GLenum>(internal), given);
  forget_index_image(target, level);
  const Pixels stored(format, type, pixels, {width, height, depth});
  call(target, level, stored_format(internal), width, height, depth, border, stored.format, stored.type, stored.data);
  mark_images_changed();
}

GLAPI void GLAPIENTRY glTexSubImage1D(GLenum target, GLint level, GLint x, GLsizei width, GLenum format, GLenum type,
                                      const GLvoid* pixels) {
  const auto call = find_driver().TexSubImage1D;
  const GivenPixels given{.target = target,
                          .level = level,
                          .dimensions = 1,
                          .offset = {x, 0, 0},
                          .size = {width, 1, 1},
                          .format = format,
                          .type = type,
                          .pixels = pixels};
  if (replace_indices(given)) return;
  const Pixels stored(format, type, pixels, {width, 1, 1});
  call(target, level, x, width, stored.format, stored.type, stored.data);
  mark_stale();
}

GLAPI void GLAPIENTRY glTexSubImage2D(GLenum target, GLint level, GLint x, GLint y, GLsizei width, GLsizei height,
                                      GLenum format, GLenum type, const GLvoid* pixels) {
  const auto call = find_driver().TexSubImage2D;
  const GivenPixels given{.target = target,
                          .level = level,
                          .dimensions = 2,
                          .offset = {x, y, 0},
                          .size = {width, height, 1},
                          .format = format,
                          .type = type,
                          .pixels = pixels};
  if (replace_indices(given)) return;
  const Pixels stored(format, type, pixels, {width, height, 1});
  call(target, level, x, y, width, height, stored.format, stored.type, stored.data);
  mark_stale();
}

GLAPI void GLAPIENTRY glTexSubImage3D(GLenum target, GLint level, GLint x, GLint y, GLint z, GLsizei width,
                                      GLsizei height, GLsizei depth, GLenum format, GLenum type, const GLvoid* pixels) {
  const auto call = find_driver().TexSubImage3D;
  if (call == nullptr) return;
  const GivenPixels given{.target = target,
                          .level = level,
                          .dimensions = 3,
                          .offset = {x, y, z},
                          .size = {width, height, depth},
                          .format = format,
                          .type = type,
                          .pixels = pixels};
  if (replace_indices(given)) return;
  const Pixels stored(format, type, pixels, {width, height, depth});
  call(target, level, x, y, z, width, height, depth, stored.format, stored.type, stored.data);
  mark_stale();
}
