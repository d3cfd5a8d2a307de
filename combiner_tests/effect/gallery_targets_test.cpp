// The gallery on every SIMD target, against its golden hashes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "combiner_tests/combiner/simd_targets.h"
#include "ninebit/effect/effect_files.h"
#include "ninebit/effect/effect_json.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/system/hashing/openssl.h"

namespace ninebit::test {
namespace {

const HardwareProfile& profile_named(const std::string& name) {
  for (const HardwareProfile& profile : hardware_profiles()) {
    if (profile.name == name) return profile;
  }
  return hardware_profiles()[0];
}

TEST(Gallery, IsTheSameOnEveryTarget) {
  const std::string folder = NINEBIT_SOURCE_DIR "/scenes/effects/";
  std::ifstream golden(folder + "expected_hashes.json");
  const auto expected = nlohmann::json::parse(golden);
  for (const auto& [name, hash] : expected.items()) {
    const auto effect = read_effect(folder + name + ".json");
    ASSERT_TRUE(effect) << name;
    for (const std::int64_t target : simd_targets()) {
      const OnTarget on_target(target);
      auto renderer = EffectRenderer::make(*effect, profile_named(effect->profile), file_readers(), EffectOptions{});
      ASSERT_TRUE(renderer) << renderer.error().text();
      ASSERT_TRUE(renderer->draw({}));
      Sha256 found;
      for (int c = 0; c < 4; ++c) found.add(renderer->picture().color(c));
      EXPECT_EQ(found.finish(), hash) << name << " on " << simd_target_name(target);
    }
  }
}

}  // namespace
}  // namespace ninebit::test
