// The article's claims, through the very state that the render uses.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "combiner_tests/shadow/support.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/shadow/index_cube.h"

namespace {

using namespace ninebit;
using shadow_test::render;

// docs/programs has the listing for those who read; the renderer makes the same calls.
TEST(Article, TheListingIsWhatTheRendererSets) {
  std::ifstream in(NINEBIT_SOURCE_DIR "/docs/programs/index_compare.gl");
  ASSERT_TRUE(in);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  for (const HardwareProfile& profile : hardware_profiles()) {
    const auto listed = parse_gl_calls({text, "index_compare.gl"}, profile);
    ASSERT_TRUE(listed) << listed.faults().front().text();
    EXPECT_EQ(*listed, *index_comparison_state(profile)) << profile.name;
  }
}

TEST(Article, EqualIndicesAreAlwaysLit) {
  const HardwareProfile& profile = profiles::geforce2;
  const Program program = normalize(*index_comparison_state(profile), profile);
  const IndexCodes codes(2);
  for (std::uint32_t n = 0; n < codes.capacity(); n += 11) {
    FragmentInputs in;
    in.primary = codes.color(n);
    in.texture[0] = Texel{.value = in.primary};
    ASSERT_EQ(evaluate(program, initial_registers(profile, in)), (Rgba9{0, 0, 0, 0})) << n;
  }
}

// "Errors at polygon joints" with an index a polygon, "no errors at polygon joints" with one an object. At the outline
// the cleared map is fetched, which no scope can help.
TEST(Article, JointErrorsVanishWithObjectIndices) {
  Scene scene = shadow_test::scene_with({3.0F, 4.0F, 6.0F}, {0.0F, 0.0F, 0.0F}, {1.0F, 4.0F, 2.0F});
  shadow_test::add_box(scene, "box", {-1, -1, -1}, {1, 1, 1});
  RenderSettings settings = shadow_test::small_settings();
  settings.map_size = 64;
  // A convex body: whatever of it the light meets first is lit.
  const auto joint_errors = [&] {
    const Rendering r = render(scene, settings);
    const auto layers = shadow_test::comparison_layers(r);
    int count = 0;
    for (std::size_t i = 0; i < r.frame.stencil().size(); ++i) {
      const std::uint32_t polygon = layers.polygon[i];
      if (polygon == 0 || r.frame.stencil()[i] == 0 || layers.texture0[0][i] == 0) continue;
      const glm::uvec3 t = scene.triangles[polygon - 1];
      const glm::vec3 normal =
          glm::cross(scene.positions[t.y] - scene.positions[t.x], scene.positions[t.z] - scene.positions[t.x]);
      count += glm::dot(normal, scene.lights[0].position - scene.positions[t.x]) > 0.0F ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(joint_errors(), 20);
  settings.index.scope = IndexScope::object;
  EXPECT_EQ(joint_errors(), 0);
}

}  // namespace
