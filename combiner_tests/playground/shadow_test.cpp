// Index shadows in the playground.
#include <gtest/gtest.h>

#include <string>

#include "combiner_tests/playground/support.h"

namespace ninebit::test {
namespace {

TEST(PlaygroundShadow, DrawsTheRoomAndItsCube) {
  Engine engine;
  const PageJson request{{"do", "shadow"}, {"size", {64, 48}}, {"map_size", 64}, {"step", 2}};
  const PageJson answer = ask(engine, request);
  ASSERT_EQ(fault_of_answer(answer), "");
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
  const PageJson other = ask(engine, moved);
  ASSERT_EQ(fault_of_answer(other), "");
  EXPECT_NE(other["hash"], answer["hash"]);
  EXPECT_EQ(other["view"]["fov"], 40);
  moved["order"] = "neighbour";
  EXPECT_EQ(ask(engine, moved)["order"]["used"], "neighbour");
}

TEST(PlaygroundShadow, ReadsAMeshThatWasPut) {
  Engine engine;
  const std::string mesh = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const auto buffer = engine.buffer(mesh.size());
  std::copy(mesh.begin(), mesh.end(), buffer.begin());
  ASSERT_EQ(fault_of_answer(ask(engine, {{"do", "put"}, {"name", "my.off"}, {"kind", "file"}})), "");
  const PageJson answer = ask(engine, {{"do", "shadow"}, {"scene", "my.off"}, {"size", {32, 32}}, {"map_size", 32}});
  ASSERT_EQ(fault_of_answer(answer), "");
  EXPECT_EQ(answer["triangles"], 4 + 2) << "the mesh and its floor";
}

TEST(PlaygroundShadow, RefusesWhatItCannotDraw) {
  Engine engine;
  const auto refused = [&](const PageJson& more) {
    PageJson request{{"do", "shadow"}, {"size", {16, 16}}, {"map_size", 16}};
    request.update(more);
    return fault_of_answer(ask(engine, request));
  };
  EXPECT_NE(refused({{"map_size", 100}}).find("power of two"), std::string::npos);
  EXPECT_NE(refused({{"step", 17}}).find("from 1 to 16"), std::string::npos);
  EXPECT_NE(refused({{"scope", "section"}}).find("unknown key \"scope\""), std::string::npos);
  EXPECT_NE(refused({{"scene", "nowhere.glb"}}).find("is no file that was put"), std::string::npos);
  EXPECT_NE(refused({{"scene", "sphere:4096"}}).find("at most 512 segments"), std::string::npos);
  EXPECT_NE(refused({{"camera", {{"position", {0, 1e30, 0}}}}}).find("three numbers"), std::string::npos);
  EXPECT_NE(refused({{"order", "random"}}).find("expected file or neighbour"), std::string::npos);
  const std::string named = R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "secret.bin"}]})";
  const auto buffer = engine.buffer(named.size());
  std::copy(named.begin(), named.end(), buffer.begin());
  ASSERT_EQ(fault_of_answer(ask(engine, {{"do", "put"}, {"name", "named.gltf"}, {"kind", "file"}})), "");
  EXPECT_NE(refused({{"scene", "named.gltf"}}).find("files are read alone here"), std::string::npos);
}

}  // namespace
}  // namespace ninebit::test
