// --supersample: pictures are means of samples, to the bit.
#include <gtest/gtest.h>

#include "combiner_tests/tools/support.h"
#include "ninebit/frame/pictures.h"

namespace tools_test {
namespace {

using ninebit::averaged;
using ninebit::Image8;

TEST(Supersample, AveragesToNearestHalvesUp) {
  const Image8 image{4, 2, 1, {0, 1, 255, 255, 1, 0, 255, 254}};
  const Image8 half = averaged(image, 2);
  EXPECT_EQ(half.width, 2);
  EXPECT_EQ(half.height, 1);
  EXPECT_EQ(half.pixels, (std::vector<std::uint8_t>{1, 255})) << "2 / 4 and 1019 / 4, halves up";
  const Image8 colors{2, 2, 3, {0, 10, 20, 4, 10, 21, 0, 10, 20, 4, 10, 21}};
  EXPECT_EQ(averaged(colors, 2).pixels, (std::vector<std::uint8_t>{2, 10, 21}));
}

TEST(Supersample, DrawsMoreSamples) {
  const TempFolder folder;
  const auto answer = [&](const std::string& out, const Words& more) {
    return json_of(ninebit(small_render(kRoom, folder / out, Words{"--json", "--quiet"} + more)));
  };
  const Json four = answer("four", {"--supersample", "4", "--size", "48x36"});
  const Json large = answer("large", {"--size", "192x144"});
  EXPECT_EQ(four["size"], Json::parse("[48, 36]"));
  EXPECT_EQ(four["supersample"], 4);
  EXPECT_EQ(four["hash"], large["hash"]) << "of the samples";
  EXPECT_EQ(four["pixels"], large["pixels"]) << "of the samples";
  const Files small = files_in(folder / "four"), big = files_in(folder / "large");
  EXPECT_NE(small.at("color.png"), big.at("color.png"));
  EXPECT_EQ(small.at("index_cube.png"), big.at("index_cube.png")) << "the map is not of the frame";
}

TEST(Supersample, TheHelpSaysHowWellItIsKnown) {
  const std::string help = ninebit({"help", "render"}).out;
  const std::string flag = help.substr(help.find("--supersample"));
  expect_parts(flag.substr(0, flag.find("--", 2)), {"is assumed"});
}

TEST(Supersample, WrongUsage) {
  const TempFolder folder;
  const std::string out = folder / "out";
  expect_error(ninebit(small_render(kRoom, out, {"--supersample", "3"})), 2, {"--supersample", "3"});
  expect_error(ninebit(small_render(kRoom, out, {"--supersample", "4", "--size", "8192x8"})), 2,
               {"--supersample", "32768", "16384"});
  expect_error(ninebit(small_render(kRoom, out, {"--supersample", "2", "--pick", "1,1"})), 2,
               {"--pick", "--supersample"});
}

}  // namespace
}  // namespace tools_test
