// `ninebit verify`: the NV2A's pictures agree with its profile, and what differs is told by place and by rule.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

const std::string kNv2aRows = NINEBIT_SOURCE_DIR "/combiner_tests/hardware/verify/rows.csv";

constexpr const char* kSquare =
    "!!RC1.0\n{ rgb { spare0 = col0; scale_by_one_half(); } }\n{ rgb { spare1 = spare0 * spare0; } }\n"
    "out.rgb = spare1;\nout.a = unsigned_invert(zero);\n";

const std::string kMuxHeader =
    "# AB: (255,0,0)\n# CD: (0,0,255)\nmux_select,spare0_alpha_byte,R,G,B,A,hw_selected,model_selected,match\n";

class Verify : public testing::Test {
 protected:
  // The rows of this table run a program that halves the primary colour, then squares it.
  Outcome verify(const std::string& table, const Words& more = {}) {
    write_bytes(folder_ / "square.rc", kSquare);
    return ninebit(Words{"verify", write_bytes(folder_ / "rows.csv", table)} + more);
  }
  TempFolder folder_;
};

TEST_F(Verify, ThePicturesOfAnNv2a) {
  EXPECT_EQ(out_of(ninebit({"verify", kNv2aRows, "--profile", "nv2a"})), "592 rows: 592 agree, 0 differ\n");
}

TEST_F(Verify, PixelsOfAnNv2a) {
  const std::map<std::string, std::string> tables{
      {"alpha_test", "2040 rows: 2040 agree, 0 differ\n"},
      {"blend", "1256 rows: 1256 agree, 0 differ\n"},
      {"dxt1", "3542 rows: 3542 agree, 0 differ\n"},
      {"dxt3", "929 rows: 929 agree, 0 differ\n"},
      {"dxt5", "1294 rows: 1294 agree, 0 differ\n"},
      {"filter", "948 rows: 948 agree, 0 differ\n"},
      {"filter_weight_bits", "167 rows: 167 agree, 0 differ; 1 with match 0 skipped\n"},
      {"lines", "828 rows: 828 agree, 0 differ; 21 with match 0 skipped\n"},
      {"line_colors", "406 rows: 406 agree, 0 differ\n"},
      {"points", "354 rows: 354 agree, 0 differ; 1 with match 0 skipped\n"},
      {"depth_floor", "3024 rows: 3024 agree, 0 differ\n"},
      {"gouraud_pixels", "4901 rows: 4901 agree, 0 differ; 39 with match 0 skipped\n"},
      {"shadow_compare", "336 rows: 336 agree, 0 differ\n"},
      {"combiner_ops", "24 rows: 24 agree, 0 differ\n"},
      {"mux", "6 rows: 6 agree, 0 differ\n"},
      {"signed_texel", "256 rows: 256 agree, 0 differ\n"},
      {"vertex_color_to_byte", "16 rows: 16 agree, 0 differ\n"},
      {"final_AB_pointparams", "273 rows: 273 agree, 0 differ\n"},
      {"depth_formats", "700 rows: 700 agree, 0 differ\n"},
      {"gouraud_ccw", "700 rows: 700 agree, 0 differ\n"},
      {"wrap", "1000 rows: 1000 agree, 0 differ\n"},
      {"color_key", "200 rows: 200 agree, 0 differ\n"},
      {"combiner_quads", "40 rows: 40 agree, 0 differ\n"}};
  for (const auto& [name, answer] : tables) {
    const std::string file = std::string(NINEBIT_SOURCE_DIR) + "/combiner_tests/hardware/nv2a_" + name + ".csv";
    const Outcome nv2a = ninebit({"verify", file, "--profile", "nv2a"});
    EXPECT_EQ(nv2a.code, 0) << name << nv2a.err;
    EXPECT_EQ(nv2a.out, answer) << name;
  }
}

