// Numbers that depend on the time of a picture, and a renderer that is changed between pictures.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "combiner_tests/effect/program_reader.h"
#include "ninebit/effect/effect_json.h"
#include "ninebit/effect/effect_renderer.h"
#include "src/effect/moving_number.h"

namespace ninebit::test {
namespace {

using effect_detail::moving_number;

double number(const std::string& text, const EffectMoment& moment = {}) {
  const auto found = moving_number(text, moment);
  EXPECT_TRUE(found) << text << ": " << found.error().message;
  return found ? found->value : std::nan("");
}

TEST(MovingNumber, HasTheUsualPrecedence) {
  EXPECT_EQ(number("1 + 2 * 3 - 4 / 8"), 6.5);
  EXPECT_EQ(number("(1 + 2) * -(3 - 4)"), 3.0);
  EXPECT_EQ(number("8 / 4 / 2"), 1.0);
  EXPECT_EQ(number("1e2 + .5"), 100.5);
  EXPECT_EQ(number("--2"), 2.0);
  EXPECT_EQ(number("1\t+\r\n2"), 3.0);
}

TEST(MovingNumber, TakesNumbersBelowTheSmallestAsZero) {
  for (const std::string& tiny :
       std::vector<std::string>{"2e-400", "123456e-500", "0.5e-99999999999", "0." + std::string(400, '0') + "1"}) {
    EXPECT_EQ(number(tiny), 0.0) << tiny;
  }
  for (const std::string& huge :
       std::vector<std::string>{"1e400", "0.5e+99999999999", "0.0001e400", std::string(400, '9')}) {
    EXPECT_FALSE(moving_number(huge, {})) << huge;
  }
}

TEST(MovingNumber, SaysWhetherItMoves) {
  for (const std::string moving : {"time", "0 * frame", "sin(1 + time)"}) {
    const auto found = moving_number(moving, {});
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->moves) << moving;
  }
  const auto still = moving_number("60 * cos(pi / 3)", {.time = 1.0, .frame = 2});
  ASSERT_TRUE(still);
  EXPECT_FALSE(still->moves);
}

TEST(MovingNumber, CountsParenthesesAndSigns) {
  for (const std::string outer : {"(", "-", "abs("}) {
    const auto nested = [&](int count) {
      std::string text;
      for (int i = 0; i < count; ++i) text += outer;
      text += '1';
      return outer == "-" ? text : text + std::string(static_cast<std::size_t>(count), ')');
    };
    EXPECT_TRUE(moving_number(nested(50), {})) << outer;
    const auto deep = moving_number(nested(51), {});
    ASSERT_FALSE(deep) << outer;
    EXPECT_EQ(deep.error().message, "has more than 50 parentheses, functions and minus signs inside each other");
  }
}

TEST(MovingNumber, ReadsTimeAndFrame) {
  EXPECT_EQ(number("time * 2 + frame", {.time = 1.25, .frame = 7}), 9.5);
  EXPECT_EQ(number("min(time, 1) + max(time, 1)", {.time = 3.0}), 4.0);
  EXPECT_EQ(number("fract(time) + floor(time) + abs(-time) + sqrt(4)", {.time = 2.75}), 7.5);
}

TEST(MovingNumber, ComputesSineAndCosine) {
  for (double x = -20.0; x <= 20.0; x += 0.01) {
    const EffectMoment moment{.time = x};
    EXPECT_NEAR(number("sin(time)", moment), std::sin(x), 1e-10) << x;
    EXPECT_NEAR(number("cos(time)", moment), std::cos(x), 1e-10) << x;
  }
  EXPECT_EQ(number("sin(0)"), 0.0);
  EXPECT_NEAR(number("sin(pi / 2)"), 1.0, 1e-10);
}

TEST(MovingNumber, RefusesWhatIsNotAnExpression) {
  for (const std::string wrong :
       {"",       " ",   "1 +", "(1", "1)",   "time time", "times", "sin",   "sin()",  "sin(1, 2)", "min(1)",
        "1 ** 2", "inf", "nan", "+1", "0x10", "sqrt(-1)",  "1 / 0", "1e999", "frame.", "a\xC3\xA9"}) {
    const auto found = moving_number(wrong, {});
    EXPECT_FALSE(found) << wrong;
  }
  EXPECT_FALSE(moving_number(std::string("1\0 2", 4), {}));
  EXPECT_FALSE(moving_number(std::string(1001, '1'), {}));
  EXPECT_FALSE(moving_number(std::string(500, '('), {}));
  EXPECT_FALSE(moving_number(std::string(500, '-') + "1", {}));
}

std::string effect_text(const std::string& constant, const std::string& light = "1") {
  return R"({"ninebit": "effect", "version": 1, "size": [24, 16], "scene": {"mesh": "sphere:8", "light": [)" + light +
         R"(, 2, 3]}, "textures": {"squares": {"source": "checker:8", "filter": "nearest"}}, "passes": [
    {"program": "mine.gl", "constants": {"const0": [)" +
         constant + R"(, 0, 0, 1]}, "units": [{"texture": "squares", "matrix": [[1, 0, 0, "time / 4"], [0, 1, 0, 0],
      [0, 0, 1, 0], [0, 0, 0, 1]]}], "primary": "light-vector"}]})";
}

