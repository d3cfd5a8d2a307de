// Every index format through its own combiners: what is lost, and pictures that do not depend on the format.
#include <gtest/gtest.h>

#include <algorithm>

#include "combiner_tests/shadow/support.h"
#include "combiner_tests/support/index_room.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/scene/scene_io.h"
#include "ninebit/shadow/index_cube.h"

namespace {

using namespace ninebit;
using enum IndexFormat;

// A comparison of two codes: the own one as primary colour, the map's as a texel of its format.
class FormatComparison {
 public:
  FormatComparison(IndexFormat format, const HardwareProfile& profile)
      : format_(format), profile_(profile), program_(normalize(*index_comparison_state(profile, format), profile)) {}

  [[nodiscard]] Rgba9 operator()(const ColorBytes& own, const ColorBytes& map) const {
    FragmentInputs in;
    in.primary = own;
    in.texture[0] = Texel{.value = map, .format = base_format(map_format(format_))};
    return evaluate(program_, initial_registers(profile_, in));
  }

 private:
  IndexFormat format_;
  HardwareProfile profile_;
  Program program_;
};

// Rules 5 to 8: differences × 4 and their squares are exact, the sum × 4 loses its fraction, and both saturate.
int spare1_of(int first, int second) {
  const int a = std::clamp(4 * first, -255, 255), b = std::clamp(4 * second, -255, 255);
  return std::min(4 * (a * a + b * b) / 255, 255);
}

TEST(IndexFormats, OneChannelLosesWhatTheLadderSays) {
  for (const IndexFormat format : {luminance, alpha}) {
    const FormatComparison compare(format, profiles::geforce2);
    for (int step = 1; step <= 4; ++step) {
      const IndexCodes codes(step, format);
      int lost = 0;
      for (std::uint32_t a = 0; a < codes.capacity(); ++a) {
        for (std::uint32_t b = 0; b < codes.capacity(); ++b) {
          const int difference = (static_cast<int>(a) - static_cast<int>(b)) * step;
          const Rgba9 out = compare(codes.color(a), codes.color(b));
          ASSERT_EQ(out, (Rgba9{0, 0, 0, static_cast<s9>(spare1_of(difference, 0))})) << a << ' ' << b << ' ' << step;
          lost += a != b && out[kAlpha] == 0 ? 1 : 0;
        }
      }
      EXPECT_EQ(lost, step == 1 ? 510 : 0) << "step " << step;
    }
  }
}

// Each pair of differences once, from the middle of what the bytes allow.
TEST(IndexFormats, LuminanceAlphaSumsBothSquares) {
  const FormatComparison compare(luminance_alpha, profiles::geforce2);
  const auto gray = [](int luminance, int alpha) {
    const auto l = static_cast<std::uint8_t>(luminance);
    return ColorBytes{l, l, l, static_cast<std::uint8_t>(alpha)};
  };
  for (int step = 1; step <= 4; ++step) {
    const int top = 255 / step * step;
    int lost = 0;
    for (int dl = -top; dl <= top; dl += step) {
      for (int da = -top; da <= top; da += step) {
        const ColorBytes own = gray(std::max(dl, 0), std::max(da, 0)), map = gray(std::max(-dl, 0), std::max(-da, 0));
        const Rgba9 out = compare(own, map);
        ASSERT_EQ(out, (Rgba9{0, 0, 0, static_cast<s9>(spare1_of(dl, da))})) << dl << ' ' << da;
        lost += (dl != 0 || da != 0) && out[kAlpha] == 0 ? 1 : 0;
      }
    }
    // With step 1 those of at most one in both channels: 64 · (1 + 1) < 255.
    EXPECT_EQ(lost, step == 1 ? 8 : 0) << "step " << step;
  }
}

TEST(IndexFormats, EveryProfileTellsEqualFromFarApart) {
  for (const HardwareProfile& profile : hardware_profiles()) {
    for (const IndexFormat format : {rgb, luminance_alpha, luminance, alpha}) {
      ASSERT_TRUE(index_comparison_state(profile, format).ok()) << profile.name;
      const FormatComparison compare(format, profile);
      const IndexCodes codes(16, format);
      for (std::uint32_t n = 0; n < codes.capacity(); n += 5) {
        EXPECT_EQ(compare(codes.color(n), codes.color(n))[kAlpha], 0) << profile.name << ' ' << n;
        EXPECT_GT(compare(codes.color(n), codes.color((n + 1) % codes.capacity()))[kAlpha], 0) << profile.name;
      }
    }
  }
}

// Twenty-eight polygons fit all formats; with step 2 none of them loses a difference, so the stencil is the same.
TEST(IndexFormats, TheShadowsDoNotDependOnTheFormat) {
  Scene scene = shadow_test::square_over_floor();
  shadow_test::add_box(scene, "box", {-2.5F, 0.2F, -0.5F}, {-1.5F, 0.9F, 0.5F});
  shadow_test::add_box(scene, "other box", {1.6F, 0.1F, 0.4F}, {2.4F, 1.4F, 1.2F});
  RenderSettings settings = shadow_test::small_settings();
  const Rendering first = shadow_test::render(scene, settings);
  ASSERT_GT(first.shadowed, 1000U);
  for (const IndexFormat format : {luminance_alpha, luminance, alpha}) {
    settings.index.format = format;
    const Rendering r = shadow_test::render(scene, settings);
    const auto layers = shadow_test::comparison_layers(r);
    EXPECT_EQ(r.frame.stencil(), first.frame.stencil());
    EXPECT_EQ(r.codes_used, scene.triangles.size());
    for (std::size_t i = 0; i < layers.polygon.size(); ++i) {
      if (layers.polygon[i] == 0) continue;
      ASSERT_EQ(layers.own(r.codes, i), layers.polygon[i]);
      ASSERT_EQ(r.frame.stencil()[i] != 0, layers.fetched(r.codes, i) != layers.polygon[i]);
    }
    for (std::size_t face = 0; face < 6; ++face) {
      for (std::size_t i = 0; i < first.index_map[face].texels(); ++i) {
        ASSERT_EQ(r.codes.number(r.index_map[face].texel(i)), first.codes.number(first.index_map[face].texel(i)));
      }
    }
  }
}

// Step 1 in luminance-alpha: numbers that differ by one in luminance are lost, as with the article's program.
TEST(IndexFormats, StepOneDropsTheShadowOfTheNextPolygonInEachFormat) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const Scene scene = shadow_test::square_over_floor();
  for (const IndexFormat format : {rgb, luminance_alpha, luminance, alpha}) {
    RenderSettings settings = shadow_test::small_settings();
    settings.index.format = format;
    settings.index.scope = IndexScope::object;  // the floor has number 1, the square above it 2
    settings.index.step = 1;
    const Rendering r = shadow_test::render(scene, settings);
    const auto layers = shadow_test::comparison_layers(r);
    int lost = 0;
    for (std::size_t i = 0; i < layers.object.size(); ++i) {
      if (layers.object[i] != 1 || layers.fetched(r.codes, i) != 2) continue;
      ++lost;
      ASSERT_EQ(r.frame.stencil()[i], 0);
    }
    EXPECT_GT(lost, 300);
    settings.index.step = 2;
    EXPECT_GT(shadow_test::render(scene, settings).shadowed, 300U);
  }
}

