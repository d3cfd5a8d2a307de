// Fragments that are lost early leave the planes as if nothing had been lost early, while others wait in a batch; and
// the operations are those of the oracle.
#include <gtest/gtest.h>

#include <algorithm>

#include "combiner_tests/raster/fragment_support.h"
#include "combiner_tests/support/environment.h"
#include "src/raster/fragment/output_planes.h"

namespace ninebit::test {
namespace {

constexpr int kRejectionWidth = 4, kRejectionHeight = 3;

struct RejectionCase {
  PipelineState state;
  oracle::Picture start;
  bool at_depth_pass = false;
  std::size_t batch = 1;  // fragments that wait together
  std::vector<oracle::Incoming> fragments;
};

RejectionCase random_case(std::uint64_t index) {
  Random random(71, index);
  RejectionCase c;
  const DepthStencilFormat format = kFormats[random.below(3)];
  randomize_fragment_operations(random, c.state);
  c.start = random_picture(random, kRejectionWidth, kRejectionHeight, format);
  c.start.has_alpha = !random.one_in(4);
  c.at_depth_pass = random.one_in(3);
  c.batch = static_cast<std::size_t>(random.pick({1, 2, 7, 64, 256}));
  for (int i = random.between(1, 150); i > 0; --i) {
    c.fragments.push_back({.x = random.below(kRejectionWidth),
                           .y = random.below(kRejectionHeight),
                           .depth = some_depth(random, format),
                           .number = static_cast<std::uint32_t>(c.fragments.size()),
                           .front_facing = random.one_in(2),
                           .color = {edge_byte(random), random.byte(), random.byte(), edge_byte(random)}});
  }
  return c;
}

struct Waiting {
  std::vector<UncoloredFragment> fragments;
  std::vector<ColorBytes> colors;
};

void flush(const FragmentOperations& operations, const OutputPlanes& outputs, Waiting& waiting) {
  std::vector<FragmentOutcome> outcomes;
  for (std::size_t i = 0; i < waiting.fragments.size(); ++i) {
    FragmentOutcome& outcome = outcomes.emplace_back();
    outcome.depth_passed = operations.depth_passes(waiting.fragments[i]);
    outcome.drawn = operations.apply(waiting.fragments[i], waiting.colors[i]);
  }
  outputs.write({.fragments = waiting.fragments, .outcomes = outcomes, .colors = waiting.colors});
  waiting = {};
}

// Returns how many fragments were lost early.
int run(const RejectionCase& c, bool reject_early, oracle::Picture& result) {
  PicturePlanes planes(c.start, c.at_depth_pass);
  const FragmentOperations operations(c.state, planes.target, reject_early);
  const OutputPlanes outputs(planes.target);
  Waiting waiting;
  int lost = 0;
  for (const oracle::Incoming& f : c.fragments) {
    const UncoloredFragment fragment{f.x, f.y, static_cast<std::uint32_t>(f.depth), f.number, f.front_facing};
    if (operations.is_lost_early(fragment)) {
      ++lost;
      continue;
    }
    waiting.fragments.push_back(fragment);
    waiting.colors.push_back(f.color);
    if (waiting.fragments.size() == c.batch) flush(operations, outputs, waiting);
  }
  flush(operations, outputs, waiting);
  result = planes.picture();
  return lost;
}

std::string describe(const RejectionCase& c, std::uint64_t index) {
  return "case " + std::to_string(index) + ", NINEBIT_RASTER_INDEX=" + std::to_string(index) +
         " runs it alone: " + describe_operations(c.state) + ", format " +
         std::to_string(static_cast<int>(c.start.format)) + ", batch of " + std::to_string(c.batch) +
         ", at depth pass " + std::to_string(c.at_depth_pass) + ", alpha plane " + std::to_string(c.start.has_alpha);
}

TEST(EarlyRejection, ChangesNothingWhateverWaits) {
  const std::uint64_t count = kSlowBuild ? 1500 : 20000;
  const CaseRange range("NINEBIT_RASTER_INDEX", count);
  std::uint64_t lost = 0, lost_two_sided = 0, lost_blending = 0, lost_at_depth_pass = 0;
  oracle::Tally tally;
  for (std::uint64_t index = range.first; index < range.end; ++index) {
    const RejectionCase c = random_case(index);
    oracle::Picture expected = c.start, late, early;
    for (const oracle::Incoming& f : c.fragments) oracle::process(c.state, f, expected, tally);
    if (!c.at_depth_pass) expected.captured = c.start.captured;
    ASSERT_EQ(run(c, false, late), 0);
    ASSERT_TRUE(same_samples(late, expected)) << describe(c, index);
    const auto n = static_cast<std::uint64_t>(run(c, true, early));
    ASSERT_TRUE(same_samples(early, expected)) << "with early rejection, " << describe(c, index);
    lost += n;
    if (c.state.stencil_test.enabled && c.state.stencil_test.back) lost_two_sided += n;
    if (c.state.blend.enabled) lost_blending += n;
    if (c.at_depth_pass) lost_at_depth_pass += n;
  }
  if (!range.is_whole) return;
  EXPECT_GE(lost, 5 * count);
  EXPECT_GE(lost_two_sided, count / 4);
  EXPECT_GE(lost_blending, count);
  EXPECT_GE(lost_at_depth_pass, count);
  for (const std::uint64_t some : {tally.alpha_fail, tally.stencil_fail, tally.depth_fail, tally.drawn}) {
    EXPECT_GE(some, tally.fragments / 20);
  }
}

// Cases that random ones could miss: each is lost early just where that is exact.
TEST(EarlyRejection, IsUsedWhereItIsExact) {
  oracle::Picture picture = empty_picture(1, 1);
  picture.depth[0] = 5;
  picture.stencil[0] = 3;
  const UncoloredFragment behind{.depth = 9}, back_behind{.depth = 9, .front_facing = false};
  const auto lost = [&](const PipelineState& state, const UncoloredFragment& fragment, bool at_depth_pass = false) {
    PicturePlanes planes(picture, at_depth_pass);
    return FragmentOperations(state, planes.target).is_lost_early(fragment);
  };
  PipelineState depth;
  depth.depth_test = {true, CompareFunction::less, true};
  EXPECT_TRUE(lost(depth, behind));
  EXPECT_TRUE(lost(depth, behind, true));
  depth.blend = {.enabled = true, .source = BlendFactor::one, .destination = BlendFactor::one};
  EXPECT_TRUE(lost(depth, behind));
  depth.depth_test.function = CompareFunction::notequal;
  picture.depth = {9};
  EXPECT_FALSE(lost(depth, behind));
  depth.depth_test.write = false;
  EXPECT_TRUE(lost(depth, behind));

  // Shadow volumes: back faces count their failures, front faces leave them alone.
  picture.depth = {5};
  PipelineState volume;
  volume.depth_test = {true, CompareFunction::less, false};
  volume.stencil_test.enabled = true;
  volume.stencil_test.back = StencilFace{.depth_fail = StencilOperation::incr_wrap};
  EXPECT_TRUE(lost(volume, behind));
  EXPECT_FALSE(lost(volume, back_behind));
  picture.format = DepthStencilFormat::d16;  // nowhere to count
  EXPECT_TRUE(lost(volume, back_behind));
  picture.format = DepthStencilFormat::d24s8;

  // The stencil test itself, as long as neither side writes and no plane asks the depth test alone.
  PipelineState stencil;
  stencil.stencil_test.enabled = true;
  stencil.stencil_test.front.function = CompareFunction::never;
  EXPECT_TRUE(lost(stencil, behind));
  EXPECT_FALSE(lost(stencil, behind, true));
  stencil.stencil_test.back = StencilFace{.depth_pass = StencilOperation::incr};
  EXPECT_FALSE(lost(stencil, behind));
  stencil.stencil_test.back->write_mask = 0;
  EXPECT_TRUE(lost(stencil, behind));
  EXPECT_FALSE(lost(stencil, back_behind));
}

}  // namespace
}  // namespace ninebit::test
