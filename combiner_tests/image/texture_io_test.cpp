// Textures out of pictures, and of six pictures as a cube; texture_dds_test.cpp has the DDS files.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "combiner_tests/image/dds_writer.h"
#include "combiner_tests/image/texture_reading.h"
#include "ninebit/image/image_io.h"

namespace {

using image_test::byte_at;
using image_test::complaint;
using image_test::DdsFile;
using image_test::random_bytes;
using image_test::read_good;
using image_test::TempFolder;
using ninebit::InternalFormat;
using ninebit::read_cube_texture;
using ninebit::Texture;
using ninebit::TextureTarget;
using ninebit::profiles::geforce2;

void write_picture(const std::filesystem::path& path, int width, int height, int channels, std::uint32_t seed) {
  const ninebit::Image8 image{width, height, channels, [&] {
                                const std::string bytes =
                                    random_bytes(static_cast<std::size_t>(width * height * channels), seed);
                                return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
                              }()};
  ASSERT_TRUE(ninebit::write_png(path, image).ok());
}

// Alpha is not multiplied in, whatever it is.
TEST(TexturePictures, PngOfEveryChannelCount) {
  const TempFolder folder;
  const auto path = folder.path() / "a.png";
  for (const auto& [channels, format] : {std::pair{1, InternalFormat::luminance8}, std::pair{3, InternalFormat::rgb8},
                                         std::pair{4, InternalFormat::rgba8}}) {
    write_picture(path, 16, 8, channels, 11);
    const Texture texture = read_good(path, geforce2, {.mipmaps = true});
    ASSERT_EQ(texture.format, format);
    ASSERT_TRUE(ninebit::is_complete(texture, true));
    const std::string bytes = random_bytes(static_cast<std::size_t>(16 * 8 * channels), 11);
    for (int i = 0; i < 16 * 8; ++i) {
      for (int k = 0; k < channels; ++k) {
        ASSERT_EQ(byte_at(texture, 0, 0, static_cast<std::size_t>(k), i % 16, i / 16),
                  static_cast<std::uint8_t>(bytes[static_cast<std::size_t>(i * channels + k)]));
      }
    }
  }
}

TEST(TexturePictures, FloatsStayFloats) {
  const TempFolder folder;
  const auto path = folder.path() / "a.exr";
  std::vector<ninebit::ExrChannel> channels;
  for (const char* name : {"R", "G", "B"}) {
    channels.push_back({name, ninebit::ExrRealRow([name](int row, std::span<float> out) {
                          for (std::size_t x = 0; x < out.size(); ++x) {
                            out[x] = static_cast<float>(row * 100 + static_cast<int>(x) * 10 + name[0] % 7) / 8;
                          }
                        })});
  }
  const ninebit::ExrPart part{"all", 4, 2, channels};
  ASSERT_TRUE(ninebit::write_exr_parts(path, {&part, 1}).ok());
  const Texture texture = read_good(path);
  ASSERT_EQ(texture.format, InternalFormat::rgba32f);
  const auto& planes = std::get<3>(texture.faces[0][0].planes);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) {
      EXPECT_EQ(planes[0].at(x, y), static_cast<float>(y * 100 + x * 10 + 'R' % 7) / 8);
      EXPECT_EQ(planes[2].at(x, y), static_cast<float>(y * 100 + x * 10 + 'B' % 7) / 8);
      EXPECT_EQ(planes[3].at(x, y), 1.0F);
    }
  }
}

TEST(TexturePictures, BadFilesAreToldByWhatIsWrong) {
  const TempFolder folder;
  const auto path = folder.path() / "a.png";
  EXPECT_EQ(complaint(path), "cannot be opened");
  EXPECT_EQ(complaint(folder.path()), "is a folder; expected a picture");
  image_test::write_bytes(path, "");
  EXPECT_EQ(complaint(path), "is empty or cannot be read; expected a picture");
  image_test::write_bytes(path, "hello, world: this is no picture");
  EXPECT_EQ(complaint(path).find("not a readable picture: "), 0U) << complaint(path);
  write_picture(path, 16, 12, 3, 1);
  EXPECT_EQ(complaint(path), "the picture is 16 x 12 in size; each side must be a power of two from 1 to 16384");
  // (A PNG cut short is refused as well, but libpng leaks a string then, and says so on stderr.)
  const auto exr = folder.path() / "a.exr";
  const ninebit::ExrPart part{"all", 64, 64, {{"R", ninebit::ExrRealRow([](int row, std::span<float> out) {
                                                 for (float& sample : out) sample = static_cast<float>(row);
                                               })}}};
  ASSERT_TRUE(ninebit::write_exr_parts(exr, {&part, 1}).ok());
  ASSERT_EQ(complaint(exr), "");
  const std::string bytes = image_test::read_bytes(exr);
  image_test::write_bytes(exr, bytes.substr(0, bytes.size() - 60));
  EXPECT_EQ(complaint(exr).find("could not be read to its end: "), 0U) << complaint(exr);
}

TEST(TexturePictures, SixMakeACube) {
  const TempFolder folder;
  std::array<std::filesystem::path, 6> files;
  for (std::size_t face = 0; face < 6; ++face) {
    files[face] = folder.path() / (std::to_string(face) + ".png");
    write_picture(files[face], 8, 8, 3, static_cast<std::uint32_t>(face));
  }
  const auto read = [&] { return read_cube_texture(geforce2, files, {.mipmaps = true}); };
  const auto cube = read();
  ASSERT_TRUE(cube.ok()) << cube.error().text();
  EXPECT_EQ(cube->target, TextureTarget::cube_map);
  EXPECT_TRUE(ninebit::is_complete(*cube, true));
  for (std::size_t face = 0; face < 6; ++face) {
    const std::string bytes = random_bytes(8 * 8 * 3, static_cast<std::uint32_t>(face));
    for (int i = 0; i < 64; ++i) {
      ASSERT_EQ(byte_at(*cube, face, 0, 1, i % 8, i / 8),
                static_cast<std::uint8_t>(bytes[static_cast<std::size_t>(3 * i + 1)]));
    }
  }
  const auto refused = [&](std::size_t face, const std::string& message) {
    const auto bad = read();
    ASSERT_FALSE(bad.ok());
    EXPECT_EQ(bad.error().text(), files[face].string() + ": " + message);
    write_picture(files[face], 8, 8, 3, 0);
  };
  write_picture(files[3], 16, 16, 3, 0);
  refused(3, "is 16 x 16 in size; the other faces of the cube map are 8 x 8");
  write_picture(files[5], 8, 4, 3, 0);
  refused(5, "is 8 x 4 in size; the faces of a cube map must be square");
  write_picture(files[0], 4, 8, 3, 0);
  refused(0, "is 4 x 8 in size; the faces of a cube map must be square");
  write_picture(files[2], 8, 8, 4, 0);
  refused(2, "has other channels or samples than the first face of the cube map");
  DdsFile dds{.width = 8, .height = 8};
  dds.make_cube();
  dds.data = random_bytes(6 * 32, 1);
  image_test::write_bytes(files[1], dds.bytes());
  refused(1, "is a cube map itself; expected one face");
  dds = {.width = 8, .height = 8, .levels = 4};
  dds.data = random_bytes(56, 1);
  image_test::write_bytes(files[4], dds.bytes());
  refused(4, "has 4 mip-map level(s); the first face of the cube map has 1");
  std::filesystem::remove(files[2]);
  refused(2, "cannot be opened");
}

}  // namespace
