// Reads textures from files, with any PictureReader.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <system_error>
#include <utility>

#include "src/image/output/faults.h"
#include "src/image/texture/texture_file.h"
#include "src/raster/texture/resample.h"
#include "src/system/stream.h"

namespace ninebit::image_detail {
namespace {

// The largest valid DDS file: six faces of floats with all levels, and the header.
constexpr std::uint64_t kLargestFile = std::uint64_t{6} * kMaxSurfaceSize * kMaxSurfaceSize * 16 * 4 / 3 + 1024;

template <class T>
void flip_planes(std::vector<T>& samples, int width, int height) {
  const auto columns = static_cast<std::ptrdiff_t>(width), rows = static_cast<std::ptrdiff_t>(height);
  const auto planes = static_cast<std::ptrdiff_t>(samples.size()) / (columns * rows);
  for (std::ptrdiff_t plane = 0; plane < planes; ++plane) {
    const auto first = samples.begin() + plane * rows * columns;
    for (std::ptrdiff_t y = 0; y < rows / 2; ++y) {
      std::swap_ranges(first + y * columns, first + (y + 1) * columns, first + (rows - 1 - y) * columns);
    }
  }
}

// Whether the file is a DDS file. Reports a file that is missing, empty or not regular.
Result<bool> is_dds_file(const std::filesystem::path& file) {
  std::error_code error;
  const std::string start = posix::read_file(file, 4, error);
  if (error == std::errc::is_a_directory) return invalid_input(file, "is a folder; expected a picture");
  if (error == posix::not_a_regular_file()) return invalid_input(file, "is not a regular file; expected a picture");
  if (error) return invalid_input(file, "cannot be opened");
  if (start.empty()) return invalid_input(file, "is empty or cannot be read; expected a picture");
  return is_dds({reinterpret_cast<const std::uint8_t*>(start.data()), start.size()});
}

Result<FileTexture> read_dds(const HardwareProfile& profile, const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!error && size > kLargestFile) {
    return invalid_input(file, fmt::format("has {} bytes; the largest texture has {}", size, kLargestFile));
  }
  const std::string bytes = posix::read_file(file, kLargestFile, error);
  if (error) return invalid_input(file, "cannot be read: " + error.message());
  return parse_dds(profile, file, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

Result<std::vector<FileTexture>> read_with(const PictureReader& reader, std::span<const PictureSource> sources,
                                           const TextureReadOptions& options) {
  if (options.isolated) return read_isolated(sources, reader, options.go_on);
  std::vector<FileTexture> pictures;
  for (const PictureSource& source : sources) {
    Result<FileTexture> picture = reader.read(source);
    if (!picture) return picture.error();
    pictures.push_back(std::move(picture).value());
  }
  return pictures;
}

// OpenImageIO's libraries take 0.2 s to load, which most PNG files do not need.
Result<std::vector<FileTexture>> read_pictures(std::span<const PictureSource> sources,
                                               const TextureReadOptions& options, const PictureReader& reader) {
  if (std::all_of(sources.begin(), sources.end(), is_plain_png)) {
    auto pictures = read_with({.read = &read_plain_png}, sources, options);
    if (pictures || pictures.error().fault == Fault::cancelled) return pictures;
  }
  return read_with(reader, sources, options);
}

void flip(FileTexture& texture) {
  for (std::vector<TextureSamples>& levels : texture.faces) {
    for (TextureSamples& image : levels) {
      std::visit([&](auto& samples) { flip_planes(samples, image.width, image.height); }, image.samples);
    }
  }
}

// Resamples a picture where the options permit that, and flips it. Reports sides that are not powers of two.
Status fit(const std::filesystem::path& file, const TextureReadOptions& options, FileTexture& texture) {
  const int width = texture.faces[0][0].width, height = texture.faces[0][0].height;
  if (options.rectangle) {
    if (texture.target != TextureTarget::texture_2d) return invalid_input(file, "is a cube map; expected one picture");
    texture.target = TextureTarget::rectangle;
    texture.faces[0].resize(1);
    if (options.flip) flip(texture);
    return {};
  }
  if (std::string complaint = complain_about_texture_size(width, height); !complaint.empty()) {
    if (!options.any_size) return invalid_input(file, "the picture " + complaint);
    for (std::vector<TextureSamples>& levels : texture.faces) resample_to_powers_of_two(levels[0]);
    if (options.on_resample) options.on_resample(width, height);
  }
  if (options.flip) flip(texture);
  return {};
}

// Reads all files, in order. Pictures are read together, in one child process.
Result<std::vector<FileTexture>> read_files(const HardwareProfile& profile,
                                            std::span<const std::filesystem::path> files,
                                            const TextureReadOptions& options, const PictureReader& reader) {
  std::vector<bool> dds;
  std::vector<PictureSource> others;
  for (const std::filesystem::path& file : files) {
    const Result<bool> found = is_dds_file(file);
    if (!found) return found.error();
    dds.push_back(*found);
    if (!*found) others.push_back({.file = file});
  }
  Result<std::vector<FileTexture>> pictures = std::vector<FileTexture>();
  if (!others.empty()) pictures = read_pictures(others, options, reader);
  if (!pictures) return pictures.error();
  std::vector<FileTexture> textures;
  std::size_t next = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    Result<FileTexture> texture = dds[i] ? read_dds(profile, files[i]) : std::move((*pictures)[next++]);
    if (!texture) return texture.error();
    if (Status fits = fit(files[i], options, *texture); !fits) return fits.error();
    textures.push_back(std::move(texture).value());
  }
  return textures;
}

Result<Texture> finish(const std::filesystem::path& file, FileTexture parts, bool mipmaps) {
  Result<Texture> texture = make_texture(parts.target, parts.format, std::move(parts.faces));
  if (texture && mipmaps && texture->faces[0].size() == 1) texture = with_mipmaps(*texture);
  if (!texture) return invalid_input(file, texture.error().message);
  return texture;
}

// Empty, or the reason why the file cannot be a face of the same cube map as the first.
std::string complain_about_face(const FileTexture& face, const FileTexture& first) {
  if (face.target != TextureTarget::texture_2d) return "is a cube map itself; expected one face";
  const TextureSamples &image = face.faces[0][0], &wanted = first.faces[0][0];
  if (image.width != image.height) {
    return fmt::format("is {} x {} in size; the faces of a cube map must be square", image.width, image.height);
  }
  if (image.width != wanted.width) {
    return fmt::format("is {} x {} in size; the other faces of the cube map are {} x {}", image.width, image.height,
                       wanted.width, wanted.height);
  }
  if (face.format != first.format) return "has other channels or samples than the first face of the cube map";
  if (face.faces[0].size() != first.faces[0].size()) {
    return fmt::format("has {} mip-map level(s); the first face of the cube map has {}", face.faces[0].size(),
                       first.faces[0].size());
  }
  return {};
}

}  // namespace

Result<Texture> read_texture(const HardwareProfile& profile, const std::filesystem::path& file,
                             const TextureReadOptions& options, const PictureReader& reader) {
  Result<std::vector<FileTexture>> parts = read_files(profile, std::span(&file, 1), options, reader);
  if (!parts) return parts.error();
  return finish(file, std::move((*parts)[0]), options.mipmaps);
}

Result<Texture> read_texture(std::span<const std::uint8_t> bytes, const std::string& name,
                             const TextureReadOptions& options, const PictureReader& reader) {
  const PictureSource source{.file = name, .bytes = bytes};
  if (bytes.empty()) return invalid_input(source.file, "is empty; expected a picture");
  Result<std::vector<FileTexture>> read = read_pictures({&source, 1}, options, reader);
  if (!read) return read.error();
  if (Status fits = fit(source.file, options, (*read)[0]); !fits) return fits.error();
  return finish(source.file, std::move((*read)[0]), options.mipmaps);
}

Result<Texture> read_cube_texture(const HardwareProfile& profile, std::span<const std::filesystem::path, 6> files,
                                  const TextureReadOptions& options, const PictureReader& reader) {
  TextureReadOptions exact = options;
  exact.any_size = false;
  Result<std::vector<FileTexture>> faces = read_files(profile, files, exact, reader);
  if (!faces) return faces.error();
  FileTexture& cube = (*faces)[0];
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (std::string complaint = complain_about_face((*faces)[i], cube); !complaint.empty()) {
      return invalid_input(files[i], std::move(complaint));
    }
  }
  for (std::size_t i = 1; i < files.size(); ++i) cube.faces.push_back(std::move((*faces)[i].faces[0]));
  cube.target = TextureTarget::cube_map;
  return finish(files[0], std::move(cube), options.mipmaps);
}

const char* extension_of_bytes(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 8> kPng{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  constexpr std::array<std::uint8_t, 3> kJpeg{0xFF, 0xD8, 0xFF};
  const auto starts = [&](const auto& with) {
    return bytes.size() >= with.size() && std::equal(with.begin(), with.end(), bytes.begin());
  };
  if (starts(kPng)) return ".png";
  return starts(kJpeg) ? ".jpg" : nullptr;
}

}  // namespace ninebit::image_detail