// The chip's linear factor is one off where 4096 f is next to a whole number, and its exponential ones come from a
// table: those may be off by one, which is counted.
TEST_F(Verify, FogOfAnNv2a) {
  const std::string file = NINEBIT_SOURCE_DIR "/combiner_tests/hardware/nv2a_fog.csv";
  const Json object = json_of(ninebit({"verify", file, "--profile", "nv2a", "--json"}), 1);
  EXPECT_EQ(object["agree"], 1198);
  EXPECT_EQ(object["near"], 173);
  EXPECT_EQ(object["rows"][0]["line"], 654);
  EXPECT_EQ(object["rows"][1]["line"], 1082);
  const Outcome text = ninebit({"verify", file, "--profile", "nv2a"});
  expect_parts(text.out, {"1200 rows: 1198 agree, 2 differ; 173 of those that agree are off by 1\n"});
}

// Offsets without a slope are exact. The table has differences of neighbours in whole numbers: a slope is known within
// one sixteenth where there are two of them, else within one, of which the factor makes 16.
TEST_F(Verify, PolygonOffsetsOfAnNv2a) {
  const std::string file = NINEBIT_SOURCE_DIR "/combiner_tests/hardware/nv2a_polygon_offset_z24.csv";
  EXPECT_EQ(ninebit({"verify", file, "--profile", "nv2a"}).out,
            "21 rows: 21 agree, 0 differ; 12 of those that agree are off by up to 5\n");
  const std::string header = "primitive,V1=passthrough vsh,offset,delta:pixels,absdzdx:n,absdzdy:n\n";
  const auto said = [&](const std::string& row) {
    write_bytes(folder_ / "offset.csv", header + row + "\n");
    return ninebit({"verify", folder_ / "offset.csv", "--profile", "nv2a"});
  };
  EXPECT_EQ(said("Q,V0,bias16,16:10;0:90,5:1,5:1").code, 0);
  EXPECT_EQ(said("Q,V0,bias16,17:10;0:90,5:1,5:1").code, 1);
  EXPECT_EQ(said("Q,V0,slope16,1608:10,0:5,100:1;101:1").code, 0);
  EXPECT_EQ(said("Q,V0,slope16,1610:10,0:5,100:1;101:1").code, 1);
  EXPECT_EQ(said("Q,V0,slope16,1616:10,100:1;16777023:4,0:5").code, 0) << "differences across edges are left out";
  EXPECT_EQ(said("Q,V0,slope16,1617:10,100:1,0:5").code, 1);
  expect_error(said("Q,V0,bias16,16,5:1,5:1"), 3, {"offset.csv:2:", "delta:pixels", "16:8121;0:144879"});
  expect_error(said("Q,V0,bias16,16:1,5:1,-5:1"), 3, {"absdzdy:n", "16:8121;0:144879"});
  expect_error(said("Q,V0,bias8,16:1,5:1,5:1"), 3, {"offset must be one of bias16, slope16 or bias16+slope16"});
  expect_error(said("Q,V0,bias16,16:1,9000:1,5:1"), 3, {"at most 8192"});
}

TEST_F(Verify, SurfacesAndSamplesOfAnNv2a) {
  const std::map<std::string, std::string> tables{
      {"surface_blend", "900 rows: 900 agree, 0 differ\n"}, {"surface_store", "1000 rows: 1000 agree, 0 differ\n"},
      {"stipple", "900 rows: 900 agree, 0 differ\n"},       {"point_sprite", "600 rows: 600 agree, 0 differ\n"},
      {"poly_smooth", "300 rows: 300 agree, 0 differ\n"},   {"aa_samples", "264 rows: 264 agree, 0 differ\n"},
      {"aa_square4", "500 rows: 500 agree, 0 differ\n"}};
  const std::string folder = NINEBIT_SOURCE_DIR "/combiner_tests/hardware/nv2a_";
  for (const auto& [name, answer] : tables) {
    const Outcome nv2a = ninebit({"verify", folder + name + ".csv", "--profile", "nv2a"});
    EXPECT_EQ(nv2a.code, 0) << name << nv2a.err;
    EXPECT_EQ(nv2a.out, answer) << name;
  }
  // What OpenGL says of blending differs.
  EXPECT_EQ(ninebit({"verify", folder + "surface_blend.csv", "--profile", "ideal"}).code, 1);
}

