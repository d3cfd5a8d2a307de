// The engine's drawings.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "combiner_tests/playground/support.h"
#include "src/playground/plane_hash.h"
#include "src/system/hashing/openssl.h"

namespace ninebit::test {
namespace {

// The red plane and so on, the lowest row first, of the answer's picture.
std::string hash_of_bytes(std::span<const std::uint8_t> rgba, std::size_t width) {
  const std::size_t height = rgba.size() / 4 / width;
  Sha256 hash;
  for (std::size_t c = 0; c < 4; ++c) {
    std::vector<std::uint8_t> plane;
    for (std::size_t y = height; y-- > 0;) {
      for (std::size_t x = 0; x < width; ++x) plane.push_back(rgba[4 * (y * width + x) + c]);
    }
    hash.add(plane);
  }
  return hash.finish();
}

TEST(PlaneHash, IsSha256) {
  std::vector<std::uint8_t> bytes;
  for (int size = 0; size < 300; ++size) {
    playground::PlaneHash hash;
    const std::span<const std::uint8_t> all(bytes);
    const std::size_t cut = bytes.size() / 3;
    hash.add(all.first(cut));
    hash.add(all.subspan(cut));
    Sha256 expected;
    expected.add(bytes);
    ASSERT_EQ(hash.finish(), expected.finish()) << size << " bytes";
    bytes.push_back(static_cast<std::uint8_t>(size * 7 + 1));
  }
}

TEST(PlaygroundDraw, GivesThePictureFromTheTop) {
  Engine engine;
  const PageJson answer = good(engine, draw_request());
  EXPECT_EQ(answer["width"], 32);
  EXPECT_EQ(answer["height"], 16);
  EXPECT_EQ(answer["profile"], "geforce2");
  ASSERT_EQ(answer["bytes"], 32 * 16 * 4);
  const auto bytes = engine.bytes();
  ASSERT_EQ(bytes.size(), 32U * 16 * 4);
  EXPECT_EQ(answer["hash"]["color"], hash_of_bytes(bytes, 32));
  // The square at (0, 0) is white, and the texture's first row is at the top: the primary colour's own bytes.
  EXPECT_EQ((std::vector<int>{bytes[0], bytes[1], bytes[2]}), (std::vector<int>{255, 128, 64}));
}

// As a file that was put, the room that the engine gives draws what its own does.
TEST(PlaygroundDraw, GivesTheRoomOfTheGallery) {
  Engine engine;
  PageJson request = draw_request();
  request["files"]["mine.gl"] = "!!RC1.0\nout.rgb = col0;\nout.a = unsigned_invert(zero);\n";
  request["effect"]["scene"] = {{"mesh", "index_room.gltf"}};
  request["effect"]["passes"][0]["units"] = PageJson::array();
  request["effect"]["passes"][0]["primary"] = "lambert";
  const PageJson expected = good(engine, request);
  const PageJson room = ask(engine, {{"do", "room"}});
  EXPECT_EQ(room["name"], "index_room.gltf");
  ASSERT_EQ(room["bytes"], engine.bytes().size());
  const std::vector<std::uint8_t> content(engine.bytes().begin(), engine.bytes().end());
  put_file(engine, "mine.gltf", content);
  request["effect"]["scene"]["mesh"] = "mine.gltf";
  EXPECT_EQ(ask(engine, request)["hash"], expected["hash"]);
  request["effect"]["scene"]["mesh"] = "torus:8";
  EXPECT_NE(ask(engine, request)["hash"], expected["hash"]);
}

TEST(PlaygroundDraw, SaysWhereTheCameraIs) {
  Engine engine;
  PageJson request = draw_request();
  EXPECT_EQ(ask(engine, request)["view"]["position"], (PageJson{0.0, 0.0, 3.0}));
  request["effect"]["scene"] = {{"mesh", "sphere:8"}};
  const PageJson framed = ask(engine, request)["view"];
  EXPECT_NE(framed["position"], (PageJson{0.0, 0.0, 3.0}));
  request["effect"]["scene"]["camera"] = framed["position"];
  request["effect"]["scene"]["look_at"] = framed["target"];
  EXPECT_EQ(ask(engine, request)["view"]["position"], framed["position"]);
}

TEST(PlaygroundDraw, KeepsTexturesAndDrawsWhatANewEngineDraws) {
  const auto put = [](Engine& engine, std::uint8_t level) {
    const auto buffer = engine.buffer(3 * 2 * 4);
    for (std::size_t i = 0; i < buffer.size(); ++i) buffer[i] = static_cast<std::uint8_t>(level + 7 * i);
    ask(engine, {{"do", "put"}, {"name", "a.png"}, {"kind", "pixels"}, {"width", 3}, {"height", 2}});
  };
  PageJson request = draw_request();
  std::vector<PageJson> requests;
  const auto with = [&](const char* source, const char* filter) {
    request["effect"]["textures"]["squares"] = {{"source", source}, {"filter", filter}};
    requests.push_back(request);
  };
  with("a.png", "nearest");
  with("a.png", "trilinear");
  with("normals:a.png", "trilinear");
  request["effect"]["textures"]["squares"]["steepness"] = 1;
  requests.push_back(request);
  with("checker:8", "nearest");
  with("checker:16", "nearest");
  with("normalize-cube:16", "linear");
  request["effect"]["textures"]["other"] = request["effect"]["textures"]["squares"];
  requests.push_back(request);
  request["profile"] = "nv2a";
  requests.push_back(request);
  Engine kept;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    for (const std::uint8_t level : {std::uint8_t{1}, std::uint8_t{90}}) {
      Engine fresh;
      put(fresh, level);
      put(kept, level);
      const PageJson expected = good(fresh, requests[i]);
      // The second time, all textures are kept: the warning about a picture's sides is, too.
      EXPECT_EQ(ask(kept, requests[i]), expected) << i;
      EXPECT_EQ(ask(kept, requests[i]), expected) << i;
    }
    // Without a put in between, the textures of the request before are there.
    Engine fresh;
    put(fresh, 90);
    const PageJson& next = requests[(i + 1) % requests.size()];
    EXPECT_EQ(ask(kept, next), ask(fresh, next)) << i;
  }
}

TEST(PlaygroundDraw, TakesPicturesThatWerePut) {
  Engine engine;
  PageJson request = draw_request();
  request["effect"]["textures"]["squares"]["source"] = "my picture.png";
  EXPECT_NE(fault_of_answer(ask(engine, request)).find("is no picture that was put"), std::string::npos);
  const auto buffer = engine.buffer(3 * 2 * 4);
  std::fill(buffer.begin(), buffer.end(), std::uint8_t{255});
  const PageJson put{{"do", "put"}, {"name", "my picture.png"}, {"kind", "pixels"}, {"width", 3}, {"height", 2}};
  good(engine, put);
  const PageJson answer = good(engine, request);
  ASSERT_EQ(answer["warnings"].size(), 1U);
  EXPECT_NE(answer["warnings"][0].get<std::string>().find("3 x 2 is resampled"), std::string::npos);
  EXPECT_EQ(engine.bytes()[1], 128);
  // The buffer was taken.
  EXPECT_NE(fault_of_answer(ask(engine, put)).find("the buffer has 0 bytes"), std::string::npos);
}

TEST(PlaygroundDraw, TakesTheProfileOfTheEffectUnlessOneIsGiven) {
  PageJson request = draw_request();
  request["effect"]["profile"] = "nv2a";
  EXPECT_EQ(ask(request)["profile"], "nv2a");
  request["profile"] = "geforce256-8bit";
  EXPECT_EQ(ask(request)["profile"], "geforce256-8bit");
  request["profile"] = "nv2a";
  const PageJson given = ask(request);
  request.erase("profile");
  EXPECT_EQ(ask(request)["hash"], given["hash"]);
}

// The texel's alpha is the program's.
PageJson alpha_request() {
  PageJson request = draw_request();
  request["effect"]["passes"][0]["program"] = "alpha.rc1";
  request["files"] = {{"alpha.rc1", "!!RC1.0\nout.rgb = zero;\nout.a = tex0.a;\n"}};
  return request;
}

TEST(PlaygroundDraw, OnePixelMakesAPictureTransparent) {
  Engine engine;
  PageJson request = alpha_request();
  request["effect"]["textures"]["squares"]["source"] = "glass.png";
  const auto buffer = engine.buffer(2 * 2 * 4);
  std::fill(buffer.begin(), buffer.end(), std::uint8_t{255});
  buffer[3] = 128;
  ask(engine, {{"do", "put"}, {"name", "glass.png"}, {"kind", "pixels"}, {"width", 2}, {"height", 2}});
  good(engine, request);
  EXPECT_EQ(engine.bytes()[3], 128);
}

TEST(PlaygroundPut, ANameStandsForWhatWasPutLast) {
  Engine engine;
  const PageJson file{{"do", "put"}, {"name", "a"}, {"kind", "file"}};
  const PageJson pixels{{"do", "put"}, {"name", "a"}, {"kind", "pixels"}, {"width", 2}, {"height", 2}};
  PageJson request = draw_request();
  request["effect"]["textures"]["squares"]["source"] = "a.png";
  const PageJson scene{{"do", "shadow"}, {"scene", "a"}, {"size", {8, 8}}};
  const auto put = [&](const PageJson& what) {
    const auto buffer = engine.buffer(2 * 2 * 4);
    std::fill(buffer.begin(), buffer.end(), std::uint8_t{7});
    good(engine, what);
  };
  put(file);
  EXPECT_EQ(fault_of_answer(ask(engine, scene)).find("is no file that was put"), std::string::npos);
  put(pixels);
  EXPECT_NE(fault_of_answer(ask(engine, scene)).find("is no file that was put"), std::string::npos);
  EXPECT_EQ(ask(engine, pixels)["fault"]["message"], "the buffer has 0 bytes; these pixels have 16");
}

TEST(PlaygroundDraw, CountsFacesAndWholeTextures) {
  PageJson cube = draw_request();
  cube["effect"]["targets"]["faces"] = {{"size", 2048}, {"cube", true}};
  cube["effect"]["passes"].insert(cube["effect"]["passes"].begin(), cube["effect"]["passes"][0]);
  cube["effect"]["passes"][0]["name"] = "faces";
  cube["effect"]["passes"][0]["target"] = "faces";
  cube["effect"]["passes"][0]["draw"] = "mesh";
  cube["effect"]["scene"]["mesh"] = "cube";
  const std::string pixels = std::to_string(6 * 2048 * 2048 + 32 * 16);
  EXPECT_NE(fault_of_answer(ask(cube)).find("have " + pixels + " pixels"), std::string::npos) << ask(cube);
  // Sides are resampled to powers of two: 4,096 texels for 2,049.
  Engine engine;
  ASSERT_EQ(engine.buffer(std::size_t{2049} * 4096 * 4).size(), std::size_t{2049} * 4096 * 4);
  ask(engine, {{"do", "put"}, {"name", "large.png"}, {"kind", "pixels"}, {"width", 2049}, {"height", 4096}});
  PageJson request = draw_request();
  for (const char* name : {"a", "b", "squares"}) request["effect"]["textures"][name] = {{"source", "large.png"}};
  EXPECT_NE(fault_of_answer(ask(engine, request)).find("have 50331648 texels"), std::string::npos);
}

TEST(PlaygroundDraw, RectanglesKeepTheirSides) {
  Engine engine;
  ASSERT_EQ(engine.buffer(std::size_t{3} * 5 * 4).size(), std::size_t{60});
  ask(engine, {{"do", "put"}, {"name", "odd.png"}, {"kind", "pixels"}, {"width", 3}, {"height", 5}});
  const auto warnings = [&](const char* source) {
    PageJson request = draw_request();
    request["effect"]["textures"]["squares"] = {{"source", source}};
    const PageJson answer = ask(engine, request);
    EXPECT_EQ(fault_of_answer(answer), "");
    return answer["warnings"].dump();
  };
  EXPECT_NE(warnings("odd.png").find("3 x 5 is resampled"), std::string::npos);
  EXPECT_EQ(warnings("rectangle:odd.png").find("resampled"), std::string::npos);
  const PageJson words = ask({{"do", "about"}})["file_origins"];
  EXPECT_NE(std::find(words.begin(), words.end(), "rectangle"), words.end());
}

TEST(PlaygroundDraw, NamesThePlaceOfAFaultInAProgram) {
  PageJson request = draw_request();
  request["files"]["mine.gl"] = "glEnable(GL_REGISTER_COMBINERS_NV);\nglNothing();\n";
  const PageJson fault = ask(request)["fault"];
  EXPECT_EQ(fault["file"], "mine.gl");
  EXPECT_EQ(fault["line"], 2);
  EXPECT_EQ(fault["column"], 1);
  PageJson effect = draw_request();
  effect["effect"] = "{\n  \"ninebit\": \"effect\", \"version\": 1,\n  \"passes\": [{\"colour\": 1}]\n}";
  const PageJson key = ask(effect)["fault"];
  EXPECT_EQ(key["file"], "effect");
  EXPECT_EQ(key["line"], 3);
  EXPECT_NE(key["message"].get<std::string>().find("unknown key \"colour\""), std::string::npos) << key;
}

TEST(PlaygroundPixel, TracesTheLastDrawing) {
  Engine engine;
  EXPECT_EQ(fault_of_answer(ask(engine, {{"do", "pixel"}, {"x", 0}, {"y", 0}})), "nothing was drawn yet");
  ask(engine, draw_request());
  const PageJson answer = good(engine, {{"do", "pixel"}, {"x", 1}, {"y", 0}});
  EXPECT_EQ(answer["effect"]["pixel"], PageJson({1, 0}));
  EXPECT_EQ(answer["effect"]["state"], "drawn");
  EXPECT_EQ(answer["effect"]["passes"][0]["fragments"][0]["color"], PageJson({255, 128, 64, 255}));
  EXPECT_NE(fault_of_answer(ask(engine, {{"do", "pixel"}, {"x", 32}, {"y", 0}})), "");
}

TEST(PlaygroundCompare, CountsThePixelsThatDiffer) {
  Engine engine;
  PageJson request = draw_request();
  request["do"] = "compare";
  request["profiles"] = {"geforce2", "geforce256-8bit"};
  const PageJson answer = good(engine, request);
  ASSERT_EQ(engine.bytes().size(), 3U * 32 * 16 * 4);
  EXPECT_EQ(answer["bytes"], engine.bytes().size());
  std::size_t differ = 0;
  int most = 0;
  const auto bytes = engine.bytes();
  for (std::size_t i = 0; i < 32 * 16; ++i) {
    int largest = 0;
    for (std::size_t c = 0; c < 4; ++c)
      largest = std::max(largest, std::abs(bytes[4 * i + c] - bytes[2048 + 4 * i + c]));
    differ += largest > 0 ? 1U : 0U;
    most = std::max(most, largest);
    ASSERT_EQ(bytes[4096 + 4 * i], std::min(16 * largest, 255));
  }
  EXPECT_GT(differ, 0U);
  EXPECT_EQ(answer["difference"]["pixels"], differ);
  EXPECT_EQ(answer["difference"]["max"], most);
  request["profiles"] = {"geforce2", "geforce2"};
  EXPECT_EQ(ask(engine, request)["difference"]["pixels"], 0);
}

TEST(PlaygroundCompare, AlphaCounts) {
  PageJson request = alpha_request();
  request["do"] = "compare";
  request["effect"]["passes"][0].erase("units");
  request["profiles"] =
      PageJson::array({"geforce2", {{"base", "geforce2"}, {"name", "mine"}, {"disabled_texture_alpha", 15}}});
  EXPECT_EQ(ask(request)["difference"], PageJson::parse(R"({"pixels": 512, "max": 240})"));
}

// The first profile may be one's own; the word stands for it with exact combiners, and only as the second.
TEST(PlaygroundCompare, ArithmeticIsTheFirstProfileWithExactCombiners) {
  Engine engine;
  PageJson request = draw_request();
  request["do"] = "compare";
  request["profiles"] = {"geforce256-8bit", "arithmetic"};
  const PageJson eight = good(engine, request);
  EXPECT_EQ(eight["profiles"], PageJson({"geforce256-8bit", "arithmetic"}));
  const std::vector<std::uint8_t> bytes(engine.bytes().begin(), engine.bytes().end());
  const PageJson exact{{"base", "geforce2"}, {"name", "exact"}, {"arithmetic", "exact"}};  // the same chip otherwise
  request["profiles"] = PageJson::array({"geforce256-8bit", exact});
  EXPECT_EQ(ask(engine, request)["difference"], eight["difference"]);
  EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), engine.bytes().begin(), engine.bytes().end()));
  EXPECT_GT(eight["difference"]["pixels"], 0);
  const PageJson own{{"base", "geforce256-8bit"}, {"name", "mine"}, {"half", 63}};
  request["profiles"] = PageJson::array({own, "arithmetic"});
  EXPECT_EQ(ask(engine, request)["difference"], eight["difference"]);
  request["profiles"] = {"arithmetic", "geforce2"};
  EXPECT_NE(fault_of_answer(ask(engine, request)).find("unknown profile"), std::string::npos);
}

