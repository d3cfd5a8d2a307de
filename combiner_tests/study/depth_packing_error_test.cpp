// Round trips of packed depths: against a loop of its own, against digits by hand, the same for any number of threads.
#include "ninebit/study/depth_packing_error.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "combiner_tests/support/slow_build.h"

namespace {

using namespace ninebit;

RoundTripError measured(std::string_view packing, ChannelStorage storage, DepthSet set, std::uint32_t float_step = 64) {
  const auto error = measure_round_trip(*find_depth_packing(packing), storage, set, float_step, {});
  EXPECT_TRUE(error);
  return *error;
}

std::vector<float> depths_of(DepthSet set, std::uint32_t float_step) {
  std::vector<float> depths;
  if (set == DepthSet::bits16) {
    for (int n = 0; n <= 65535; ++n) depths.push_back(static_cast<float>(n / 65535.0));
  } else {
    const auto one = std::bit_cast<std::uint32_t>(1.0F);
    for (std::uint32_t bits = 0; bits < one; bits += float_step) depths.push_back(std::bit_cast<float>(bits));
    depths.push_back(1.0F);
  }
  return depths;
}

void expect_like_a_plain_loop(const DepthPacking& packing, ChannelStorage storage, DepthSet set,
                              std::uint32_t float_step) {
  const std::vector<float> depths = depths_of(set, float_step);
  std::vector<float> seen;
  std::uint64_t exact = 0, inversions = 0;
  long double sum = 0.0L, sizes = 0.0L;
  double largest = 0.0;
  float before = 0.0F;
  for (const float depth : depths) {
    const float back = read_depth(packing, store_depth(packing, depth, storage), storage);
    const double error = static_cast<double>(back) - static_cast<double>(depth);
    seen.push_back(back);
    if (error == 0.0) ++exact;
    if (back < before) ++inversions;
    before = back;
    if (depth == 1.0F) continue;
    sum += error;
    sizes += std::fabs(error);
    largest = std::max(largest, std::fabs(error));
  }
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  const RoundTripError e = measured(packing.name, storage, set, float_step);
  const auto n = static_cast<double>(depths.size() - 1);  // depth 1 has rows of its own
  EXPECT_EQ(e.depths, depths.size());
  EXPECT_EQ(e.exact, exact) << packing.name;
  EXPECT_EQ(e.distinct, seen.size()) << packing.name;
  EXPECT_EQ(e.inversions, inversions) << packing.name;
  EXPECT_EQ(e.max_error, largest) << packing.name;
  EXPECT_NEAR(e.mean_error, static_cast<double>(sizes) / n, 1e-12) << packing.name;
  EXPECT_NEAR(e.mean_bias, static_cast<double>(sum) / n, 1e-12) << packing.name;
  EXPECT_EQ(std::fabs(static_cast<double>(e.worst_back) - static_cast<double>(e.worst_depth)), largest);
  EXPECT_EQ(read_depth(packing, store_depth(packing, e.worst_depth, storage), storage), e.worst_back);
}

TEST(DepthPackingError, SixteenBitsMatchAPlainLoop) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (const DepthPacking& packing : depth_packings()) {
    for (const StorageRule& rule : storage_rules()) {
      expect_like_a_plain_loop(packing, rule.storage, DepthSet::bits16, 1);
    }
  }
}

