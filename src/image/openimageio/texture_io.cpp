#include "ninebit/image/texture_io.h"

#include <ImfThreading.h>

#include <memory>

#include "src/image/texture/texture_file.h"

namespace ninebit {
namespace {

// Ends the threads of OpenEXR's pool, which OpenImageIO starts for the first EXR file; the destructor starts as many
// again. A child process has none of its parent's threads, and OpenEXR would wait for them there.
class WithoutImageThreads {
 public:
  WithoutImageThreads() : threads_(Imf::globalThreadCount()) {
    if (threads_ > 0) Imf::setGlobalThreadCount(0);
  }
  WithoutImageThreads(const WithoutImageThreads&) = delete;
  WithoutImageThreads& operator=(const WithoutImageThreads&) = delete;
  ~WithoutImageThreads() {
    if (threads_ > 0) Imf::setGlobalThreadCount(threads_);
  }

 private:
  int threads_;
};

Result<std::shared_ptr<void>> without_threads(const std::filesystem::path&) {
  return std::shared_ptr<void>(std::make_shared<WithoutImageThreads>());
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
