// Index shadows in the playground.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "combiner_tests/playground/support.h"
#include "ninebit/scene/scene_io.h"
#include "ninebit/shadow/ground_truth.h"
#include "ninebit/shadow/index_cube.h"

namespace ninebit::test {
namespace {

Scene room() {
  auto read = read_scene(NINEBIT_SOURCE_DIR "/scenes/index_room.gltf");
  if (!read) throw std::runtime_error(read.error().text());
  return std::move(*read);
}

TEST(PlaygroundShadow, DrawsTheRoomAndItsCube) {
  Engine engine;
  const PageJson request{{"do", "shadow"}, {"size", {64, 48}}, {"map_size", 64}, {"step", 2}};
  const PageJson answer = good(engine, request);
  EXPECT_EQ(answer["width"], 64);
  EXPECT_EQ(answer["height"], 48);
  EXPECT_EQ(answer["cube"]["width"], 256);
  EXPECT_EQ(answer["cube"]["height"], 192);
  EXPECT_EQ(answer["bytes"], 4 * (64 * 48 + 256 * 192));
  EXPECT_EQ(engine.bytes().size(), answer["bytes"]);
  const PageJson& pixels = answer["pixels"];
  EXPECT_EQ(pixels["background"].get<int>() + pixels["lit"].get<int>() + pixels["shadowed"].get<int>(), 64 * 48);
  EXPECT_GT(pixels["shadowed"], 0);
  EXPECT_EQ(answer["order"]["used"], "file");
  // Another camera gives another picture.
  PageJson moved = request;
  moved["camera"] = {{"position", {0, 3, 6}}, {"target", {0, 1, 0}}, {"fov", 40}};
  const PageJson other = good(engine, moved);
  EXPECT_NE(other["hash"], answer["hash"]);
  EXPECT_EQ(other["view"]["fov"], 40);
  moved["hash"] = false;
  EXPECT_FALSE(ask(engine, moved).contains("hash"));
  moved["order"] = "neighbour";
  EXPECT_EQ(ask(engine, moved)["order"]["used"], "neighbour");
}

// The last answer of a judgement, some rows at a time.
PageJson judge_by_rows(Engine& engine, PageJson request, int rows) {
  request["do"] = "judge";
  PageJson answer = ask(engine, request);
  EXPECT_EQ(fault_of_answer(answer), "");
  EXPECT_EQ(answer["judged"], 0);
  for (int judged = 0; judged < answer["height"];) {
    EXPECT_FALSE(answer.contains("errors"));
    answer = ask(engine, {{"do", "judge_rows"}, {"rows", rows}});
    if (!fault_of_answer(answer).empty()) return answer;
    EXPECT_EQ(answer["judged"], std::min(judged + rows, answer["height"].get<int>()));
    judged = answer["judged"];
  }
  return answer;
}

TEST(PlaygroundShadow, CountsWrongPixelsByRaysSomeRowsAtATime) {
  Engine engine;
  const PageJson request{{"size", {80, 60}}, {"map_size", 64}, {"profile", "nv2a"}};
  const PageJson answer = judge_by_rows(engine, request, 7);
  ASSERT_EQ(fault_of_answer(answer), "");
  // The same scene, judged with Embree.
  auto read = complete_scene(room(), {}, 80.0F / 60.0F);
  ASSERT_TRUE(read);
  RenderSettings settings;
  settings.width = 80;
  settings.height = 60;
  settings.map_size = 64;
  settings.profile = profiles::nv2a;
  settings.evidence = true;
  const auto rendering = render_index_cube(*read, settings, {});
  ASSERT_TRUE(rendering);
  const auto rays = GroundTruthScene::make(*read);
  ASSERT_TRUE(rays);
  const auto truth = measure(*rays, settings, *rendering);
  ASSERT_TRUE(truth);
  EXPECT_GT(truth->false_lit + truth->false_shadowed, 100U);
  EXPECT_EQ(answer["errors"]["false_lit"], truth->false_lit);
  EXPECT_EQ(answer["errors"]["false_shadowed"], truth->false_shadowed);
  for (const ErrorCause cause : causes_of(*rendering->evidence)) {
    EXPECT_EQ(answer["errors"]["by_cause"][std::string(name_of(cause))],
              truth->by_cause[static_cast<std::size_t>(cause)]);
  }
  EXPECT_EQ(answer["pixels"]["lit"], rendering->lit);
  ASSERT_EQ(engine.bytes().size(), 80U * 60U);
  // From the top, and falsely lit pixels have 128 more.
  std::size_t lit = 0;
  for (std::size_t i = 0; i < truth->cause.size(); ++i) {
    const std::uint8_t byte = engine.bytes()[(59 - i / 80) * 80 + i % 80];
    ASSERT_EQ(byte & 127, static_cast<int>(truth->cause[i])) << i;
    lit += byte >> 7;
  }
  EXPECT_EQ(lit, truth->false_lit);
  EXPECT_EQ(judge_by_rows(engine, request, 60), answer) << "all rows at once";
  EXPECT_NE(fault_of_answer(ask(engine, {{"do", "judge_rows"}, {"rows", 1}})).find("nothing is being judged"),
            std::string::npos);
}

TEST(PlaygroundShadow, ANewJudgementReplacesTheOneThatRuns) {
  Engine engine;
  const PageJson coarse{{"size", {40, 30}}, {"map_size", 32}}, fine{{"size", {40, 30}}, {"map_size", 256}};
  const PageJson expected = judge_by_rows(engine, fine, 30);
  PageJson begun = coarse;
  begun["do"] = "judge";
  ask(engine, begun);
  ask(engine, {{"do", "judge_rows"}, {"rows", 10}});
  EXPECT_EQ(judge_by_rows(engine, fine, 11), expected);
  EXPECT_NE(judge_by_rows(engine, coarse, 11)["errors"], expected["errors"]);
  // A scene that cannot be rendered leaves nothing to judge.
  begun["map_size"] = 33;
  EXPECT_NE(fault_of_answer(ask(engine, begun)), "");
  EXPECT_NE(fault_of_answer(ask(engine, {{"do", "judge_rows"}, {"rows", 1}})), "");
}

TEST(PlaygroundShadow, ReadsAMeshThatWasPut) {
  Engine engine;
  const std::string mesh = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  put_file(engine, "my.off", mesh);
  const PageJson answer = good(engine, {{"do", "shadow"}, {"scene", "my.off"}, {"size", {32, 32}}, {"map_size", 32}});
  EXPECT_EQ(answer["triangles"], 4 + 2) << "the mesh and its floor";
}

TEST(PlaygroundShadow, RefusesWhatItCannotDraw) {
  Engine engine;
  const auto refused = [&](const PageJson& more) {
    PageJson request{{"do", "shadow"}, {"size", {16, 16}}, {"map_size", 16}};
    request.update(more);
    return fault_of_answer(ask(engine, request));
  };
  EXPECT_NE(refused({{"map_size", 100}}).find("a power of two from 1 to 2048"), std::string::npos);
  EXPECT_NE(refused({{"step", 17}}).find("from 1 to 16"), std::string::npos);
  EXPECT_NE(refused({{"scope", "section"}}).find("unknown key \"scope\""), std::string::npos);
  EXPECT_NE(refused({{"scene", "nowhere.glb"}}).find("is no file that was put"), std::string::npos);
  EXPECT_NE(refused({{"scene", "sphere:4096"}}).find("at most 512 segments"), std::string::npos);
  EXPECT_NE(refused({{"camera", {{"position", {0, 1e30, 0}}}}}).find("three numbers"), std::string::npos);
  EXPECT_NE(refused({{"order", "random"}}).find("expected file or neighbour"), std::string::npos);
  const std::string named = R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "secret.bin"}]})";
  put_file(engine, "named.gltf", named);
  EXPECT_NE(refused({{"scene", "named.gltf"}}).find("files are read alone here"), std::string::npos);
}

}  // namespace
}  // namespace ninebit::test