TEST_F(Verify, WrongTablesOfSurfacesAndSamples) {
  const auto fault = [this](const std::string& table, const std::string& profile, const std::string& message) {
    expect_error(verify(table, {"--profile", profile}), 3, {"rows.csv:2:", message});
  };
  fault("surface,blend,r,g,b,a,word_hex\nB8,0,1,2,3,4,FF\n", "nv2a", "surface must be one of R5G6B5");
  fault("surface,blend,r,g,b,a,word_hex\nR5G6B5,0,1,2,3,4,10000\n", "nv2a", "up to four hexadecimal digits");
  fault("surface,blend,r,g,b,a,word_hex\nR5G6B5,0,1,2,3,4,\n", "nv2a", "up to four hexadecimal digits");
  fault("pattern,x,y,drawn\nStripes,1,2,1\n", "nv2a", "pattern must be one of Asymmetric, Border or Checkered");
  const std::string sprites = "test,x,y,r,g,b,a,pic_r,pic_g,pic_b,pic_a\n0,149,83,1,2,3,4,1,2,3,4\n";
  fault(sprites, "geforce2", "profile geforce2 has no point sprites");
  fault("test,x,y,r,g,b,a,pic_r,pic_g,pic_b,pic_a\n0,100,83,1,2,3,4,1,2,3,4\n", "nv2a", "must lie within the point");
  fault("x0,y0,x1,y1,x2,y2,x,y,alpha\n0,0,1,1,1e9,3,0,0,255\n", "nv2a", "x2 must be a number from -4096 to 4096");
  fault("mode,sample,y,first,last\nCENTER_1,1,9,1,2\n", "nv2a", "CENTER_1 has sample 0 alone");
  fault("mode,sample,y,first,last\nQUINCUNX,1,9,1,2\n", "nv2a", "mode must be one of CENTER_1 or CENTER_CORNER_2");
  fault("mode,sample,y,first,last\nCENTER_CORNER_2,1,9,1,2\n", "geforce2", "no surfaces with several samples");
  fault("column,row,covered\n1,1,0\n", "geforce2", "no surfaces with several samples");
}

// The GeForce 2 kept 16 bits of DXT1 without a dither.
TEST_F(Verify, ARuleOfPixelsIsFound) {
  const std::string file = std::string(NINEBIT_SOURCE_DIR) + "/combiner_tests/hardware/nv2a_dxt1.csv";
  const Json object = json_of(ninebit({"verify", file, "--json"}), 1);
  EXPECT_EQ(object["places"], Json::parse(R"([{"place": "DXT1", "rows": 3348}])"));
  EXPECT_EQ(object["rules"][0]["value"], "dithered565");
  EXPECT_EQ(object["rules"][0]["agree_then"], 3542);
  EXPECT_EQ(object["skipped"], 0);
}

