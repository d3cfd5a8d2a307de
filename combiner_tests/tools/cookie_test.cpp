// `ninebit render --technique light-cookie`: cubes of every kind that it reads, and what it refuses.
#include <gtest/gtest.h>

#include <cstdlib>

#include "combiner_tests/support/stored_pictures.h"
#include "combiner_tests/tools/support.h"
#include "ninebit/image/image_io.h"
#include "ninebit/image/texture_io.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/image/texture/texture_file.h"

namespace tools_test {
namespace {

namespace fs = std::filesystem;

const std::string kPlain = NINEBIT_SOURCE_DIR "/scenes/cookies/labels.dds";
const std::string kDxt1 = NINEBIT_SOURCE_DIR "/scenes/cookies/labels_dxt1.dds";
const std::string kModule = NINEBIT_BINARY_DIR "/ninebit_pictures.so";

class Cookie : public testing::Test {
 protected:
  [[nodiscard]] Words arguments(const std::string& cookie, const Words& more = {}) const {
    return small_render(kRoom, folder_ / "out", Words{"--technique", "light-cookie", "--cookie", cookie} + more);
  }
  [[nodiscard]] Json render(const std::string& cookie, Words more = {}) const {
    return json_of(ninebit(arguments(cookie, more + Words{"--json", "--quiet"})));
  }
  void expect_refused(const std::string& cookie, const Words& words) const {
    SCOPED_TRACE(cookie);
    expect_error(ninebit(arguments(cookie)), 3, words);
    EXPECT_FALSE(fs::exists(folder_.path() / "out"));
  }
  // Runs a copy of the program in a folder of its own; gives its exit code and what it said.
  [[nodiscard]] std::pair<int, std::string> run_copy(const std::string& program, const std::string& cookie) const {
    fs::create_directories(fs::path(program).parent_path());
    fs::copy_file(kProgram, program, fs::copy_options::overwrite_existing);
    std::string command = "'" + program + "'";
    for (const std::string& argument : arguments(cookie, {"--quiet"})) command += " '" + argument + "'";
    const int code = std::system((command + " >'" + folder_ / "messages' 2>&1").c_str());
    return {code, read_bytes(folder_ / "messages")};
  }
  // The faces of the labelled cube as pictures of `channels` channels, and the flag's value for them.
  [[nodiscard]] std::string pictures(int channels = 3, const std::string& extension = ".png") const {
    const auto cube = ninebit::image_detail::read_texture(ninebit::profiles::geforce2, kPlain, {}, {});  // a DDS file
    if (!cube) return {};
    std::string all;
    for (std::size_t face = 0; face < 6; ++face) {
      const ninebit::TextureImage& from = cube->faces[face][0];
      ninebit::Image8 image{from.width, from.height, channels, {}};
      for (int y = 0; y < from.height; ++y) {
        for (int x = 0; x < from.width; ++x) {
          for (int c = 0; c < channels; ++c) {
            image.pixels.push_back(std::get<0>(from.planes)[static_cast<std::size_t>(c)].at(x, y));
          }
        }
      }
      const std::string file = folder_ / (std::to_string(face) + extension);
      ninebit::test::write_as(file, image);
      all += (face == 0 ? "" : ",") + file;
    }
    return all;
  }
  // A square or other picture of one grey.
  [[nodiscard]] std::string grey(const std::string& name, int width, int height) const {
    ninebit::Image8 image{width, height, 1, {}};
    image.pixels.assign(static_cast<std::size_t>(width * height), 99);
    const std::string file = folder_ / name;
    EXPECT_TRUE(ninebit::write_png(file, image));
    return file;
  }

