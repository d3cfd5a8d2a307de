#include "ninebit/raster/texture.h"

#include <algorithm>
#include <bit>
#include <string>

#include "src/raster/texture/cube_coordinate.h"

namespace ninebit {
namespace {

bool is_power_of_two(int side) {
  return side >= 1 && std::has_single_bit(static_cast<unsigned>(side));
}

std::string size_text(const TextureImage& image) {
  const std::string area = std::to_string(image.width) + " x " + std::to_string(image.height);
  return image.depth == 1 ? area : area + " x " + std::to_string(image.depth);
}

std::string image_name(const Texture& texture, std::size_t face, std::size_t level) {
  std::string name = "level " + std::to_string(level);
  if (texture.target == TextureTarget::cube_map) name += " of cube-map face " + std::to_string(face);
  return name;
}

// The alternative of TexelPlanes that a format has.
std::size_t planes_index(InternalFormat format) {
  switch (format) {
    case InternalFormat::depth16:
    case InternalFormat::depth24:
      return 1;
    case InternalFormat::rgba16f:
      return 2;
    case InternalFormat::rgba32f:
      return 3;
    default:
      return 0;
  }
}

// The error in an image's sides, or empty.
std::string complaint_about_size(const Texture& texture, const TextureImage& image) {
  const bool any_side = texture.target == TextureTarget::rectangle, is_3d = texture.target == TextureTarget::texture_3d;
  const int largest = is_3d ? kMax3dTextureSize : kMaxSurfaceSize;
  for (const int side : {image.width, image.height, image.depth}) {
    if (side >= 1 && side <= largest && (any_side || is_power_of_two(side))) continue;
    return " is " + size_text(image) + "; each side must be " + (any_side ? "" : "a power of two ") + "from 1 to " +
           std::to_string(largest);
  }
  if (!is_3d && image.depth != 1) return " is " + size_text(image) + "; only 3D textures have layers";
  if (texture.target == TextureTarget::texture_1d && image.height != 1) {
    return " is " + size_text(image) + "; a 1D texture has one row";
  }
  return {};
}

// The error in one image, or empty.
std::string complaint_about(const Texture& texture, const TextureImage& image) {
  if (std::string complaint = complaint_about_size(texture, image); !complaint.empty()) return complaint;
  if (texture.target == TextureTarget::cube_map && image.width != image.height) {
    return " is " + size_text(image) + "; the faces of a cube map must be square";
  }
  if (image.planes.index() != planes_index(texture.format)) return " has samples of the wrong type for its format";
  const std::array<bool, 4> stored = stored_components(texture.format);
  return std::visit(
      [&](const auto& planes) -> std::string {
        for (std::size_t i = 0; i < 4; ++i) {
          if (!stored[i]) continue;
          if (!planes[i]) return " is missing a plane that its format needs";
          if (planes[i].step >= 1 && planes[i].step <= kMaxStep) continue;
          return " has a step of " + std::to_string(planes[i].step) + " samples between texels; expected 1 to " +
                 std::to_string(kMaxStep);
        }
        return {};
      },
      image.planes);
}

}  // namespace

const CubeFaceAxes& cube_face_axes(CubeFace face) {
  static constexpr std::array<CubeFaceAxes, 6> axes{{
      {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}},
      {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
      {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
      {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
      {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
      {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
  }};
  return axes[static_cast<std::size_t>(face)];
}

CubeCoordinate cube_coordinate(float rx, float ry, float rz) {
  return cube_coordinate_inline(rx, ry, rz);
}

TextureFormat base_format(InternalFormat format) {
  switch (format) {
    case InternalFormat::alpha8:
      return TextureFormat::alpha;
    case InternalFormat::luminance8:
      return TextureFormat::luminance;
    case InternalFormat::luminance8_alpha8:
      return TextureFormat::luminance_alpha;
    case InternalFormat::intensity8:
      return TextureFormat::intensity;
    case InternalFormat::rgb8:
      return TextureFormat::rgb;
    case InternalFormat::hilo16:
      return TextureFormat::hilo;
    case InternalFormat::dsdt8:
      return TextureFormat::dsdt;
    case InternalFormat::dsdt8_mag8:
      return TextureFormat::dsdt_mag;
    case InternalFormat::dsdt8_mag8_intensity8:
      return TextureFormat::dsdt_mag_intensity;
    case InternalFormat::depth16:
    case InternalFormat::depth24:
      return TextureFormat::depth;
    case InternalFormat::rgba8:
    case InternalFormat::rgba16f:
    case InternalFormat::rgba32f:
      break;
  }
  return TextureFormat::rgba;
}

std::array<bool, 4> stored_components(InternalFormat format) {
  switch (format) {
    case InternalFormat::alpha8:
      return {false, false, false, true};
    case InternalFormat::luminance8:
    case InternalFormat::intensity8:
    case InternalFormat::depth16:
    case InternalFormat::depth24:
      return {true, false, false, false};
    case InternalFormat::luminance8_alpha8:
      return {true, false, false, true};
    case InternalFormat::rgb8:
    case InternalFormat::dsdt8_mag8:
      return {true, true, true, false};
    case InternalFormat::dsdt8:
      return {false, true, true, false};
    case InternalFormat::hilo16:
    case InternalFormat::dsdt8_mag8_intensity8:
    case InternalFormat::rgba8:
    case InternalFormat::rgba16f:
    case InternalFormat::rgba32f:
      break;
  }
  return {true, true, true, true};
}

Status check_texture(const Texture& texture) {
  const bool is_deep = texture.target == TextureTarget::cube_map || texture.target == TextureTarget::texture_3d;
  if (is_deep && base_format(texture.format) == TextureFormat::depth) {
    return Diagnostic{std::string(texture.target == TextureTarget::cube_map ? "a cube map" : "a 3D texture") +
                      " has a depth format; expected a 1D, 2D or rectangle texture"};
  }
  if (texture.target == TextureTarget::rectangle && texture.faces[0].size() > 1) {
    return Diagnostic{"a rectangle has mip-maps; it can have one level"};
  }
  for (std::size_t face = 0; face < texture.faces.size(); ++face) {
    const std::vector<TextureImage>& levels = texture.faces[face];
    if (face >= texture.face_count() && !levels.empty()) {
      constexpr std::array kNames{"a 2D texture", "", "a 1D texture", "a 3D texture", "a rectangle"};
      return Diagnostic{std::string(kNames[static_cast<std::size_t>(texture.target)]) + " has more than one face"};
    }
    if (levels.size() > static_cast<std::size_t>(kMaxTextureLevels)) {
      return Diagnostic{"a texture has " + std::to_string(levels.size()) + " levels; there can be " +
                        std::to_string(kMaxTextureLevels)};
    }
    for (std::size_t level = 0; level < levels.size(); ++level) {
      const std::string complaint = complaint_about(texture, levels[level]);
      if (!complaint.empty()) return Diagnostic{image_name(texture, face, level) + complaint};
    }
  }
  return {};
}

namespace {

std::string size_of(int width, int height, int depth) {
  std::string text = std::to_string(width) + " × " + std::to_string(height);
  if (depth > 1) text += " × " + std::to_string(depth);
  return text;
}

}  // namespace

std::string why_incomplete(const Texture& texture, bool with_mipmaps) {
  const std::vector<TextureImage>& first = texture.faces[0];
  if (first.empty()) return "it has no level 0";
  if (with_mipmaps && texture.target == TextureTarget::rectangle) {
    return "its filter reads mip-maps, which rectangles do not have";
  }
  for (std::size_t face = 0; face < texture.face_count(); ++face) {
    const std::string of_face = texture.face_count() > 1 ? " of face " + std::to_string(face) : "";
    const std::vector<TextureImage>& levels = texture.faces[face];
    int width = first[0].width, height = first[0].height, depth = first[0].depth;
    for (std::size_t level = 0;; ++level) {
      const std::string which = "level " + std::to_string(level) + of_face;
      const std::string reads = level > 0 ? "its filter reads mip-maps, and " : "";
      const std::string expected = size_of(width, height, depth);
      if (level >= levels.size()) return reads + which + " (" + expected + " texels) is missing";
      const TextureImage& image = levels[level];
      if (image.width != width || image.height != height || image.depth != depth) {
        return reads + which + " has " + size_of(image.width, image.height, image.depth) + " texels; expected " +
               expected;
      }
      if (!with_mipmaps || (width == 1 && height == 1 && depth == 1)) break;
      width = std::max(width / 2, 1);
      height = std::max(height / 2, 1);
      depth = std::max(depth / 2, 1);
    }
  }
  return {};
}

bool is_complete(const Texture& texture, bool with_mipmaps) {
  return why_incomplete(texture, with_mipmaps).empty();
}

Texture texture_view(InternalFormat format, std::span<const TextureImage> faces) {
  Texture texture{.target = faces.size() == 6 ? TextureTarget::cube_map : TextureTarget::texture_2d, .format = format};
  if (faces.size() != texture.face_count()) return texture;
  for (std::size_t face = 0; face < faces.size(); ++face) texture.faces[face] = {faces[face]};
  return texture;
}

}  // namespace ninebit