// OpenGL's lines and points differ, and where nothing is drawn counts, too.
TEST_F(Verify, TheShapesOfLinesAndPointsAreFound) {
  for (const auto& [table, rule, differ] :
       {std::tuple("lines", "line_shape", 663), std::tuple("points", "point_shape", 166)}) {
    const std::string file = std::string(NINEBIT_SOURCE_DIR) + "/combiner_tests/hardware/nv2a_" + table + ".csv";
    const Json object = json_of(ninebit({"verify", file, "--profile", "ideal", "--json"}), 1);
    EXPECT_EQ(object["differ"], differ);
    ASSERT_FALSE(object["rules"].empty());
    EXPECT_EQ(object["rules"][0]["field"], rule);
    EXPECT_EQ(object["rules"][0]["explains"], differ);
  }
  const std::string points = "picture,size_eighths,hw_first,hw_last,model_first,model_last,match\n";
  EXPECT_EQ(verify(points + "p,4,,,,,1\n", {"--profile", "nv2a"}).code, 0);
  EXPECT_EQ(verify(points + "p,4,0,0,,,1\n", {"--profile", "nv2a"}).code, 1);
  EXPECT_EQ(verify(points + "p,8,,,,,1\n", {"--profile", "nv2a"}).code, 1);
  EXPECT_EQ(verify(points + "p,8,-1,-2,,,1\n", {"--profile", "nv2a"}).code, 1);
}

TEST_F(Verify, WrongTablesOfPixels) {
  const std::string smooth = "triangle,x,y,hw_R,hw_G,hw_B,model_R,model_G,model_B,match\n";
  expect_error(verify(smooth), 3, {"nv2a_gouraud_triangles.csv", "No such file"});
  write_bytes(folder_ / "nv2a_gouraud_triangles.csv", "triangle,x0\n");
  expect_error(verify(smooth), 3, {"nv2a_gouraud_triangles.csv:1:1", "expected the header triangle,picture,"});
  write_bytes(folder_ / "nv2a_gouraud_triangles.csv",
              "triangle,picture,vertices,x0,y0,x1,y1,x2,y2,w0,w1,w2,c0,c1,c2,pixels,wrong,uncovered\n"
              "7,p,v,0,0,16,16,32,0,1,1,1,FF0000,00FF00,0000FF,1,0,0\n");
  expect_error(verify(smooth + "3,0,0,1,2,3,1,2,3,1\n"), 3,
               {"rows.csv:2:1", "nv2a_gouraud_triangles.csv has no triangle '3'"});
  expect_error(verify(smooth + "7,0,0,1,2,3,1,2,3,2\n"), 3, {"rows.csv:2:19", "match must be 0 or 1, not '2'"});
  expect_error(verify(smooth + "7,,0,1,2,3,1,2,3,1\n"), 3, {"rows.csv:2:3", "x must be a whole number from 0 to 4095"});
  expect_error(verify(smooth + "7,0\n"), 3, {"rows.csv:2:1", "2 fields, the header 10"});
  expect_error(verify(smooth), 3, {"the table has no rows"});
  expect_error(verify(smooth, {"--program", "square.rc"}), 3, {"--program is not for measured tables"});
  expect_error(verify("func,ref,alpha_byte,hw_drawn,pixels,model_drawn,match\nSometimes,1,2,1,1,1,1\n"), 3,
               {"rows.csv:2:1", "func must be one of Never, LessThan", "'Sometimes'"});
  const std::string lines =
      "# quad: (215,380) (219,380) (219,390) (215,390)\npicture,width,object,y,hw_runs,model_runs,match\n";
  expect_error(verify(lines + "p,1,star,388,215-218,,1\n"), 3, {"rows.csv:3:1", "object must be one of quad, loop"});
  for (const std::string runs : {"215", "-", "215-", "a-b", "1-2,,3-4"}) {
    expect_error(verify(lines + "p,1,quad,388," + runs + ",,1\n"), 3, {"rows.csv:3:"});
  }
}

// A number beyond 32 bits would otherwise be compared with nothing.
TEST_F(Verify, AMeasuredNumberBeyond32Bits) {
  EXPECT_EQ(verify(kMuxHeader + "MSB,0,255,0,0,255|2147483647,AB,AB,1\n", {"--profile", "nv2a"}).code, 0);
  for (const char* number : {"2147483648", "4294967551", "-2147483649", "99999999999999999999"}) {
    expect_error(verify(kMuxHeader + "MSB,0,255,0,0,255|" + number + ",AB,AB,1\n", {"--profile", "nv2a"}), 3,
                 {"rows.csv:4:15", "A must be whole numbers of 32 bits separated by |, or empty, not '255|"});
  }
  expect_error(verify("program,primary.r,out.r\nsquare.rc,101,4294967305\n"), 3,
               {"rows.csv:2:15", "out.r must be whole numbers", "'4294967305'"});
}

