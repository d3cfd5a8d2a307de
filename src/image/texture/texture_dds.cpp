#include "src/image/texture/texture_dds.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "ninebit/numerics/hardware_profile.h"
#include "src/image/output/faults.h"
#include "src/image/texture/texture_file.h"

namespace ninebit::image_detail {
namespace {

constexpr std::array<std::uint8_t, 4> kMagic{'D', 'D', 'S', ' '};
constexpr std::uint32_t kHeaderSize = 124, kPixelFormatSize = 32;
constexpr std::uint32_t kHasPitch = 0x8, kHasLinearSize = 0x80000, kHasDepth = 0x800000;
constexpr std::uint32_t kCubeMap = 0x200, kFirstFace = 0x400, kVolume = 0x200000;

// Empty, or what is wrong with the header apart from its pixel format.
std::string complain_about_header(const DdsHeader& header) {
  if (header.header_size != kHeaderSize) {
    return fmt::format("the DDS header has a size field of {}; expected {}", header.header_size, kHeaderSize);
  }
  if (header.pixel_format_size != kPixelFormatSize) {
    return fmt::format("the DDS pixel format has a size field of {}; expected {}", header.pixel_format_size,
                       kPixelFormatSize);
  }
  if ((header.caps2 & kVolume) != 0 || ((header.flags & kHasDepth) != 0 && header.depth > 1)) {
    return "is a volume texture; expected a 2D texture or a cube map";
  }
  if (std::string complaint = complain_about_texture_size(header.width, header.height); !complaint.empty()) {
    return "the texture " + complaint;
  }
  const auto levels = static_cast<std::uint32_t>(std::bit_width(std::max(header.width, header.height)));
  if (header.mipmap_count > 1 && header.mipmap_count != levels) {
    return fmt::format("has {} mip-map levels; expected 1 or all {}", header.mipmap_count, levels);
  }
  if ((header.caps2 & kCubeMap) == 0) return {};
  std::string missing;
  constexpr std::array names{"+x", "-x", "+y", "-y", "+z", "-z"};
  for (std::size_t face = 0; face < 6; ++face) {
    if ((header.caps2 & (kFirstFace << face)) == 0) missing += fmt::format(" {}", names[face]);
  }
  if (!missing.empty()) return fmt::format("is a cube map without the faces{}; expected all six", missing);
  if (header.width != header.height) {
    return fmt::format("is a cube map with faces of {} x {}; expected squares", header.width, header.height);
  }
  return {};
}

// Empty, or how the header's row or image size contradicts the format. A size of 0 is not checked.
std::string complain_about_pitch(const DdsHeader& header, const DdsPixels& pixels) {
  const std::uint64_t given = header.pitch_or_linear_size;
  const auto width = static_cast<int>(header.width), height = static_cast<int>(header.height);
  if (given == 0) return {};
  if (pixels.s3tc && (header.flags & kHasLinearSize) != 0) {
    const std::size_t expected = dds_level_bytes(pixels, width, height);
    if (given != expected) return fmt::format("the DDS header has an image of {} bytes; expected {}", given, expected);
  }
  if (!pixels.s3tc && (header.flags & kHasPitch) != 0) {
    const std::size_t expected = dds_level_bytes(pixels, width, 1);
    if (given != expected) return fmt::format("the DDS header has rows of {} bytes; expected {}", given, expected);
  }
  return {};
}

}  // namespace

std::string complain_about_texture_size(std::int64_t width, std::int64_t height) {
  for (const std::int64_t side : {width, height}) {
    if (side < 1 || side > kMaxSurfaceSize || !std::has_single_bit(static_cast<std::uint64_t>(side))) {
      return fmt::format("is {} x {} in size; each side must be a power of two from 1 to {}", width, height,
                         kMaxSurfaceSize);
    }
  }
  return {};
}

std::string complain_about_picture_size(std::int64_t width, std::int64_t height) {
  if (std::min(width, height) >= 1 && std::max(width, height) <= kMaxSurfaceSize) return {};
  return fmt::format("is {} x {} in size; each side must be a power of two from 1 to {}", width, height,
                     kMaxSurfaceSize);
}

bool is_dds(std::span<const std::uint8_t> start) {
  return start.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), start.begin());
}

DdsHeader parse_dds_header(std::span<const std::uint8_t> bytes) {
  const auto word = [&](std::size_t index) {  // counted after the magic number
    const std::span<const std::uint8_t> at = bytes.subspan(4 + 4 * index, 4);
    return at[0] | (std::uint32_t{at[1]} << 8) | (std::uint32_t{at[2]} << 16) | (std::uint32_t{at[3]} << 24);
  };
  return {.header_size = word(0),
          .flags = word(1),
          .height = word(2),
          .width = word(3),
          .pitch_or_linear_size = word(4),
          .depth = word(5),
          .mipmap_count = word(6),
          .pixel_format_size = word(18),
          .pixel_flags = word(19),
          .four_cc = word(20),
          .bit_count = word(21),
          .mask = {word(22), word(23), word(24), word(25)},
          .caps2 = word(27)};
}

Result<FileTexture> parse_dds(const HardwareProfile& profile, const std::filesystem::path& file,
                              std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kDdsHeaderBytes) {
    return invalid_input(file, fmt::format("has {} bytes; a DDS header alone has {}", bytes.size(), kDdsHeaderBytes));
  }
  const DdsHeader header = parse_dds_header(bytes);
  if (std::string complaint = complain_about_header(header); !complaint.empty()) {
    return invalid_input(file, std::move(complaint));
  }
  const Result<DdsPixels> pixels = dds_pixels(header);
  if (!pixels) return invalid_input(file, pixels.error().message);
  if (std::string complaint = complain_about_pitch(header, *pixels); !complaint.empty()) {
    return invalid_input(file, std::move(complaint));
  }
  FileTexture texture{.format = pixels->format, .faces = {}};
  if ((header.caps2 & kCubeMap) != 0) texture.target = TextureTarget::cube_map;
  const std::size_t faces = texture.target == TextureTarget::cube_map ? 6 : 1;
  const std::uint32_t levels = std::max(header.mipmap_count, 1U);
  const auto width_of = [&](std::uint32_t level) { return static_cast<int>(std::max(header.width >> level, 1U)); };
  const auto height_of = [&](std::uint32_t level) { return static_cast<int>(std::max(header.height >> level, 1U)); };
  std::size_t needed = kDdsHeaderBytes;
  for (std::uint32_t level = 0; level < levels; ++level) {
    needed += faces * dds_level_bytes(*pixels, width_of(level), height_of(level));
  }
  if (bytes.size() != needed) {
    return invalid_input(file, fmt::format("has {} bytes; its header requires {} ({} x {}, {} face(s), {} level(s))",
                                           bytes.size(), needed, header.width, header.height, faces, levels));
  }
  std::span<const std::uint8_t> rest = bytes.subspan(kDdsHeaderBytes);
  for (std::size_t face = 0; face < faces; ++face) {
    std::vector<TextureSamples>& images = texture.faces.emplace_back();
    for (std::uint32_t level = 0; level < levels; ++level) {
      const std::size_t size = dds_level_bytes(*pixels, width_of(level), height_of(level));
      auto image = decode_dds_level(*pixels, profile.dxt1_palette, width_of(level), height_of(level), rest.first(size));
      if (!image) return invalid_input(file, image.error().message);
      images.push_back(std::move(image).value());
      rest = rest.subspan(size);
    }
  }
  return texture;
}

}  // namespace ninebit::image_detail
