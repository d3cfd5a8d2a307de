// DDS of every kind that is read, judged by the blocks' decoder and by OpenImageIO, and what is refused.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "combiner_tests/image/dds_writer.h"
#include "combiner_tests/image/texture_reading.h"
#include "ninebit/raster/s3tc.h"

namespace {

using image_test::byte_at;
using image_test::complaint;
using image_test::DdsFile;
using image_test::random_bytes;
using image_test::read_good;
using image_test::TempFolder;
using image_test::Written;
using ninebit::InternalFormat;
using ninebit::S3tcFormat;
using ninebit::Texture;
using ninebit::TextureTarget;
using ninebit::profiles::geforce2;

struct Kind {
  const char* four_cc;
  std::uint32_t pixel_flags;
  S3tcFormat format;
};
const Kind kKinds[] = {{"DXT1", 0x4, S3tcFormat::dxt1_rgb},
                       {"DXT1", 0x5, S3tcFormat::dxt1_rgba},
                       {"DXT3", 0x4, S3tcFormat::dxt3},
                       {"DXT5", 0x4, S3tcFormat::dxt5}};

// All levels of all faces, in the file's order.
void expect_decoded(const Texture& texture, const Kind& kind, ninebit::Dxt1Palette palette, const std::string& data) {
  std::size_t at = 0;
  for (std::size_t face = 0; face < texture.face_count(); ++face) {
    for (std::size_t level = 0; level < texture.faces[face].size(); ++level) {
      const ninebit::TextureImage& image = texture.faces[face][level];
      const std::size_t size = ninebit::s3tc_image_bytes(kind.format, image.width, image.height);
      const auto expected = ninebit::decode_s3tc(kind.format, palette, image.width, image.height,
                                                 {reinterpret_cast<const std::uint8_t*>(data.data()) + at, size});
      ASSERT_TRUE(expected.ok());
      const auto& samples = std::get<0>(expected->samples);
      for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto in_plane = static_cast<int>(i % static_cast<std::size_t>(image.width * image.height));
        const std::size_t k = i / static_cast<std::size_t>(image.width * image.height);
        ASSERT_EQ(byte_at(texture, face, level, k, in_plane % image.width, in_plane / image.width), samples[i])
            << kind.four_cc << " face " << face << " level " << level;
      }
      at += size;
    }
  }
  EXPECT_EQ(at, data.size());
}

TEST(Dds, CompressedTexturesWithAllLevels) {
  for (const Kind& kind : kKinds) {
    for (const bool cube : {false, true}) {
      DdsFile dds{.width = 16,
                  .height = cube ? 16U : 8U,
                  .levels = 5,
                  .pixel_flags = kind.pixel_flags,
                  .four_cc = kind.four_cc};
      if (cube) dds.make_cube();
      std::size_t size = 0;
      for (unsigned level = 0; level < 5; ++level) {
        size += ninebit::s3tc_image_bytes(kind.format, static_cast<int>(dds.width >> level),
                                          static_cast<int>(std::max(dds.height >> level, 1U)));
      }
      dds.data = random_bytes(size * (cube ? 6 : 1), 3);
      const Written file(dds.bytes());
      for (const ninebit::HardwareProfile& profile : {geforce2, ninebit::profiles::ideal}) {
        const Texture texture = read_good(file.path, profile);
        ASSERT_EQ(texture.target, cube ? TextureTarget::cube_map : TextureTarget::texture_2d);
        ASSERT_EQ(texture.format, ninebit::s3tc_internal_format(kind.format));
        ASSERT_TRUE(ninebit::is_complete(texture, true));
        expect_decoded(texture, kind, profile.dxt1_palette, dds.data);
        if (HasFatalFailure()) return;
      }
    }
  }
}