TEST_F(Verify, WrongTablesOfCombiners) {
  expect_error(verify(kMuxHeader + "LSB,0,255,0,0,255,AB,AB,1\n"), 3,
               {"rows.csv:4:1", "profile geforce2 has no mux by the lowest bit of spare0's alpha"});
  expect_error(verify(kMuxHeader + "ISB,0,255,0,0,255,AB,AB,1\n"), 3,
               {"mux_select must be one of LSB or MSB, not 'ISB'"});
  expect_error(verify("op,op_code_bits15_17,portion,channel,in,hw_out,model_out,match,how\nSHL3,0,rgb,R,1,1,1,1,\n"), 3,
               {"rows.csv:2:1", "op must be one of IDENTITY, BIAS", "'SHL3'"});
  expect_error(verify("float,model,hw,match\n(half),1,1,1\n"), 3, {"rows.csv:2:1", "float must be a number"});
  const std::string shadow = "picture,mode,bits,r,func,t,hw,model,match\n";
  expect_error(verify(shadow + "p,4D,16,1,LT,1,1,1,1\n"), 3, {"mode must be one of 2D or 3D"});
  expect_error(verify(shadow + "p,3D,16,1,<,1,1,1,1\n"), 3, {"func must be one of N, LT"});
  expect_error(verify(shadow + "p,3D,17,1,LT,1,1,1,1\n"), 3, {"bits must be 16 or 24"});
  expect_error(verify(shadow + "p,3D,16,65536,LT,1,1,1,1\n"), 3, {"r and t must be whole numbers from 0 to 65535"});
}

// The scale of one half and the products of the final combiner show how the GeForce 2 narrows.
TEST_F(Verify, ARuleOfTheCombinersIsFound) {
  const std::string file = std::string(NINEBIT_SOURCE_DIR) + "/combiner_tests/hardware/nv2a_combiner_ops.csv";
  const Json object = json_of(ninebit({"verify", file, "--json"}), 1);
  EXPECT_EQ(object["places"], Json::parse(R"([{"place": "scale and bias", "rows": 4}])"));
  EXPECT_EQ(object["rules"][0]["field"], "general_narrowing");
  EXPECT_EQ(object["rules"][0]["agree_then"], 24);
}

// An NV2A that cut toward zero, as the GeForce 2 does: the scale of one half shows it, and the rule is found.
TEST_F(Verify, AnotherRuleIsFound) {
  const std::string own = folder_ / "own.json";
  write_bytes(own, R"({"base": "nv2a", "name": "mine", "general_narrowing": "toward-zero"})");
  const Json object = [&] { return json_of(ninebit({"verify", kNv2aRows, "--profile", own, "--json"}), 1); }();
  EXPECT_EQ(object["count"], 592);
  EXPECT_EQ(object["differ"], 4);
  EXPECT_EQ(object["agree"], 588);
  ASSERT_EQ(object["rows"].size(), 4U);
  for (const Json& row : object["rows"]) EXPECT_TRUE(row["name"].get<std::string>().starts_with("SHR1")) << row;
  ASSERT_FALSE(object["rules"].empty());
  EXPECT_EQ(object["rules"][0]["field"], "general_narrowing");
  EXPECT_EQ(object["rules"][0]["value"], "nearest-halves-up");
  EXPECT_EQ(object["rules"][0]["explains"], 4);
  EXPECT_EQ(object["rules"][0]["agree_then"], 592);
}

