// The stencil test over all values: functions, operations, masks, and formats with fewer bits or none.
#include "src/raster/fragment/stencil.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "combiner_tests/raster/fragment_support.h"

namespace ninebit::test {
namespace {

using Function = bool (*)(int, int);
// In the order of CompareFunction.
constexpr std::array<Function, 8> kFunctions{[](int, int) { return false; },      [](int a, int b) { return a < b; },
                                             [](int a, int b) { return a == b; }, [](int a, int b) { return a <= b; },
                                             [](int a, int b) { return a > b; },  [](int a, int b) { return a != b; },
                                             [](int a, int b) { return a >= b; }, [](int, int) { return true; }};

// 8 functions, 256 references, 256 masks, 256 stored values.
TEST(Stencil, EveryFunctionOfEveryReferenceMaskAndStoredValue) {
  const int step = kSlowBuild ? 15 : 1;  // of references and masks: 0 and 255 are among them
  std::uint64_t wrong = 0, passed = 0;
  for (std::size_t function = 0; function < 8; ++function) {
    for (int reference = 0; reference < 256; reference += step) {
      for (int mask = 0; mask < 256; mask += step) {
        const StencilSide side({.function = static_cast<CompareFunction>(function),
                                .reference = reference,
                                .mask = static_cast<std::uint8_t>(mask)},
                               8);
        for (int stored = 0; stored < 256; ++stored) {
          const bool expected = kFunctions[function](reference & mask, stored & mask);
          wrong += side.passes(static_cast<std::uint8_t>(stored)) != expected ? 1U : 0U;
          passed += expected ? 1U : 0U;
        }
      }
    }
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GE(passed, kSlowBuild ? 100000U : 40000000U);
}

// 8 operations, 256 references, 256 write masks, 256 stored values; each operation in each of the three places.
TEST(Stencil, EveryOperationOnEveryReferenceMaskAndStoredValue) {
  const int step = kSlowBuild ? 15 : 1;
  std::uint64_t wrong = 0, changed = 0;
  for (int operation = 0; operation < 8; ++operation) {
    for (int reference = 0; reference < 256; reference += step) {
      std::array<int, 256> unmasked{};  // by the oracle
      for (int stored = 0; stored < 256; ++stored) {
        unmasked[static_cast<std::size_t>(stored)] =
            oracle::after_stencil({.reference = reference}, static_cast<StencilOperation>(operation), 8, stored);
      }
      for (int mask = 0; mask < 256; mask += step) {
        const auto named = static_cast<StencilOperation>(operation);
        const int place = (operation + reference + mask) % 3;
        StencilFace face{.reference = reference, .write_mask = static_cast<std::uint8_t>(mask)};
        (place == 0 ? face.fail : place == 1 ? face.depth_fail : face.depth_pass) = named;
        const StencilSide side(face, 8);
        for (int stored = 0; stored < 256; ++stored) {
          const auto byte = static_cast<std::uint8_t>(stored);
          const int result = place == 0   ? side.after_fail(byte)
                             : place == 1 ? side.after_depth_fail(byte)
                                          : side.after_depth_pass(byte);
          const int expected = (stored & ~mask) | (unmasked[static_cast<std::size_t>(stored)] & mask);
          wrong += result != expected ? 1U : 0U;
          changed += result != stored ? 1U : 0U;
        }
      }
    }
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GE(changed, kSlowBuild ? 100000U : 40000000U);
}

// By hand: stored, reference, and what each operation makes of them without masks.
TEST(Stencil, OperationsByHand) {
  struct Row {
    std::uint8_t stored;
    std::array<int, 8> after;  // keep, zero, replace, incr, decr, invert, incr_wrap, decr_wrap
  };
  for (const Row& row : {Row{0, {0, 0, 77, 1, 0, 255, 1, 255}}, Row{1, {1, 0, 77, 2, 0, 254, 2, 0}},
                         Row{200, {200, 0, 77, 201, 199, 55, 201, 199}}, Row{255, {255, 0, 77, 255, 254, 0, 0, 254}}}) {
    for (std::size_t operation = 0; operation < 8; ++operation) {
      const StencilSide side({.reference = 77, .mask = 0, .depth_pass = static_cast<StencilOperation>(operation)}, 8);
      EXPECT_EQ(side.after_depth_pass(row.stored), row.after[operation]) << int{row.stored} << ' ' << operation;
    }
  }
  // A masked write keeps the other bits: 0x0F of 0x5A over 0xC3.
  const StencilSide side({.reference = 0x5A, .write_mask = 0x0F, .depth_pass = StencilOperation::replace}, 8);
  EXPECT_EQ(side.after_depth_pass(0xC3), 0xCA);
}

TEST(Stencil, ReferencesAreClampedToTheFormat) {
  constexpr int kLowest = std::numeric_limits<int>::min(), kHighest = std::numeric_limits<int>::max();
  const auto written = [](int reference, int bits) {
    return int{
        StencilSide({.reference = reference, .depth_pass = StencilOperation::replace}, bits).after_depth_pass(0)};
  };
  for (const int low : {kLowest, -1, 0}) {
    EXPECT_EQ(written(low, 8), 0);
    EXPECT_EQ(written(low, 1), 0);
  }
  EXPECT_EQ(written(255, 8), 255);
  for (const int high : {256, 1000, kHighest}) EXPECT_EQ(written(high, 8), 255);
  for (const int high : {1, 2, 254, kHighest}) EXPECT_EQ(written(high, 1), 1);
  // The comparison takes the clamped reference too: 256 & 0xFF would be 0.
  EXPECT_TRUE(StencilSide({.function = CompareFunction::equal, .reference = 256}, 8).passes(255));
  EXPECT_FALSE(StencilSide({.function = CompareFunction::equal, .reference = 256}, 8).passes(0));
}

// One bit: all functions, operations, masks and stored bytes, whose upper bits are not the stencil's.
TEST(Stencil, OneBit) {
  std::uint64_t wrong = 0, changed = 0;
  for (unsigned i = 0; i < 8 * 8 * 4; ++i) {
    const auto function = static_cast<CompareFunction>(i % 8);
    const auto operation = static_cast<StencilOperation>(i / 8 % 8);
    const int reference = static_cast<int>(i / 64) - 1;  // -1, 0, 1, 2
    for (const int mask : {0, 1, 2, 0xFE, 0xFF}) {
      for (const int write_mask : {0, 1, 2, 0xFE, 0xFF}) {
        StencilFace face{.function = function,
                         .reference = reference,
                         .mask = static_cast<std::uint8_t>(mask),
                         .write_mask = static_cast<std::uint8_t>(write_mask),
                         .depth_pass = operation};
        const StencilSide side(face, 1);
        for (int stored = 0; stored < 256; ++stored) {
          const int clamped = reference < 0 ? 0 : reference > 1 ? 1 : reference;
          const auto byte = static_cast<std::uint8_t>(stored);
          const bool passes = kFunctions[i % 8](clamped & mask, stored & 1 & mask);
          wrong += side.passes(byte) != passes ? 1U : 0U;
          const int after = side.after_depth_pass(byte);
          wrong += after != oracle::after_stencil(face, operation, 1, stored) || after / 2 != stored / 2 ? 1U : 0U;
          changed += after != stored ? 1U : 0U;
        }
      }
    }
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GE(changed, 10000U);
}

// A format without stencil bits: the test passes, nothing is written, and no plane is needed.
TEST(Stencil, WithoutBitsTheTestPassesAndWritesNothing) {
  oracle::Picture start = empty_picture(1, 1, DepthStencilFormat::d16);
  start.depth[0] = 100;
  start.stencil[0] = 42;
  PipelineState state;
  state.stencil_test.enabled = true;
  state.stencil_test.front = {.function = CompareFunction::never,
                              .reference = 1,
                              .fail = StencilOperation::replace,
                              .depth_fail = StencilOperation::invert,
                              .depth_pass = StencilOperation::incr};
  state.depth_test = {true, CompareFunction::less, false};
  for (const bool with_plane : {false, true}) {
    PicturePlanes planes(start);
    std::uint8_t stencil = 42;
    if (with_plane) planes.target.stencil = {&stencil, 1};
    const FragmentOperations operations(state, planes.target);
    const UncoloredFragment before{.depth = 99}, behind{.depth = 101};
    EXPECT_FALSE(operations.is_lost_early(before));
    EXPECT_TRUE(operations.apply(before, {1, 2, 3, 4}));
    EXPECT_FALSE(operations.apply(behind, {5, 6, 7, 8}));
    EXPECT_EQ(planes.picture().color[0], (oracle::Bytes{1, 2, 3, 4}));
    EXPECT_EQ(stencil, 42);
  }
}

// The counting of shadow volumes: back faces that fail the depth test up, front faces down, in one draw.
TEST(Stencil, SidesHaveOperationsOfTheirOwn) {
  oracle::Picture start = empty_picture(1, 1);
  start.depth[0] = 100;
  PicturePlanes planes(start);
  PipelineState state;
  state.color_mask = {};
  state.depth_test = {true, CompareFunction::less, false};
  state.stencil_test.enabled = true;
  state.stencil_test.front.depth_fail = StencilOperation::decr_wrap;
  state.stencil_test.back = StencilFace{.depth_fail = StencilOperation::incr_wrap};
  const FragmentOperations operations(state, planes.target);
  const auto draw = [&](std::uint32_t depth, bool front) {
    const UncoloredFragment fragment{.depth = depth, .front_facing = front};
    if (!operations.is_lost_early(fragment)) operations.apply(fragment, {});
    return int{planes.picture().stencil[0]};
  };
  EXPECT_EQ(draw(50, false), 0);
  EXPECT_EQ(draw(150, false), 1);
  EXPECT_EQ(draw(150, false), 2);
  EXPECT_EQ(draw(150, true), 1);
  EXPECT_EQ(draw(50, true), 1);
  EXPECT_EQ(draw(150, true), 0);
  EXPECT_EQ(draw(150, true), 255);
}

}  // namespace
}  // namespace ninebit::test