// OpenImageIO widens 5 and 6 bits to v × 255 / 31 and / 63, rounded, and cuts the fractions of alphas: ours may be off
// by one, and by more where rgb565 leaves its mark.
TEST(Dds, AgreesWithOpenImageIo) {
  for (const Kind& kind : kKinds) {
    DdsFile dds{.width = 256, .height = 256, .pixel_flags = kind.pixel_flags, .four_cc = kind.four_cc};
    dds.data = random_bytes(ninebit::s3tc_image_bytes(kind.format, 256, 256), 5);
    const Written file(dds.bytes());
    OIIO::ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(file.path.string(), &wishes);
    ASSERT_TRUE(input) << OIIO::geterror();
    const int channels = input->spec().nchannels;
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(channels) * 65536);
    ASSERT_TRUE(input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, pixels.data()));
    for (const ninebit::HardwareProfile& profile : {ninebit::profiles::ideal, geforce2}) {
      const Texture texture = read_good(file.path, profile);
      int largest = 0, largest_alpha = 0, different = 0;
      for (int i = 0; i < 65536; ++i) {
        bool equal = true;
        for (int k = 0; k < channels; ++k) {
          if (k == 3 && texture.format == InternalFormat::rgb8) continue;
          const int off = std::abs(byte_at(texture, 0, 0, static_cast<std::size_t>(k), i % 256, i / 256) -
                                   pixels[static_cast<std::size_t>(i * channels + k)]);
          (k == 3 ? largest_alpha : largest) = std::max(k == 3 ? largest_alpha : largest, off);
          equal = equal && off == 0;
        }
        different += equal ? 0 : 1;
      }
      const bool narrow =
          profile.dxt1_palette.value == ninebit::Dxt1Palette::rgb565 && ninebit::s3tc_block_bytes(kind.format) == 8;
      EXPECT_LE(largest, narrow ? 5 : 1) << kind.four_cc;
      EXPECT_LE(different, narrow ? 40000 : 30000) << kind.four_cc;
      EXPECT_LE(largest_alpha, 1) << kind.four_cc;
    }
  }
}

TEST(Dds, UncompressedPixels) {
  struct Layout {
    std::uint32_t kind, bits, red, green, blue, alpha;
    InternalFormat format;
    std::string pixel;          // one, as it lies in the file
    std::vector<int> expected;  // red, green, blue, alpha; -1: not stored
  };
  const std::vector<Layout> layouts{
      {0x40, 24, 0xFF0000, 0xFF00, 0xFF, 0, InternalFormat::rgb8, "\x01\x02\x03", {3, 2, 1, -1}},
      {0x40, 32, 0xFF0000, 0xFF00, 0xFF, 0, InternalFormat::rgb8, "\x01\x02\x03\x7F", {3, 2, 1, -1}},
      {0x41, 32, 0xFF0000, 0xFF00, 0xFF, 0xFF000000, InternalFormat::rgba8, "\x01\x02\x03\x04", {3, 2, 1, 4}},
      {0x41, 32, 0xFF, 0xFF00, 0xFF0000, 0xFF000000, InternalFormat::rgba8, "\x01\x02\x03\x04", {1, 2, 3, 4}},
      {0x40, 16, 0xF800, 0x07E0, 0x001F, 0, InternalFormat::rgb8, "\x23\x19", {25, 36, 25, -1}},  // 0x1923: 3, 9, 3
      {0x41, 16, 0x7C00, 0x03E0, 0x001F, 0x8000, InternalFormat::rgba8, "\x01\x84", {8, 0, 8, 255}},
      {0x20000, 8, 0xFF, 0, 0, 0, InternalFormat::luminance8, "\x50", {80, -1, -1, -1}},
      {0x20001, 16, 0xFF, 0, 0, 0xFF00, InternalFormat::luminance8_alpha8, "\x50\x60", {80, -1, -1, 96}},
      {0x20001, 8, 0x0F, 0, 0, 0xF0, InternalFormat::luminance8_alpha8, "\x2F", {255, -1, -1, 34}},
      {0x2, 8, 0, 0, 0, 0xFF, InternalFormat::alpha8, "\x70", {-1, -1, -1, 112}},
  };
  for (const Layout& layout : layouts) {
    DdsFile dds{
        .width = 2, .height = 2, .red = layout.red, .green = layout.green, .blue = layout.blue, .alpha = layout.alpha};
    dds.make_uncompressed(layout.kind, layout.bits);
    dds.data = random_bytes(3 * layout.bits / 8, 8) + layout.pixel;  // the last texel: x = 1, y = 1
    const Written file(dds.bytes());
    const Texture texture = read_good(file.path);
    ASSERT_EQ(texture.format, layout.format);
    for (std::size_t k = 0; k < 4; ++k) {
      if (layout.expected[k] < 0) continue;
      EXPECT_EQ(byte_at(texture, 0, 0, k, 1, 1), layout.expected[k]) << layout.kind << ' ' << layout.bits;
    }
  }
}

