#include <ImathBox.h>
#include <ImfEnvmap.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <string>

#include "combiner_tests/image/read_back.h"
#include "combiner_tests/image/rows.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/image/image_io.h"
#include "src/system/parallel/parallel_loop.h"

namespace {

using image_test::RowLog;
using image_test::rows_of;
using image_test::TempFolder;
using Imath::V2f;
using Imath::V3f;
using ninebit::ExrChannel;

// The direction of the centre of texel (i, j), by the table of ARB_texture_cube_map: for each face its major axis and
// what sc and tc are.
V3f texel_direction(int face, int i, int j, int size) {
  const float sc = 2.0F * (static_cast<float>(i) + 0.5F) / static_cast<float>(size) - 1.0F;
  const float tc = 2.0F * (static_cast<float>(j) + 0.5F) / static_cast<float>(size) - 1.0F;
  switch (face) {
    case 0:
      return {1.0F, -tc, -sc};
    case 1:
      return {-1.0F, -tc, sc};
    case 2:
      return {sc, 1.0F, tc};
    case 3:
      return {sc, -1.0F, -tc};
    case 4:
      return {sc, -tc, 1.0F};
    default:
      return {-sc, -tc, -1.0F};
  }
}

std::uint32_t texel_code(int face, int i, int j) {
  return static_cast<std::uint32_t>(face * 1000000 + i * 1000 + j);
}

// Neither copied nor moved: the faces borrow the planes.
struct Cube {
  explicit Cube(int size);
  Cube(const Cube&) = delete;
  Cube& operator=(const Cube&) = delete;
  std::array<std::vector<std::uint32_t>, 6> codes;
  std::array<std::vector<float>, 6> shades;
  std::array<std::vector<ExrChannel>, 6> faces;
};

Cube::Cube(int size) {
  for (int face = 0; face < 6; ++face) {
    const auto f = static_cast<std::size_t>(face);
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i) {
        codes[f].push_back(texel_code(face, i, j));
        shades[f].push_back(static_cast<float>(face * 256 + (7 * i + 31 * j) % 256));
      }
    }
    faces[f] = {{"index", rows_of(codes[f], size)}, {"R", rows_of(shades[f], size)}};
  }
}

class CubeSizes : public testing::TestWithParam<int> {};

// Each stored pixel is the texel whose centre is nearest to the direction that OpenEXR gives the pixel.
TEST_P(CubeSizes, EveryPixelHasTheDirectionThatOpenExrGivesIt) {
  const int size = GetParam();
  const TempFolder folder;
  const Cube cube(size);
  const auto status = ninebit::write_exr_cube(folder.path() / "a.exr", size, cube.faces);
  ASSERT_TRUE(status.ok()) << status.error().text();
  const auto parts = image_test::read_exr(folder.path() / "a.exr");
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_TRUE(parts[0].cube);
  EXPECT_TRUE(parts[0].zip);
  ASSERT_EQ(parts[0].width, size);
  ASSERT_EQ(parts[0].height, 6 * size);
  const auto& codes = parts[0].channels.at("index").integers;
  const auto& shades = parts[0].channels.at("R").reals;
  const Imath::Box2i window({0, 0}, {size - 1, 6 * size - 1});
  int checked = 0;
  for (int face = 0; face < 6; ++face) {
    for (int v = 0; v < size; ++v) {
      for (int u = 0; u < size; ++u) {
        const auto imf_face = static_cast<Imf::CubeMapFace>(face);
        const V2f in_face(static_cast<float>(u), static_cast<float>(v));
        const V3f wanted = Imf::CubeMap::direction(imf_face, window, in_face).normalized();
        int best_i = 0;
        int best_j = 0;
        float best = -2.0F;
        for (int j = 0; j < size; ++j) {
          for (int i = 0; i < size; ++i) {
            const float cosine = wanted.dot(texel_direction(face, i, j, size).normalized());
            if (cosine > best) {
              best = cosine;
              best_i = i;
              best_j = j;
            }
          }
        }
        const V2f position = Imf::CubeMap::pixelPosition(imf_face, window, in_face);
        const auto at = static_cast<std::size_t>(std::lround(position.y)) * static_cast<std::size_t>(size) +
                        static_cast<std::size_t>(std::lround(position.x));
        ASSERT_EQ(codes.at(at), texel_code(face, best_i, best_j)) << "face " << face << " pixel " << u << ' ' << v;
        const std::size_t texel = static_cast<std::size_t>(best_j * size + best_i);
        ASSERT_EQ(shades.at(at), cube.shades[static_cast<std::size_t>(face)][texel]);
        ++checked;
      }
    }
  }
  EXPECT_EQ(checked, 6 * size * size);
}

INSTANTIATE_TEST_SUITE_P(All, CubeSizes, testing::Values(2, 3, 5, 16, 25));

