// The files of `ninebit render`: --only, the manifest, and what an earlier run left.
#include <gtest/gtest.h>

#include <filesystem>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

Words names_in(const TempFolder& folder) {
  Words names;
  for (const auto& [name, bytes] : files_in(folder / "out")) names.push_back(name);
  return names;
}

TEST(RenderFiles, OnlyWritesWhatIsNamed) {
  const TempFolder folder;
  const std::string out = folder / "out";
  EXPECT_EQ(ninebit(small_render(kRoom, out, {"--only", "color,index_cube", "--quiet"})).code, 0);
  EXPECT_EQ(names_in(folder), (Words{"color.png", "index_cube.exr", "index_cube.png", "render.json"}));
  const Json manifest = Json::parse(read_bytes(out + "/render.json"));
  EXPECT_EQ(manifest["ninebit"], "render");
  EXPECT_EQ(manifest["files"], Json::parse(R"(["color.png", "index_cube.png", "index_cube.exr"])"));
  for (const char* wrong : {"colour", "color,", "", "error", "color.png"}) {
    const TempFolder other;
    const Outcome outcome = ninebit(small_render(kRoom, other / "out", {std::string("--only=") + wrong}));
    EXPECT_EQ(outcome.code, 2) << wrong << ": " << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(other / "out")) << wrong;
  }
}

TEST(RenderFiles, OfAnEarlierRunAreRemoved) {
  const TempFolder folder;
  const std::string out = folder / "out";
  EXPECT_EQ(ninebit(small_render(kRoom, out, {"--ground-truth", "--layers", "--quiet"})).code, 0);
  EXPECT_TRUE(std::filesystem::exists(out + "/error.png"));
  EXPECT_TRUE(std::filesystem::exists(out + "/layers.exr"));
  write_bytes(out + "/mine.png", "mine");
  expect_parts(err_of(ninebit(small_render(kRoom, out))), {"removed " + out + "/error.png"});
  EXPECT_FALSE(std::filesystem::exists(out + "/error.png"));
  EXPECT_FALSE(std::filesystem::exists(out + "/layers.exr"));
  EXPECT_EQ(read_bytes(out + "/mine.png"), "mine") << "not a file of a run";
  EXPECT_TRUE(std::filesystem::exists(out + "/color.png"));
}

// A manifest that names something else than files of its folder removes nothing.
TEST(RenderFiles, AForeignManifestRemovesNothing) {
  const TempFolder folder;
  const std::string out = folder / "out";
  std::filesystem::create_directory(out);
  std::filesystem::create_directory(out + "/deep");
  write_bytes(folder / "outside.png", "outside");
  write_bytes(out + "/deep/inside.png", "inside");
  write_bytes(out + "/stays.png", "stays");
  for (const char* manifest :
       {R"({"ninebit": "render", "version": 1, "files": ["../outside.png", "stays.png"]})",
        R"({"ninebit": "render", "version": 1, "files": ["deep/inside.png", "stays.png"]})",
        R"({"ninebit": "study", "version": 1, "files": ["stays.png"]})",
        R"({"ninebit": "render", "version": 1, "files": "stays.png"})", R"(["stays.png"])", "{", ""}) {
    write_bytes(out + "/render.json", manifest);
    EXPECT_EQ(ninebit(small_render(kRoom, out, {"--quiet"})).code, 0);
    EXPECT_EQ(read_bytes(folder / "outside.png"), "outside") << manifest;
    EXPECT_EQ(read_bytes(out + "/deep/inside.png"), "inside") << manifest;
    EXPECT_EQ(read_bytes(out + "/stays.png"), "stays") << manifest;
  }
  write_bytes(out + "/render.json", R"({"ninebit": "render", "version": 1, "files": ["deep", "link.png"]})");
  std::filesystem::create_symlink(out + "/stays.png", out + "/link.png");
  EXPECT_EQ(ninebit(small_render(kRoom, out, {"--quiet"})).code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(out + "/link.png"));
  EXPECT_TRUE(std::filesystem::is_directory(out + "/deep"));
}

// A run that fails keeps the files of the earlier one.
TEST(RenderFiles, AFailedRunRemovesNothing) {
  const TempFolder folder;
  const std::string out = folder / "out";
  EXPECT_EQ(ninebit(small_render(kRoom, out, {"--ground-truth", "--quiet"})).code, 0);
  const Files before = files_in(out);
  EXPECT_EQ(ninebit(small_render(kRoom, out, {"--only", "nothing"})).code, 2);
  EXPECT_EQ(files_in(out), before);
}

}  // namespace
}  // namespace tools_test
