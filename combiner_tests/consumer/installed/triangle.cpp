// ninebit::raster in somebody else's project: one triangle into memory of one's own.
#include <ninebit/raster/rasterizer.h>

#include <cstdio>
#include <vector>

int main() {
  using namespace ninebit;
  const std::vector<glm::vec3> corners{{-0.8F, -0.8F, 0}, {0.8F, -0.8F, 0}, {0, 0.8F, 0}};
  const std::vector<ColorBytes> colors{{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}};
  std::vector<std::uint8_t> planes[3];
  RenderTarget target{.width = 320, .height = 240};
  for (std::size_t i = 0; i < 3; ++i) {
    planes[i].resize(320 * 240);
    target.color[i] = {planes[i].data(), 320};
  }
  const VertexArrays triangle{.positions = corners, .vertex_colors = colors};
  if (const Status s = rasterize(PipelineState{}, glm::mat4(1.0F), triangle, {}, target); !s) return 1;
  int drawn = 0;
  for (std::size_t i = 0; i < planes[0].size(); ++i) drawn += planes[0][i] + planes[1][i] + planes[2][i] > 0 ? 1 : 0;
  std::printf("%d pixels are red, green or blue\n", drawn);
}
