// Textures out of files, whoever reads the pictures.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

#include "src/image/faults.h"
#include "src/image/texture_file.h"

namespace ninebit::image_detail {
namespace {

// The largest DDS file that there can be: six faces of floats with all levels, and the header.
constexpr std::uint64_t kLargestFile = std::uint64_t{6} * kMaxSurfaceSize * kMaxSurfaceSize * 16 * 4 / 3 + 1024;

Result<std::vector<std::uint8_t>> read_whole(const std::filesystem::path& file, std::ifstream& in) {
  in.seekg(0, std::ios::end);
  const std::streamoff size = in.tellg();
  if (!in || size < 0) return invalid_input(file, "cannot be read");
  if (static_cast<std::uint64_t>(size) > kLargestFile) {
    return invalid_input(file, fmt::format("has {} bytes, more than any texture needs", size));
  }
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), size);
  if (!in) return invalid_input(file, "cannot be read to its end");
  return bytes;
}

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

Result<FileTexture> read_file(const HardwareProfile& profile, const std::filesystem::path& file, bool flip,
                              PictureReader reader) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) return invalid_input(file, "is a folder; expected a picture");
  std::ifstream in(file, std::ios::binary);
  if (!in) return invalid_input(file, "cannot be opened");
  std::array<char, 4> start{};
  in.read(start.data(), start.size());
  const auto found = static_cast<std::size_t>(in.gcount());
  if (found == 0) return invalid_input(file, "is empty or cannot be read; expected a picture");
  in.clear();
  Result<FileTexture> texture = [&]() -> Result<FileTexture> {
    if (!is_dds({reinterpret_cast<const std::uint8_t*>(start.data()), found})) {
      in.close();
      return reader(file);
    }
    const auto bytes = read_whole(file, in);
    if (!bytes) return bytes.error();
    return parse_dds(profile, file, *bytes);
  }();
  if (texture && flip) {
    for (std::vector<TextureSamples>& levels : texture.value().faces) {
      for (TextureSamples& image : levels) {
        std::visit([&](auto& samples) { flip_planes(samples, image.width, image.height); }, image.samples);
      }
    }
  }
  return texture;
}

Result<Texture> finish(const std::filesystem::path& file, FileTexture parts, bool mipmaps) {
  Result<Texture> texture = make_texture(parts.target, parts.format, std::move(parts.faces));
  if (texture && mipmaps && texture->faces[0].size() == 1) texture = with_mipmaps(*texture);
  if (!texture) return invalid_input(file, texture.error().message);
  return texture;
}

// Empty, or why the file cannot be a face beside the first one.
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
                             const TextureReadOptions& options, PictureReader reader) {
  Result<FileTexture> parts = read_file(profile, file, options.flip, reader);
  if (!parts) return parts.error();
  return finish(file, std::move(parts).value(), options.mipmaps);
}

Result<Texture> read_cube_texture(const HardwareProfile& profile, std::span<const std::filesystem::path, 6> files,
                                  const TextureReadOptions& options, PictureReader reader) {
  FileTexture cube;
  for (const std::filesystem::path& file : files) {
    Result<FileTexture> face = read_file(profile, file, options.flip, reader);
    if (!face) return face.error();
    if (std::string complaint = complain_about_face(*face, cube.faces.empty() ? *face : cube); !complaint.empty()) {
      return invalid_input(file, std::move(complaint));
    }
    if (cube.faces.empty()) {
      cube = std::move(face).value();
    } else {
      cube.faces.push_back(std::move(face.value().faces[0]));
    }
  }
  cube.target = TextureTarget::cube_map;
  return finish(files[0], std::move(cube), options.mipmaps);
}

}  // namespace ninebit::image_detail