TEST(PlaygroundDrawing, RecordsWhatThePassCombines) {
  Engine engine;
  PageJson request = draw_request();
  request["do"] = "combiners";
  request["pass"] = 0;
  const PageJson answer = good(engine, request);
  EXPECT_EQ(answer["drawn"], 32 * 16);
  const std::vector<std::string> names = answer["registers"];
  ASSERT_EQ(names.size(), 8U);
  const std::size_t plane = 32 * 16 * 4;
  ASSERT_EQ(engine.bytes().size(), names.size() * plane * 2 + plane + 32 * 16);
  const auto code = [&](const std::string& name, std::size_t pixel, std::size_t component) {
    const auto reg = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    const std::size_t at = reg * plane * 2 + (pixel * 4 + component) * 2;
    return static_cast<std::int16_t>(engine.bytes()[at] | (engine.bytes()[at + 1] << 8));
  };
  const std::uint8_t* const output = engine.bytes().data() + names.size() * plane * 2;
  for (std::size_t i = 0; i < 32 * 16; ++i) {
    // The program is the texel times the primary colour, 1, 0.5, 0.25.
    EXPECT_EQ(code("primary", i, 2), 64);
    EXPECT_EQ(output[4 * i + 2], code("tex0", i, 2) * 64 / 255) << i;
    EXPECT_EQ(engine.bytes()[names.size() * plane * 2 + plane + i], 1);
  }
  EXPECT_NE(answer["glsl"].get<std::string>().find("ivec4 ninebit_combine("), std::string::npos);
  request["pass"] = 1;
  EXPECT_NE(fault_of_answer(ask(engine, request)), "");
  request["pass"] = 0;
  request["size"] = {2048, 1024};
  EXPECT_NE(fault_of_answer(ask(engine, request)).find("at most 1048576"), std::string::npos);
  request["size"] = {32, 16};
  PageJson aside = request;
  aside["effect"]["targets"]["aside"] = {{"size", {2048, 1024}}};
  aside["effect"]["passes"].insert(aside["effect"]["passes"].begin(), aside["effect"]["passes"][0]);
  aside["effect"]["passes"][0]["name"] = "first";
  aside["effect"]["passes"][0]["target"] = "aside";
  EXPECT_NE(fault_of_answer(ask(engine, aside)).find("draws 2097152 pixels; at most 1048576"), std::string::npos);
  request["effect"]["passes"][0].erase("program");
  EXPECT_NE(fault_of_answer(ask(engine, request)).find("has no program"), std::string::npos);
}