  TempFolder folder_;
};

TEST_F(Cookie, DdsFilesAndPicturesGiveTheSameBits) {
  const Json plain = render(kPlain);
  EXPECT_EQ(plain["technique"], "light-cookie");
  EXPECT_EQ(plain["facts"], (Json{{"cookie_size", 64}}));
  EXPECT_EQ(keys_of(plain["hash"]), (Words{"color", "stencil", "index_map"}));
  EXPECT_GT(plain["pixels"]["shadowed"], 0);
  EXPECT_EQ(render(kDxt1)["hash"], plain["hash"]);
  EXPECT_EQ(render(pictures())["hash"], plain["hash"]);
  EXPECT_NE(render(kPlain, {"--light-rotate", "0,90,0"})["hash"]["color"], plain["hash"]["color"]);

  const Json bare = render(kPlain, {"--cookie-shadows", "none"});
  EXPECT_EQ(keys_of(bare["hash"]), (Words{"color", "stencil"}));
  EXPECT_EQ(bare["pixels"]["shadowed"], 0);
}

TEST_F(Cookie, LayersHaveTheLitPass) {
  const Json with = render(kPlain, {"--layers"});
  const std::string layers = read_bytes(folder_ / "out/layers.exr");
  EXPECT_EQ(with["hash"], render(kPlain)["hash"]);
  expect_parts(layers, {"primary", "texture0", "lit_primary", "lit_secondary", "lit_texture0", "lit_spare0",
                        "lit_output", "stencil", "polygon"});
}

// The comparison of polygons decides the shadow. Without shadows the lit pass is traced, which reads the cookie.
TEST_F(Cookie, TraceFollowsTheShadowOrTheLight) {
  const auto trace = [](const Words& more) {
    return json_of(ninebit(Words{"trace", "--scene", kRoom, "--size", "64x48", "--pixel", "32,40", "--json"} + more));
  };
  const Json shadow = trace({"--map-size", "64", "--technique", "light-cookie", "--cookie", kPlain});
  EXPECT_EQ(shadow["scene"]["technique"], "light-cookie");
  EXPECT_EQ(shadow["scene"]["pass"], "comparison");
  EXPECT_EQ(shadow["stages"], trace({"--map-size", "64"})["stages"]) << "as with index-cube";
  const Json light = trace({"--technique", "light-cookie", "--cookie", kPlain, "--cookie-shadows", "none"});
  EXPECT_EQ(light["scene"]["pass"], "lit");
  EXPECT_EQ(light["out"]["bytes"], light["scene"]["passes"][1]["fragments"].back()["color"]);
}

// Only pictures other than plain PNG files need the module; it may lie beside the program or where an installation has
// it.
TEST_F(Cookie, TheModuleIsFoundOrMissed) {
  const std::string lone = folder_ / "lone/bin/ninebit";
  for (const std::string& alone : {kDxt1, pictures()}) {
    const auto rendered = run_copy(lone, alone);
    EXPECT_EQ(rendered.first, 0) << rendered.second;
    fs::remove_all(folder_.path() / "out");
  }

  const std::string files = pictures(3, ".tga");
  const auto missing = run_copy(lone, files);
  EXPECT_NE(missing.first, 0);
  for (const std::string& part : {folder_ / "0.tga", folder_ / "lone/bin/ninebit_pictures.so",
                                  folder_ / "lone/lib/ninebit/ninebit_pictures.so"}) {
    EXPECT_NE(missing.second.find(part), std::string::npos) << part << " is missing in: " << missing.second;
  }
  EXPECT_EQ(std::count(missing.second.begin(), missing.second.end(), '\n'), 1) << missing.second;
  EXPECT_FALSE(fs::exists(folder_.path() / "out"));

  fs::create_directories(folder_ / "lone/lib/ninebit");
  const std::string installed = folder_ / "lone/lib/ninebit/ninebit_pictures.so";
  write_bytes(installed, "not a library");
  const auto broken = run_copy(lone, files);
  EXPECT_NE(broken.first, 0);
  expect_parts(broken.second, {installed + ", which"});

  fs::copy_file(kModule, installed, fs::copy_options::overwrite_existing);
  const auto found = run_copy(lone, files);
  EXPECT_EQ(found.first, 0) << found.second;
}

TEST_F(Cookie, CubesThatCannotBeRead) {
  const std::string cut = write_bytes(folder_ / "cut.dds", read_bytes(kDxt1).substr(0, 9000));
  expect_refused(cut, {cut, "9000 bytes", "12416"});
  std::string bytes = read_bytes(kDxt1);
  bytes[113] = static_cast<char>(0x7E);  // the header's caps2, without the face -Z
  const std::string five = write_bytes(folder_ / "five.dds", bytes);
  expect_refused(five, {five, "without the faces -z"});
  bytes = read_bytes(kDxt1);
  bytes[113] = 0;
  const std::string flat = write_bytes(folder_ / "flat.dds", bytes.substr(0, 128 + 2048));
  expect_refused(flat, {flat, "2D texture", "expected a cube map"});
  expect_refused(folder_ / "missing.dds", {folder_ / "missing.dds", "cannot be opened"});
  expect_refused(folder_.path().string(), {folder_.path().string(), "is a folder"});
  const std::string noise = write_bytes(folder_ / "noise.png", "no picture at all");
  expect_refused(noise, {noise, "not a readable picture"});
}

TEST_F(Cookie, FacesThatDoNotFit) {
  const std::string a = grey("a.png", 16, 16), small = grey("small.png", 8, 8), wide = grey("wide.png", 16, 8),
                    odd = grey("odd.png", 12, 12);
  const auto six = [&](const std::string& last) { return a + "," + a + "," + a + "," + a + "," + a + "," + last; };
  EXPECT_FALSE(render(six(a)).is_null());
  fs::remove_all(folder_.path() / "out");
  expect_refused(six(small), {small, "8 x 8", "16 x 16"});
  expect_refused(six(wide), {wide, "16 x 8", "square"});
  expect_refused(six(odd), {odd, "12 x 12", "power of two"});
  expect_refused(six(kPlain), {kPlain, "is a cube map itself"});
  expect_refused(six(folder_ / "none.png"), {folder_ / "none.png", "cannot be opened"});
  expect_refused(a, {a, "2D texture", "expected a cube map"});
}

TEST_F(Cookie, WrongUsage) {
  const auto expect_usage = [&](const Words& flags, const Words& words) {
    SCOPED_TRACE(testing::PrintToString(flags));
    expect_error(ninebit(small_render(kRoom, folder_ / "out", flags)), 2, words);
  };
  expect_usage({"--technique", "light-cookie"}, {"--technique light-cookie requires --cookie"});
  expect_usage({"--technique", "light-cookie", "--cookie", "a,b,c,d,e"}, {"--cookie", "5 files", "+X,-X,+Y"});
  expect_usage({"--technique", "light-cookie", "--cookie", "a,b,c,d,e,"}, {"6 files", "empty"});
  expect_usage({"--technique", "light-cookie", "--cookie", ""}, {"--cookie", "empty"});
  expect_usage({"--technique", "light-cookie", "--cookie", kPlain, "--light-rotate", "1,2"}, {"--light-rotate"});
}

}  // namespace
}  // namespace tools_test
