// `ninebit verify` of the tables of texture-shader stages and texel formats.
#include <gtest/gtest.h>

#include <sstream>

#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

class VerifyStages : public testing::Test {
 protected:
  Outcome verify(const std::string& table, const Words& more = {}) {
    return ninebit(Words{"verify", write_bytes(folder_ / "rows.csv", table)} + more);
  }
  TempFolder folder_;
};

TEST_F(VerifyStages, ThePicturesOfAnNv2a) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const std::map<std::string, std::string> tables{
      {"passthru", "1300 rows: 1300 agree, 0 differ\n"},     {"bumpenvmap", "1500 rows: 1500 agree, 0 differ\n"},
      {"bumpenv_lum", "4000 rows: 4000 agree, 0 differ\n"},  {"dot_cube", "1920 rows: 1920 agree, 0 differ\n"},
      {"hilo_dot_st", "1000 rows: 1000 agree, 0 differ\n"},  {"cubemap", "1000 rows: 1000 agree, 0 differ\n"},
      {"clipplane", "900 rows: 900 agree, 0 differ\n"},      {"yuv", "4500 rows: 4500 agree, 0 differ\n"},
      {"texel_formats", "1700 rows: 1700 agree, 0 differ\n"}};
  const std::string folder = NINEBIT_SOURCE_DIR "/combiner_tests/hardware/nv2a_";
  for (const auto& [name, answer] : tables) {
    const Outcome nv2a = ninebit({"verify", folder + name + ".csv", "--profile", "nv2a"});
    EXPECT_EQ(nv2a.code, 0) << name << nv2a.err;
    EXPECT_EQ(nv2a.out, answer) << name;
  }
  // The chip's quotients are not exact: two depths of a thousand are one off.
  EXPECT_EQ(json_of(ninebit({"verify", folder + "dot_zw.csv", "--profile", "nv2a", "--json"}), 1)["differ"], 2);
}

// The gradient texture is computed; the published file has its 64 rows of 64 texels. Each is read here, on face +z.
TEST_F(VerifyStages, TheGradientTextureIsThePublishedOne) {
  std::istringstream published(read_bytes(NINEBIT_SOURCE_DIR "/combiner_tests/hardware/nv2a_cube_radial.csv"));
  std::string line, table =
                        "# rows of cube 0: 2 0 -1; 0 -2 1; 0 0 1\n# rows of cube 1: 0 0 0; 0 0 0; 0 0 0\n"
                        "mode,mapping,eye,cube,R,G,B,A,face,tx,ty,pic_r,pic_g,pic_b,tex\n";
  std::getline(published, line);  // the comment
  for (int y = 0; y < 64; ++y) {
    std::getline(published, line);
    std::istringstream numbers(line);
    for (int x = 0; x < 64; ++x) {
      std::string number;
      std::getline(numbers, number, ',');
      const int h = (2 * x + 1) * 512, l = (2 * y + 1) * 512;  // the middle of a texel, of 65,536
      table += "STR_CUBE,HiLo_1,,0";
      for (const int part : {h % 256, l / 256, l % 256, h / 256}) table += "," + std::to_string(part);
      table += ",4,0,0,0,0," + number + ",R\n";
    }
  }
  const Outcome all = verify(table, {"--profile", "nv2a"});
  EXPECT_EQ(all.out, "4096 rows: 4096 agree, 0 differ\n") << all.err;
}

TEST_F(VerifyStages, WrongTables) {
  const std::string lum = "scale,offset,L,T,out\n1,0,255,255,255\n";
  EXPECT_EQ(verify(lum, {"--profile", "nv2a"}).code, 0);
  expect_error(verify(lum, {"--profile", "geforce2"}), 3,
               {"rows.csv:2:1", "geforce2 has no texture shaders", "such as nv2a"});
  for (const std::string number : {"nan", "inf", "1e308", "-1e39"}) {
    expect_error(verify("scale,offset,L,T,out\n1," + number + ",255,255,255\n", {"--profile", "nv2a"}), 3,
                 {"rows.csv:2:3", "offset must be a number within ±3.4e38, not '" + number + "'"});
  }
  const std::string offsets = "picture,Bs,Gs,i,j,b_first,g_first,b_last,g_last,b,g,m00,m01,m11,m10,class\n";
  expect_error(verify(offsets + "p,0,0,1,1,0,0,0,0,0,0,1,nan,1,0,0\n", {"--profile", "nv2a"}), 3,
               {"rows.csv:2:25", "m01 must be a number within ±3.4e38, not 'nan'"});
  const std::string cube = "mode,mapping,eye,cube,R,G,B,A,face,tx,ty,pic_r,pic_g,pic_b,tex\n";
  expect_error(verify(cube), 3, {"the comments do not state rows of cube 0", "# rows of cube 0: 1 0 1"});
  const std::string rows = "# rows of cube 0: 1 0 0; 0 1 0; 0 0 1\n# rows of cube 1: 1 0 0; 0 1 0; 0 0 1\n";
  const auto one = [&](const std::string& row) { return verify(rows + cube + row, {"--profile", "nv2a"}); };
  EXPECT_EQ(one("STR_CUBE,0to1,,0,255,0,0,255,0,32,32,255,119,119,C\n").code, 0);
  EXPECT_EQ(one("STR_CUBE,0to1,,0,255,0,0,255,0,32,32,255,119,118,C\n").code, 1);
  expect_error(one("SPEC,0to1,0 0,0,255,0,0,255,0,32,32,1,2,3,C\n"), 3, {"eye must be three whole numbers", "'0 0'"});
  expect_error(one("SPEC,0to1,0 0 x 1,0,255,0,0,255,0,32,32,1,2,3,C\n"), 3,
               {"eye must be three whole numbers", "'0 0 x 1'"});
  expect_error(one("STR,0to1,,0,255,0,0,255,0,32,32,1,2,3,C\n"), 3, {"mode must be one of STR_CUBE", "'STR'"});
  const std::string cull = "modes,s0,t0,r0,q0,s1,t1,r1,q1,s2,t2,r2,q2,visible\n";
  expect_error(verify(cull + "012,0,0,0,0,0,0,0,0,0,0,0,0,3\n", {"--profile", "nv2a"}), 3,
               {"modes must be four digits 0 or 1", "'012'"});
  const std::string words = "# over (32,32,32,254)\nformat,word,pic_r,pic_g,pic_b,pic_a\n";
  expect_error(verify(words + "A8,0x100,1,2,3,4\n", {"--profile", "nv2a"}), 3,
               {"word must have at most 8 bits, not '0x100'"});
  expect_error(verify(words + "P8,0x1,1,2,3,4\n", {"--profile", "nv2a"}), 3, {"such as A8R8G8B8", "'P8'"});
}

// Colours to nearest, as OpenGL has them, are not what the chip gives.
TEST_F(VerifyStages, ARuleIsFound) {
  const std::string file = NINEBIT_SOURCE_DIR "/combiner_tests/hardware/nv2a_passthru.csv";
  const Json object = json_of(ninebit({"verify", file, "--profile", "ideal", "--json"}), 1);
  EXPECT_EQ(object["rules"][0]["field"], "stage_byte");
  EXPECT_EQ(object["rules"][0]["value"], "12-bits");
}

}  // namespace
}  // namespace tools_test
