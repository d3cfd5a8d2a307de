// `ninebit render --technique depth-cube`: its flags, its answer and its files.
#include <gtest/gtest.h>

#include <algorithm>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

Words depth_cube(const TempFolder& folder, const Words& more) {
  return small_render(kRoom, folder / "out", Words{"--technique", "depth-cube", "--json", "--quiet"} + more);
}

TEST(DepthCubeCli, AnswersWithTheFactsOfEachKindOfBits) {
  const TempFolder folder;
  for (const std::string bits : {"8", "16", "float"}) {
    const Json answer = json_of(ninebit(depth_cube(folder, {"--depth-bits", bits, "--bias", "0.5"})));
    const Json& facts = answer.at("facts");
    EXPECT_EQ(facts.at("depth_bits"), bits);
    EXPECT_EQ(facts.at("texture_units"), bits == "float" ? 0 : 2);
    EXPECT_GE(facts.at("bias").get<double>(), 0.5);
    EXPECT_LT(facts.at("bias").get<double>(), 0.51);
    EXPECT_EQ(answer.at("hash").at("depth_cube").get<std::string>().size(), 64U);
    EXPECT_FALSE(answer.at("hash").contains("index_map"));
  }
}

TEST(DepthCubeCli, WritesTheMapAndTheLayers) {
  const TempFolder folder;
  json_of(ninebit(depth_cube(folder, {"--depth-bits", "16", "--layers"})));
  Words names;
  for (const auto& [name, bytes] : files_in(folder / "out")) names.push_back(name);
  EXPECT_EQ(names, (Words{"color.png", "depth_cube.png", "layers.exr", "maps.exr", "render.json", "shadow.png"}));
}

TEST(DepthCubeCli, TraceTellsTheComparisonOfThePixelsFace) {
  const Json answer = json_of(ninebit({"trace", "--scene", kRoom, "--size", "200x150", "--map-size", "64", "--pixel",
                                       "100,120", "--technique", "depth-cube", "--depth-bits", "16", "--json"}));
  const std::string text = answer.dump();
  expect_parts(text, {"\"high byte ", "\"low byte "});
}

TEST(DepthCubeCli, RefusesWhatIsNoBias) {
  const TempFolder folder;
  expect_error(ninebit(small_render(kRoom, folder / "out", {"--technique", "depth-cube", "--bias", "-1"})), 2,
               {"--bias", "-1"});
  expect_error(ninebit(small_render(kRoom, folder / "out", {"--technique", "depth-cube", "--depth-bits", "12"})), 2,
               {"--depth-bits", "12"});
}

}  // namespace
}  // namespace tools_test
