#include "src/gl_layer/calls/paletted_textures.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "src/gl_layer/calls/display_lists.h"
#include "src/gl_layer/calls/paletted_pixels.h"
#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/lookups.h"

namespace ninebit::gl_layer {
namespace {

bool has_palettes(const Context* context) {
  return context != nullptr && context->features.extras.have(Extra::paletted_texture);
}

GLenum texture_target(GLenum image) {
  const bool is_face = image >= GL_TEXTURE_CUBE_MAP_POSITIVE_X && image <= GL_TEXTURE_CUBE_MAP_NEGATIVE_Z;
  return is_face ? GLenum{GL_TEXTURE_CUBE_MAP} : image;
}

// Where the texture that is bound to a target is recorded; the name is empty for a target without palettes.
std::optional<std::pair<unsigned, unsigned>> bound_texture(GLenum image) {
  const GLenum target = texture_target(image);
  GLenum binding = 0;
  if (target == GL_TEXTURE_1D) binding = GL_TEXTURE_BINDING_1D;
  if (target == GL_TEXTURE_2D) binding = GL_TEXTURE_BINDING_2D;
  if (target == GL_TEXTURE_3D) binding = GL_TEXTURE_BINDING_3D;
  if (target == GL_TEXTURE_CUBE_MAP) binding = GL_TEXTURE_BINDING_CUBE_MAP;
  if (binding == 0) return std::nullopt;
  return std::pair{target, static_cast<unsigned>(driver_integer(binding))};
}

// While it lives, the driver reads pixels without gaps and leaves their values as they are.
class PlainPixels {
 public:
  PlainPixels() {
    found_driver.PushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
    found_driver.PushAttrib(GL_PIXEL_MODE_BIT);
    if (found_driver.BindBuffer != nullptr) found_driver.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    found_driver.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    for (const int name : {GL_UNPACK_SWAP_BYTES, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
                           GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES}) {
      found_driver.PixelStorei(static_cast<GLenum>(name), 0);
    }
    found_driver.PixelTransferi(GL_MAP_COLOR, GL_FALSE);
    for (const int name : {GL_RED_SCALE, GL_GREEN_SCALE, GL_BLUE_SCALE, GL_ALPHA_SCALE}) {
      found_driver.PixelTransferf(static_cast<GLenum>(name), 1);
    }
    for (const int name : {GL_RED_BIAS, GL_GREEN_BIAS, GL_BLUE_BIAS, GL_ALPHA_BIAS}) {
      found_driver.PixelTransferf(static_cast<GLenum>(name), 0);
    }
  }
  ~PlainPixels() {
    found_driver.PopAttrib();
    found_driver.PopClientAttrib();
  }
  PlainPixels(const PlainPixels&) = delete;
  PlainPixels& operator=(const PlainPixels&) = delete;
};

// Gives the driver an image of the texture that is bound to its target.
void upload(const std::pair<unsigned, int>& at, const IndexImage& image, const Palette& palette) {
  std::vector<PaletteColor> texels;
  texels.reserve(image.indices.size());
  for (const std::uint16_t index : image.indices) texels.push_back(palette.colors[index & (palette.colors.size() - 1)]);
  const PlainPixels plain;
  const auto& [target, level] = at;
  const auto& [width, height, depth] = image.size;
  if (image.dimensions == 1) {
    found_driver.TexImage1D(target, level, GL_RGBA8, width, image.border, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
  } else if (image.dimensions == 2) {
    found_driver.TexImage2D(target, level, GL_RGBA8, width, height, image.border, GL_RGBA, GL_UNSIGNED_BYTE,
                            texels.data());
  } else {
    found_driver.TexImage3D(target, level, GL_RGBA8, width, height, depth, image.border, GL_RGBA, GL_UNSIGNED_BYTE,
                            texels.data());
  }
}

const Palette& palette_of(const Context& context, const PalettedTexture& texture) {
  return context.shared_palette.enabled ? context.shared_palette.palette : texture.palette;
}

// With the group's mutex: all textures have other colours.
void upload_all(Context& context) {
  for (const auto& [key, texture] : context.group->paletted) {
    const auto bound = bound_texture(key.first);
    found_driver.BindTexture(key.first, key.second);
    for (const auto& [at, image] : texture.images) upload(at, image, palette_of(context, texture));
    if (bound) found_driver.BindTexture(key.first, bound->second);
  }
}

// Runs a command, or puts it into the display list that is open. What it captures must be values.
void run_or_record(std::function<void(Context&)> command) {
  Context& context = *current();
  if (context.open_list != nullptr) {
    if (context.list_in_begin()) return record_begin_error(context);
    return record(context, [command = std::move(command)] {
      if (Context* const now = current(); now != nullptr && now->outside_begin()) command(*now);
    });
  }
  if (context.outside_begin()) command(context);
}

void store_image(Context& context, const std::pair<unsigned, int>& at, IndexImage image) {
  const auto key = bound_texture(at.first);
  if (!key) return context.raise(GL_INVALID_ENUM);
  const std::lock_guard lock(context.group->mutex);
  PalettedTexture& texture = context.group->paletted[*key];
  const GLenum before = found_driver.GetError();
  upload(at, image, palette_of(context, texture));
  const GLenum error = found_driver.GetError();
  if (error == GL_NO_ERROR) texture.images[at] = std::move(image);
  if (before != GL_NO_ERROR || error != GL_NO_ERROR) context.raise(before != GL_NO_ERROR ? before : error);
}

// The palette of a target; nullptr: it is not one, and an error is raised. With the group's mutex.
Palette* find_palette(Context& context, GLenum target) {
  if (target == GL_SHARED_TEXTURE_PALETTE_EXT && context.features.extras.have(Extra::shared_texture_palette)) {
    return &context.shared_palette.palette;
  }
  const auto key = texture_target(target) == target ? bound_texture(target) : std::nullopt;
  if (key) return &context.group->paletted[*key].palette;
  context.raise(GL_INVALID_ENUM);
  return nullptr;
}

void show_palette(Context& context, GLenum target) {
  if (target == GL_SHARED_TEXTURE_PALETTE_EXT) {
    if (context.shared_palette.enabled) upload_all(context);
  } else if (!context.shared_palette.enabled) {
    const auto key = bound_texture(target);
    for (const auto& [at, image] : context.group->paletted[*key].images) {
      upload(at, image, context.group->paletted[*key].palette);
    }
  }
  ++context.group->images_changed;
}

bool is_of_colors(Context& context, GLenum format, GLenum type) {
  if (!components_of_colors(format).empty() && component_bytes(type) != 0) return true;
  context.raise(GL_INVALID_ENUM);
  return false;
}

void color_table(GLenum target, GLenum internal, GLsizei width, GLenum format, GLenum type, const void* data) {
  Context& now = *current();
  note_use(Asked::paletted_texture);
  if (palette_base(internal) == GL_NONE) return now.raise(GL_INVALID_ENUM);
  if (width < 1 || width > 65536 || (width & (width - 1)) != 0) return now.raise(GL_INVALID_VALUE);
  if (!is_of_colors(now, format, type)) return;
  run_or_record([=, colors = read_colors(width, format, type, data, palette_base(internal))](Context& context) {
    const std::lock_guard lock(context.group->mutex);
    Palette* const palette = find_palette(context, target);
    if (palette == nullptr) return;
    *palette = {.format = internal, .colors = colors};
    show_palette(context, target);
  });
}

void color_sub_table(GLenum target, GLsizei start, GLsizei count, GLenum format, GLenum type, const void* data) {
  Context& now = *current();
  if (start < 0 || count < 0) return now.raise(GL_INVALID_VALUE);
  if (!is_of_colors(now, format, type)) return;
  // How they are kept is known when they are.
  run_or_record([=, colors = read_colors(count, format, type, data, GL_RGBA)](Context& context) {
    const std::lock_guard lock(context.group->mutex);
    Palette* const palette = find_palette(context, target);
    if (palette == nullptr) return;
    const auto begin = static_cast<std::size_t>(start);
    if (begin + colors.size() > palette->colors.size()) return context.raise(GL_INVALID_VALUE);
    for (std::size_t i = 0; i < colors.size(); ++i) {
      std::array<double, 4> color{};
      for (std::size_t k = 0; k < 4; ++k) color[k] = colors[i][k] / 255.0;
      palette->colors[begin + i] = kept_color(color, palette_base(palette->format));
    }
    show_palette(context, target);
  });
}

void get_color_table(GLenum target, GLenum format, GLenum type, void* data) {
  Context& context = *current();
  if (!context.outside_begin()) return;
  const std::lock_guard lock(context.group->mutex);
  const Palette* const palette = find_palette(context, target);
  if (palette == nullptr) return;
  const std::vector<std::size_t> components = components_of_colors(format);
  const bool is_type = type == GL_UNSIGNED_BYTE || type == GL_FLOAT;
  if (components.empty() || components[0] == 4 || !is_type) return context.raise(GL_INVALID_ENUM);
  std::size_t at = 0;
  for (const PaletteColor& color : palette->colors) {
    for (const std::size_t i : components) {
      if (type == GL_FLOAT) {
        static_cast<GLfloat*>(data)[at++] = static_cast<GLfloat>(color[i]) / 255;
      } else {
        static_cast<GLubyte*>(data)[at++] = color[i];
      }
    }
  }
}

template <class T>
void get_color_table_parameter(GLenum target, GLenum pname, T* params) {
  Context& context = *current();
  if (!context.outside_begin()) return;
  const std::lock_guard lock(context.group->mutex);
  const Palette* const palette = find_palette(context, target);
  if (palette == nullptr) return;
  const GLenum base = palette_base(palette->format);
  const auto size = [&](bool is_kept) { *params = static_cast<T>(is_kept ? 8 : 0); };
  switch (pname) {
    case GL_COLOR_TABLE_FORMAT:
      *params = static_cast<T>(palette->format);
      return;
    case GL_COLOR_TABLE_WIDTH:
      *params = static_cast<T>(palette->colors.size());
      return;
    case GL_COLOR_TABLE_RED_SIZE:
    case GL_COLOR_TABLE_GREEN_SIZE:
    case GL_COLOR_TABLE_BLUE_SIZE:
      return size(base == GL_RGB || base == GL_RGBA);
    case GL_COLOR_TABLE_ALPHA_SIZE:
      return size(base == GL_RGBA || base == GL_ALPHA || base == GL_LUMINANCE_ALPHA);
    case GL_COLOR_TABLE_LUMINANCE_SIZE:
      return size(base == GL_LUMINANCE || base == GL_LUMINANCE_ALPHA);
    case GL_COLOR_TABLE_INTENSITY_SIZE:
      return size(base == GL_INTENSITY);
    default:
      context.raise(GL_INVALID_ENUM);
  }
}

// What glGetTexLevelParameter says of an image of indices; empty: the driver answers.
std::optional<GLint> index_image_value(GLenum target, GLint level, GLenum pname) {
  Context* const context = current();
  const bool is_asked = pname == GL_TEXTURE_INDEX_SIZE_EXT || pname == GL_TEXTURE_INTERNAL_FORMAT;
  if (!is_asked || !has_palettes(context) || context->in_begin) return std::nullopt;
  const auto key = bound_texture(target);
  const std::lock_guard lock(context->group->mutex);
  const auto texture = key ? context->group->paletted.find(*key) : context->group->paletted.end();
  if (texture != context->group->paletted.end()) {
    const auto image = texture->second.images.find({target, level});
    if (image != texture->second.images.end()) {
      const GLenum format = image->second.format;
      return pname == GL_TEXTURE_INTERNAL_FORMAT ? static_cast<GLint>(format) : bits_of(format);
    }
  }
  return pname == GL_TEXTURE_INDEX_SIZE_EXT ? std::optional(0) : std::nullopt;
}

}  // namespace

bool is_index_format(int internal) {
  return internal >= GL_COLOR_INDEX1_EXT && internal <= GL_COLOR_INDEX16_EXT && has_palettes(current());
}

void define_index_image(unsigned internal, const GivenPixels& given) {
  Context& context = *current();
  if (given.format != GL_COLOR_INDEX) return context.raise(GL_INVALID_OPERATION);
  if (component_bytes(given.type) == 0) return context.raise(GL_INVALID_ENUM);
  const bool is_size =
      std::all_of(given.size.begin(), given.size.end(), [](int side) { return side >= 0 && side <= 16384; });
  if (!is_size) return context.raise(GL_INVALID_VALUE);
  IndexImage image{.format = internal, .dimensions = given.dimensions, .size = given.size, .border = given.border};
  image.indices = read_indices(given, internal);
  run_or_record([at = std::pair{given.target, given.level}, image](Context& now) {
    store_image(now, at, image);
    mark_images_changed();
  });
}

bool replace_indices(const GivenPixels& given) {
  Context* const context = current();
  if (given.format != GL_COLOR_INDEX || !has_palettes(context)) return false;
  if (component_bytes(given.type) == 0) {
    context->raise(GL_INVALID_ENUM);
    return true;
  }
  run_or_record([given, indices = read_indices(given, GL_COLOR_INDEX16_EXT)](Context& now) {
    const auto key = bound_texture(given.target);
    const std::lock_guard lock(now.group->mutex);
    const auto texture = key ? now.group->paletted.find(*key) : now.group->paletted.end();
    if (texture == now.group->paletted.end()) return now.raise(GL_INVALID_OPERATION);
    const std::pair at{given.target, given.level};
    const auto found = texture->second.images.find(at);
    if (found == texture->second.images.end()) return now.raise(GL_INVALID_OPERATION);
    IndexImage& image = found->second;
    for (std::size_t i = 0; i < 3; ++i) {
      const int border = i < static_cast<std::size_t>(image.dimensions) ? image.border : 0;
      const int begin = given.offset[i] + border;
      if (begin < 0 || given.size[i] < 0 || given.size[i] > image.size[i] - begin) return now.raise(GL_INVALID_VALUE);
    }
    const auto mask = static_cast<std::uint16_t>((1 << bits_of(image.format)) - 1);
    const int border_y = image.dimensions > 1 ? image.border : 0, border_z = image.dimensions > 2 ? image.border : 0;
    std::size_t from = 0;
    for (int z = 0; z < given.size[2]; ++z) {
      for (int y = 0; y < given.size[1]; ++y) {
        for (int x = 0; x < given.size[0]; ++x) {
          const int row = (given.offset[2] + border_z + z) * image.size[1] + given.offset[1] + border_y + y;
          const int to = row * image.size[0] + given.offset[0] + image.border + x;
          image.indices[static_cast<std::size_t>(to)] = static_cast<std::uint16_t>(indices[from++] & mask);
        }
      }
    }
    upload(at, image, palette_of(now, texture->second));
    mark_stale();
  });
  return true;
}

void forget_index_image(unsigned target, int level) {
  Context* const context = current();
  if (!has_palettes(context) || context->in_begin || context->open_list != nullptr) return;
  const std::lock_guard lock(context->group->mutex);
  if (context->group->paletted.empty()) return;
  const auto key = bound_texture(target);
  const auto texture = key ? context->group->paletted.find(*key) : context->group->paletted.end();
  if (texture != context->group->paletted.end()) texture->second.images.erase({target, level});
}

void forget_paletted_textures(int count, const unsigned* names) {
  Context* const context = current();
  if (!has_palettes(context) || count <= 0) return;
  const std::lock_guard lock(context->group->mutex);
  std::erase_if(context->group->paletted, [&](const auto& texture) {
    const unsigned name = texture.first.second;
    return name != 0 && std::find(names, names + count, name) != names + count;
  });
}

void enable_shared_palette(bool enabled) {
  run_or_record([enabled](Context& context) {
    if (context.shared_palette.enabled == enabled) return;
    context.shared_palette.enabled = enabled;
    const std::lock_guard lock(context.group->mutex);
    upload_all(context);
    ++context.group->images_changed;
  });
}

}  // namespace ninebit::gl_layer

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

#define NINEBIT_PALETTE_CALL(name, parameters, arguments, own)                    \
  GLAPI void GLAPIENTRY gl##name parameters {                                     \
    if (has_palettes(current())) return own arguments;                            \
    static const auto next = next_function_as<decltype(&::gl##name)>("gl" #name); \
    if (next != nullptr) next arguments;                                          \
  }

NINEBIT_PALETTE_CALL(ColorTableEXT,
                     (GLenum target, GLenum internalFormat, GLsizei width, GLenum format, GLenum type,
                      const void* table),
                     (target, internalFormat, width, format, type, table), color_table)
NINEBIT_PALETTE_CALL(ColorSubTableEXT,
                     (GLenum target, GLsizei start, GLsizei count, GLenum format, GLenum type, const void* data),
                     (target, start, count, format, type, data), color_sub_table)
NINEBIT_PALETTE_CALL(GetColorTableEXT, (GLenum target, GLenum format, GLenum type, void* data),
                     (target, format, type, data), get_color_table)
NINEBIT_PALETTE_CALL(GetColorTableParameterivEXT, (GLenum target, GLenum pname, GLint* params), (target, pname, params),
                     get_color_table_parameter)
NINEBIT_PALETTE_CALL(GetColorTableParameterfvEXT, (GLenum target, GLenum pname, GLfloat* params),
                     (target, pname, params), get_color_table_parameter)

GLAPI void GLAPIENTRY glGetTexLevelParameteriv(GLenum target, GLint level, GLenum pname, GLint* params) {
  const auto value = index_image_value(target, level, pname);
  if (!value) return find_driver().GetTexLevelParameteriv(target, level, pname, params);
  *params = *value;
}

GLAPI void GLAPIENTRY glGetTexLevelParameterfv(GLenum target, GLint level, GLenum pname, GLfloat* params) {
  const auto value = index_image_value(target, level, pname);
  if (!value) return find_driver().GetTexLevelParameterfv(target, level, pname, params);
  *params = static_cast<GLfloat>(*value);
}
