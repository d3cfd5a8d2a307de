// The forms of depth packing that engines use beside three.js: against formulas written out here, and their figures.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "combiner_tests/study/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/study/depth_packing_error.h"

namespace {

using namespace ninebit;

float fraction_of(float x) {
  return x - std::floor(x);
}

// What a shader writes, from the texts of the sources. They are in the order of depth_packings(), after three.js'.
constexpr std::array<std::string_view, 9> kForms{"rgba8-base255",      "rgba8-base255-typo",   "rgba8-base255-clamped",
                                                 "rgba8-base255-2007", "rgba8-base255-by-256", "rgb8-base255",
                                                 "rg8-base255",        "rgb8-65793",           "rgb8-floor"};

using Four = std::array<float, 4>;

Four written_255(std::string_view form, float d) {
  const float alpha_factor = form == "rgba8-base255-typo" ? 160581375.0F : 16581375.0F;
  if (form == "rgba8-base255-clamped") d = std::min(d, 0.999F);
  if (form == "rgb8-base255") d = std::min(d, std::nextafter(1.0F, 0.0F));
  if (form == "rg8-base255") d *= 0.99F;
  Four e{fraction_of(d), fraction_of(255.0F * d), fraction_of(65025.0F * d), fraction_of(alpha_factor * d)};
  if (form.starts_with("rgb8")) e[3] = 0.0F;
  if (form.starts_with("rg8")) e[2] = e[3] = 0.0F;
  if (form == "rgba8-base255-by-256") e[0] = d;
  const Four lower{e[1], e[2], e[3], 0.0F};
  for (std::size_t i = 0; i < 4; ++i) {
    if (form == "rgba8-base255-2007") {
      e[i] += 0.5F / 255.0F;
    } else {
      e[i] -= lower[i] * (form == "rgba8-base255-by-256" ? 1.0F / 256.0F : 1.0F / 255.0F);
    }
  }
  return e;
}

Four written(std::string_view form, float d) {
  if (form == "rgb8-floor") {
    const float all = d * 16777216.0F, high = std::floor(all / 65536.0F);
    const float middle = std::floor((all - high * 65536.0F) / 256.0F);
    return {high / 255.0F, middle / 255.0F, ((all - high * 65536.0F) - middle * 256.0F) / 255.0F, 0.0F};
  }
  if (form != "rgb8-65793") return written_255(form, d);
  const float high = 65536.0F / 16777215.0F, middle = 256.0F / 16777215.0F;
  const float red = fraction_of(d) * (256.0F / 255.0F);
  const float green = fraction_of((d - std::floor(d / high) * high) * 256.0F) * (256.0F / 255.0F);
  const float blue = fraction_of((d - std::floor(d / middle) * middle) * 65536.0F) * (256.0F / 255.0F);
  return {red - green / 256.0F, green - blue / 256.0F, blue, 0.0F};
}

float joined(std::string_view form, const Four& c) {
  if (form == "rgb8-floor") return (c[0] * 255.0F * 65536.0F + c[1] * 255.0F * 256.0F + c[2] * 255.0F) / 16777216.0F;
  if (form == "rgb8-65793") {
    return (c[0] * (65536.0F / 65793.0F) + c[1] * (256.0F / 65793.0F)) + c[2] * (1.0F / 65793.0F);
  }
  const float alpha = form == "rgba8-base255-typo" ? 1.0F / 160581375.0F : 1.0F / 16581375.0F;
  const float sum = ((c[0] + c[1] * (1.0F / 255.0F)) + c[2] * (1.0F / 65025.0F)) + c[3] * alpha;
  return form == "rg8-base255" ? sum / 0.99F : sum;
}

float through_a_texel(float component, ChannelStorage storage) {
  const long double v = std::clamp(component, 0.0F, 1.0F);
  const bool halves_up = storage == ChannelStorage::round || storage == ChannelStorage::half;
  const long double scaled = storage == ChannelStorage::floor_256 ? v * 255.999L : v * 255.0L;
  const float read = static_cast<float>(std::floor(halves_up ? scaled + 0.5L : scaled)) / 255.0F;
  if (storage != ChannelStorage::half || read == 0.0F) return read;
  const int last_bit = std::ilogb(read) - 10;  // a half float has eleven significant bits
  return std::ldexp(std::nearbyint(std::ldexp(read, -last_bit)), last_bit);
}

float expected_depth(std::string_view form, float depth, ChannelStorage storage) {
  Four c = written(form, depth);
  for (float& component : c) component = through_a_texel(component, storage);
  return joined(form, c);
}

TEST(DepthPackingForms, ReadWhatTheirFormulasRead) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (const std::string_view form : kForms) {
    const DepthPacking* const packing = find_depth_packing(form);
    ASSERT_NE(packing, nullptr) << form;
    for (const StorageRule& rule : storage_rules()) {
      for (const DepthSet set : {DepthSet::bits16, DepthSet::floats}) {
        constexpr std::uint32_t kStep = 20'011;
        std::vector<float> depths(depth_count(set, kStep)), back(depths.size());
        for (std::size_t i = 0; i < depths.size(); ++i) depths[i] = depth_at(set, kStep, i);
        packing->round_trips(depths, rule.storage, back);
        for (std::size_t i = 0; i < depths.size(); ++i) {
          const float expected = expected_depth(form, depths[i], rule.storage);
          ASSERT_EQ(back[i], expected) << form << ' ' << rule.name << " of " << depths[i];
          ASSERT_EQ(read_depth(*packing, store_depth(*packing, depths[i], rule.storage), rule.storage), expected);
        }
      }
    }
  }
}

