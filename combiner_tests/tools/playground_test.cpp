// The playground's engine answers what the program prints.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "combiner_tests/support/stored_pictures.h"
#include "combiner_tests/tools/support.h"
#include "src/playground/engine.h"

namespace tools_test {
namespace {

using ninebit::playground::Engine;

const std::string kGallery = NINEBIT_SOURCE_DIR "/scenes/effects/";

Json asked(Engine& engine, const Json& request) {
  return Json::parse(engine.answer(request.dump()));
}

// Puts a picture file as a page does: four components, rows from the top.
void put_picture(Engine& engine, const std::string& name) {
  const ninebit::Image8 image = ninebit::test::read_png(kGallery + name);
  const auto channels = static_cast<std::size_t>(image.channels);
  const auto count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const auto buffer = engine.buffer(4 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* const pixel = image.pixels.data() + i * channels;
    for (std::size_t c = 0; c < 3; ++c) buffer[4 * i + c] = pixel[channels < 3 ? 0 : c];
    buffer[4 * i + 3] = channels % 2 == 0 ? pixel[channels - 1] : 255;
  }
  const Json answer = asked(
      engine, {{"do", "put"}, {"name", name}, {"kind", "pixels"}, {"width", image.width}, {"height", image.height}});
  ASSERT_EQ(answer.value("ok", false), true) << answer;
}

// Puts an effect's pictures and gives the request that draws it.
Json request_of(Engine& engine, const std::string& file) {
  const std::string text = read_bytes(kGallery + file);
  const Json effect = Json::parse(text);
  Json files = Json::object();
  for (const Json& pass : effect["passes"]) {
    if (pass.contains("program")) files[pass["program"]] = read_bytes(kGallery + pass["program"].get<std::string>());
  }
  for (const Json& texture : effect.value("textures", Json::object())) {
    std::string source = texture["source"];
    if (const std::size_t colon = source.find(':'); colon != std::string::npos) source.erase(0, colon + 1);
    if (!source.ends_with(".png")) continue;
    for (std::size_t at = 0; at < source.size();) {
      const std::size_t end = std::min(source.find(',', at), source.size());
      put_picture(engine, source.substr(at, end - at));
      at = end + 1;
    }
  }
  return {{"do", "draw"}, {"effect", text}, {"files", files}, {"name", kGallery + file}};
}

TEST(PlaygroundAnswers, TheGalleryIsToTheBit) {
  const Json expected = Json::parse(read_bytes(kGallery + "expected_hashes.json"));
  for (const auto& [name, hash] : expected.items()) {
    Engine engine;
    const Json drawn = asked(engine, request_of(engine, name + ".json"));
    ASSERT_FALSE(drawn.contains("fault")) << name << ": " << drawn;
    EXPECT_EQ(drawn["hash"]["color"], hash) << name;
    EXPECT_TRUE(drawn["warnings"].empty()) << name << ": " << drawn["warnings"];
  }
}

TEST(PlaygroundAnswers, APixelsTraceIsTheProgramsOwn) {
  for (const char* const name : {"dot3_specular.json", "index_cube.json", "depth_balls.json", "clip_planes.json"}) {
    Engine engine;
    asked(engine, request_of(engine, name));
    for (const auto& [x, y] : std::vector<std::pair<int, int>>{{128, 80}, {0, 0}}) {
      const Json answer = asked(engine, {{"do", "pixel"}, {"x", x}, {"y", y}});
      const std::string pixel = std::to_string(x) + "," + std::to_string(y);
      EXPECT_EQ(answer, json_of(ninebit({"trace", "--effect", kGallery + name, "--pixel", pixel, "--json"}))) << pixel;
    }
  }
}

TEST(PlaygroundAnswers, ATraceIsTheProgramsOwn) {
  const std::string file = kGallery + "programs/dot3_specular.rc1";
  Engine engine;
  const Json answer = asked(engine, {{"do", "trace"},
                                     {"text", read_bytes(file)},
                                     {"name", file},
                                     {"profile", "nv2a"},
                                     {"registers", {{"tex0", {200, 100, 250, 12}}, {"const1", {1, 2, 3, 4}}}}});
  EXPECT_EQ(answer, json_of(ninebit({"trace", file, "--profile", "nv2a", "--set", "tex0=200,100,250,12", "--set",
                                     "const1=1,2,3,4", "--json"})));
  const Json plain = asked(engine, {{"do", "trace"}, {"text", read_bytes(file)}, {"name", file}, {"profile", "nv2a"}});
  EXPECT_EQ(plain, json_of(ninebit({"trace", file, "--profile", "nv2a", "--json"})));
}

TEST(PlaygroundAnswers, TheRoomsShadowsAreTheProgramsOwn) {
  Engine engine;
  const Json answer = asked(engine, {{"do", "shadow"}, {"size", {320, 240}}, {"map_size", 256}});
  ASSERT_FALSE(answer.contains("fault")) << answer;
  const Json expected = Json::parse(read_bytes(NINEBIT_SOURCE_DIR "/scenes/expected_hashes.json"));
  const Json& room = expected["index_room.gltf"]["--size 320x240 --map-size 256"];
  EXPECT_EQ(answer["hash"]["color"], room["color"]);
  EXPECT_EQ(answer["hash"]["stencil"], room["stencil"]);
  EXPECT_EQ(engine.bytes().size(), answer["bytes"]);
}

}  // namespace
}  // namespace tools_test