// Quantities of a whole table are never assumed.
TEST_F(Verify, WhatATablesCommentsState) {
  struct Case {
    std::string stated, header, row;
    std::string missing;  // what is asked for without the comments
  };
  const std::string colors = "Px,Py,Qx,Qy,c0,c1,x,y,hw_R,hw_G,hw_B,model_R,model_G,model_B,match\n",
                    // 6.7 pixels beside the line, so not of one 8 pixels wide; t is 0.507, n 129
      beside = "2560,6368,3520,6208,3333FF,33FF33,191,399,51,154,152,0,0,0,1\n",
                    runs = "picture,width,object,y,hw_runs,model_runs,match\n",
                    texels = "texel_R,texel_G,texel_B,texel_A,model_R,model_G,model_B,model_A,match\n";
  const std::vector<Case> cases{
      {"# width: 16\n", colors, beside, "do not state width; expected a comment such as # width: 16"},
      {"# source: results/Line_width/Line_0016.0.png\n", colors, beside, "do not state width"},
      {"# quad: (170,398) (230,388) (228.5,473.375) (182.75,455.5)\n", runs, "p,1,quad,388,224-229,,1\n",
       "do not state the corners of the quad"},
      {"# constant: 80402010\n# under: (0,0,0,0)\n",
       "equation,sfactor,dfactor,s,d,bR,bG,bB,bA,hw_R,hw_G,hw_B,hw_A,model_R,model_G,model_B,model_A,match\n",
       "ADD,cRGB,0,FFFFFFFF,0,0,0,0,0,32,16,8,64,0,0,0,0,1\n", "do not state constant"},
      {"# under: 32\n# alpha_under: 0\n", "c0,c1,index,alpha4,hw_R,hw_G,hw_B,hw_A," + texels,
       "0x62F4,0x2354,1,9,33,76,112,92,0,0,0,0,0,0,0,0,1\n", "do not state under"},
      {"# alpha: 255\n# under: 0\n",
       "row,place,w,lum,hw_R(values seen),model_out,match,model_out_if_nearest,match_if_nearest\n",
       "0,0.0,0,0,76,0,1,0,1\n", "do not state alpha"},
      {"# AB: (10,20,30)\n# CD: (0,0,0)\n", "mux_select,spare0_alpha_byte,R,G,B,A,hw_selected,model_selected,match\n",
       "MSB,0,10,20,30,255,AB,AB,1\n", "do not state AB"},
      {"# full: 128\n# dim: 0\n", "col,row,ch,diffuse_float,f2b_model,hw_full,hw_dim,model_dim,f2b_match,dim_match\n",
       "0,1,R,1.0,255,128,0,0,1,1\n", "do not state full"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.stated);
    const Outcome outcome = verify(c.stated + c.header + c.row, {"--profile", "nv2a"});
    EXPECT_EQ(outcome.out, "1 rows: 1 agree, 0 differ\n") << outcome.err;
    expect_error(verify(c.header + c.row, {"--profile", "nv2a"}), 3, {"rows.csv:", c.missing});
  }
  EXPECT_EQ(verify("# width: 8\n" + colors + beside, {"--profile", "nv2a"}).code, 1);
  EXPECT_EQ(verify("# width: 16\n# Line_0016.0.png\n" + colors + beside, {"--profile", "nv2a"}).code, 0);
  expect_error(verify("# width: 8\n# Line_0016.0.png\n" + colors + beside), 3,
               {"rows.csv:3:1", "the comments state different values of width"});
  expect_error(verify("# width: 65\n" + colors + beside), 3, {"width must be from 0 to 64"});
  expect_error(verify("# width: 8\n" + colors + "0,0,4096,0,0,FF,1,1,0,0,0,0,0,0,1\n"), 3,
               {"rows.csv:3:1", "the lines are too long or too wide; expected at most 256 pixels"});
  expect_error(verify("# loop: (0,0) (300,0)\n" + runs + "p,1,loop,1,1-2,,1\n"), 3, {"the lines are too long"});
}

