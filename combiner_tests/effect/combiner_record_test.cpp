// What is recorded of a pass's combiners: the registers that a probe finds, and the colours that the reference computes
// from them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/effect/effect_files.h"
#include "ninebit/effect/effect_json.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {
namespace {

RegisterFile recorded_registers(const CombinerRecord& record, std::size_t pixel) {
  RegisterFile registers;
  for (std::size_t r = 0; r < kRecordedRegisters.size(); ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      registers.value[static_cast<std::size_t>(kRecordedRegisters[r])][c] = record.inputs[r][c][pixel];
    }
  }
  return registers;
}

// The last fragment that passed the depth test, or nullptr.
const ProbedFragment* recorded_fragment(const ProbedPass& pass) {
  const auto found = std::find_if(pass.fragments.rbegin(), pass.fragments.rend(),
                                  [](const ProbedFragment& f) { return f.depth_passes; });
  return found == pass.fragments.rend() ? nullptr : &*found;
}

struct Seen {
  int passes = 0, drawn = 0, empty = 0, probed = 0;
};

void check_pass(const Effect& effect, std::size_t number, const HardwareProfile& profile, Seen& seen) {
  const glm::ivec2 at(effect.width * 2 / 5, effect.height * 2 / 5);
  auto renderer = EffectRenderer::make(effect, profile, file_readers(), {.pixel = at, .recorded_pass = number});
  ASSERT_TRUE(renderer) << renderer.error().text();
  ASSERT_TRUE(renderer->draw());
  const CombinerRecord& record = renderer->recorded();
  ASSERT_EQ(record.drawn.size(), static_cast<std::size_t>(record.width) * static_cast<std::size_t>(record.height));
  ++seen.passes;
  for (std::size_t i = 0; i < record.drawn.size(); ++i) {
    if (!record.drawn[i]) {
      ++seen.empty;
      EXPECT_EQ(record.inputs[0][3][i], 0);
      continue;
    }
    ++seen.drawn;
    if (i % 7 != 0) continue;
    const Rgba9 out = evaluate(*record.program, recorded_registers(record, i));
    for (std::size_t c = 0; c < 4; ++c) {
      ASSERT_EQ(record.output[c][i], to_byte(profile, out[c])) << "pixel " << i << ", component " << c;
    }
  }
  const auto& probed = renderer->probed();
  const auto pass = std::find_if(probed.begin(), probed.end(),
                                 [&](const ProbedPass& p) { return p.name == effect.passes[number].name; });
  if (pass == probed.end()) return;  // it draws into another target than the picture
  const auto pixel =
      static_cast<std::size_t>(at.y) * static_cast<std::size_t>(record.width) + static_cast<std::size_t>(at.x);
  const ProbedFragment* const fragment = recorded_fragment(*pass);
  ASSERT_EQ(record.drawn[pixel], fragment != nullptr);
  if (fragment == nullptr) return;
  ++seen.probed;
  for (const Register reg : kRecordedRegisters) {
    const auto r = static_cast<std::size_t>(reg);
    EXPECT_EQ(recorded_registers(record, pixel).value[r], fragment->registers.value[r]) << name_of(reg);
  }
}

TEST(CombinerRecord, IsWhatTheCombinersOfTheGalleryReadAndGave) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  Seen seen;
  int effects = 0;
  for (const auto& entry : std::filesystem::directory_iterator(NINEBIT_SOURCE_DIR "/scenes/effects")) {
    if (entry.path().extension() != ".json" || entry.path().filename() == "expected_hashes.json") continue;
    if (++effects % 4 != 0 && ninebit::test::kSlowBuild) continue;
    SCOPED_TRACE(entry.path().filename());
    const auto effect = read_effect(entry.path().string());
    ASSERT_TRUE(effect);
    const HardwareProfile* const own = find_profile(effect->profile);
    for (std::size_t i = 0; i < effect->passes.size(); ++i) {
      if (effect->passes[i].program.empty()) continue;
      check_pass(*effect, i, own != nullptr ? *own : profiles::geforce2, seen);
    }
  }
  if (ninebit::test::kSlowBuild) return;  // a quarter of them
  EXPECT_GE(seen.passes, 20);
  EXPECT_GE(seen.probed, 15);
  EXPECT_GT(seen.drawn, 500'000);
  EXPECT_GT(seen.empty, 50'000) << "around meshes";
}

// Recording changes no picture.
TEST(CombinerRecord, LeavesThePictureAsItIs) {
  const auto effect = read_effect(NINEBIT_SOURCE_DIR "/scenes/effects/index_cube.json");
  ASSERT_TRUE(effect);
  const auto draw = [&](const EffectOptions& options) {
    auto renderer = EffectRenderer::make(*effect, profiles::geforce2, file_readers(), options);
    EXPECT_TRUE(renderer);
    EXPECT_TRUE(renderer->draw());
    return renderer;
  };
  const auto plain = draw({}), recorded = draw({.recorded_pass = 2});
  for (int c = 0; c < 4; ++c) EXPECT_TRUE(plain->picture().color(c) == recorded->picture().color(c));
  EXPECT_TRUE(plain->picture().depth() == recorded->picture().depth());
  EXPECT_TRUE(plain->picture().stencil() == recorded->picture().stencil());
  EXPECT_FALSE(recorded->recorded().drawn.empty());
}

}  // namespace
}  // namespace ninebit::test