TEST(Dds, FloatPixels) {
  DdsFile dds{.width = 1, .height = 2};
  dds.four_cc = std::string("\x74\0\0\0", 4);
  const float reals[] = {1.5F, -2.0F, 0.25F, 1e30F, 5.0F, 6.0F, 7.0F, 8.0F};
  dds.data.assign(reinterpret_cast<const char*>(reals), sizeof reals);
  Texture texture = read_good(Written(dds.bytes()).path);
  ASSERT_EQ(texture.format, InternalFormat::rgba32f);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(std::get<3>(texture.faces[0][0].planes)[i % 4].at(0, static_cast<int>(i / 4)), reals[i]);
  }
  dds.four_cc = std::string("\x71\0\0\0", 4);
  dds.data = random_bytes(16, 9);
  texture = read_good(Written(dds.bytes()).path);
  ASSERT_EQ(texture.format, InternalFormat::rgba16f);
  for (std::size_t i = 0; i < 8; ++i) {
    const int bits = static_cast<std::uint8_t>(dds.data[2 * i]) | (static_cast<std::uint8_t>(dds.data[2 * i + 1]) << 8);
    EXPECT_EQ(std::get<2>(texture.faces[0][0].planes)[i % 4].at(0, static_cast<int>(i / 4)).bits, bits);
  }
}

TEST(Dds, MipmapsAreAddedAndRowsFlippedOnDemand) {
  DdsFile dds{.width = 4, .height = 2, .red = 0xFF};
  dds.make_uncompressed(0x20000, 8);
  dds.data = std::string("\x01\x02\x03\x04\x05\x06\x07\x08");
  const Written file(dds.bytes());
  Texture texture = read_good(file.path);
  EXPECT_EQ(texture.faces[0].size(), 1U);
  EXPECT_EQ(byte_at(texture, 0, 0, 0, 1, 0), 2);  // the file's first row is at t = 0
  texture = read_good(file.path, geforce2, {.mipmaps = true, .flip = true});
  ASSERT_TRUE(ninebit::is_complete(texture, true));
  EXPECT_EQ(byte_at(texture, 0, 0, 0, 1, 0), 6);
  EXPECT_EQ(byte_at(texture, 0, 0, 0, 1, 1), 2);
  EXPECT_EQ(byte_at(texture, 0, 1, 0, 0, 0), 4);  // (1 + 2 + 5 + 6) / 4 = 3.5
  EXPECT_EQ(byte_at(texture, 0, 2, 0, 0, 0), 5);  // (4 + 6) / 2; 3.5 and 5.5 went up
}

