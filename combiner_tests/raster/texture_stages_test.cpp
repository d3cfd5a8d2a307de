// Texture-shader stages with textures: one fragment, batches on every SIMD target, and the oracle give the same.
#include "ninebit/raster/texture_stages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/oracle/stage_oracle.h"
#include "combiner_tests/raster/stage_support.h"
#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/support/special_floats.h"

namespace ninebit::test {
namespace {

constexpr std::uint64_t kStageSeed = 4201;
constexpr std::size_t kStageFragments = kSlowBuild ? 40 : 256;
constexpr int kStageStates = 40;  // times kStageFragments: more than 10,000 fragments of each operation

std::unique_ptr<StageCase> make_case(TextureOperation operation, std::uint64_t index, bool has_mipmaps) {
  Random random(kStageSeed + (has_mipmaps ? 1 : 0), 1000 * static_cast<std::uint64_t>(operation) + index);
  auto made = random_stages(random, operation, has_mipmaps);
  StageCase& c = *made;
  for (std::size_t place = 0; place < 3; ++place) {
    for (auto& unit : c.given[place]) {
      for (auto& k : unit) {
        for (std::size_t i = 0; i < kStageFragments; ++i) {
          k.push_back(place == 0 ? random_stage_number(random) : has_mipmaps ? random_change(random) : 0.0F);
        }
        k.shrink_to_fit();  // a sanitizer sees a read beyond
      }
    }
  }
  return made;
}

struct StagesSeen {
  std::array<int, 24> consistent{}, inconsistent{};
  int culled = 0, depths = 0, codes_above_0 = 0;
};

bool same_number(float a, float b) {
  return (std::isnan(a) && std::isnan(b)) || a == b;
}

// What a batch gave for all fragments.
struct StageBatchResult {
  std::array<CodeArrays, kTextureStages> codes{CodeArrays(kStageFragments), CodeArrays(kStageFragments),
                                               CodeArrays(kStageFragments), CodeArrays(kStageFragments)};
  std::vector<std::uint8_t> killed = std::vector<std::uint8_t>(kStageFragments, 7);
  std::vector<float> depth = std::vector<float>(kStageFragments, 7.0F);
};

void run_stage_batch(const TextureStages& stages, const StageCase& c, StageBatchResult& result) {
  StageOutputs outputs{.codes = {}, .killed = result.killed.data(), .depth = result.depth.data()};
  for (std::size_t u = 0; u < kTextureStages; ++u) outputs.codes[u] = result.codes[u].at();
  stages.run(c.batch(), kStageFragments, outputs);
}

std::string stage_place(TextureOperation operation, std::uint64_t index, std::size_t i, std::size_t unit) {
  return std::string(info_of(operation).name) + ", case " + std::to_string(index) + ", fragment " + std::to_string(i) +
         ", stage " + std::to_string(unit);
}

// One fragment against the oracle, which reads the same textures.
void expect_oracle(const StageCase& c, oracle::StageQuestion& question, const TextureStages& stages,
                   const TextureShaderResult& result, std::size_t i, const std::string& place, StagesSeen& seen) {
  question.coordinate = c.inputs(i).at;
  const oracle::StageAnswer answer = oracle::run_stages(question);
  for (std::size_t u = 0; u < kTextureStages; ++u) {
    const auto operation = static_cast<std::size_t>(c.state.stage[u].operation);
    ++(answer.consistent[u] ? seen.consistent : seen.inconsistent)[operation];
    ASSERT_EQ(stages.program().stage[u].inconsistent.empty(), answer.consistent[u])
        << place << ' ' << u << ": " << stages.program().stage[u].inconsistent;
    for (std::size_t k = 0; k < 4; ++k) {
      ASSERT_EQ(int{result.stage[u].texel[k]}, answer.texel[u][k]) << place << ' ' << u << ", component " << k;
      ASSERT_EQ(int{result.stage[u].codes[k]}, answer.code[u][k]) << place << ' ' << u << ", component " << k;
    }
    if (answer.dot[u]) {
      ASSERT_TRUE(result.stage[u].dot && same_number(*result.stage[u].dot, *answer.dot[u])) << place << ' ' << u;
    }
  }
  ASSERT_EQ(result.is_culled, answer.culled) << place;
  ASSERT_EQ(result.depth.has_value(), answer.depth.has_value()) << place;
  if (answer.depth) {
    ASSERT_TRUE(same_number(*result.depth, *answer.depth)) << place;
  }
}

void run(TextureOperation operation, std::uint64_t index, bool has_mipmaps, StagesSeen& seen) {
  const auto c = make_case(operation, index, has_mipmaps);
  const auto stages = TextureStages::make(c->profile, c->state, c->units);
  ASSERT_TRUE(stages.ok()) << stages.error().text();
  std::vector<TextureShaderResult> results;
  for (std::size_t i = 0; i < kStageFragments; ++i) results.push_back(stages->evaluate(c->inputs(i)));
  oracle::StageQuestion question = stage_question(*c);
  for (std::size_t i = 0; i < kStageFragments && !has_mipmaps; ++i) {
    expect_oracle(*c, question, *stages, results[i], i, stage_place(operation, index, i, 0), seen);
    if (testing::Test::HasFatalFailure()) return;
  }
  for (const std::int64_t target : simd_targets()) {
    const OnTarget on(target);
    StageBatchResult batch;
    run_stage_batch(*stages, *c, batch);
    for (std::size_t i = 0; i < kStageFragments; ++i) {
      const TextureShaderResult& one = results[i];
      for (std::size_t u = 0; u < kTextureStages; ++u) {
        ASSERT_EQ(batch.codes[u].of(i), one.stage[u].codes)
            << simd_target_name(target) << ", " << stage_place(operation, index, i, u);
        seen.codes_above_0 += one.stage[u].codes[0] > 0 ? 1 : 0;
      }
      ASSERT_EQ(batch.killed[i] != 0, one.is_culled)
          << simd_target_name(target) << ' ' << stage_place(operation, index, i, 0);
      seen.culled += one.is_culled ? 1 : 0;
      if (!one.depth) continue;
      ++seen.depths;
      ASSERT_TRUE(same_number(batch.depth[i], *one.depth))
          << simd_target_name(target) << ' ' << stage_place(operation, index, i, 0);
    }
  }
}

TEST(TextureStages, OneFragmentBatchesAndTheOracleAgree) {
  for (int n = 0; n < static_cast<int>(TextureOperation::brdf); ++n) {
    const auto operation = static_cast<TextureOperation>(n);
    StagesSeen seen;
    for (std::uint64_t index = 0; index < kStageStates; ++index) {
      run(operation, index, false, seen);
      if (HasFatalFailure()) return;
    }
    const auto at = static_cast<std::size_t>(n);
    EXPECT_GE(seen.consistent[at], kStageStates * static_cast<int>(kStageFragments) / 5) << info_of(operation).name;
    EXPECT_GT(seen.codes_above_0, 0);
    if (operation == TextureOperation::cull_fragment) {
      EXPECT_GT(seen.culled, 0);
    }
    if (operation == TextureOperation::dot_product_depth_replace) {
      EXPECT_GT(seen.depths, 0);
    }
  }
}

TEST(TextureStages, BatchesWithMipMapsAgree) {
  for (int n = 0; n < static_cast<int>(TextureOperation::brdf); ++n) {
    StagesSeen seen;
    for (std::uint64_t index = 0; index < kStageStates / 8; ++index) {
      run(static_cast<TextureOperation>(n), index, true, seen);
      if (HasFatalFailure()) return;
    }
  }
}

// Runs batches of random coordinates, in which arrays that no stage reads are null, and expects what single fragments
// give, which it returns.
std::vector<TextureShaderResult> expect_same_batches(const TextureStages& stages, Random& random) {
  std::array<std::array<std::vector<float>, 4>, kTextureStages> given;
  StageBatch batch;
  for (int u = 0; u < kTextureStages; ++u) {
    for (int k = 0; k < 4; ++k) {
      auto& array = given[static_cast<std::size_t>(u)][static_cast<std::size_t>(k)];
      const bool is_one = k == 3 && random.one_in(2);  // a null q
      for (std::size_t i = 0; i < kStageFragments; ++i) array.push_back(is_one ? 1.0F : random.real_f(-2, 2));
      if (stages.reads(u, k) && !is_one)
        batch.value[static_cast<std::size_t>(u)][static_cast<std::size_t>(k)] = array.data();
    }
  }
  std::vector<TextureShaderResult> results;
  for (std::size_t i = 0; i < kStageFragments; ++i) {
    StageInputs inputs;
    for (std::size_t u = 0; u < kTextureStages; ++u) {
      for (std::size_t k = 0; k < 4; ++k) inputs.at[u][k] = given[u][k][i];
    }
    results.push_back(stages.evaluate(inputs));
  }
  for (const std::int64_t target : simd_targets()) {
    const OnTarget on(target);
    StageBatchResult result;
    StageOutputs outputs;
    for (std::size_t u = 0; u < kTextureStages; ++u) outputs.codes[u] = result.codes[u].at();
    stages.run(batch, kStageFragments, outputs);
    for (std::size_t i = 0; i < kStageFragments; ++i) {
      for (std::size_t u = 0; u < kTextureStages; ++u) {
        EXPECT_EQ(result.codes[u].of(i), results[i].stage[u].codes)
            << simd_target_name(target) << ", fragment " << i << ", stage " << u;
      }
    }
  }
  return results;
}

// The stages of dot products on the texel of stage 0, without a texture on unit 3.
TextureShaderState dot_products(TextureOperation two, TextureOperation three) {
  TextureShaderState state;
  state.enabled = true;
  state.rules = StageRules::nv2a;
  state.stage[0].operation = TextureOperation::texture_2d;
  state.stage[1].operation = TextureOperation::dot_product;
  state.stage[2].operation = two;
  state.stage[3].operation = three;
  return state;
}

TEST(TextureStages, ADiffuseCubeMapReadsTheStageAfterItEvenIfThatIsInconsistent) {
  Random random(kStageSeed + 2);
  const Texture flat = random_texture(random, TextureTarget::texture_2d, InternalFormat::rgba8, 4, 4, false),
                cube = random_texture(random, TextureTarget::cube_map, InternalFormat::rgba8, 4, 4, false);
  StageUnits units{.texture = {&flat, nullptr, &cube, nullptr}};
  units.sampler.fill(kNearestSampler);
  const auto stages = TextureStages::make(
      profiles::nv2a,
      dot_products(TextureOperation::dot_product_diffuse_cube_map, TextureOperation::dot_product_reflect_cube_map),
      units);
  ASSERT_TRUE(stages.ok()) << stages.error().text();
  ASSERT_TRUE(stages->program().stage[2].inconsistent.empty());
  ASSERT_FALSE(stages->program().stage[3].inconsistent.empty());
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(stages->reads(3, k)) << k;
  EXPECT_FALSE(stages->reads(3, 3));
  expect_same_batches(*stages, random);
}

// A depth is compared with r, which is 0 where two dot products are the coordinates.
TEST(TextureStages, TwoDotProductsCompareADepthWithZero) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  Random random(kStageSeed + 3);
  const Texture flat = random_texture(random, TextureTarget::texture_2d, InternalFormat::rgba8, 4, 4, false);
  const std::vector<std::uint32_t> half{0x7FFFFF};
  const Texture depth = make_texture(TextureTarget::texture_2d, InternalFormat::depth24, {{{1, 1, half}}}).value();
  StageUnits units{.texture = {&flat, nullptr, &depth, nullptr}};
  units.sampler.fill(kNearestSampler);
  units.sampler[2].comparison = DepthComparison::lequal;
  const auto stages = TextureStages::make(
      profiles::nv2a, dot_products(TextureOperation::dot_product_2d, TextureOperation::none), units);
  ASSERT_TRUE(stages.ok()) << stages.error().text();
  int above_half = 0;
  for (const TextureShaderResult& one : expect_same_batches(*stages, random)) {
    EXPECT_EQ(one.stage[2].codes, (Rgba9{255, 255, 255, 255}));
    above_half += *one.stage[1].dot > 0.5F ? 1 : 0;
  }
  EXPECT_GT(above_half, 0);
}

}  // namespace
}  // namespace ninebit::test
