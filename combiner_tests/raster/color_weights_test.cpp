// Smooth colours against pixels that an NV2A drew (rule 27).
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "combiner_tests/hardware/csv.h"
#include "combiner_tests/raster/support.h"

namespace ninebit::test {
namespace {

constexpr int kScreenWidth = 640, kScreenHeight = 480;

// Six hexadecimal digits, RRGGBB.
ColorBytes rgb_of(const std::string& digits) {
  const auto word = static_cast<std::uint32_t>(std::stoul(digits, nullptr, 16));
  const auto byte = [word](unsigned shift) { return static_cast<std::uint8_t>(word >> shift); };
  return {byte(16), byte(8), byte(0), 255};
}

// The corners of a row, whose window has y down, at the middle of their cells of 1/16 pixel.
std::array<glm::vec4, 3> corners_of(const HardwareRow& row) {
  std::array<glm::vec4, 3> corners;
  for (int i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i);
    const float w = std::stof(row.at("w" + n));
    const oracle::WindowVertex at{
        .x_q4 = std::stoi(row.at("x" + n)), .y_q4 = 16 * kScreenHeight - std::stoi(row.at("y" + n)), .z24 = 1 << 23};
    corners[static_cast<std::size_t>(i)] = glm::vec4(clip_position(at, kScreenWidth, kScreenHeight) * w, w);
  }
  return corners;
}

TEST(ColorWeights, SmoothTrianglesAreThoseOfTheNv2a) {
  std::map<std::string, Surface> pictures;
  for (const HardwareRow& row : read_hardware_table("nv2a_gouraud_triangles")) {
    const std::array<glm::vec4, 3> corners = corners_of(row);
    const std::array<ColorBytes, 3> colors{rgb_of(row.at("c0")), rgb_of(row.at("c1")), rgb_of(row.at("c2"))};
    Surface surface = Surface::make(kScreenWidth, kScreenHeight).value();
    RenderTarget target = surface.target();
    PipelineState state;
    state.profile = profiles::nv2a;
    state.depth_test.enabled = false;
    const Status drawn =
        rasterize(state, kIdentity, {.homogeneous_positions = corners, .vertex_colors = colors}, {}, target);
    ASSERT_TRUE(drawn.ok()) << drawn.error().message;
    pictures.emplace(row.at("triangle"), std::move(surface));
  }
  std::size_t pixels = 0, outside = 0, wrong = 0;
  for (const HardwareRow& row : read_hardware_table("nv2a_gouraud_pixels")) {
    if (row.at("match") == "0") {  // outside of the rule
      ++outside;
      continue;
    }
    const Surface& picture = pictures.at(row.at("triangle"));
    const auto at =
        static_cast<std::size_t>((kScreenHeight - 1 - std::stoi(row.at("y"))) * kScreenWidth + std::stoi(row.at("x")));
    const bool same = picture.color(0)[at] == std::stoi(row.at("hw_R")) &&
                      picture.color(1)[at] == std::stoi(row.at("hw_G")) &&
                      picture.color(2)[at] == std::stoi(row.at("hw_B"));
    if (!same) {
      ADD_FAILURE() << "triangle " << row.at("triangle") << " at " << row.at("x") << ", " << row.at("y");
      ASSERT_LT(++wrong, 10U);
    }
    ++pixels;
  }
  EXPECT_GT(pixels, 4800U);
  EXPECT_LT(outside, 100U);
}

}  // namespace
}  // namespace ninebit::test
