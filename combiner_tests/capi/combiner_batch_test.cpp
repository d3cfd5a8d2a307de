// The batch behind the header of the two C99 files gives the bits of the C file.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/support/chip_words.h"

namespace ninebit::test {
namespace {

constexpr std::size_t kCount = 700;  // two batches and a piece of one

using Planes = std::array<std::array<std::vector<std::int16_t>, 4>, NBC_REGISTERS>;

// A random valid program for the NV2A, through its words.
nbc_program random_program(Random& random) {
  const CombinerState state = random_state(random, profiles::nv2a);
  nbc_words words{};
  const auto encoded = encode_register_words(state, ChipClass::nv20, profiles::nv2a);
  EXPECT_TRUE(encoded);
  for_each_word(words, ChipClass::nv20, [&](const std::string& name, std::uint32_t& to) {
    for (const RegisterWord& word : *encoded) {
      if (word.name == name) to = word.value;
    }
  });
  nbc_state c_state;
  nbc_program program{};
  EXPECT_TRUE(nbc_read_words(&words, NBC_NV20, &c_state));
  EXPECT_TRUE(nbc_compile(&c_state, nbc_find_profile("nv2a"), &program));
  return program;
}

struct Arrays {
  const std::int16_t* input[NBC_REGISTERS][4];
  std::array<std::vector<std::int16_t>, 4> colors;
  std::int16_t* color[4];

  explicit Arrays(const Planes& planes) {
    for (std::size_t r = 0; r < NBC_REGISTERS; ++r) {
      for (std::size_t c = 0; c < 4; ++c) input[r][c] = planes[r][c].data();
    }
    for (std::size_t c = 0; c < 4; ++c) {
      colors[c].assign(kCount, -1);
      color[c] = colors[c].data();
    }
  }
};

Planes random_planes(Random& random) {
  Planes planes;
  for (auto& reg : planes) {
    for (auto& plane : reg) {
      for (std::size_t i = 0; i < kCount; ++i) {
        plane.push_back(static_cast<std::int16_t>(random_code(random, profiles::nv2a)));
      }
    }
  }
  return planes;
}

TEST(CombinerBatch, GivesTheBitsOfTheCFile) {
  Random random(53);
  int colored = 0;
  for (int i = 0; i < 40; ++i) {
    const nbc_program program = random_program(random);
    const Planes planes = random_planes(random);
    Arrays arrays(planes);
    nbc_batch* const batch = nbc_batch_create(&program);
    ASSERT_NE(batch, nullptr);
    ASSERT_TRUE(nbc_batch_evaluate(batch, kCount, arrays.input, arrays.color));
    nbc_batch_free(batch);
    for (std::size_t f = 0; f < kCount; ++f) {
      std::int16_t registers[NBC_REGISTERS][4], color[4];
      for (std::size_t r = 0; r < NBC_REGISTERS; ++r) {
        for (std::size_t c = 0; c < 4; ++c) registers[r][c] = planes[r][c][f];
      }
      nbc_evaluate(&program, registers, color);
      for (std::size_t c = 0; c < 4; ++c) ASSERT_EQ(arrays.colors[c][f], color[c]) << i << ' ' << f;
      colored += color[0] > 0 && color[0] < 255 ? 1 : 0;
    }
  }
  EXPECT_GT(colored, 1000);
}

TEST(CombinerBatch, RefusesCodesOutOfRangeAndTakesMissingPlanes) {
  Random random(54);
  const nbc_program program = random_program(random);
  Planes planes = random_planes(random);
  nbc_batch* const batch = nbc_batch_create(&program);
  ASSERT_NE(batch, nullptr);
  planes[NBC_TEXTURE0][NBC_GREEN][kCount - 1] = 256;
  Arrays arrays(planes);
  EXPECT_FALSE(nbc_batch_evaluate(batch, kCount, arrays.input, arrays.color));
  EXPECT_EQ(arrays.colors[0], std::vector<std::int16_t>(kCount, -1));
  for (auto& reg : arrays.input) {
    for (const std::int16_t*& plane : reg) plane = nullptr;
  }
  arrays.color[NBC_ALPHA] = nullptr;
  EXPECT_TRUE(nbc_batch_evaluate(batch, kCount, arrays.input, arrays.color));
  EXPECT_GE(arrays.colors[0][0], 0);
  EXPECT_EQ(arrays.colors[NBC_ALPHA][0], -1);
  nbc_batch_free(batch);
  nbc_batch_free(nullptr);
}

}  // namespace
}  // namespace ninebit::test
