// --turntable: pictures from all around.
#include <gtest/gtest.h>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

TEST(Turntable, FrameZeroIsTheOrdinaryPicture) {
  const TempFolder folder;
  const Json turned =
      json_of(ninebit(small_render(kCornell, folder / "turn", {"--turntable", "4", "--json", "--quiet"})));
  const Json plain = json_of(ninebit(small_render(kCornell, folder / "plain", {"--json", "--quiet"})));
  const Files frames = files_in(folder / "turn");
  ASSERT_EQ(frames.size(), 5U) << "four pictures and the manifest";
  EXPECT_EQ(frames.at("color_000.png"), files_in(folder / "plain").at("color.png"));
  EXPECT_EQ(turned["frames"][0]["color"], plain["hash"]["color"]);
  EXPECT_EQ(turned["frames"].size(), 4U);
  EXPECT_EQ(turned["frames"][3]["file"], "color_003.png");
  for (int i = 1; i < 4; ++i) {
    EXPECT_NE(turned["frames"][static_cast<std::size_t>(i)]["color"], turned["frames"][0]["color"]) << i;
  }
}

// Half a turn of two frames is the second of four.
TEST(Turntable, AnglesAreEqual) {
  const TempFolder folder;
  const auto frames = [&](const char* count) {
    return json_of(ninebit(small_render(kRoom, folder / count, {"--turntable", count, "--json", "--quiet"})))["frames"];
  };
  EXPECT_EQ(frames("2")[1]["color"], frames("4")[2]["color"]);
}

TEST(Turntable, WrongUsage) {
  const TempFolder folder;
  const std::string out = folder / "out";
  expect_error(ninebit(small_render(kRoom, out, {"--turntable", "1"})), 2, {"--turntable", "1"});
  for (const char* flag : {"--ground-truth", "--layers", "--check-order"}) {
    expect_error(ninebit(small_render(kRoom, out, {"--turntable", "3", flag})), 2, {"--turntable", flag});
  }
}

}  // namespace
}  // namespace tools_test
