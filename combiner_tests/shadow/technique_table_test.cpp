// Every technique with every depth-stencil format, on frames of several sizes: the same bytes each time, for any number
// of threads, and whatever memory held before.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "combiner_tests/raster/in_threads.h"
#include "combiner_tests/shadow/support.h"
#include "combiner_tests/support/index_room.h"
#include "combiner_tests/support/random.h"
#include "ninebit/raster/texture.h"
#include "ninebit/scene/scene_io.h"

namespace {

using namespace ninebit;
using ninebit::test::Random;
using ninebit::test::with_threads;

constexpr std::array kTableFormats{DepthStencilFormat::d24s8, DepthStencilFormat::d15s1, DepthStencilFormat::f24s8,
                                   DepthStencilFormat::w24s8};

// While it lives, memory that is allocated holds this byte's complement, and memory that is freed the byte.
class MemoryHolds {
 public:
  explicit MemoryHolds([[maybe_unused]] int byte) {
#ifdef M_PERTURB
    ::mallopt(M_PERTURB, byte);
#endif
  }
  ~MemoryHolds() {
#ifdef M_PERTURB
    ::mallopt(M_PERTURB, 0);
#endif
  }
  MemoryHolds(const MemoryHolds&) = delete;
  MemoryHolds& operator=(const MemoryHolds&) = delete;
};

// All that can be seen of a rendering.
struct Bytes {
  std::array<PlaneSamples<std::uint8_t>, 4> color;
  PlaneSamples<std::uint32_t> depth;
  PlaneSamples<std::uint8_t> stencil;
  std::vector<PlaneSamples<std::uint8_t>> index_map;
  std::uint64_t background, lit, shadowed;
  bool operator==(const Bytes&) const = default;
};

class TechniqueTable : public testing::Test {
 protected:
  TechniqueTable() : cookie_(ninebit::test::noisy_cookie()) {
    for (const Technique& technique : techniques()) scenes_.push_back(ninebit::test::index_room(technique.lights));
  }

  [[nodiscard]] Result<Rendering> render(std::size_t technique, const glm::ivec2& size,
                                         DepthStencilFormat format) const {
    RenderSettings settings;
    settings.width = size.x;
    settings.height = size.y;
    settings.map_size = 32;
    settings.depth_stencil = format;
    settings.light_cookie.cookie = cookie_;
    settings.reflective.samples = 10;
    settings.reflective.gather_scale = 2;
    return techniques()[technique].render(scenes_[technique], settings, {});
  }

  [[nodiscard]] Bytes bytes(std::size_t technique, const glm::ivec2& size, DepthStencilFormat format, int threads,
                            int memory) const {
    std::optional<Bytes> found;
    const MemoryHolds holds(memory);
    with_threads(threads, [&] {
      const auto rendering = render(technique, size, format);
      if (!rendering) throw std::runtime_error(rendering.error().text());
      const Surface& frame = rendering->frame;
      found = Bytes{.color = {frame.color(0), frame.color(1), frame.color(2), frame.color(3)},
                    .depth = frame.depth(),
                    .stencil = frame.stencil(),
                    .index_map = {},
                    .background = rendering->background,
                    .lit = rendering->lit,
                    .shadowed = rendering->shadowed};
      for (const IndexMapFace& face : rendering->index_map) {
        for (int c = 0; c < 4; ++c) {
          if (const auto plane = face.plane(c)) {
            PlaneSamples<std::uint8_t>& copy = found->index_map.emplace_back();
            for (int y = 0; y < face.size; ++y) {
              for (int x = 0; x < face.size; ++x) copy.push_back(plane.at(x, y));
            }
          }
        }
      }
    });
    return *found;
  }

 private:
  std::shared_ptr<const Texture> cookie_;
  std::vector<Scene> scenes_;
};

// Sizes of whole tiles, and others.
TEST_F(TechniqueTable, DrawsTheSameBytesEachTime) {
  for (std::size_t technique = 0; technique < techniques().size(); ++technique) {
    for (const DepthStencilFormat format : kTableFormats) {
      // Volumes to infinity are refused.
      if (layout_of(format).is_w && techniques()[technique].name == "shadow-volume") continue;
      for (const glm::ivec2& size : {glm::ivec2(128, 64), glm::ivec2(150, 70), glm::ivec2(33, 17)}) {
        const std::string what = std::string(techniques()[technique].name) + ", " +
                                 std::to_string(stencil_bits(format)) + " stencil bits, width " +
                                 std::to_string(size.x);
        const Bytes first = bytes(technique, size, format, 1, 0x5A);
        for (const int memory : {0xA5, 0x01}) {
          EXPECT_TRUE(bytes(technique, size, format, 3, memory) == first) << what << ", three threads";
        }
        EXPECT_GT(first.lit, 0U) << what;
        EXPECT_GT(first.shadowed, 0U) << what;
        const int most = (1 << stencil_bits(format)) - 1;
        EXPECT_LE(*std::max_element(first.stencil.begin(), first.stencil.end()), most) << what;
      }
    }
  }
}

// A stencil buffer of one bit holds the lowest of eight. Depth of 15 bits decides a pixel otherwise here and there.
TEST_F(TechniqueTable, OneStencilBitIsTheLowestOfEight) {
  const glm::ivec2 size(150, 100);
  for (std::size_t technique = 0; technique < techniques().size(); ++technique) {
    const Bytes eight = bytes(technique, size, DepthStencilFormat::d24s8, 3, 0x5A);
    const Bytes one = bytes(technique, size, DepthStencilFormat::d15s1, 3, 0x5A);
    std::size_t different = 0, set = 0;
    for (std::size_t i = 0; i < one.stencil.size(); ++i) {
      different += one.stencil[i] != (eight.stencil[i] & 1) ? 1U : 0U;
      set += one.stencil[i];
    }
    EXPECT_LT(different, one.stencil.size() / 200) << techniques()[technique].name;
    EXPECT_GT(set, one.stencil.size() / 50) << techniques()[technique].name;
    EXPECT_EQ(one.shadowed, set) << techniques()[technique].name;
    EXPECT_TRUE(one.index_map == eight.index_map) << techniques()[technique].name;
  }
}

TEST_F(TechniqueTable, FormatsWithoutStencilAreRefused) {
  for (std::size_t technique = 0; technique < techniques().size(); ++technique) {
    const auto rendering = render(technique, {33, 17}, DepthStencilFormat::d16);
    ASSERT_FALSE(rendering.ok()) << techniques()[technique].name;
    EXPECT_NE(rendering.error().message.find("d16 has no stencil bits"), std::string::npos)
        << techniques()[technique].name << ": " << rendering.error().message;
  }
}

}  // namespace
