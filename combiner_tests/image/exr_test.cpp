#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <string>

#include "combiner_tests/image/read_back.h"
#include "combiner_tests/image/rows.h"
#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/support/special_floats.h"
#include "ninebit/image/image_io.h"
#include "src/system/parallel/parallel_loop.h"

namespace {

using ninebit::test::kInfinity;

using image_test::read_exr;
using image_test::RowLog;
using image_test::rows_of;
using image_test::scramble;
using image_test::StoredPart;
using image_test::TempFolder;
using ninebit::ExrChannel;
using ninebit::ExrPart;
using ninebit::Fault;

using Integers = std::vector<std::uint32_t>;
using Reals = std::vector<float>;

Integers integers(int width, int height, std::uint32_t seed) {
  Integers plane(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = scramble(static_cast<std::uint32_t>(i) + seed);
  if (plane.size() > 2) {
    plane[0] = 0xFFFFFFFFU;
    plane[1] = 0;
    plane[2] = 0x80000000U;
  }
  return plane;
}

// Multiples of 1/1024 in [-1, 1): half holds each exactly.
Reals reals(int width, int height, std::uint32_t seed) {
  Reals plane(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < plane.size(); ++i) {
    plane[i] = (static_cast<float>(scramble(static_cast<std::uint32_t>(i) + seed) % 2048U) - 1024.0F) / 1024.0F;
  }
  return plane;
}

TEST(Exr, StoresPartsOfDifferentSizesExactly) {
  const TempFolder folder;
  const Integers index = integers(150, 131, 1);
  const Integers depth = integers(150, 131, 2);
  const Reals red = reals(150, 131, 3);
  const Reals alpha = reals(17, 200, 4);
  const Integers stencil = integers(1, 1, 5);
  const std::vector<ExrPart> parts = {
      {"camera", 150, 131, {{"index", rows_of(index, 150)}, {"Z", rows_of(depth, 150)}, {"R", rows_of(red, 150)}}},
      {"map", 17, 200, {{"A", rows_of(alpha, 17)}}},
      {"dot", 1, 1, {{"stencil", rows_of(stencil, 1)}}},
  };
  const auto status = ninebit::write_exr_parts(folder.path() / "a.exr", parts);
  ASSERT_TRUE(status.ok()) << status.error().text();
  const std::vector<StoredPart> stored = read_exr(folder.path() / "a.exr");
  ASSERT_EQ(stored.size(), 3U);
  EXPECT_EQ(stored[0].name, "camera");
  EXPECT_EQ(stored[0].width, 150);
  EXPECT_EQ(stored[0].height, 131);
  EXPECT_TRUE(stored[0].zip);
  EXPECT_FALSE(stored[0].cube);
  ASSERT_EQ(stored[0].channels.size(), 3U);
  EXPECT_EQ(stored[0].channels.at("index").integers, index);
  EXPECT_EQ(stored[0].channels.at("Z").integers, depth);
  EXPECT_EQ(stored[0].channels.at("R").reals, red);
  EXPECT_EQ(stored[1].name, "map");
  EXPECT_EQ(stored[1].width, 17);
  EXPECT_EQ(stored[1].height, 200);
  ASSERT_EQ(stored[1].channels.size(), 1U);
  EXPECT_EQ(stored[1].channels.at("A").reals, alpha);
  EXPECT_EQ(stored[2].channels.at("stencil").integers, stencil);
}

TEST(Exr, StoresOnePart) {
  const TempFolder folder;
  const Reals red = reals(33, 64, 1);
  const std::vector<ExrPart> parts = {{"only", 33, 64, {{"R", rows_of(red, 33)}}}};
  ASSERT_TRUE(ninebit::write_exr_parts(folder.path() / "a.exr", parts).ok());
  const std::vector<StoredPart> stored = read_exr(folder.path() / "a.exr");
  ASSERT_EQ(stored.size(), 1U);
  EXPECT_EQ(stored[0].name, "only");
  EXPECT_EQ(stored[0].channels.at("R").reals, red);
}

TEST(Exr, RoundsRealsToHalf) {
  const TempFolder folder;
  const Reals given = {0.0F,       -0.0F, 1.0F,    0.1F,    65504.0F,  65505.0F,   70000.0F,
                       -100000.0F, 1e-9F, 6.0e-8F, 2049.0F, kInfinity, -kInfinity, std::nanf("")};
  // By hand: 10 bits of fraction, largest 65504, smallest 2^-24, ties to even.
  const Reals expected = {0.0F,       -0.0F, 1.0F,       0.0999755859375F, 65504.0F,  65504.0F,  kInfinity,
                          -kInfinity, 0.0F,  0x1.0p-24F, 2048.0F,          kInfinity, -kInfinity};
  const int count = static_cast<int>(given.size());
  const std::vector<ExrPart> parts = {{"p", count, 1, {{"v", rows_of(given, count)}}}};
  ASSERT_TRUE(ninebit::write_exr_parts(folder.path() / "a.exr", parts).ok());
  const Reals stored = read_exr(folder.path() / "a.exr").at(0).channels.at("v").reals;
  ASSERT_EQ(stored.size(), given.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(stored[i], expected[i]) << "sample " << i;
    EXPECT_EQ(std::signbit(stored[i]), std::signbit(expected[i])) << "sample " << i;
  }
  EXPECT_TRUE(std::isnan(stored.back()));
}

TEST(Exr, IsTheSameBytesForAnyNumberOfThreads) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "other numbers of threads: the build without sanitizers runs this";
  const TempFolder folder;
  const Integers index = integers(301, 277, 1);
  const Reals red = reals(301, 277, 3);
  const Reals small = reals(64, 64, 9);
  const std::vector<ExrPart> parts = {{"a", 301, 277, {{"index", rows_of(index, 301)}, {"R", rows_of(red, 301)}}},
                                      {"b", 64, 64, {{"R", rows_of(small, 64)}}}};
  std::string first;
  for (const std::size_t threads : {1U, 1U, 2U, 5U}) {
    const ninebit::ScopedThreadLimit limit(threads);
    ASSERT_TRUE(ninebit::write_exr_parts(folder.path() / "a.exr", parts).ok());
    const std::string bytes = image_test::read_bytes(folder.path() / "a.exr");
    ASSERT_FALSE(bytes.empty());
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << threads << " threads";
  }
}

// Rows that compress well, rows that do not compress at all, and a last block of fewer rows.
TEST(Exr, StoresFlatAndNoisyBlocksExactly) {
  constexpr int kWidth = 257, kHeight = 100;
  const TempFolder folder;
  Integers index = integers(kWidth, kHeight, 7);
  std::fill_n(index.begin(), kWidth * 50, 77U);
  Reals red = reals(kWidth, kHeight, 8);
  std::fill_n(red.begin() + kWidth * 30, kWidth * 40, 0.5F);
  Reals exact(index.size());
  for (std::size_t i = 0; i < exact.size(); ++i) exact[i] = static_cast<float>(index[i]) * 0.1F;
  const std::vector<ExrPart> parts = {{"a",
                                       kWidth,
                                       kHeight,
                                       {{"z", rows_of(index, kWidth)},
                                        {"R", rows_of(red, kWidth)},
                                        {"d", ninebit::ExrFloatRow{rows_of(exact, kWidth)}}}}};
  ASSERT_TRUE(ninebit::write_exr_parts(folder.path() / "a.exr", parts).ok());
  const StoredPart stored = read_exr(folder.path() / "a.exr").at(0);
  EXPECT_EQ(stored.channels.at("z").integers, index);
  EXPECT_EQ(stored.channels.at("R").reals, red);
  EXPECT_EQ(stored.channels.at("d").floats, exact);
}

TEST(Exr, AsksForEachRowOnceFromTheTopDown) {
  const TempFolder folder;
  RowLog integers_log;
  RowLog reals_log;
  RowLog second_log;
  const std::vector<ExrPart> parts = {
      {"a", 9, 150, {{"index", integers_log.rows<std::uint32_t>(9)}, {"R", reals_log.rows<float>(9)}}},
      {"b", 200, 64, {{"R", second_log.rows<float>(200)}}},
  };
  const auto status = ninebit::write_exr_parts(folder.path() / "a.exr", parts);
  ASSERT_TRUE(status.ok()) << status.error().text();
  EXPECT_EQ(integers_log.asked(), image_test::up_to(150));
  EXPECT_EQ(reals_log.asked(), image_test::up_to(150));
  EXPECT_EQ(second_log.asked(), image_test::up_to(64));
}

TEST(Exr, LeavesNoFileWhenTheRowsRunOutOfMemory) {
  const TempFolder folder;
  const auto fill = [](int row, std::span<float> out) {
    if (row == 130) throw std::bad_alloc();
    std::fill(out.begin(), out.end(), 1.0F);
  };
  const std::vector<ExrPart> parts = {{"a", 3, 130, {{"R", fill}}}, {"b", 3, 131, {{"R", fill}}}};
  EXPECT_THROW((void)ninebit::write_exr_parts(folder.path() / "a.exr", parts), std::bad_alloc);
  EXPECT_TRUE(folder.names().empty());
}

TEST(Exr, StoresTheLargestSides) {
  const TempFolder folder;
  const Integers wide = integers(16384, 3, 1);
  const Reals tall = reals(2, 16384, 2);
  const std::vector<ExrPart> parts = {{"wide", 16384, 3, {{"v", rows_of(wide, 16384)}}},
                                      {"tall", 2, 16384, {{"v", rows_of(tall, 2)}}}};
  ASSERT_TRUE(ninebit::write_exr_parts(folder.path() / "a.exr", parts).ok());
  const std::vector<StoredPart> stored = read_exr(folder.path() / "a.exr");
  EXPECT_EQ(stored.at(0).channels.at("v").integers, wide);
  EXPECT_EQ(stored.at(1).channels.at("v").reals, tall);
}

TEST(Exr, ReportsSenselessParts) {
  const TempFolder folder;
  const auto file = folder.path() / "a.exr";
  const Reals four(4);
  const auto two_rows = rows_of(four, 2);
  RowLog log;
  const ExrChannel good{"R", two_rows};
  const ExrChannel logged{"G", log.rows<float>(2)};
  const auto expect_refused = [&](const std::vector<ExrPart>& parts, const std::string& what) {
    const auto status = ninebit::write_exr_parts(file, parts);
    ASSERT_FALSE(status.ok()) << what;
    EXPECT_EQ(status.error().fault, Fault::invalid_input) << what;
    EXPECT_EQ(status.error().file, file.string()) << what;
    EXPECT_FALSE(status.error().message.empty()) << what;
  };
  expect_refused({}, "no part");
  expect_refused({{"p", 2, 2, {}}}, "no channel");
  expect_refused({{"", 2, 2, {good}}}, "no name");
  expect_refused({{"p", 2, 2, {good}}, {"p", 2, 2, {good}}}, "a name twice");
  expect_refused({{"p", 2, 2, {good, good}}}, "a channel twice");
  expect_refused({{"p", 2, 2, {{"", two_rows}}}}, "a channel without a name");
  expect_refused({{"p", 2, 2, {{std::string(256, 'x'), two_rows}}}}, "a channel with too long a name");
  expect_refused({{"p", 2, 2, {{std::string("R\0S", 3), two_rows}}}}, "a channel with NUL in its name");
  expect_refused({{"p", 2, 2, {good, {"index", ninebit::ExrIntegerRow()}}}}, "no function for the integers' rows");
  expect_refused({{"p", 2, 2, {{"G", ninebit::ExrRealRow()}, good}}}, "no function for the reals' rows");
  expect_refused({{"p", 2, 2, {{}}}}, "an empty channel");
  expect_refused({{"p", 2, 2, {logged}}, {"q", 2, 2, {}}}, "no channel in the last part");
  EXPECT_TRUE(log.asked().empty());
  expect_refused({{"p", 0, 2, {good}}}, "no width");
  expect_refused({{"p", -2, -2, {good}}}, "negative sizes");
  expect_refused({{"p", 16385, 1, {good}}}, "too wide");
  expect_refused({{"p", 2, 2, {good}}, {"q", 1 << 30, 1 << 30, {good}}}, "far too large");
  EXPECT_TRUE(folder.names().empty());
  const auto status = ninebit::write_exr_parts(file, std::vector<ExrPart>{{"p", 2, 2, {good}}});
  EXPECT_TRUE(status.ok());
  ASSERT_TRUE(
      ninebit::write_exr_parts(file, std::vector<ExrPart>{{"p", 2, 2, {{std::string(255, 'x'), two_rows}}}}).ok());
  EXPECT_EQ(read_exr(file).at(0).channels.at(std::string(255, 'x')).reals, four);
}

}  // namespace