TEST_F(Verify, Spare0sAlphaStartsAsTexture0s) {
  write_bytes(folder_ / "spare.rc", "!!RC1.0\nout.rgb = spare0.a;\nout.a = zero;\n");
  const Outcome outcome =
      verify("program,tex0.a,spare0.a,out.r\nspare.rc,77,,77\nspare.rc,77,5,5\nspare.rc,,,255\n", {"--quiet"});
  EXPECT_EQ(outcome.out, "3 rows: 3 agree, 0 differ\n") << outcome.err;
}

TEST_F(Verify, AProfileThatIsNotGivenIsNamed) {
  const std::string file = std::string(NINEBIT_SOURCE_DIR) + "/combiner_tests/hardware/nv2a_dxt1.csv";
  expect_parts(ninebit({"verify", file}).err, {"compared with profile geforce2; --profile names another"});
  EXPECT_EQ(ninebit({"verify", file, "--quiet"}).err, "");
  EXPECT_EQ(ninebit({"verify", file, "--profile", "nv2a"}).err, "");
}

TEST_F(Verify, TheFirstPlaceThatDiffers) {
  // 101 / 2 is 50 on a GeForce 2; 50 squared is 9. What follows from a wrong 51 is not counted again.
  const std::string table =
      "program,primary.r,stage0.spare0.r,stage1.spare1.r,out.r\n"
      "square.rc,101,50,9,9\n"
      "square.rc,101,51,10,10\n"
      "square.rc,101,50,10,10\n"
      "square.rc,101,,,11|12\n"
      "square.rc,101,50|51,9,\n";
  const Json object = json_of(verify(table, {"--json"}), 1);
  EXPECT_EQ(object["count"], 5);
  EXPECT_EQ(object["agree"], 2);
  EXPECT_EQ(object["places"], Json::parse(R"([{"place": "general combiner 0, rgb", "rows": 1},
                            {"place": "general combiner 1, rgb", "rows": 1}, {"place": "output, rgb", "rows": 1}])"));
  ASSERT_EQ(object["rows"].size(), 3U);
  EXPECT_EQ(object["rows"][0]["line"], 3);
  EXPECT_EQ(object["rows"][0]["differences"].size(), 3U);
  EXPECT_EQ(object["rows"][0]["differences"][0],
            Json::parse(R"({"column": "stage0.spare0.r", "expected": [51], "computed": 50})"));
  EXPECT_EQ(object["rows"][2]["differences"][0]["expected"], Json::array({11, 12}));

  const Outcome text = verify(table, {"--most", "1"});
  expect_parts(text.out, {"rows.csv:3: ", "stage0.spare0.r is 50, expected 51; stage1.spare1.r is 9, expected 10",
                          "and 2 more rows", "general_narrowing = nearest-halves-up (rules 5, 8)"});
}

TEST_F(Verify, WhatNoRuleExplains) {
  expect_parts(out_of(verify("program,primary.r,out.r\nsquare.rc,101,200\n"), 1),
               {"No single rule with another value explains"});
}

TEST_F(Verify, AProgramForAllRowsAndStandardInput) {
  EXPECT_EQ(verify("primary.r,out.r\n101,9\n", {"--program", folder_ / "square.rc"}).code, 0);
  const std::string table = write_bytes(folder_ / "in.csv", "# a comment\nprimary.r,out.r\n\n101,9\n");
  EXPECT_EQ(out_of(ninebit({"verify", "-", "--program", folder_ / "square.rc"}, {.in = table})),
            "1 rows: 1 agree, 0 differ\n");
}

