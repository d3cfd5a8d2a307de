// Scenes that cannot be rendered: exit code 3 and one line that names the file; nothing is written.
#include <gtest/gtest.h>

#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

class InputError : public testing::Test {
 protected:
  void expect_refused(const std::string& scene, const Words& words, const Words& flags = {}) const {
    SCOPED_TRACE(scene + ' ' + testing::PrintToString(flags));
    expect_error(ninebit(small_render(scene, folder_ / "out/deep", flags)), 3, words + Words{scene});
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out"));
  }
  [[nodiscard]] std::string make(const std::string& name, std::string_view bytes) const {
    return write_bytes(folder_.path() / name, bytes);
  }

  TempFolder folder_;
};

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST_F(InputError, NoSceneFile) {
  expect_refused(folder_ / "missing.gltf", {"there is no such file"});
  expect_refused(folder_ / "no/folder/a.obj", {"there is no such file"});
  expect_refused(folder_.path().string(), {"is a folder"});
  for (const char* name : {"a.gltf", "a.glb", "a.obj", "a.ply", "a.off", "a.3ds"}) {
    expect_refused(make(name, ""), {"is empty"});
  }
  expect_refused(make("a.txt", "hello"), {"'.txt'", ".gltf, .glb, .obj, .ply, .off, .3ds, .stl, .dae and .fbx"});
  expect_refused(make("scene", "hello"), {"no extension"});
  expect_refused("/dev/null", {"not a regular file"});
}

// Real files, cut. An OBJ file that is cut between two lines is a good, shorter one: nothing in it says how long it is.
TEST_F(InputError, TruncatedFiles) {
  for (const auto& [name, source] : {std::pair{"cut.glb", kEngine}, {"cut.gltf", kRoom}, {"cut.obj", kBunny}}) {
    const std::string whole = read_bytes(source);
    for (const double share : {0.0, 0.0001, 0.3, 0.8, 1.0}) {
      auto length = static_cast<std::size_t>(share * static_cast<double>(whole.size() - 9)) + 2;
      if (source == kBunny) length = whole.rfind('\n', length) + 1 + std::string_view("f 12").size() - 1;
      if (source == kBunny && share == 0.0) length = 3;
      expect_refused(make(name, std::string_view(whole).substr(0, length)), {});
    }
  }
}

// Others of each kind: combiner_tests/scene/bad_input_test.cpp.
TEST_F(InputError, SenselessGeometry) {
  expect_refused(make("points.obj", kTriangle), {"no triangles"});
  expect_refused(make("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"), {"nan.obj:2", "not finite"});
  expect_refused(make("index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), {"out of range"});
  expect_refused(make("huge.obj", "v -3e38 0 0\nv 3e38 0 0\nv 0 3e38 0\nf 1 2 3\n"), {"too large"});
}

TEST_F(InputError, CameraAndLight) {
  expect_refused(kRoom, {"camera", "at the light"}, {"--camera", "1,2,3", "--light", "1,2,3"});
  expect_refused(kRoom, {"camera", "the point that it looks at"}, {"--camera", "1,2,3", "--look-at", "1,2,3"});
  expect_refused(kBunny, {"light", "(0, 0, 0)", "inside a solid", "the camera is not"}, {"--light", "0,0,0"});
}

// Counts and remedies of all formats and scopes: combiner_tests/shadow/index_codes_test.cpp.
TEST_F(InputError, TooManyPolygonsSaysWhatWouldDo) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  // 69,668 polygons with the floor. Step 6 has 43 codes a channel, 79,507 in all.
  expect_refused(
      kBunny,
      {"too many polygons", "69668", "69669 codes", "step 16 has 4096", "index step 6 would do (79507", "scope object"},
      {"--index-step", "16"});
  for (const Words& remedy :
       std::vector<Words>{{"--index-step", "6"}, {"--index-step", "16", "--index-scope", "object"}}) {
    EXPECT_EQ(err_of(ninebit(small_render(kBunny, folder_ / "done", remedy + Words{"--quiet"}))), "");
  }
}

// A polygon more than there are codes, and just as many as there are: 16^3 with step 16, one of them the cleared map's.
TEST_F(InputError, TheLastCodeIsUsable) {
  std::string strip = "v 0 0 0\n";
  for (int i = 0; i < 4096; ++i) strip += "v 1 " + std::to_string(i) + " 0\n";
  for (int i = 0; i < 4095; ++i) strip += "f 1 " + std::to_string(i + 2) + ' ' + std::to_string(i + 3) + '\n';
  const std::string scene = make("fan.obj", strip);
  const Json answer =
      json_of(ninebit(small_render(scene, folder_ / "done", {"--floor", "none", "--index-step", "16", "--json"})));
  EXPECT_EQ(answer["index"]["used"], 4095);
  EXPECT_EQ(answer["index"]["capacity"], 4096);
  expect_refused(make("more.obj", strip + "f 1 2 3\n"), {"4096 of them", "index step 15 would do"},
                 {"--floor", "none", "--index-step", "16"});
}

// Odd and harmless, as the documentation says: degenerate triangles cover no pixel, a light in a triangle's plane sees
// that triangle nowhere.
TEST_F(InputError, HarmlessScenes) {
  const std::string good = make("good.obj", kTriangle + "f 1 2 3\n");
  const std::string with = make("with.obj", kTriangle + "f 1 2 3\nf 1 1 2\nf 2 2 2\n");
  const auto render = [&](const std::string& scene, Words flags) {
    flags.emplace_back("--json");
    return json_of(ninebit(small_render(scene, folder_ / "done", flags)));
  };
  const Json plain = render(good, {}), more = render(with, {});
  EXPECT_EQ(more["triangles"].get<int>(), plain["triangles"].get<int>() + 2);
  EXPECT_EQ(more["pixels"], plain["pixels"]);
  EXPECT_EQ(more["hash"]["color"], plain["hash"]["color"]);
  EXPECT_EQ(render(make("only.obj", kTriangle + "f 1 1 1\n"), {"--floor", "none"})["pixels"]["background"], 48 * 36);

  const Words front{"--floor", "none", "--camera", "0.3,0.3,2", "--look-at", "0.3,0.3,0"};
  for (const char* light : {"5,5,0", "0.2,0.2,0", "0,0,0", "0.5,0,0"}) {
    SCOPED_TRACE(light);
    const Json answer = render(good, front + Words{"--light", light});
    EXPECT_GT(answer["pixels"]["lit"].get<int>() + answer["pixels"]["shadowed"].get<int>(), 0);
  }
}

}  // namespace
}  // namespace tools_test
