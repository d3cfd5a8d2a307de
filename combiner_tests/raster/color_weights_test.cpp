// Smooth colours against pixels that an NV2A drew (rule 27).
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

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

std::array<ColorBytes, 3> colors_of(const HardwareRow& row) {
  return {rgb_of(row.at("c0")), rgb_of(row.at("c1")), rgb_of(row.at("c2"))};
}

Surface drawn_as(PrimitiveType type, std::span<const glm::vec4> corners, std::span<const ColorBytes> colors) {
  PipelineState state;
  state.profile = profiles::nv2a;
  state.depth_test.enabled = false;
  return drawn_surface(kScreenWidth, kScreenHeight, state,
                       {.type = type, .homogeneous_positions = corners, .vertex_colors = colors});
}

// Compares the measured pixels of the triangles that have a picture. Returns their number.
std::size_t compare_pixels(const std::map<std::string, const Surface*>& picture_of) {
  std::size_t pixels = 0, outside = 0, wrong = 0;
  for (const HardwareRow& row : read_hardware_table("nv2a_gouraud_pixels")) {
    const auto found = picture_of.find(row.at("triangle"));
    if (found == picture_of.end()) continue;
    if (row.at("match") == "0") {  // outside of the rule
      ++outside;
      continue;
    }
    const Surface& picture = *found->second;
    const auto at =
        static_cast<std::size_t>((kScreenHeight - 1 - std::stoi(row.at("y"))) * kScreenWidth + std::stoi(row.at("x")));
    const bool same = picture.color(0)[at] == std::stoi(row.at("hw_R")) &&
                      picture.color(1)[at] == std::stoi(row.at("hw_G")) &&
                      picture.color(2)[at] == std::stoi(row.at("hw_B"));
    if (!same) {
      ADD_FAILURE() << "triangle " << row.at("triangle") << " at " << row.at("x") << ", " << row.at("y");
      if (++wrong == 10) break;
    }
    ++pixels;
  }
  EXPECT_LT(outside, 100U);
  return pixels;
}

TEST(ColorWeights, SmoothTrianglesAreThoseOfTheNv2a) {
  std::map<std::string, Surface> pictures;
  for (const HardwareRow& row : read_hardware_table("nv2a_gouraud_triangles")) {
    pictures.emplace(row.at("triangle"), drawn_as(PrimitiveType::triangles, corners_of(row), colors_of(row)));
  }
  std::map<std::string, const Surface*> picture_of;
  for (const auto& [triangle, picture] : pictures) picture_of[triangle] = &picture;
  EXPECT_GT(compare_pixels(picture_of), 4800U);
}

// The same triangles as parts of the primitives that the hardware drew, each cut as the hardware cut it (rule 32). The
// table leaves out single vertices; those are put where they make a parallelogram.
TEST(ColorWeights, PrimitivesAreCutAsOnTheNv2a) {
  struct Drawn {
    PrimitiveType type;
    std::string name;
    std::size_t vertices, pixels;  // of the primitive; measured ones of the table's triangles, at least
  };
  for (const Drawn& drawn :
       {Drawn{PrimitiveType::triangle_strip, "TriStrip", 8, 780}, Drawn{PrimitiveType::triangle_fan, "TriFan", 8, 780},
        Drawn{PrimitiveType::quads, "Quad", 8, 519}, Drawn{PrimitiveType::quad_strip, "QuadStrip", 6, 520},
        Drawn{PrimitiveType::polygon, "Poly", 4, 259}}) {
    SCOPED_TRACE(drawn.name);
    std::vector<std::optional<glm::vec4>> known(drawn.vertices);
    std::vector<ColorBytes> colors(drawn.vertices, ColorBytes{0, 0, 255, 255});
    std::vector<std::string> triangles;
    for (const HardwareRow& row : read_hardware_table("nv2a_gouraud_triangles")) {
      if (row.at("picture") != "Shade_model/Prog_" + drawn.name + "_Smooth_Last.png") continue;
      triangles.push_back(row.at("triangle"));
      std::istringstream numbers(row.at("vertices"));
      for (std::size_t i = 0; i < 3; ++i) {
        std::string number;
        std::getline(numbers, number, '-');
        known[std::stoul(number)] = corners_of(row)[i];
        colors[std::stoul(number)] = colors_of(row)[i];
      }
    }
    std::vector<glm::vec4> corners;
    for (std::size_t v = 0; v < known.size(); ++v) {
      const std::size_t before = v == 0 ? 1 : v - 1, after = v == 0 ? 2 : v + 1;
      corners.push_back(known[v] ? *known[v] : *known[before] + *known[after] - *known[after + 1]);
    }
    const Surface picture = drawn_as(drawn.type, corners, colors);
    std::map<std::string, const Surface*> picture_of;
    for (const std::string& triangle : triangles) picture_of[triangle] = &picture;
    EXPECT_GE(compare_pixels(picture_of), drawn.pixels);
  }
}

}  // namespace
}  // namespace ninebit::test
