// `ninebit eval` on pictures: the table's results, texel by texel, and what is refused; names of registers in the
// languages.
#include <gtest/gtest.h>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/support/stored_pictures.h"
#include "combiner_tests/tools/program_support.h"
#include "ninebit/image/image_io.h"

namespace tools_test {
namespace {

using ninebit::Image8;
using ninebit::test::Random;

class EvalPictures : public testing::Test {
 protected:
  std::string picture(const std::string& name, const Image8& image) const {
    EXPECT_TRUE(ninebit::write_png(folder_ / name, image));
    return folder_ / name;
  }
  static Image8 random_image(Random& random, int width, int height, int channels) {
    Image8 image{width, height, channels, {}};
    for (int i = 0; i < width * height * channels; ++i) image.pixels.push_back(random.byte());
    return image;
  }
  void refuses(const Words& flags, const std::string& message, int code = 2) const {
    expect_parts(err_of(ninebit(Words{"eval", kArticle} + flags), code), {message});
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.png"));
  }
  TempFolder folder_;
};

// The same fragments as rows of a table. Sides that are no powers of two are kept.
TEST_F(EvalPictures, AreWhatTheTableGivesForEachTexel) {
  for (const char* const profile : {"geforce2", "nv2a", "ideal"}) {
    for (std::uint64_t k = 0; k < 4; ++k) {
      Random random(77, k);
      const ninebit::HardwareProfile& rules = *ninebit::find_profile(profile);
      const std::string program = write_program(folder_, "program.json", ninebit::test::random_state(random, rules));
      const int width = random.between(1, 9), height = random.between(1, 7);
      const Image8 rgba = random_image(random, width, height, 4), rgb = random_image(random, width, height, 3);
      const Image8 grey = random_image(random, width, height, 1);
      std::string table = "tex0.r,tex0.g,tex0.b,tex0.a,tex1.r,tex1.g,tex1.b,tex1.a,primary.g\n";
      const bool is_grey = k % 2 == 0;
      for (std::size_t i = 0; i < static_cast<std::size_t>(width * height); ++i) {
        for (std::size_t c = 0; c < 4; ++c) table += std::to_string(rgba.pixels[4 * i + c]) + ',';
        for (std::size_t c = 0; c < 3; ++c)
          table += std::to_string(is_grey ? grey.pixels[i] : rgb.pixels[3 * i + c]) + ',';
        table += "255,77\n";
      }
      const Outcome rows =
          ninebit({"eval", program, "--profile", profile, "--inputs", write_bytes(folder_ / "in.csv", table)});
      ASSERT_EQ(rows.code, 0) << rows.err;
      const std::string out = folder_ / "result.png";
      const Outcome drawn =
          ninebit({"eval", program, "--profile", profile, "--tex0", picture("rgba.png", rgba), "--tex1",
                   picture("other.png", is_grey ? grey : rgb), "--set", "v0.g=77", "-o", out});
      ASSERT_EQ(drawn.code, 0) << drawn.err;
      const Image8 result = ninebit::test::read_png(out);
      ASSERT_EQ(result.width, width);
      ASSERT_EQ(result.height, height);
      std::string text = "out.r,out.g,out.b,out.a\n";
      for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        text += std::to_string(result.pixels[i]) + (i % 4 == 3 ? '\n' : ',');
      }
      EXPECT_EQ(text, rows.out) << profile << ' ' << k;
    }
  }
}

TEST_F(EvalPictures, AnswersInJson) {
  Random random(1);
  const std::string in = picture("in.png", random_image(random, 5, 3, 4)), out = folder_ / "out.png";
  const Json answer = json_of(ninebit({"eval", kArticle, "--tex0", in, "-o", out, "--json"}));
  EXPECT_EQ(answer["size"], Json({5, 3}));
  EXPECT_EQ(answer["fragments"], 15);
  EXPECT_EQ(answer["files"], Json({out}));
}

TEST_F(EvalPictures, WhatIsRefused) {
  Random random(2);
  const std::string in = picture("in.png", random_image(random, 5, 3, 4)), out = folder_ / "out.png";
  const std::string other = picture("other.png", random_image(random, 3, 5, 4));
  const std::string table = write_bytes(folder_ / "in.csv", "tex0.r\n1\n");
  refuses({}, "--inputs FILE.csv or --tex0 PICTURE is required");
  refuses({"--tex0", in}, "-o FILE.png is required with pictures");
  refuses({"--tex0", in, "-o", folder_ / "out.csv"}, "expected the name of a .png file");
  refuses({"--tex0", in, "--inputs", table, "-o", out}, "--inputs is a table; expected a table or pictures");
  refuses({"--tex2", in, "-o", out}, "--tex2: profile geforce2 has 2 texture units");
  refuses({"--tex0", in, "--set", "t0.r=3", "-o", out}, "--set tex0.r: --tex0 gives its values");
  refuses({"--tex0", in, "--set", "col0.r=300", "-o", out}, "col0.r takes a whole number from -255 to 255, not '300'");
  refuses({"--inputs", table, "--set", "col0.r=3"}, "--set col0.r=3: expected it beside pictures");
  refuses({"--tex0", in, "--registers", "-o", out}, "--registers is for tables");
  refuses({"--tex0", in, "--engine", "simd", "-o", out}, "--engine is for tables");
  refuses({"--tex0", in, "--tex1", other, "-o", out}, "other.png: is 3 x 5 in size, and " + in + " is 5 x 3", 3);
  refuses({"--tex0", table, "-o", out}, "in.csv", 3);
  refuses({"--tex0", in, "-o", in + "/out.png"}, "in.png", 4);
}

// One program's registers by the names of each language.
TEST_F(EvalPictures, RegistersHaveTheirNamesInEachLanguage) {
  const std::string expected =
      ninebit({"eval", kArticle, "--inputs", write_bytes(folder_ / "a.csv", "primary.r,tex0.r,const0.g\n9,7,1\n")}).out;
  for (const char* const header : {"col0.r,tex0.r,const0.g", "v0.r,t0.r,c0.g"}) {
    const std::string table = write_bytes(folder_ / "b.csv", std::string(header) + "\n9,7,1\n");
    EXPECT_EQ(ninebit({"eval", kArticle, "--inputs", table}).out, expected) << header;
  }
  const auto traced = [&](const char* primary, const char* texture) {
    return ninebit(
               {"trace", kArticle, "--set", std::string(primary) + "=9,8,7,6", "--set", std::string(texture) + ".r=3"})
        .out;
  };
  EXPECT_EQ(traced("v0", "t0"), traced("primary", "tex0"));
  EXPECT_EQ(traced("col0", "tex0"), traced("primary", "tex0"));
  const std::string table = write_bytes(folder_ / "c.csv", "v0.r,primary.r\n1,2\n");
  expect_parts(ninebit({"eval", kArticle, "--inputs", table}).err, {"duplicate column primary.r"});
}

}  // namespace
}  // namespace tools_test