// A step that divides the floats below 1, and one that does not.
TEST(DepthPackingError, FloatsMatchAPlainLoop) {
  for (const std::uint32_t step : {65536U, 100'003U}) {
    for (const DepthPacking& packing : depth_packings()) {
      for (const StorageRule& rule : storage_rules()) {
        expect_like_a_plain_loop(packing, rule.storage, DepthSet::floats, step);
      }
    }
  }
}

TEST(DepthPackingError, SetsGoFromZeroToOne) {
  for (const DepthSet set : kDepthSets) {
    for (const std::uint32_t step : {1U, 3U, 64U}) {
      const std::uint64_t n = depth_count(set, step);
      EXPECT_EQ(depth_at(set, step, 0), 0.0F);
      EXPECT_EQ(depth_at(set, step, n - 1), 1.0F);
      EXPECT_LT(depth_at(set, step, n - 2), 1.0F);
    }
  }
  EXPECT_EQ(depth_count(DepthSet::bits24, 64), 1U << 24);
  EXPECT_EQ(depth_count(DepthSet::floats, 1), 0x3F800001U);
  EXPECT_EQ(depth_at(DepthSet::floats, 1, 1), std::bit_cast<float>(1U));  // the smallest float above 0
}

// n / 16777215 in a float names n: no two are the same, and a packing that loses nothing brings all of them back.
TEST(DepthPackingError, AllDepthsOf24BitsComeBackThroughDigits) {
  const RoundTripError e = measured("rgba8-modf", ChannelStorage::round, DepthSet::bits24);
  EXPECT_EQ(e.depths, 1U << 24);
  EXPECT_EQ(e.distinct, 1U << 24);
  EXPECT_EQ(e.inversions, 0U);
  EXPECT_LT(e.max_error, std::ldexp(1.0, -32));
}

// Two bytes hold 65,536 depths at most, the nearest of which is half a step away.
TEST(DepthPackingError, TwoBytesHold16Bits) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const RoundTripError rounded = measured("rg8-modf", ChannelStorage::round, DepthSet::bits24);
  EXPECT_LE(rounded.distinct, 65536U);
  EXPECT_NEAR(rounded.max_error, std::ldexp(1.0, -17), std::ldexp(1.0, -23));
  const RoundTripError cut = measured("rg8-modf", ChannelStorage::truncate, DepthSet::bits24);
  EXPECT_NEAR(cut.max_error, std::ldexp(1.0, -16), std::ldexp(1.0, -23));
  EXPECT_LT(cut.mean_bias, -0.4 * std::ldexp(1.0, -16));
}

TEST(DepthPackingError, EndsOfTheRange) {
  const auto one = [](std::string_view name) {
    return measured(name, ChannelStorage::round, DepthSet::bits16).one_back;
  };
  EXPECT_EQ(one("rgba8-fract"), 0.0F);
  EXPECT_EQ(one("rgba8-mod"), 1.0F);
  EXPECT_EQ(one("rgba8-256over255"), 0.99609375F);
  EXPECT_EQ(one("rgba8-modf"), 1.0F);
  for (const DepthPacking& packing : depth_packings()) {
    EXPECT_EQ(measured(packing.name, ChannelStorage::truncate, DepthSet::bits16).zero_back, 0.0F);
  }
}

// fract stores a digit d as the nearest byte to 255/256 d, and a byte b reads as 256/255 b digits.
TEST(DepthPackingError, FractShiftsAsItsDigitsSay) {
  const DepthPacking& fract = *find_depth_packing("rgba8-fract");
  const auto byte_of = [](int digit) { return (digit * 255 + 128) / 256; };
  for (int highest = 0; highest < 256; ++highest) {
    for (int second = 0; second < 256; ++second) {
      const TwoDigits stored = store_two_digits(fract, ChannelStorage::round, highest, second);
      ASSERT_EQ(stored.highest_byte, byte_of(highest));
      ASSERT_EQ(stored.second_byte, byte_of(second));
      const double back = 256.0 / 255.0 * (256.0 * byte_of(highest) + byte_of(second));
      ASSERT_NEAR(stored.shift, back - (256.0 * highest + second), 0.01) << highest << ' ' << second;
    }
  }
  // The text's chart: a shift by as much as the highest byte holds.
  EXPECT_NEAR(store_two_digits(fract, ChannelStorage::round, 128, 0).shift, 128.5, 0.01);
  const DepthPacking& mod = *find_depth_packing("rgba8-mod");
  for (int second = 0; second < 256; ++second) {
    EXPECT_NEAR(store_two_digits(mod, ChannelStorage::round, 128, second).shift, 0.0, 0.01);
  }
}

TEST(DepthPackingError, ThreadsChangeNothing) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "other numbers of threads: the build without sanitizers runs this";
  const auto with_threads = [](std::size_t n) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, n);
    return measured("rgba8-mod", ChannelStorage::truncate, DepthSet::floats, 512);
  };
  const RoundTripError one = with_threads(1), four = with_threads(4);
  EXPECT_EQ(one.mean_error, four.mean_error);
  EXPECT_EQ(one.mean_bias, four.mean_bias);
  EXPECT_EQ(one.max_error, four.max_error);
  EXPECT_EQ(one.worst_depth, four.worst_depth);
  EXPECT_EQ(one.distinct, four.distinct);
  EXPECT_EQ(one.inversions, four.inversions);
}

std::unique_ptr<Study> study_of(const DepthPackingOptions& options) {
  auto study = make_depth_packing_study(options);
  EXPECT_TRUE(study) << study.error().text();
  return std::move(study).value();
}

