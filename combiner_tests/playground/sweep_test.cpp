// Sweeps of an input, and where the combiners lost something.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "combiner_tests/playground/support.h"

namespace ninebit::test {
namespace {

// Scaled by four, and a negative result.
constexpr std::string_view kLossy = R"(!!RC1.0
const0 = (0.5, 0.25, 1, 1);
{
  rgb {
    spare0 = tex0 * col0;
    scale_by_four();
  }
  alpha {
    spare1 = -tex0 * col0;
  }
}
{
  rgb {
    spare1 = spare0 * const0;
  }
}
out.rgb = spare1;
out.a = spare1;
)";

PageJson lossy_request() {
  PageJson request = draw_request();
  request["files"]["mine.gl"] = kLossy;
  request["hash"] = false;
  return request;
}

PageJson sweep(Engine& engine, const std::string& input, const std::string& output) {
  return ask(engine, {{"do", "sweep"}, {"x", 3}, {"y", 5}, {"input", input}, {"output", output}});
}

TEST(PlaygroundSweep, NeedsADrawing) {
  EXPECT_EQ(fault_of_answer(ask({{"do", "sweep"}, {"x", 0}, {"y", 0}, {"input", "tex0.r"}, {"output", "out.r"}})),
            "nothing was drawn yet");
  EXPECT_EQ(fault_of_answer(ask({{"do", "losses"}, {"pass", 0}})), "nothing was drawn yet");
}

TEST(PlaygroundSweep, IsTheProductForEachByte) {
  Engine engine;
  PageJson drawn = draw_request();
  good(engine, drawn);
  const PageJson answer = sweep(engine, "tex0.rgb", "out.g");
  ASSERT_EQ(fault_of_answer(answer), "");
  EXPECT_EQ(answer["inputs"],
            (PageJson{"tex0", "primary", "secondary", "fog"}));  // GL's default final combiner reads fog
  const PageJson& curve = answer["curves"][0];
  EXPECT_EQ(curve["profile"], "geforce2");
  EXPECT_EQ(curve["one"], 255);
  EXPECT_EQ(curve["at"], 255);  // the pixel is in a white square
  ASSERT_EQ(curve["codes"].size(), 256U);
  for (int byte = 0; byte < 256; ++byte) {
    EXPECT_EQ(curve["codes"][static_cast<std::size_t>(byte)], byte * 128 / 255) << byte;
    EXPECT_DOUBLE_EQ(curve["exact"][static_cast<std::size_t>(byte)].get<double>(), byte / 255.0 * 128 / 255.0);
  }
}

TEST(PlaygroundSweep, OffersWhatTheStagesWrite) {
  Engine engine;
  good(engine, lossy_request());
  const PageJson answer = sweep(engine, "const0.r", "spare1.r");
  ASSERT_EQ(fault_of_answer(answer), "");
  EXPECT_EQ(answer["inputs"], (PageJson{"tex0", "primary", "const0"}));
  ASSERT_EQ(answer["outputs"].size(), 4U);
  EXPECT_EQ(answer["outputs"][0], (PageJson{{"stage", 0}, {"register", "spare0"}, {"components", "rgb"}}));
  EXPECT_EQ(answer["outputs"][1], (PageJson{{"stage", 0}, {"register", "spare1"}, {"components", "a"}}));
  EXPECT_EQ(answer["outputs"][3]["register"], "out");
  // spare0 is 1, clamped; so spare1 is the constant.
  EXPECT_EQ(answer["curves"][0]["at"], 128);
  for (std::size_t byte = 0; byte < 256; ++byte) EXPECT_EQ(answer["curves"][0]["codes"][byte], byte);
}

TEST(PlaygroundSweep, ReadsARegisterAfterItsStage) {
  Engine engine;
  good(engine, lossy_request());
  PageJson request{{"do", "sweep"}, {"x", 3}, {"y", 5}, {"input", "tex0.r"}, {"output", "spare1.r"}, {"stage", 0}};
  EXPECT_EQ(ask(engine, request)["curves"][0]["codes"][200], 0);  // not yet written
  request["stage"] = 1;
  EXPECT_NE(ask(engine, request)["curves"][0]["codes"][200], 0);
  request["stage"] = 2;
  EXPECT_NE(fault_of_answer(ask(engine, request)).find("the program has 2 general combiners"), std::string::npos);
}

// An engine that has drawn a program on one texel.
void draw_texel(Engine& engine, const std::vector<std::uint8_t>& rgba, std::string_view program) {
  const auto buffer = engine.buffer(4);
  std::copy(rgba.begin(), rgba.end(), buffer.begin());
  ask(engine, {{"do", "put"}, {"name", "a.png"}, {"kind", "pixels"}, {"width", 1}, {"height", 1}});
  PageJson request = draw_request();
  request["effect"]["textures"]["squares"]["source"] = "a.png";
  request["files"]["mine.gl"] = program;
  good(engine, request);
}

TEST(PlaygroundSweep, MarksAByteOnlyIfAllComponentsHaveIt) {
  Engine engine;
  draw_texel(engine, {10, 200, 30, 255}, kTexelTimesColor);
  EXPECT_TRUE(sweep(engine, "tex0.rgb", "out.g")["curves"][0]["at"].is_null());
  EXPECT_EQ(sweep(engine, "tex0.g", "out.g")["curves"][0]["at"], 200);
  EXPECT_EQ(sweep(engine, "tex0.r", "out.g")["curves"][0]["at"], 10);
  draw_texel(engine, {200, 200, 200, 255}, kTexelTimesColor);
  EXPECT_EQ(sweep(engine, "tex0.rgb", "out.g")["curves"][0]["at"], 200);
}

// Spare 0 begins with the alpha of texture 0.
TEST(PlaygroundSweep, SweepsTheAlphaThatSpare0IsLoadedFrom) {
  Engine engine;
  draw_texel(engine, {10, 200, 30, 77}, R"(!!RC1.0
{
  rgb {
    spare1 = spare0.a;
  }
}
out.rgb = spare1;
out.a = spare0;
)");
  const PageJson curve = sweep(engine, "tex0.a", "out.r")["curves"][0];
  EXPECT_EQ(curve["at"], 77);
  for (std::size_t byte = 0; byte < 256; ++byte) EXPECT_EQ(curve["codes"][byte], byte);
  const PageJson other = sweep(engine, "tex0.g", "out.r")["curves"][0];
  EXPECT_EQ(other["codes"][0], 77);
  EXPECT_EQ(other["codes"][255], 77);
}

TEST(PlaygroundSweep, ComparesProfilesAndLeavesTheDrawing) {
  Engine engine;
  good(engine, draw_request());
  const PageJson pixel{{"do", "pixel"}, {"x", 3}, {"y", 5}};
  const PageJson before = ask(engine, pixel);
  PageJson request{{"do", "sweep"}, {"x", 3}, {"y", 5}, {"input", "tex0.r"}, {"output", "out.r"}};
  const PageJson own{{"base", "geforce2"}, {"name", "mine"}, {"general_narrowing", "nearest-halves-up"}};
  request["profiles"] = PageJson::array({"geforce2", "geforce256-8bit", own});
  const PageJson answer = good(engine, request);
  ASSERT_EQ(answer["curves"].size(), 3U);
  EXPECT_EQ(answer["curves"][1]["profile"], "geforce256-8bit");
  EXPECT_EQ(answer["curves"][2]["profile"], "mine");
  EXPECT_EQ(ask(engine, pixel), before);
  request["profiles"] = PageJson::array({"nowhere"});
  EXPECT_NE(fault_of_answer(ask(engine, request)).find("unknown profile"), std::string::npos);
  request["profiles"] = PageJson::array();
  EXPECT_NE(fault_of_answer(ask(engine, request)).find("1 to 4 profiles"), std::string::npos);
}

TEST(PlaygroundSweep, RefusesOtherPlaces) {
  Engine engine;
  good(engine, draw_request());
  for (const char* wrong : {"", "tex0", "tex0.", "tex0.x", "zero.r", "out.r", "nothing.r"}) {
    EXPECT_NE(fault_of_answer(sweep(engine, wrong, "out.r")).find("is not valid; expected a register"),
              std::string::npos)
        << wrong;
  }
  for (const char* wrong : {"out.rgb", "out", "tex9.r"}) {
    EXPECT_NE(fault_of_answer(sweep(engine, "tex0.r", wrong)).find("is not valid; expected out or"), std::string::npos)
        << wrong;
  }
}

TEST(PlaygroundLosses, MarksTruncationClampsAndDistances) {
  Engine engine;
  good(engine, lossy_request());
  const PageJson answer = good(engine, {{"do", "losses"}, {"pass", 0}});
  EXPECT_EQ(answer["general_combiners"], 2);
  const std::size_t plane = 32 * 16;
  ASSERT_EQ(engine.bytes().size(), 3 * plane);
  const auto at = [&](std::size_t stage, std::size_t x, std::size_t y) {
    return engine.bytes()[stage * plane + y * 32 + x];
  };
  // White: four times 1, 0.5, 0.25 is clamped to 1.
  EXPECT_EQ(at(0, 3, 5) & 2, 2);
  EXPECT_EQ(at(2, 3, 5) & 2, 0);
  // Each pixel's trace says the same.
  const std::vector<std::uint8_t> bytes(engine.bytes().begin(), engine.bytes().end());
  for (const std::size_t x : {0U, 3U, 9U, 21U}) {
    const PageJson pixel = ask(engine, {{"do", "pixel"}, {"x", x}, {"y", 5}});
    ASSERT_EQ(pixel["stages"].size(), 2U);
    for (std::size_t stage = 0; stage < 2; ++stage) {
      bool truncated = false, clamped = false;
      double distance = 0;
      for (const char* portion : {"rgb", "alpha"}) {
        for (const PageJson& channel : pixel["stages"][stage][portion]["channels"]) {
          for (const PageJson& output : channel["outputs"]) {
            truncated |= output["dropped"]["units"].get<double>() != 0.0;
            clamped |= output["cut"]["code"].get<int>() != 0;
            const PageJson& written = output["written"];
            distance = std::max(distance, std::abs(written["code"].get<int>() - 255 * written["ideal"].get<double>()));
          }
        }
      }
      const int expected = (truncated ? 1 : 0) + (clamped ? 2 : 0) + 4 * static_cast<int>(std::floor(distance + 0.5));
      EXPECT_EQ(int{bytes[stage * plane + 5 * 32 + x]}, expected) << x << " in stage " << stage;
    }
  }
}

TEST(PlaygroundLosses, RefusesOtherPasses) {
  Engine engine;
  PageJson request = draw_request();
  request["effect"]["passes"].push_back({{"name", "plain"}, {"primary", "constant:1,0,0"}});
  good(engine, request);
  EXPECT_NE(fault_of_answer(ask(engine, {{"do", "losses"}, {"pass", 1}})).find("has no program"), std::string::npos);
  EXPECT_NE(fault_of_answer(ask(engine, {{"do", "losses"}, {"pass", 2}})), "");
}

TEST(PlaygroundTime, MovesAnEffect) {
  Engine engine;
  PageJson request = draw_request();
  EXPECT_EQ(ask(engine, request)["moves"], false);
  request["effect"]["passes"][0]["units"][0]["matrix"] =
      PageJson::parse(R"([[1, 0, 0, "time / 8"], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])");
  const PageJson still = good(engine, request);
  EXPECT_EQ(still["moves"], true);
  request["time"] = 1.0;
  const PageJson moved = ask(engine, request);
  EXPECT_NE(moved["hash"], still["hash"]);
  EXPECT_EQ(moved["hash"], ask(request)["hash"]);
  request["time"] = 0;
  EXPECT_EQ(ask(engine, request)["hash"], still["hash"]);
  request["time"] = "late";
  EXPECT_NE(fault_of_answer(ask(engine, request)).find("number of seconds"), std::string::npos);
}

// The renderer's messages name its profile, long after the request with the profile's text has gone.
TEST(PlaygroundDraw, KeepsTheNameOfAProfileOfOnesOwn) {
  const std::string name(60, 'n');
  PageJson request = draw_request();
  request["profile"] = {{"base", "geforce2"}, {"name", name}};
  Engine engine;
  for (int drawing = 0; drawing < 3; ++drawing) EXPECT_EQ(ask(engine, request)["profile"], name);
  request["effect"]["passes"][0]["polygon_mode"] = "point";
  request["effect"]["passes"][0]["units"][0]["coordinates"] = "point-sprite";
  const std::string message = fault_of_answer(ask(engine, request));
  EXPECT_NE(message.find(name), std::string::npos) << message;
}

// What the drawing before leaves does not change a picture.
TEST(PlaygroundDraw, KeepsARendererAndDrawsWhatANewEngineDraws) {
  std::vector<PageJson> requests;
  PageJson request = draw_request();
  const auto add = [&] { requests.push_back(request); };
  add();
  request["files"]["mine.gl"] = kLossy;
  add();
  request["profile"] = "nv2a";
  add();
  request["profile"] = {{"base", "nv2a"}, {"name", "mine"}, {"half", 127}};
  add();
  request["profile"]["half"] = 128;
  add();
  request["effect"]["scene"] = {{"mesh", "torus:8"}, {"light", {"time", 2, 1}}};
  request["effect"]["passes"][0]["primary"] = "light-vector";
  add();
  request["time"] = 0.5;
  add();
  request["size"] = {16, 16};
  add();
  request["effect"]["passes"][0]["program"] = "missing.gl";
  add();
  request = requests[0];
  add();
  Engine kept;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    for (int twice = 0; twice < 2; ++twice) {
      Engine fresh;
      EXPECT_EQ(ask(kept, requests[i]), ask(fresh, requests[i])) << i;
      EXPECT_EQ(std::vector(kept.bytes().begin(), kept.bytes().end()),
                std::vector(fresh.bytes().begin(), fresh.bytes().end()));
      const PageJson pixel{{"do", "pixel"}, {"x", 8}, {"y", 8}};
      if (requests[i]["effect"]["passes"][0]["program"] != "missing.gl") {
        EXPECT_EQ(ask(kept, pixel), ask(fresh, pixel)) << i;
      }
    }
  }
}

}  // namespace
}  // namespace ninebit::test
