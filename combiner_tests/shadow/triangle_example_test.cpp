// The triangle of docs/library.md: compiled, run, and the very text of that page.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "combiner_tests/support/stored_pictures.h"
#include "ninebit/image/image_io.h"
#include "ninebit/raster/rasterizer.h"

namespace {

// clang-format off
// [example]
ninebit::Status draw_triangle(const char* file) {
  using namespace ninebit;
  const std::vector<glm::vec3> corners{{-0.8F, -0.8F, 0}, {0.8F, -0.8F, 0}, {0, 0.8F, 0}};
  const std::vector<ColorBytes> colors{{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}};
  std::vector<std::uint8_t> planes[3];  // memory of your own; a Surface has all planes at once
  RenderTarget target{.width = 320, .height = 240};
  for (std::size_t i = 0; i < 3; ++i) {
    planes[i].resize(320 * 240);
    target.color[i] = {planes[i].data(), 320};
  }
  const VertexArrays triangle{.positions = corners, .vertex_colors = colors};
  if (Status s = rasterize(PipelineState{}, glm::mat4(1.0F), triangle, {}, target); !s) return s;
  const auto top_down = [&](int i) { return upside_down(planes[i].data(), 320, 240); };
  return write_png(file, 320, 240, std::vector{top_down(0), top_down(1), top_down(2)});
}
// [example]
// clang-format on

std::string content(const std::string& file) {
  std::ifstream in(std::string(NINEBIT_SOURCE_DIR) + "/" + file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(TriangleExample, IsTheReadmes) {
  const std::string source = content("combiner_tests/shadow/triangle_example_test.cpp");
  const std::string mark = "// [example]\n";
  const std::size_t begin = source.find(mark) + mark.size(), end = source.find(mark, begin);
  ASSERT_NE(end, std::string::npos);
  EXPECT_NE(content("docs/library.md").find("```cpp\n" + source.substr(begin, end - begin) + "```"), std::string::npos);
}

TEST(TriangleExample, DrawsATriangle) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      ("ninebit-triangle-" + std::to_string(testing::UnitTest::GetInstance()->random_seed()) + "-" +
       std::to_string(getpid()) + ".png");
  const ninebit::Status drawn = draw_triangle(file.c_str());
  ASSERT_TRUE(drawn.ok()) << drawn.error().text();
  const ninebit::Image8 image = ninebit::test::read_png(file);
  std::filesystem::remove(file);
  ASSERT_EQ(image.width, 320);
  ASSERT_EQ(image.height, 240);
  const auto at = [&](int x, int y) { return image.pixels.data() + 3 * (static_cast<std::ptrdiff_t>(y) * 320 + x); };
  EXPECT_GT(at(160, 30)[2], 240) << "blue at the top";
  EXPECT_GT(at(36, 214)[0], 240) << "red at the lower left";
  EXPECT_GT(at(283, 214)[1], 240) << "green at the lower right";
  EXPECT_EQ(at(10, 10)[0] + at(10, 10)[1] + at(10, 10)[2], 0);
}

}  // namespace
