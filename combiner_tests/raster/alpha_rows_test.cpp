// The alpha test against pixels of an NV2A (rule 18): 8 functions with the reference 0x7F, 255 alphas each.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "combiner_tests/hardware/csv.h"
#include "combiner_tests/raster/support.h"

namespace ninebit::test {
namespace {

const std::map<std::string, CompareFunction> kFunctions{{"Never", CompareFunction::never},
                                                        {"LessThan", CompareFunction::less},
                                                        {"Equal", CompareFunction::equal},
                                                        {"LessThanOrEqual", CompareFunction::lequal},
                                                        {"GreaterThan", CompareFunction::greater},
                                                        {"NotEqual", CompareFunction::notequal},
                                                        {"GreaterThanOrEqual", CompareFunction::gequal},
                                                        {"Always", CompareFunction::always}};

// Which of 256 pixels in a row are drawn, pixel i with the alpha i.
std::vector<bool> drawn(const HardwareProfile& profile, CompareFunction function, std::uint8_t reference) {
  constexpr int kAlphas = 256;
  std::vector<glm::vec3> positions;
  std::vector<ColorBytes> colors;
  for (int i = 0; i < kAlphas; ++i) {
    const float left = static_cast<float>(i) / 128.0F - 1.0F, right = static_cast<float>(i + 1) / 128.0F - 1.0F;
    positions.insert(positions.end(), {{left, -1, 0}, {right, -1, 0}, {right, 1, 0}, {left, 1, 0}});
    colors.push_back({255, 0, 0, static_cast<std::uint8_t>(i)});
  }
  PipelineState state;
  state.profile = profile;
  state.alpha_test = {true, function, reference};
  const Surface surface = drawn_surface(
      kAlphas, 1, state, {.type = PrimitiveType::quads, .positions = positions, .primitive_colors = colors});
  std::vector<bool> result;
  for (const std::uint8_t red : surface.color(kRed)) result.push_back(red == 255);
  return result;
}

TEST(AlphaRows, DecideAsTheHardwareDid) {
  for (const HardwareProfile& profile : {profiles::nv2a, profiles::geforce2}) {
    std::map<std::string, std::vector<bool>> decided;
    for (const auto& [name, function] : kFunctions) decided[name] = drawn(profile, function, 0x7F);
    int rows = 0, pixels = 0, passed = 0;
    for (const auto& row : read_hardware_table("nv2a_alpha_test")) {
      ASSERT_EQ(row.at("ref"), "127");
      const auto alpha = static_cast<std::size_t>(std::stoi(row.at("alpha_byte")));
      const bool expected = row.at("hw_drawn") == "1";
      ASSERT_EQ(decided.at(row.at("func")).at(alpha), expected) << row.at("func") << ' ' << alpha;
      ++rows;
      pixels += std::stoi(row.at("pixels"));
      passed += expected ? 1 : 0;
    }
    EXPECT_EQ(rows, 2040);
    EXPECT_EQ(pixels, 14656);
    EXPECT_EQ(passed, 1020);
  }
}

}  // namespace
}  // namespace ninebit::test
