// Pictures read in a child process: the same textures, and readers that fail in every way.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "combiner_tests/image/texture_reading.h"
#include "combiner_tests/support/stored_pictures.h"
#include "src/image/texture/texture_file.h"
#include "src/system/sandbox.h"

namespace {

using image_test::TempFolder;
using ninebit::Result;
using ninebit::Texture;
using ninebit::image_detail::FileTexture;
using ninebit::image_detail::PictureSource;
using ninebit::profiles::geforce2;
namespace fs = std::filesystem;

void expect_same(const Texture& one, const Texture& other) {
  ASSERT_EQ(one.format, other.format);
  const auto &a = one.faces[0][0], &b = other.faces[0][0];
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  const auto stored = ninebit::stored_components(one.format);
  std::visit(
      [&](const auto& planes) {
        const auto& others = std::get<std::decay_t<decltype(planes)>>(b.planes);
        for (std::size_t k = 0; k < 4; ++k) {
          for (int i = 0; stored[k] && i < a.width * a.height; ++i) {
            ASSERT_EQ(planes[k].at(i % a.width, i / a.width), others[k].at(i % a.width, i / a.width));
          }
        }
      },
      a.planes);
}

// Whatever this build of OpenImageIO both writes and reads; the ordinary formats are there in any.
// All are read here first: OpenImageIO starts threads at the first TIFF, and a child that is forked while they start
// waits forever for a lock that one of them holds.
TEST(IsolatedPictures, AreTheSameInEveryFormat) {
  const TempFolder folder;
  ninebit::Image8 image{16, 8, 3, {}};
  for (int i = 0; i < 16 * 8 * 3; ++i) image.pixels.push_back(static_cast<std::uint8_t>(i * 7));
  std::vector<std::pair<fs::path, Result<Texture>>> read_here;
  for (const char* format : {"png", "jpg", "tga", "tif", "bmp", "sgi", "ppm", "exr", "hdr", "webp", "gif", "dpx", "rla",
                             "pic", "ico", "jp2", "iff", "zfile"}) {
    const fs::path file = folder.path() / (std::string("a.") + format);
    try {
      ninebit::test::write_as(file, image);
    } catch (const std::runtime_error&) {
      continue;
    }
    read_here.emplace_back(file, ninebit::read_texture(geforce2, file));
  }
  int read = 0;
  for (const auto& [file, here] : read_here) {
    SCOPED_TRACE(file);
    const Result<Texture> there = ninebit::read_texture(geforce2, file, {.isolated = true});
    ASSERT_EQ(here.ok(), there.ok()) << (here ? there : here).error().text();
    if (here) {
      expect_same(*here, *there);
    } else {
      EXPECT_EQ(here.error().text(), there.error().text());
    }
    read += here ? 1 : 0;
  }
  EXPECT_GE(read, 8);
}

// (Without a PNG cut short, on which libpng leaks in this process.)
TEST(IsolatedPictures, FaultsAreTheSame) {
  const TempFolder folder;
  for (const char* content : {"", "hello, world: this is no picture", "\x01\xda\x01\x01", "BM"}) {
    const fs::path file = folder.path() / "a.png";
    image_test::write_bytes(file, content);
    const auto here = ninebit::read_texture(geforce2, file);
    const auto there = ninebit::read_texture(geforce2, file, {.isolated = true});
    ASSERT_FALSE(here.ok() || there.ok());
    EXPECT_EQ(here.error().text(), there.error().text());
  }
}

class IsolatedReader : public testing::Test {
 protected:
  // The fault of the second of six faces, whose reader is the given one; the others are good.
  std::string complaint(Result<FileTexture> (*read)(const PictureSource&), const std::function<bool()>& go_on = {}) {
    std::array<fs::path, 6> files;
    for (std::size_t i = 0; i < 6; ++i) {
      files[i] = folder_.path() / std::string(1, static_cast<char>('0' + i));
      image_test::write_bytes(files[i], "picture");
    }
    const auto cube =
        ninebit::image_detail::read_cube_texture(geforce2, files, {.isolated = true, .go_on = go_on}, {.read = read});
    if (cube) return "";
    last_ = cube.error();
    EXPECT_TRUE(last_.file.empty() || last_.file == files[1].string()) << last_.file;
    return last_.message;
  }

  static Result<FileTexture> good() {
    FileTexture texture;
    texture.format = ninebit::InternalFormat::luminance8;
    texture.faces.push_back({{1, 1, std::vector<std::uint8_t>{7}}});
    return texture;
  }
  static bool is_second(const PictureSource& source) { return source.file.filename() == "1"; }

  TempFolder folder_;
  ninebit::Diagnostic last_;
};

TEST_F(IsolatedReader, IsBelievedWhereItIsRight) {
  EXPECT_EQ(complaint([](const PictureSource&) { return good(); }), "");
}

TEST_F(IsolatedReader, Crashes) {
  EXPECT_EQ(complaint([](const PictureSource& file) {
              if (is_second(file)) std::abort();
              return good();
            }),
            "OpenImageIO's reader crashed");
}

TEST_F(IsolatedReader, Hangs) {
  EXPECT_EQ(complaint([](const PictureSource& file) {
              if (is_second(file)) std::this_thread::sleep_for(std::chrono::hours(1));
              return good();
            }),
            "OpenImageIO's reader took more than 8 s");
}

TEST_F(IsolatedReader, EatsMemory) {
  if (!ninebit::posix::can_limit_memory())
    GTEST_SKIP() << "sanitizers map terabytes, so the address space has no limit";
  EXPECT_EQ(complaint([](const PictureSource& file) {
              Result<FileTexture> texture = good();
              if (is_second(file)) {
                const std::vector<std::uint8_t> much(std::size_t{1} << 36U, 7);
                texture->faces[0][0].samples = std::vector<std::uint8_t>{much.back()};
              }
              return texture;
            }),
            "OpenImageIO's reader needed more than 1536 MiB");
}

TEST_F(IsolatedReader, IsStoppedByTheCaller) {
  EXPECT_EQ(complaint(
                [](const PictureSource&) {
                  std::this_thread::sleep_for(std::chrono::hours(1));
                  return good();
                },
                [] { return false; }),
            "interrupted");
  EXPECT_EQ(last_.fault, ninebit::Fault::cancelled);
}

// Answers that no reader should give are not taken for pictures.
TEST_F(IsolatedReader, IsNotBelievedWhereItIsMad) {
  static void (*madden)(FileTexture&) = nullptr;
  int number = 0;
  for (void (*const each)(FileTexture&) : std::initializer_list<void (*)(FileTexture&)>{
           [](FileTexture& t) { t.faces[0][0].width = 0; }, [](FileTexture& t) { t.faces[0][0].height = 1 << 30; },
           [](FileTexture& t) { t.faces[0][0].samples = std::vector<std::uint8_t>(5); },
           [](FileTexture& t) { t.format = static_cast<ninebit::InternalFormat>(200); }}) {
    madden = each;
    SCOPED_TRACE(number++);
    EXPECT_EQ(complaint([](const PictureSource& file) {
                Result<FileTexture> texture = good();
                if (is_second(file)) madden(*texture);
                return texture;
              }),
              "OpenImageIO's reader returned no picture");
  }
}

}  // namespace
