// Texture-shader stages emitted as C, compiled by the machine's C compiler, against one fragment's evaluation.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "combiner_tests/language/compiled_c.h"
#include "combiner_tests/language/emit_stage_cases.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/language/c_source.h"
#include "ninebit/language/program_text.h"

namespace ninebit::test {
namespace {

using Texel = void (*)(void*, int, const float*, std::int32_t*);
using StageFunction = int (*)(const float*, const float*, const float*, const float*, Texel, void*, std::int32_t*,
                              std::int32_t*, std::int32_t*, std::int32_t*, float*);

// The places at which a fragment's textures were read.
struct Places {
  std::array<std::array<float, 3>, kTextureStages> at{};
};

void read_place(void* data, int unit, const float* at, std::int32_t* rgba) {
  auto& place = static_cast<Places*>(data)->at[static_cast<std::size_t>(unit)];
  std::copy_n(at, 3, place.begin());
  const Bytes4 bytes = texel_of(place, unit);
  std::copy(bytes.begin(), bytes.end(), rgba);
}

std::uint32_t bits(float value) {
  return std::isnan(value) ? 0x7fc00000U : std::bit_cast<std::uint32_t>(value);
}

// A random coordinate, now and then one at an edge.
float random_coordinate(Random& random) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  if (!random.one_in(12)) return random.real_f(-2, 2);
  return random.pick({0.0F, -0.0F, 1.0F, 1.0F / 255.0F, 1e30F, kInfinite, -kInfinite,
                      std::numeric_limits<float>::quiet_NaN(), 1e-42F});
}

TEST(EmitCStages, RandomStagesGiveTheBitsOfTheReference) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  Random random(0x63737467);
  std::vector<StageCase> cases;
  std::vector<TextureShaderProgram> programs;
  std::string source;
  for (int n = 0; n < 8 * kStageOperations; ++n) {
    StageCase& c = cases.emplace_back(random_stage_case(random, static_cast<TextureOperation>(n % kStageOperations)));
    if (random.one_in(20)) c.state.stage[1].matrix[0] = std::numeric_limits<float>::infinity();
    const auto program = compile(c.state, c.textures, c.profile);
    ASSERT_TRUE(program.ok()) << program.error().message;
    programs.push_back(*program);
    const auto text = emit_c_texture_shader(*program, c.profile, "stages" + std::to_string(n));
    ASSERT_TRUE(text.ok());
    source += *text;
  }
  const CompiledC compiled(source, CompiledC::Runs::seldom);
  ASSERT_FALSE(HasFailure());
  int depths = 0, culled = 0, reads = 0;
  for (std::size_t n = 0; n < cases.size(); ++n) {
    const auto function = compiled.find_as<StageFunction>("stages" + std::to_string(n));
    ASSERT_NE(function, nullptr);
    for (int fragment = 0; fragment < 250; ++fragment) {
      StageInputs in;
      for (auto& unit : in.at) {
        for (float& c : unit) c = random_coordinate(random);
      }
      in.right = in.above = in.at;
      const TextureShaderResult expected =
          evaluate(programs[n], cases[n].profile, in,
                   [](int unit, const TexturePlace& place) { return texel_of(place.at, unit); });
      Places places;
      std::array<std::array<std::int32_t, 4>, 4> codes{};
      float depth = -1.0F;
      const int is_culled =
          function(in.at[0].data(), in.at[1].data(), in.at[2].data(), in.at[3].data(), read_place, &places,
                   codes[0].data(), codes[1].data(), codes[2].data(), codes[3].data(), &depth);
      ASSERT_EQ(is_culled != 0, expected.is_culled) << n;
      ASSERT_EQ(bits(depth), bits(expected.depth.value_or(0.0F))) << n;
      depths += expected.depth ? 1 : 0;
      culled += expected.is_culled ? 1 : 0;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < 4; ++k)
          ASSERT_EQ(codes[i][k], expected.stage[i].codes[k]) << n << ' ' << i << ' ' << k;
        if (!expected.stage[i].at) continue;
        ++reads;
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_EQ(bits(places.at[i][k]), bits((*expected.stage[i].at)[k]))
              << emit_c_texture_shader(programs[n], cases[n].profile).value();
        }
      }
    }
  }
  EXPECT_GT(depths, 1000);
  EXPECT_GT(culled, 1000);
  EXPECT_GT(reads, 50000);
}

// Both halves of a program are one source, whose second function's results the first one reads.
TEST(EmitCStages, BothHalvesAreOneSource) {
  TextProgram program;
  program.texture_shader = {.enabled = true, .rules = StageRules::nv2a};
  program.texture_shader.stage[0].operation = TextureOperation::texture_2d;
  program.texture_shader.stage[1].operation = TextureOperation::offset_2d;
  program.state.final_combiner.a = {Register::zero};
  program.state.final_combiner.c = {Register::texture1};
  const auto text = find_form("c")->print(program, ChipClass::nv20, profiles::nv2a);
  ASSERT_TRUE(text.ok()) << text.error().message;
  const CompiledC compiled(*text);
  const auto stages = compiled.find_as<StageFunction>("ninebit_texture_shader");
  ASSERT_NE(stages, nullptr);
  const std::array<float, 4> at{0.25F, 0.5F, 0.0F, 1.0F};
  Places places;
  RegisterFile registers{};
  std::array<std::array<std::int32_t, 4>, 4> codes{};
  float depth = 1.0F;
  EXPECT_EQ(stages(at.data(), at.data(), at.data(), at.data(), read_place, &places, codes[0].data(), codes[1].data(),
                   codes[2].data(), codes[3].data(), &depth),
            0);
  EXPECT_EQ(depth, 0.0F);
  for (std::size_t k = 0; k < 4; ++k) registers[Register::texture1][k] = static_cast<s9>(codes[1][k]);
  const EmittedFunction combine = compiled.find("ninebit_combine");
  ASSERT_NE(combine, nullptr);
  const Bytes4 moved = texel_of(places.at[1], 1);
  const Rgba9 color = call(combine, registers);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(color[k], moved[k]);
  EXPECT_FALSE(emit_c_texture_shader({}, profiles::nv2a, "no name").ok());
}

}  // namespace
}  // namespace ninebit::test
