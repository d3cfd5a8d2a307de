#include "ninebit/image/texture_io.h"

#include <memory>

#include "src/image/openimageio/image_threads.h"
#include "src/image/texture/texture_file.h"

namespace ninebit {
namespace {

Result<std::shared_ptr<void>> without_threads(const std::filesystem::path&) {
  return std::shared_ptr<void>(std::make_shared<image_detail::WithoutImageThreads>());
}

constexpr image_detail::PictureReader kOpenImageIO{.read = &image_detail::read_picture, .prepare = &without_threads};

}  // namespace

Result<Texture> read_texture(const HardwareProfile& profile, const std::filesystem::path& file,
                             const TextureReadOptions& options) {
  return image_detail::read_texture(profile, file, options, kOpenImageIO);
}

Result<Texture> read_texture(std::span<const std::uint8_t> bytes, const std::string& name,
                             const TextureReadOptions& options) {
  return image_detail::read_texture(bytes, name, options, kOpenImageIO);
}

Result<Texture> read_cube_texture(const HardwareProfile& profile, std::span<const std::filesystem::path, 6> files,
                                  const TextureReadOptions& options) {
  return image_detail::read_cube_texture(profile, files, options, kOpenImageIO);
}

}  // namespace ninebit