TEST(DepthPackingStudy, UnitsAnswerWhatIsAsked) {
  DepthPackingOptions options = all_depth_packings();
  options.packings = {"rgba8-fract", "rgba8-mod"};
  options.sets = {DepthSet::bits16};
  const auto study = study_of(options);
  EXPECT_EQ(study->question().command(),
            "ninebit study depth-packing --packings rgba8-fract,rgba8-mod --storages round,truncate --depths 16 "
            "--float-step 256");
  ASSERT_EQ(study->units(), 8U);
  EXPECT_EQ(study->unit_name(0), "rgba8-fract, round, 16 bits");
  EXPECT_EQ(study->unit_name(7), "rgba8-mod, truncate, highest digit 128");
  std::vector<StudyRow> rows;
  for (std::size_t unit = 0; unit < study->units(); ++unit) {
    const auto more = study->run(unit, {});
    ASSERT_TRUE(more);
    EXPECT_EQ(more->size(), unit % 2 == 0 ? 1U : 256U);
    rows.insert(rows.end(), more->begin(), more->end());
  }
  EXPECT_EQ(rows[0].text("packing"), "rgba8-fract");
  EXPECT_EQ(rows[0].count("inversions"), measured("rgba8-fract", ChannelStorage::round, DepthSet::bits16).inversions);
  EXPECT_EQ(rows[1].table, "second_digit");

  const auto report = study->report(rows, study->units());
  ASSERT_TRUE(report);
  std::string answers;
  for (const std::string& line : report->answers) answers += line + '\n';
  EXPECT_NE(answers.find("1 reads as 0 through rgba8-fract"), std::string::npos) << answers;
  EXPECT_NE(answers.find("Where the highest digit is 128, rgba8-fract (round) shifts the depth by"), std::string::npos);
  EXPECT_EQ(answers.find("rgba8-mod (round) shifts"), std::string::npos) << answers;
  ASSERT_EQ(report->tables.size(), 3U);  // packings, storages, round trips
  EXPECT_EQ(report->tables[0].rows.size(), 2U);
  EXPECT_EQ(text_of(report->tables[0].rows[1][2]), find_depth_packing("rgba8-mod")->formula);
  EXPECT_EQ(report->tables[1].rows.size(), 2U);
  EXPECT_EQ(report->tables[2].rows.size(), 4U);
  const auto& columns = report->tables[2].columns;
  EXPECT_NE(std::find(columns.begin(), columns.end(), "max_error below 1"), columns.end());
  ASSERT_EQ(report->summary.size(), 1U);
  EXPECT_EQ(report->summary[0].rows.size(), 4U);
  EXPECT_EQ(report->plots.size(), 4U);
  ASSERT_EQ(report->heat_maps.size(), 3U);  // both of fract; mod where it is cut
  EXPECT_EQ(report->heat_maps[0].values.size(), 65536U);
  EXPECT_NEAR(report->heat_maps[0].values[128 * 256], 128.5F, 0.01F);
}

TEST(DepthPackingStudy, ReportsOfSomeUnits) {
  DepthPackingOptions options = all_depth_packings();
  options.sets = {DepthSet::bits16};
  const auto study = study_of(options);
  const auto rows = study->run(1, {});
  ASSERT_TRUE(rows);
  EXPECT_TRUE(study->report(*rows, 1));
  EXPECT_TRUE(study->report({}, 0));
}

TEST(DepthPackingStudy, RefusesWhatItCannotAsk) {
  const auto message = [](auto change) {
    DepthPackingOptions options = all_depth_packings();
    change(options);
    const auto study = make_depth_packing_study(options);
    return study ? std::string("no error") : study.error().message;
  };
  EXPECT_NE(message([](auto& o) { o.packings = {"rgba8"}; }).find("'rgba8' is not a depth packing"), std::string::npos);
  for (const auto& emptied : {message([](auto& o) { o.packings.clear(); }),
                              message([](auto& o) { o.storages.clear(); }), message([](auto& o) { o.sets.clear(); })}) {
    EXPECT_NE(emptied.find("nothing to study"), std::string::npos) << emptied;
  }
  EXPECT_NE(message([](auto& o) { o.float_step = 0; }).find("step"), std::string::npos);
}

TEST(DepthPackingStudy, StopsWhenAsked) {
  const auto study = study_of(all_depth_packings());
  const auto rows = study->run(1, [] { return false; });
  ASSERT_FALSE(rows);
  EXPECT_EQ(rows.error().fault, Fault::cancelled);
}

}  // namespace
