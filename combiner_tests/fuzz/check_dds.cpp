// DDS files.
#include <algorithm>
#include <string>

#include "combiner_tests/fuzz/checks.h"
#include "combiner_tests/fuzz/common.h"
#include "combiner_tests/fuzz/memory_file.h"
#include "src/image/texture/texture_file.h"

namespace ninebit::fuzz {
namespace {

using image_detail::FileTexture;

Result<FileTexture> no_picture(const image_detail::PictureSource& source) {
  return Diagnostic{.message = "is no DDS file", .file = source.file.string()};
}

std::string wrong_with_texture(const Texture& texture, bool mipmaps) {
  if (const Status fits = check_texture(texture); !fits) return "it is no texture: " + fits.error().message;
  if (!is_complete(texture, mipmaps)) return "it is not complete";
  return texture.faces[0][0].width <= kMaxSurfaceSize ? "" : "it is too large";
}

std::string wrong_with_file(const std::string& file, const HardwareProfile& profile, TextureReadOptions options) {
  const auto texture = image_detail::read_texture(profile, file, options, {.read = no_picture});
  if (texture) return wrong_with_texture(*texture, options.mipmaps);
  if (texture.error().file != file) return "a fault names the file '" + texture.error().file + "'";
  return wrong_with_message(texture.error().message);
}

}  // namespace

std::string check_dds(std::string_view bytes) {
  HardwareProfile other = profiles::geforce2;
  other.dxt1_palette.value = Dxt1Palette::rgb888;
  const MemoryFile file(bytes);
  for (const HardwareProfile& profile : {profiles::geforce2, other}) {
    for (const TextureReadOptions& options : {TextureReadOptions{}, {.mipmaps = true, .flip = true}}) {
      std::string wrong = wrong_with_file(file.path(), profile, options);
      if (!wrong.empty()) return wrong;
    }
  }
  return {};
}

}  // namespace ninebit::fuzz