// The other way round: a direction inside a face leads OpenEXR to that direction's texel.
TEST(Cube, OpenExrFindsTheTexelOfADirection) {
  constexpr int kSize = 67;  // more than one block of rows, and no multiple of a compressed one
  const TempFolder folder;
  const Cube cube(kSize);
  ASSERT_TRUE(ninebit::write_exr_cube(folder.path() / "a.exr", kSize, cube.faces).ok());
  const auto parts = image_test::read_exr(folder.path() / "a.exr");
  const auto& codes = parts.at(0).channels.at("index").integers;
  const Imath::Box2i window({0, 0}, {kSize - 1, 6 * kSize - 1});
  for (int face = 0; face < 6; ++face) {
    for (int j = 0; j < kSize; ++j) {
      for (int i = 0; i < kSize; ++i) {
        Imf::CubeMapFace found = Imf::CUBEFACE_POS_X;
        V2f in_face;
        Imf::CubeMap::faceAndPixelPosition(texel_direction(face, i, j, kSize), window, found, in_face);
        ASSERT_EQ(static_cast<int>(found), face);
        const V2f position = Imf::CubeMap::pixelPosition(found, window, in_face);
        const auto at = static_cast<std::size_t>(std::lround(position.y)) * kSize +
                        static_cast<std::size_t>(std::lround(position.x));
        ASSERT_EQ(codes.at(at), texel_code(face, i, j)) << "face " << face << " texel " << i << ' ' << j;
      }
    }
  }
}

TEST(Cube, StoresASingleTexelAFace) {
  const TempFolder folder;
  const Cube cube(1);
  ASSERT_TRUE(ninebit::write_exr_cube(folder.path() / "a.exr", 1, cube.faces).ok());
  const auto parts = image_test::read_exr(folder.path() / "a.exr");
  EXPECT_EQ(parts.at(0).channels.at("index").integers,
            (std::vector<std::uint32_t>{0, 1000000, 2000000, 3000000, 4000000, 5000000}));
}

TEST(Cube, IsTheSameBytesForAnyNumberOfThreads) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "other numbers of threads: the build without sanitizers runs this";
  const TempFolder folder;
  const Cube cube(128);
  std::string first;
  for (const std::size_t threads : {1U, 1U, 3U}) {
    const ninebit::ScopedThreadLimit limit(threads);
    ASSERT_TRUE(ninebit::write_exr_cube(folder.path() / "a.exr", 128, cube.faces).ok());
    const std::string bytes = image_test::read_bytes(folder.path() / "a.exr");
    ASSERT_FALSE(bytes.empty());
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << threads << " threads";
  }
}

TEST(Cube, AsksForEachRowOfEachFaceOnce) {
  constexpr int kSize = 150;  // two blocks of rows and some
  const TempFolder folder;
  std::array<RowLog, 6> integers;
  std::array<RowLog, 6> reals;
  std::array<std::vector<ExrChannel>, 6> faces;
  for (std::size_t f = 0; f < 6; ++f) {
    faces[f] = {{"index", integers[f].rows<std::uint32_t>(kSize)}, {"R", reals[f].rows<float>(kSize)}};
  }
  const auto status = ninebit::write_exr_cube(folder.path() / "a.exr", kSize, faces);
  ASSERT_TRUE(status.ok()) << status.error().text();
  for (std::size_t f = 0; f < 6; ++f) {
    for (const RowLog* log : {&integers[f], &reals[f]}) {
      std::vector<int> asked = log->asked();
      std::sort(asked.begin(), asked.end());
      EXPECT_EQ(asked, image_test::up_to(kSize)) << "face " << f;
    }
  }
}

TEST(Cube, LeavesNoFileWhenTheRowsRunOutOfMemory) {
  const TempFolder folder;
  std::array<std::vector<ExrChannel>, 6> faces;
  faces.fill({{"index", [](int, std::span<std::uint32_t> out) { std::fill(out.begin(), out.end(), 1U); }}});
  faces[4][0].rows = [](int row, std::span<std::uint32_t>) {
    if (row < 100) throw std::bad_alloc();
  };
  EXPECT_THROW((void)ninebit::write_exr_cube(folder.path() / "a.exr", 130, faces), std::bad_alloc);
  EXPECT_TRUE(folder.names().empty());
}

TEST(Cube, ReportsFacesThatDoNotFit) {
  const TempFolder folder;
  const auto file = folder.path() / "a.exr";
  const Cube good(4);
  const auto expect_refused = [&](int size, const std::array<std::vector<ExrChannel>, 6>& faces, const char* what) {
    const auto status = ninebit::write_exr_cube(file, size, faces);
    ASSERT_FALSE(status.ok()) << what;
    EXPECT_EQ(status.error().fault, ninebit::Fault::invalid_input) << what;
    EXPECT_EQ(status.error().file, file.string()) << what;
  };
  expect_refused(0, good.faces, "no size");
  expect_refused(-4, good.faces, "a negative size");
  expect_refused(16385, good.faces, "too large");
  expect_refused(1 << 20, good.faces, "far too large");
  auto faces = good.faces;
  faces[3].pop_back();
  expect_refused(4, faces, "a channel less");
  faces = good.faces;
  faces[5][0].name = "other";
  expect_refused(4, faces, "another name");
  faces = good.faces;
  faces[1][0].rows = good.faces[1][1].rows;
  expect_refused(4, faces, "another type");
  faces = good.faces;
  faces[2][1].rows = ninebit::ExrRealRow();
  expect_refused(4, faces, "no function for the rows");
  RowLog log;
  faces.fill({{"index", log.rows<std::uint32_t>(4)}});
  faces[5].push_back({"R", log.rows<float>(4)});
  expect_refused(4, faces, "a channel more");
  EXPECT_TRUE(log.asked().empty());
  expect_refused(4, {}, "no channels");
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