// The triangle that the map holds at a texel has the index that was read there.
TEST(IndexFormats, EvidenceNamesTheOwnerOfWhatWasFetched) {
  const Scene scene = ninebit::test::index_room();
  using enum IndexScope;
  for (const auto& [format, scope] : {std::pair{luminance_alpha, polygon},
                                      {luminance_alpha, section},
                                      {luminance, object},
                                      {IndexFormat::alpha, object},
                                      {rgb, section}}) {
    RenderSettings settings = shadow_test::small_settings();
    settings.index = {.format = format, .scope = scope, .section_size = 32};
    settings.evidence = true;
    const Rendering r = shadow_test::render(scene, settings);
    const auto layers = shadow_test::comparison_layers(r);
    ASSERT_TRUE(r.evidence.has_value());
    std::size_t found = 0;
    for (std::size_t i = 0; i < layers.polygon.size(); ++i) {
      if (layers.polygon[i] == 0) continue;
      const std::uint32_t owner = r.evidence->fetched[i];
      const std::uint32_t index = owner == 0 ? 0 : r.evidence->index_of_triangle[owner - 1];
      ASSERT_EQ(index, layers.fetched(r.codes, i));
      found += owner == 0 ? 0 : 1;
    }
    EXPECT_GT(found, layers.polygon.size() / 2);
  }
}

}  // namespace