// Programs that rows name stand below the table's folder.
TEST_F(Verify, ProgramsOfRowsStandBelowTheTable) {
  std::filesystem::create_directories(folder_ / "in/deep");
  write_bytes(folder_ / "in/deep/square.rc", kSquare);
  write_bytes(folder_ / "square.rc", kSquare);
  std::filesystem::create_symlink("../square.rc", folder_ / "in/link.rc");
  ASSERT_EQ(::mkfifo((folder_ / "in/fifo").c_str(), 0600), 0);
  const std::string file = folder_ / "in/rows.csv";
  const auto verify_named = [&](const std::string& name, bool allow) {
    write_bytes(file, "program,primary.r,out.r\n" + name + ",101,9\n");
    Words words{"verify", file};
    if (allow) words.emplace_back("--allow-outside");
    return ninebit(words);
  };
  EXPECT_EQ(verify_named("deep/square.rc", false).code, 0);
  for (const std::string& name : {std::string("../square.rc"), folder_ / "square.rc", std::string("link.rc")}) {
    SCOPED_TRACE(name);
    expect_error(verify_named(name, false), 3, {file + ":2:1", "'" + name + "'", "--allow-outside"});
    EXPECT_EQ(verify_named(name, true).code, 0);
  }
  expect_error(verify_named("fifo", false), 3, {file + ":2:1", "'fifo' is not a regular file"});
  expect_error(verify_named("-", false), 3, {"-", "No such file"});
  // Nor does a table from standard input name standard input.
  const std::string table = write_bytes(folder_ / "stdin.csv", "program,primary.r,out.r\n-,101,9\n");
  expect_error(ninebit({"verify", "-"}, {.folder = folder_ / "in", .in = table}), 3, {"./-", "No such file"});
}

TEST_F(Verify, WrongTables) {
  struct Case {
    std::string table;
    Words words;
  };
  const std::vector<Case> cases{
      {"", {"rows.csv:1:1", "empty"}},
      {"program,primry.r,out.r\n", {"rows.csv:1:9", "unknown column 'primry.r'", "did you mean 'primary.r'?"}},
      {"program,primary.r\n", {"no column has an expected value"}},
      {"primary.r,out.r\n1,1\n", {"no column `program`"}},
      {"y,x,alpha_left,primary.r,out.r\n1,2,3,4,5\n",
       {"rows.csv:1:1", "unknown columns 'y', 'x', 'alpha_left'; expected program", "colours of lines, points"}},
      {"# left\ny,x,left,right,hw\n292,608,608,1,2\n292,608,612,1,2\n",
       {"rows.csv:2:1", "unknown columns 'y', 'x', 'left', 'right', 'hw'"}},
      {"# levels\n292,608,608,1\n292,608,612,2\n", {"rows.csv:2:1", "the first line has numbers alone"}},
      {"program,out.r,out.r\n", {"rows.csv:1:15", "duplicate column"}},
      {"program,stage2.spare0.r\n", {"unknown column 'stage2.spare0.r'", "(of 2)"}},
      {"program,stage0.const0.r\n", {"unknown column 'stage0.const0.r'"}},
      {"program,out.r\n", {"the table has no rows"}},
      {"program,out.r\nsquare.rc\n", {"rows.csv:2:1", "1 fields, the header 2"}},
      {"program,primary.r,out.r\nsquare.rc,256,1\n", {"rows.csv:2:11", "primary.r", "-255 to 255", "'256'"}},
      {"program,primary.r,out.r\nsquare.rc,1,1|x\n", {"rows.csv:2:13", "out.r", "'1|x'"}},
      {"program,primary.r,out.r\nsquare.rc,1,\n", {"the row has no expected value"}},
      {"program,out.r\nmissing.rc,1\n", {"missing.rc"}},
      {"program,out.r\nrows.csv,1\n", {"rows.csv: this is a table", "`ninebit eval` reads it"}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.table);
    expect_error(verify(c.table), 3, c.words);
  }
  write_bytes(folder_ / "one.rc", "!!RC1.0\nout.rgb = col0;\nout.a = zero;\n");
  expect_error(verify("program,stage1.spare0.r\none.rc,1\n"), 3, {"stage1.spare0.r", "1 general combiners"});
}

}  // namespace
}  // namespace tools_test
