// A texture as read from a file, before it becomes a Texture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ninebit/image/texture_io.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/raster/texture.h"

namespace ninebit::image_detail {

struct FileTexture {
  TextureTarget target = TextureTarget::texture_2d;
  InternalFormat format = InternalFormat::rgb8;
  std::vector<std::vector<TextureSamples>> faces;  // [face][level], row 0 of the file first
};

// Empty if the sides are from 1 to kMaxSurfaceSize, else the complaint.
[[nodiscard]] std::string complain_about_picture_size(std::int64_t width, std::int64_t height);

// Empty if the sides are powers of two in range, else the complaint.
[[nodiscard]] std::string complain_about_texture_size(std::int64_t width, std::int64_t height);

// Whether a file with this start is a DDS file.
[[nodiscard]] bool is_dds(std::span<const std::uint8_t> start);

// `file` is for the Diagnostics; `bytes` is its whole content.
[[nodiscard]] Result<FileTexture> parse_dds(const HardwareProfile& profile, const std::filesystem::path& file,
                                            std::span<const std::uint8_t> bytes);

// The limit for a compressed picture, 8192 x 8192: a few KiB of it can claim any number of pixels.
inline constexpr std::int64_t kMostPicturePixels = std::int64_t{1} << 26;

// A file, or the bytes of one.
struct PictureSource {
  std::filesystem::path file{};  // with bytes: their name in Diagnostics
  std::optional<std::span<const std::uint8_t>> bytes{};
};

// The bytes of a PNG or JPEG file, by their first bytes; nullptr: of neither, else the usual extension, ".png".
[[nodiscard]] const char* extension_of_bytes(std::span<const std::uint8_t> bytes);

// The reader of all files except DDS. It is OpenImageIO, which depends on 250 shared libraries: the library links it,
// the program loads it for the first picture (picture_loader.h).
struct PictureReader {
  Result<FileTexture> (*read)(const PictureSource& source) = nullptr;
  // Makes the process ready for isolated calls of read(), as long as the answer is kept; nullptr: it is ready. `file`
  // is for Diagnostics.
  Result<std::shared_ptr<void>> (*prepare)(const std::filesystem::path& file) = nullptr;
};

// Reads any picture with OpenImageIO; from bytes PNG and JPEG. Its sides are from 1 to kMaxSurfaceSize.
[[nodiscard]] Result<FileTexture> read_picture(const PictureSource& source);

// Plain PNG files, read by libpng alone (plain_png.cpp).

// Whether the source begins as a PNG file of 8 bits a sample without a palette does.
[[nodiscard]] bool is_plain_png(const PictureSource& source);

// Reads such a file to the texture that read_picture() gives. A file that it refuses may be one for read_picture(),
// which also says what is wrong with a damaged one.
[[nodiscard]] Result<FileTexture> read_plain_png(const PictureSource& source);

// Calls reader.read() for each source in one isolated call (src/system/isolated_call.h). Reports what it reports, and
// the file at which the reader crashed or exceeded its limits.
[[nodiscard]] Result<std::vector<FileTexture>> read_isolated(std::span<const PictureSource> sources,
                                                             const PictureReader& reader,
                                                             const std::function<bool()>& go_on);

// The functions of texture_io.h, with `reader` for pictures.
[[nodiscard]] Result<Texture> read_texture(const HardwareProfile& profile, const std::filesystem::path& file,
                                           const TextureReadOptions& options, const PictureReader& reader);
[[nodiscard]] Result<Texture> read_cube_texture(const HardwareProfile& profile,
                                                std::span<const std::filesystem::path, 6> files,
                                                const TextureReadOptions& options, const PictureReader& reader);

[[nodiscard]] Result<Texture> read_texture(std::span<const std::uint8_t> bytes, const std::string& name,
                                           const TextureReadOptions& options, const PictureReader& reader);

}  // namespace ninebit::image_detail
