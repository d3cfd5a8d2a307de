// Nothing that is asked ends the engine.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "combiner_tests/playground/support.h"

namespace ninebit::test {
namespace {

// The answer is one JSON object on one line.
PageJson answer_object(Engine& engine, std::string_view request) {
  const std::string answer = engine.answer(request);
  EXPECT_EQ(answer.find('\n'), std::string::npos);
  const PageJson object = PageJson::parse(answer, nullptr, false);
  EXPECT_TRUE(object.is_object()) << answer.substr(0, 200);
  return object;
}

TEST(PlaygroundHostile, EveryRefusalSaysWhatIsWrong) {
  struct Case {
    std::string request, message;
  };
  const std::vector<Case> cases{
      {"", "not valid JSON"},
      {"{\"do\":", "not valid JSON"},
      {"[]", "the value must be an object, not an array"},
      {"null", "the value must be an object, not null"},
      {"{}", "the key \"do\" is missing"},
      {R"({"do": 1})", "do must be a string, not a number"},
      {R"({"do": "fly"})", "\"fly\" is not a request; expected about"},
      {R"({"do": "about", "colour": 1})", "unknown key \"colour\"; the keys here are do"},
      {R"({"do": "about", "do": "about"})", "do"},
      {R"({"do": "read"})", "the key \"text\" is missing"},
      {R"({"do": "read", "text": [1]})", "text must be a string, not an array"},
      {R"({"do": "read", "text": "", "profile": "voodoo"})", "unknown profile \"voodoo\"; expected one of geforce2"},
      {R"({"do": "read", "text": "", "profile": 7})", "profile must be an object, or a string with its text"},
      {R"({"do": "convert", "text": "", "to": "latin"})", "\"latin\" is not a form to write; expected one of gl"},
      {R"({"do": "trace", "text": "", "registers": 1})", "registers must be an object, not a number"},
      {R"({"do": "trace", "text": "", "registers": {"tex0": [1, 2, 3]}})", "tex0 must be an array of four codes"},
      {R"({"do": "trace", "text": "", "registers": {"tex0": [1, 2, 3, 1e999]}})", "not valid JSON"},
      {R"({"do": "trace", "text": "", "registers": {"tex0": [1, 2, 3, 99999999999999999999]}})", "whole number"},
      {R"({"do": "put", "name": "", "kind": "file"})", "a name has 1 to 1024 bytes"},
      {R"({"do": "put", "name": "a", "kind": "sound"})", "\"sound\" is not a kind; expected pixels or file"},
      {R"({"do": "put", "name": "a", "kind": "pixels", "width": 5000, "height": 1})", "from 1 to 4096"},
      {R"({"do": "put", "name": "a", "kind": "pixels", "width": 1.5, "height": 1})", "whole number"},
      {R"({"do": "draw"})", "the key \"effect\" is missing"},
      {R"({"do": "draw", "effect": 3})", "effect must be an object, or a string with its text, not a number"},
      {R"({"do": "draw", "effect": {}})", "the key \"ninebit\": \"effect\" is missing"},
      {R"({"do": "draw", "effect": {"ninebit": "effect", "version": 1}, "files": {"a": 1}})", "must be a string"},
      {R"({"do": "draw", "effect": {"ninebit": "effect", "version": 1, "passes": [{"program": "<b>.gl"}]}})",
       "is not among the files of the request"},
      {R"({"do": "draw", "effect": {"ninebit": "effect", "version": 1, "size": 16384, "passes": [{}]}})",
       "the playground draws at most 16777216"},
      {R"({"do": "draw", "effect": {"ninebit": "effect", "version": 1, "passes": [{}],
           "textures": {"a": {"source": "normalize-cube:16384"}}}})",
       "the playground takes at most 33554432"},
      {R"({"do": "draw", "effect": {"ninebit": "effect", "version": 1, "scene": {"mesh": "plane:4096"}, "passes": [{}]}})",
       "at most 512 segments"},
      {R"({"do": "draw", "effect": {"ninebit": "effect", "version": 1, "scene": {"mesh": "x.glb"}, "passes": [{}]}})",
       "x.glb"},
      {R"({"do": "draw", "effect": {"ninebit": "effect", "version": 1, "profile": "voodoo", "passes": [{}]}})",
       "voodoo"},
      {R"({"do": "compare", "effect": {"ninebit": "effect", "version": 1, "passes": [{}]}, "profiles": ["nv2a"]})",
       "profiles must be an array of two profiles"},
      {R"({"do": "pixel", "x": 0, "y": 0})", "nothing was drawn yet"},
      {"{\"do\": \"read\", \"text\": \"\xFF\xFE\"}", "not valid JSON"},
      {std::string(100'000, '['), "nested more than 16 deep"},
      {R"({"do": "about", "x": )" + std::string(10'000, '[') + std::string(10'000, ']') + "}",
       "nested more than 16 deep"},
      {std::string((std::size_t{16} << 20) + 1, ' '), "at most 16777216 are read"},
  };
  for (const Case& one : cases) {
    Engine engine;
    const PageJson answer = answer_object(engine, one.request);
    const std::string message = fault_of_answer(answer);
    const std::string all = answer.dump();
    EXPECT_NE(message, "") << one.request.substr(0, 200);
    EXPECT_NE((message + " " + answer["fault"].value("file", "")).find(one.message), std::string::npos)
        << one.request.substr(0, 200) << "\n"
        << all.substr(0, 400);
    EXPECT_TRUE(engine.bytes().empty());
  }
}

TEST(PlaygroundHostile, TextsOfEveryKindAreRead) {
  Engine engine;
  for (const std::string& text : {std::string(), std::string("\0\0\0", 3), std::string("<script>alert(1)</script>"),
                                  std::string(100'000, '('), std::string(1'000'000, 'a'), std::string("!!RC1.0\n{"),
                                  std::string("ps.1.1\n"), std::string("{\"ninebit\": \"program\"")}) {
    const PageJson request{{"do", "read"}, {"text", text}};
    const PageJson answer = answer_object(engine, request.dump());
    ASSERT_EQ(fault_of_answer(answer), "");
    for (const PageJson& fault : answer["faults"]) {
      EXPECT_GE(fault["line"], 1);
      EXPECT_GE(fault["column"], 1);
      EXPECT_GE(fault["length"], 1);
    }
  }
}

// Requests that are damaged byte by byte, and values of other types in every place.
TEST(PlaygroundHostile, DamagedRequestsAreAnswered) {
  const std::vector<std::string> whole{
      draw_request().dump(),
      R"({"do": "trace", "text": "!!RC1.0\n{ rgb { spare0 = tex0 * col0; } }\nout.rgb = spare0;", "profile": "nv2a",
          "registers": {"tex0": [1, 2, 3, 4]}})",
      R"({"do": "read", "text": "ps.1.1\ntex t0\nmul r0, t0, v0\n", "profile": {"base": "nv2a", "name": "m", "one": 255}})",
      R"({"do": "put", "name": "a", "kind": "file"})"};
  std::mt19937 random(1);
  Engine engine;
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string request = whole[static_cast<std::size_t>(i) % whole.size()];
    for (auto n = 1 + random() % 3; n > 0; --n) {
      const std::size_t at = random() % request.size();
      constexpr std::string_view kBytes = "{}[]\",:0-e.\\\n\x01\xFFtx";
      if (random() % 3 == 0) {
        request.erase(at, 1 + random() % 8);
      } else {
        request[at] = kBytes[random() % kBytes.size()];
      }
      if (request.empty()) request = "{";
    }
    refused += fault_of_answer(answer_object(engine, request)).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 1000);
  EXPECT_LT(refused, 2000);
}

}  // namespace
}  // namespace ninebit::test
