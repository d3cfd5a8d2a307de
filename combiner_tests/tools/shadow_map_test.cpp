// `ninebit render --technique shadow-map`: what it answers, writes and refuses.
#include <gtest/gtest.h>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

Words shadow_map_render(const std::string& folder, const Words& more) {
  return small_render(kRoom, folder, {"--technique", "shadow-map"}) + more;
}

TEST(ShadowMapProgram, AnswersWithFactsAndHashesTheMap) {
  const TempFolder folder;
  const Json d24 = json_of(ninebit(shadow_map_render(folder / "a", {"--json"})));
  EXPECT_EQ(d24["technique"], "shadow-map");
  EXPECT_EQ(keys_of(d24["facts"]),
            (Words{"polygon_offset_factor", "polygon_offset_units", "texel_size", "depth_step", "texture_units"}));
  EXPECT_EQ(d24["facts"]["texture_units"], 2);
  EXPECT_EQ(keys_of(d24["hash"]), (Words{"color", "stencil", "shadow_map"}));
  EXPECT_GT(d24["pixels"]["lit"], 0);
  EXPECT_GT(d24["pixels"]["shadowed"], 0);
  const Json packed =
      json_of(ninebit(shadow_map_render(folder / "b", {"--json", "--depth-encoding", "rgba8-modf", "--layers"})));
  EXPECT_EQ(keys_of(packed["hash"]), (Words{"color", "stencil", "packed_depth", "shadow_map"}));
  EXPECT_TRUE(packed["facts"].contains("encoding_error"));
  EXPECT_EQ(packed["hash"]["shadow_map"], d24["hash"]["shadow_map"]);
  Words names;
  for (const auto& [name, bytes] : files_in(folder / "b")) names.push_back(name);
  EXPECT_EQ(names, (Words{"color.png", "layers.exr", "maps.exr", "render.json", "shadow.png", "shadow_map.png"}));
}

// The flag reaches the map.
TEST(ShadowMapProgram, TakesTheOffset) {
  const TempFolder folder;
  const Json none = json_of(ninebit(shadow_map_render(folder / "a", {"--json", "--polygon-offset", "0,0"})));
  const Json some = json_of(ninebit(shadow_map_render(folder / "b", {"--json"})));
  EXPECT_EQ(none["facts"]["polygon_offset_factor"], 0.0);
  EXPECT_NE(none["hash"]["shadow_map"], some["hash"]["shadow_map"]);
  EXPECT_GT(none["pixels"]["shadowed"], some["pixels"]["shadowed"]);
}

TEST(ShadowMapProgram, RefusesLightsThatItCannotDrawWith) {
  const TempFolder folder;
  expect_error(ninebit(shadow_map_render(folder / "out", {"--light", "1,2,1", "--light-target", "1,2,1"})), 3,
               {kRoom, "is at the point that it shines at"});
  expect_error(ninebit(shadow_map_render(folder / "out", {"--light-type", "point"})), 2,
               {"--light-type point", "shadow-map"});
  EXPECT_TRUE(files_in(folder / "out").empty());
}

}  // namespace
}  // namespace tools_test