TEST(DepthPackingForms, FollowThoseOfThreeJs) {
  const auto all = depth_packings();
  ASSERT_EQ(all.size(), 7 + kForms.size());
  for (std::size_t i = 0; i < kForms.size(); ++i) EXPECT_EQ(all[7 + i].name, kForms[i]);
}

TEST(DepthPackingForms, HalfFloatsAreOffByATenthOfAByteAtMost) {
  float largest = 0.0F;
  for (int n = 0; n < 256; ++n) {
    const auto byte = static_cast<std::uint8_t>(n);
    const float exact = read_component(byte, ChannelStorage::round), half = read_component(byte, ChannelStorage::half);
    largest = std::max(largest, std::fabs(half - exact) * 255.0F);
  }
  EXPECT_GT(largest, 0.06F);  // 1/16: half a unit of 2^-11
  EXPECT_LT(largest, 0.1F);
}

RoundTripError all_24_bits(std::string_view form, ChannelStorage storage) {
  const auto error = measure_round_trip(*find_depth_packing(form), storage, DepthSet::bits24, 1, {});
  EXPECT_TRUE(error);
  return *error;
}

// The table of docs/study/depth-packing.md.
TEST(DepthPackingForms, FiguresOf24Bits) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  constexpr auto kRound = ChannelStorage::round, kCut = ChannelStorage::truncate;
  struct Figures {
    std::string_view form;
    ChannelStorage storage;
    double largest, mean;
    std::uint64_t inversions;
    float one;
  };
  const std::array figures{Figures{"rgba8-base255", kRound, 1.19e-7, 1.42e-8, 1, 0.0F},
                           Figures{"rgba8-base255", kCut, 3.94e-3, 1.04e-3, 446'630, 0.0F},
                           Figures{"rgba8-base255", ChannelStorage::half, 2.44e-4, 8.13e-5, 2'289, 0.0F},
                           Figures{"rgba8-base255-typo", kRound, 1.19e-7, 1.96e-8, 7, 0.0F},
                           Figures{"rgba8-base255-typo", kCut, 3.94e-3, 1.04e-3, 438'790, 0.0F},
                           Figures{"rgba8-base255-clamped", kRound, 1.0e-3, 5.14e-7, 0, 0.999F},
                           Figures{"rgba8-base255-clamped", kCut, 3.94e-3, 1.05e-3, 446'498, 0.999F},
                           Figures{"rgba8-base255-2007", kRound, 3.94e-3, 3.94e-3, 25'250, 0.0039370088F},
                           Figures{"rgba8-base255-2007", kCut, 3.94e-3, 1.97e-3, 71'121, 0.0F},
                           Figures{"rgba8-base255-by-256", kRound, 1.19e-7, 1.42e-8, 0, 1.0F},
                           Figures{"rgba8-base255-by-256", kCut, 1.55e-5, 1.72e-6, 105'053, 1.0F},
                           Figures{"rgb8-base255", kRound, 1.19e-7, 1.92e-8, 4, 0.99999994F},
                           Figures{"rgb8-base255", kCut, 3.94e-3, 1.04e-3, 438'645, 0.99999994F},
                           Figures{"rg8-base255", kRound, 7.87e-6, 3.88e-6, 1, 1.0000038F},
                           Figures{"rg8-base255", kCut, 3.98e-3, 1.08e-3, 237'202, 0.9999883F},
                           Figures{"rgb8-65793", kRound, 5.96e-8, 1.50e-8, 1, 0.0039061310F},
                           Figures{"rgb8-65793", kCut, 1.53e-5, 5.11e-8, 23'283, 0.0039061310F},
                           Figures{"rgb8-floor", kRound, 2.98e-8, 9.93e-9, 1, 0.99609375F},
                           Figures{"rgb8-floor", kCut, 2.98e-8, 9.93e-9, 1, 0.99609375F}};
  for (const Figures& f : figures) {
    SCOPED_TRACE(std::string(f.form) + ' ' + std::string(name_of(f.storage)));
    const RoundTripError e = all_24_bits(f.form, f.storage);
    EXPECT_NEAR(e.max_error / f.largest, 1.0, 0.01);
    EXPECT_NEAR(e.mean_error / f.mean, 1.0, 0.01);
    EXPECT_EQ(e.inversions, f.inversions);
    EXPECT_NEAR(e.one_back, f.one, 6e-8F);
  }
}

// The typing error. Its form's errors are counted here without the library: all 2^24 depths, rounded.
TEST(DepthPackingForms, ATypingErrorCosts40PercentInTheMean) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  constexpr std::string_view kTypo = "rgba8-base255-typo";
  constexpr int kLast = 16'777'215;
  double sizes = 0.0, largest = 0.0;
  std::uint64_t inversions = 0;
  float before = 0.0F;
  for (int n = 0; n <= kLast; ++n) {
    const auto depth = static_cast<float>(static_cast<double>(n) / kLast);
    const float back = expected_depth(kTypo, depth, ChannelStorage::round);
    const double size = std::fabs(static_cast<double>(back) - static_cast<double>(depth));
    if (back < before) ++inversions;
    before = back;
    if (n == kLast) continue;
    sizes += size;
    largest = std::max(largest, size);
  }
  const RoundTripError e = all_24_bits(kTypo, ChannelStorage::round);
  EXPECT_EQ(e.max_error, largest);
  EXPECT_NEAR(e.mean_error, sizes / kLast, 1e-15);
  EXPECT_EQ(e.inversions, inversions);
  EXPECT_NEAR(e.mean_error / all_24_bits("rgba8-base255", ChannelStorage::round).mean_error, 1.4, 0.05);
}

std::string answers_of(const DepthPackingOptions& options) {
  const auto study = make_depth_packing_study(options);
  EXPECT_TRUE(study);
  const auto report = (*study)->report(test::all_rows(**study), (*study)->units());
  EXPECT_TRUE(report);
  std::string all;
  for (const std::string& line : report->answers) all += line + '\n';
  for (const std::string& line : report->headlines) {
    if (line.starts_with("160581375") || line.starts_with("Depth 1 reads")) {
      EXPECT_NE(all.find(line), std::string::npos);
    }
  }
  return all;
}

TEST(DepthPackingForms, TheReportAnswersWhatIsAsked) {
  DepthPackingOptions options = all_depth_packings();
  options.packings = {"rgba8-base255", "rgba8-base255-typo", "rgba8-base255-2007", "rgba8-base255-by-256",
                      "rgba8-modf"};
  options.sets = {DepthSet::bits16};
  const std::string all = answers_of(options);
  const auto says = [&](std::string_view words) { return all.find(words) != std::string::npos; };
  EXPECT_TRUE(says("160581375 typed for 16581375 (rgba8-base255-typo) does little harm (16 bits, round)")) << all;
  EXPECT_TRUE(says("+33 %; largest error 8.03e-08 instead of 5.96e-08; inversions 1 instead of 1.")) << all;
  EXPECT_TRUE(says("The components of rgba8-base255-2007 must not be rounded: depths then read +0.00394 off")) << all;
  EXPECT_TRUE(says("in any set, components rounded to bytes: rgba8-base255-by-256, rgba8-modf.\n")) << all;
  EXPECT_TRUE(says("in any set, components truncated to bytes: rgba8-modf.\n")) << all;

  options.packings = {"rgba8-fract", "rgba8-base255-typo"};
  options.storages = {ChannelStorage::half};
  const std::string fewer = answers_of(options);
  EXPECT_EQ(fewer.find("typed for"), std::string::npos) << fewer;
  EXPECT_EQ(fewer.find("must not be rounded"), std::string::npos) << fewer;
  EXPECT_NE(fewer.find("read as half floats: no packing."), std::string::npos) << fewer;
}

}  // namespace