TEST(Dds, BadFilesAreToldByWhatIsWrong) {
  DdsFile good{.width = 8, .height = 8, .levels = 4};
  good.data = random_bytes(32 + 8 + 8 + 8, 4);
  ASSERT_EQ(complaint(Written(good.bytes()).path), "");
  const auto with = [&](const std::function<void(DdsFile&)>& spoil) {
    DdsFile dds = good;
    spoil(dds);
    return complaint(Written(dds.bytes()).path);
  };
  EXPECT_EQ(with([](DdsFile& d) { d.header_size = 123; }), "the DDS header has a size field of 123; expected 124");
  EXPECT_EQ(with([](DdsFile& d) { d.pixel_format_size = 0; }),
            "the DDS pixel format has a size field of 0; expected 32");
  EXPECT_EQ(with([](DdsFile& d) { d.width = 0; }),
            "the texture is 0 x 8 in size; each side must be a power of two from 1 to 16384");
  EXPECT_EQ(with([](DdsFile& d) { d.height = 12; }),
            "the texture is 8 x 12 in size; each side must be a power of two from 1 to 16384");
  EXPECT_EQ(with([](DdsFile& d) { d.height = 0x80000000; }),
            "the texture is 8 x 2147483648 in size; each side must be a power of two from 1 to 16384");
  EXPECT_EQ(with([](DdsFile& d) { d.width = d.height = 16384, d.levels = 1; }),
            "has 184 bytes; its header requires 134217856 (16384 x 16384, 1 face(s), 1 level(s))");
  EXPECT_EQ(with([](DdsFile& d) { d.levels = 3; }), "has 3 mip-map levels; expected 1 or all 4");
  EXPECT_EQ(with([](DdsFile& d) { d.levels = 0xFFFFFFFF; }), "has 4294967295 mip-map levels; expected 1 or all 4");
  EXPECT_EQ(with([](DdsFile& d) { d.data.pop_back(); }),
            "has 183 bytes; its header requires 184 (8 x 8, 1 face(s), 4 level(s))");
  EXPECT_EQ(with([](DdsFile& d) { d.data += '!'; }),
            "has 185 bytes; its header requires 184 (8 x 8, 1 face(s), 4 level(s))");
  EXPECT_EQ(with([](DdsFile& d) { d.flags |= 0x80000, d.pitch = 33; }),
            "the DDS header has an image of 33 bytes; expected 32");
  EXPECT_EQ(with([](DdsFile& d) { d.flags |= 0x80000, d.pitch = 32; }), "");
  EXPECT_EQ(with([](DdsFile& d) { d.caps2 = 0x200000; }), "is a volume texture; expected a 2D texture or a cube map");
  EXPECT_EQ(with([](DdsFile& d) { d.caps2 = 0xFE00 & ~0x2000U; }),
            "is a cube map without the faces -y; expected all six");
  EXPECT_EQ(with([](DdsFile& d) { d.caps2 = 0xFE00, d.height = 4; }),
            "is a cube map with faces of 8 x 4; expected squares");
  EXPECT_EQ(with([](DdsFile& d) { d.make_cube(); }),
            "has 184 bytes; its header requires 464 (8 x 8, 6 face(s), 4 level(s))");
  EXPECT_EQ(with([](DdsFile& d) { d.four_cc = "DXT2"; }),
            "the DDS pixel format DXT2 is not supported; expected DXT1, DXT3, DXT5, uncompressed bytes or RGBA floats");
  EXPECT_EQ(
      with([](DdsFile& d) { d.four_cc = "\x24"; }),
      "the DDS pixel format number 36 is not supported; expected DXT1, DXT3, DXT5, uncompressed bytes or RGBA floats");
  EXPECT_EQ(with([](DdsFile& d) { d.make_uncompressed(0x200, 16); }),
            "the DDS pixel format with flags 0x200 is not supported; expected a four-character code, RGB, luminance or "
            "alpha");
  EXPECT_EQ(with([](DdsFile& d) { d.make_uncompressed(0x40, 12); }),
            "the DDS header has 12 bits per pixel; expected 8, 16, 24 or 32");
  EXPECT_EQ(with([](DdsFile& d) { d.make_uncompressed(0x20000, 8); }),
            "the DDS header has a component mask of 0x0; expected 1 to 8 adjacent bits within 8 bits");
  EXPECT_EQ(with([](DdsFile& d) { d.make_uncompressed(0x20000, 8), d.red = 0x1FF; }),
            "the DDS header has a component mask of 0x1ff; expected 1 to 8 adjacent bits within 8 bits");
  EXPECT_EQ(with([](DdsFile& d) { d.make_uncompressed(0x20000, 16), d.red = 0x5; }),
            "the DDS header has a component mask of 0x5; expected 1 to 8 adjacent bits within 16 bits");
  EXPECT_EQ(with([](DdsFile& d) { d.make_uncompressed(0x20000, 8), d.red = 0xFF, d.flags |= 8, d.pitch = 12; }),
            "the DDS header has rows of 12 bytes; expected 8");
}

// Cut anywhere, or with any byte of the header changed, a file is read or refused, with one line.
TEST(Dds, DamagedHeadersAreReadOrRefused) {
  DdsFile good{.width = 4, .height = 4, .levels = 3};
  good.make_cube();
  good.data = random_bytes(6 * 24, 4);
  const std::string bytes = good.bytes();
  const TempFolder folder;
  const auto path = folder.path() / "damaged.dds";
  for (std::size_t size = 0; size < bytes.size(); size += size < 130 ? 7 : 31) {
    image_test::write_bytes(path, bytes.substr(0, size));
    EXPECT_NE(complaint(path), "") << size;
  }
  int read = 0;
  for (std::size_t at = 0; at < 128; ++at) {
    for (const int flip : {1, 16, 255}) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ flip);
      image_test::write_bytes(path, damaged);
      read += complaint(path).empty() ? 1 : 0;
    }
  }
  EXPECT_GT(read, 120);  // reserved words
  EXPECT_LT(read, 340);
}

}  // namespace