TEST(PlaygroundDraw, DrawsTheChosenFunctionAndProgramOfASource) {
  const std::string text =
      "void f(float x) {\n  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);\n"
      "  GLfloat c[4] = { x, 0, 0, 1 };\n  glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, c);\n"
      "  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_CONSTANT_COLOR0_NV, GL_UNSIGNED_IDENTITY_NV, "
      "GL_RGB);\n"
      "  glDrawArrays(GL_TRIANGLES, 0, 3);\n  c[1] = 1;\n  glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, c);\n"
      "  glDrawArrays(GL_TRIANGLES, 0, 3);\n}\n"
      "void g(void) { glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2); }\n";
  PageJson request = draw_request();
  request["files"] = {{"two.c", text}};
  request["effect"]["passes"][0]["program"] = "two.c";
  const auto drawn = [&](Engine& engine) { return fault_of_answer(ask(engine, request)); };
  Engine engine;
  EXPECT_NE(drawn(engine), "");
  request["choices"] = {{"two.c", {{"function", "f"}, {"defines", {{"x", "1"}}}}}};
  EXPECT_NE(drawn(engine).find("pick one with #1 to #2"), std::string::npos);
  for (const int number : {1, 2}) {
    request["effect"]["passes"][0]["program"] = "two.c#" + std::to_string(number);
    ASSERT_EQ(drawn(engine), "");
    const std::vector<std::uint8_t> pixel(engine.bytes().begin(), engine.bytes().begin() + 3);
    EXPECT_EQ(pixel, (std::vector<std::uint8_t>{255, static_cast<std::uint8_t>(number == 2 ? 255 : 0), 0})) << number;
  }
  request["choices"] = {{"two.c", 7}};
  EXPECT_NE(drawn(engine), "");
}

}  // namespace
}  // namespace ninebit::test
