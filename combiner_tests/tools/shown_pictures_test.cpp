// Pictures that pages show: what stands beside them is true of them.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/support/stored_pictures.h"
#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

const std::string kTree = NINEBIT_SOURCE_DIR;

TEST(ShownPictures, TheDemoNamesTheProfileOfEachPicture) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const TempFolder folder, tools;
  write_bytes(tools / "dpkg", "#!/bin/sh\nexit 1\n");  // no model is installed
  std::filesystem::permissions(tools / "dpkg", std::filesystem::perms::owner_all);
  // The page says the same of smaller pictures.
  write_bytes(tools / "ninebit", "#!/usr/bin/env bash\nwords=(\"${@/#[48]00x[36]00/80x60}\")\nexec '" + kProgram +
                                     "' \"${words[@]/#1024/64}\"\n");
  std::filesystem::permissions(tools / "ninebit", std::filesystem::perms::owner_all);
  const std::string demo = "cd '" + kTree + "' && PATH='" + tools.path().string() + "':\"$PATH\" scenes/demo '" +
                           (tools / "ninebit") + "' '" + folder.path().string() + "' >'" + tools / "log" + "' 2>&1";
  ASSERT_EQ(std::system(demo.c_str()), 0) << read_bytes(tools / "log");
  const std::string page = read_bytes(folder / "index.html"), begin = "<figure>", effects = "\"effects/";
  int figures = 0;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1), ++figures) {
    const std::string figure = page.substr(at, page.find("</figure>", at) - at);
    std::string profile = "geforce2";
    if (const std::size_t name = figure.find(effects); name != std::string::npos) {
      const std::size_t first = name + effects.size();
      const std::string effect = figure.substr(first, figure.find('.', first) - first);
      profile = Json::parse(read_bytes(kTree + "/scenes/effects/" + effect + ".json")).value("profile", profile);
    }
    expect_parts(figure, {"Profile " + profile + "."});
  }
  EXPECT_EQ(figures, 5);
}

// Reflected light makes the box brighter, and the difference is the darkest of the three.
TEST(ShownPictures, TheCornellBoxIsShownWithReflectedLightFirst) {
  const auto image = ninebit::test::read_png(kTree + "/docs/images/reflective_on_off.png");
  std::array<long, 3> light{};
  const std::size_t row = image.pixels.size() / static_cast<std::size_t>(image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) light[i % row * 3 / row] += image.pixels[i];
  EXPECT_GT(light[0], light[1]);
  EXPECT_GT(light[1], light[2]);
  const std::string text = read_bytes(kTree + "/README.md");
  expect_parts(text, {"The Cornell box with reflected light, without it, and the difference",
                      "gather the light of other surfaces: with it,\nwithout it, and the difference"});
}

}  // namespace
}  // namespace tools_test