TEST(MovingEffect, IsReadAtItsMoment) {
  const std::string text = effect_text("\"time / 2\"", "\"frame\"");
  const auto effect = parse_effect({text, "moving"}, {.time = 1.0, .frame = 5});
  ASSERT_TRUE(effect) << effect.faults()[0].text();
  EXPECT_TRUE(effect->moves);
  EXPECT_EQ((*effect->passes[0].constants.global[0])[0], 0.5F);
  EXPECT_EQ(effect->passes[0].units[0].coordinates.matrix[3][0], 0.25F);
  EXPECT_EQ(effect->scene.setup.light->x, 5.0F);
}

TEST(MovingEffect, ReportsNumbersOutOfRangeAndOtherStrings) {
  const auto far = parse_effect({effect_text("\"time\""), "moving"}, {.time = 2.0});
  ASSERT_FALSE(far);
  EXPECT_NE(far.faults()[0].message.find("\"time\" is 2 at time 2, frame 0; expected a number from 0 to 1"),
            std::string::npos)
      << far.faults()[0].message;
  const auto word = parse_effect({effect_text("\"tim\""), "moving"});
  ASSERT_FALSE(word);
  EXPECT_NE(word.faults()[0].message.find("\"tim\" is wrong at character 1; expected numbers, time"), std::string::npos)
      << word.faults()[0].message;
}

TEST(MovingEffect, DoesNotMoveWithoutExpressions) {
  const std::string still = R"({"ninebit": "effect", "version": 1, "passes": [{"primary": "constant:1,0,0"}]})";
  const auto effect = parse_effect({still, "still"});
  ASSERT_TRUE(effect);
  EXPECT_FALSE(effect->moves);
  const auto constant = parse_effect({R"({"ninebit": "effect", "version": 1, "scene": {"mesh": "cube", "fov": "60"},
    "passes": [{"primary": "constant:1,0,0"}]})",
                                      "constant"});
  ASSERT_TRUE(constant) << constant.faults()[0].text();
  EXPECT_FALSE(constant->moves);
}

std::vector<std::uint8_t> bytes_of(const Surface& surface) {
  std::vector<std::uint8_t> bytes;
  for (int c = 0; c < 4; ++c) bytes.insert(bytes.end(), surface.color(c).begin(), surface.color(c).end());
  return bytes;
}

// One renderer that takes effect after effect gives the pictures of a new one each time.
TEST(EffectRendererChange, GivesThePicturesOfANewRenderer) {
  const HardwareProfile& profile = profiles::nv2a;
  std::vector<Effect> effects;
  const auto add = [&](const std::string& text, double time) {
    auto effect = parse_effect({text, "moving"}, {.time = time});
    ASSERT_TRUE(effect) << effect.faults()[0].text();
    effects.push_back(std::move(*effect));
  };
  for (const double time : {0.0, 0.5, 1.0}) add(effect_text("\"time / 2\""), time);
  add(effect_text("0.25", "\"time\""), 2.0);
  effects.push_back(effects.back());
  effects.back().passes[0].primary = {.source = VertexSource::normal};
  effects.push_back(effects.back());
  effects.back().width = 40;
  effects.push_back(effects.back());
  effects.back().scene.mesh = "torus:6";
  effects.push_back(effects.back());
  effects.back().scene.setup.floor = FloorChoice::automatic;
  effects.push_back(effects.back());
  effects.back().passes.push_back(effects.back().passes[0]);
  effects.back().passes.back().name = "again";
  effects.back().passes.back().geometry = EffectGeometry::rectangle;
  effects.push_back(effects[0]);
  effects.push_back(effects[0]);
  const EffectReaders readers = reader_of(
      "!!RC1.0\n{ rgb { discard = tex0 * const0; discard = col0 * col0; spare0 = sum(); } }\n"
      "out.rgb = spare0; out.a = unsigned_invert(zero);\n");
  auto kept = EffectRenderer::make(effects[0], profile, readers);
  ASSERT_TRUE(kept) << kept.error().message;
  std::vector<std::vector<std::uint8_t>> pictures;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const Status changed = kept->change(effects[i], readers);
    ASSERT_TRUE(changed) << i << ": " << changed.error().message;
    ASSERT_TRUE(kept->draw());
    auto fresh = EffectRenderer::make(effects[i], profile, readers);
    ASSERT_TRUE(fresh);
    ASSERT_TRUE(fresh->draw());
    EXPECT_EQ(kept->picture().width(), fresh->picture().width());
    pictures.push_back(bytes_of(kept->picture()));
    EXPECT_EQ(pictures.back(), bytes_of(fresh->picture())) << i;
    EXPECT_EQ(kept->warnings(), fresh->warnings()) << i;
  }
  // The steps do differ.
  for (const std::size_t i : {1U, 3U, 5U, 7U, 8U}) EXPECT_NE(pictures[i], pictures[i - 1]) << i;
}

}  // namespace
}  // namespace ninebit::test
