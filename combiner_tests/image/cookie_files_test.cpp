// The cubes that the project ships: made by their generator, and the same texels in both.
#include <gtest/gtest.h>

#include <string>

#include "combiner_tests/support/generated_file.h"
#include "ninebit/image/texture_io.h"
#include "ninebit/numerics/hardware_profile.h"

namespace {

using namespace ninebit;

const std::string kScenes = NINEBIT_SOURCE_DIR "/scenes/";

TEST(CookieFiles, AreWhatTheirGeneratorMakes) {
  for (const std::string name : {"labels.dds", "labels_dxt1.dds"}) {
    test::expect_makes(kScenes + "make_cookie_cube.py", name, kScenes + "cookies/" + name);
  }
}

TEST(CookieFiles, HoldTheSameCube) {
  for (const HardwareProfile& profile : hardware_profiles()) {
    const auto plain = read_texture(profile, kScenes + "cookies/labels.dds");
    const auto blocks = read_texture(profile, kScenes + "cookies/labels_dxt1.dds");
    ASSERT_TRUE(plain.ok() && blocks.ok());
    ASSERT_EQ(plain->target, TextureTarget::cube_map);
    ASSERT_EQ(blocks->target, TextureTarget::cube_map);
    // Bytes below 15 may become 0 where they are dithered (rule 24).
    const int nearness = profile.dxt1_palette.value == Dxt1Palette::dithered565 ? 14 : 0;
    for (std::size_t face = 0; face < 6; ++face) {
      ASSERT_EQ(plain->faces[face].size(), 1U);
      const TextureImage &a = plain->faces[face][0], &b = blocks->faces[face][0];
      ASSERT_EQ(a.width, 64);
      ASSERT_EQ(b.width, 64);
      const auto &p = std::get<0>(a.planes), &q = std::get<0>(b.planes);
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
          for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_NEAR(p[c].at(x, y), q[c].at(x, y), nearness) << profile.name << face;
          }
        }
      }
    }
  }
}

}  // namespace
