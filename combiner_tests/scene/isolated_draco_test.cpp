// Draco decoders that crash, hang, eat memory and lie, in a child process; and a right one, whose meshes come back.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "combiner_tests/scene/draco_text.h"
#include "src/scene/files/draco_meshes.h"
#include "src/system/sandbox.h"

namespace ninebit {
namespace {

using scene_tests::draco_stream;
using scene_tests::put;

const std::string& right_stream() {
  static const std::string stream = draco_stream({});
  return stream;
}

DracoRequest request() {
  DracoRequest one;
  one.stream = right_stream();
  one.positions = DracoAttribute{0, 5126};
  one.most_triangles = 8;
  one.name = "a mesh";
  return one;
}

// One triangle, whatever was asked for.
DracoMesh one_triangle() {
  DracoMesh mesh;
  for (const std::uint32_t index : {0U, 1U, 2U}) put(mesh.indices, index, 4);
  for (const float value : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) put(mesh.positions, value);
  return mesh;
}

// The fault of two meshes that the given decoder decodes; empty if they came back.
std::string fault_from(DracoDecode decode, bool isolated = true, const std::function<bool()>& go_on = {}) {
  const std::vector<DracoRequest> requests{request(), request()};
  const auto meshes = decode_all(decode, requests, {.isolated = isolated, .go_on = go_on});
  return meshes ? "" : meshes.error().message;
}

TEST(IsolatedDraco, BringsEveryMesh) {
  std::vector<DracoRequest> requests{request(), request()};
  requests[1].normals = DracoAttribute{1, 5126};
  const auto there = decode_all(&decode_draco, requests, {.isolated = true});
  const auto here = decode_all(&decode_draco, requests, {});
  ASSERT_TRUE(there.ok() && here.ok());
  ASSERT_EQ(there->size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ((*there)[i].indices.size(), 96U);
    EXPECT_EQ((*there)[i].positions.size(), 108U);
    EXPECT_EQ((*there)[i].normals.size(), 108U * i);
    EXPECT_EQ((*there)[i].indices, (*here)[i].indices);
    EXPECT_EQ((*there)[i].positions, (*here)[i].positions);
    EXPECT_EQ((*there)[i].normals, (*here)[i].normals);
  }
}

TEST(IsolatedDraco, BringsTheFault) {
  for (const bool isolated : {false, true}) {
    EXPECT_EQ(fault_from([](const DracoRequest&) -> Result<DracoMesh> { return Diagnostic{"is odd"}; }, isolated),
              "a mesh is odd");
  }
}

TEST(IsolatedDraco, SurvivesWhatItCalls) {
  EXPECT_EQ(fault_from([](const DracoRequest&) -> Result<DracoMesh> { std::abort(); }), "Draco's reader crashed");
  EXPECT_EQ(fault_from([](const DracoRequest&) -> Result<DracoMesh> { throw 1; }), "Draco's reader crashed");
  EXPECT_EQ(fault_from([](const DracoRequest&) -> Result<DracoMesh> {
              std::this_thread::sleep_for(std::chrono::hours(1));
              return one_triangle();
            }),
            "Draco's reader took more than 8 s");
}

TEST(IsolatedDraco, LimitsMemory) {
  if (!posix::can_limit_memory()) GTEST_SKIP() << "sanitizers map terabytes, so the address space has no limit";
  EXPECT_EQ(fault_from([](const DracoRequest&) -> Result<DracoMesh> {
              DracoMesh mesh = one_triangle();
              mesh.positions.resize(std::size_t{1} << 32U);
              return mesh;
            }),
            "Draco's reader needed more than 1024 MiB");
}

TEST(IsolatedDraco, IsStoppedByTheCaller) {
  const DracoDecode hangs = [](const DracoRequest&) -> Result<DracoMesh> {
    std::this_thread::sleep_for(std::chrono::hours(1));
    return one_triangle();
  };
  EXPECT_EQ(fault_from(hangs, true, [] { return false; }), "interrupted");
}

// A mesh that no decoder should give is not taken for one, here or from a child.
template <class Change>
void expect_no_mesh(Change) {
  for (const bool isolated : {false, true}) {
    EXPECT_EQ(fault_from(
                  [](const DracoRequest&) -> Result<DracoMesh> {
                    DracoMesh mesh = one_triangle();
                    Change()(mesh);
                    return mesh;
                  },
                  isolated),
              "Draco's reader gave no mesh");
  }
}

TEST(IsolatedDraco, IsNotBelieved) {
  EXPECT_EQ(fault_from([](const DracoRequest&) -> Result<DracoMesh> { return one_triangle(); }), "");
  expect_no_mesh([](DracoMesh& mesh) { mesh.indices[4] = 3; });
  expect_no_mesh([](DracoMesh& mesh) { mesh.indices[11] = '\x80'; });
  expect_no_mesh([](DracoMesh& mesh) { mesh.indices.pop_back(); });
  expect_no_mesh([](DracoMesh& mesh) { mesh.positions.pop_back(); });
  expect_no_mesh([](DracoMesh& mesh) { mesh.positions.clear(); });
  expect_no_mesh([](DracoMesh& mesh) { mesh.positions += std::string(12, '\0'); });
  expect_no_mesh([](DracoMesh& mesh) { mesh.normals = mesh.positions; });
  expect_no_mesh([](DracoMesh& mesh) {
    for (int i = 0; i < 4; ++i) mesh.indices += mesh.indices;
  });
}

}  // namespace
}  // namespace ninebit
