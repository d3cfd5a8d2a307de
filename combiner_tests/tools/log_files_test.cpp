// Logs of register writes and the Xbox's definitions as files: listed, picked by LOG#N, in every verb.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

const std::string kHeader = "class,method,data\n";
// Texture 0 or 1 times the primary colour, doubled.
std::string program_writes(int texture) {
  return "0x97,0x1e60,0x101\n0x97,0xac0,0x0" + std::to_string(8 + texture) +
         "040000\n0x97,0x260,0\n0x97,0xaa0,0\n0x97,0x1e40,0x100c0\n0x97,0x288,0xc\n0x97,0x28c,0x1c80\n0x97,0x1e70,"
         "0x21\n";
}
const std::string kDraw = "0x97,0x17fc,5\n0x97,0x1810,0x02000000\n0x97,0x17fc,0\n";
const std::string kFlip = "0x97,0x12c,0\n0x97,0x130,0\n";
// Two frames and two set-ups, of which the first is in both.
const std::string kLog =
    kHeader + program_writes(0) + kDraw + kFlip + program_writes(1) + kDraw + program_writes(0) + kDraw;

const std::string kDefinition =
    "psd.PSRGBInputs[0] = PS_COMBINERINPUTS(PS_REGISTER_T0, PS_REGISTER_V0, 0, 0);\n"
    "psd.PSRGBOutputs[0] = PS_COMBINEROUTPUTS(PS_REGISTER_R0, 0, 0, PS_COMBINEROUTPUT_SHIFTLEFT_1);\n"
    "psd.PSFinalCombinerInputsABCD = 0xc;\npsd.PSFinalCombinerInputsEFG = 0x1c80;\npsd.PSCombinerCount = 0x101;\n"
    "psd.PSTextureModes = PS_TEXTUREMODES(PS_TEXTUREMODES_PROJECT2D, PS_TEXTUREMODES_CUBEMAP, 0, 0);\n";

Words on_nv2a(Words arguments) {
  return arguments + Words{"--profile", "nv2a"};
}

TEST(LogFiles, ConvertListsTheSetUps) {
  const TempFolder folder;
  const std::string log = write_bytes(folder / "f.log", kLog);
  const Outcome all = ninebit(on_nv2a({"convert", log}));
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_EQ(all.err, "");
  EXPECT_EQ(all.out,
            log +
                ": 2 frames, 3 draws, 2 combiner set-ups\n"
                "    #     draws  first line     frames  combiners  textures    first equation\n"
                "    1         2          10        1-2          1  0           spare0 = 2·(tex0 × primary)\n"
                "    2         1          23          2          1  1           spare0 = 2·(tex1 × primary)\n");
  const Outcome first = ninebit(on_nv2a({"convert", log, "--frame", "1"}));
  EXPECT_EQ(lines_of(first.out).size(), 3U) << first.out;
  expect_parts(first.out, {"1 draw in frame 1"});
  const std::string output = folder / "list.txt";
  EXPECT_EQ(ninebit(on_nv2a({"convert", log, "-o", output})).code, 0);
  EXPECT_EQ(read_bytes(output), all.out);
}

TEST(LogFiles, ConvertListsTheSetUpsAsRows) {
  const TempFolder folder;
  const std::string log = write_bytes(folder / "f.log", kLog);
  const Json object = json_of(ninebit(on_nv2a({"convert", log, "--frame", "2", "--json"})));
  EXPECT_EQ(object["command"], "convert");
  EXPECT_EQ(object["frames"], 2);
  EXPECT_EQ(object["frame"], 2);
  EXPECT_EQ(object["draws"], 2);
  EXPECT_EQ(object["chip"], "nv20");
  ASSERT_EQ(object["rows"].size(), 2U);
  const Json& second = object["rows"][1];
  EXPECT_EQ(second["setup"], 2);
  EXPECT_EQ(second["draws"], 1);
  EXPECT_EQ(second["textures"], Json::array({1}));
  EXPECT_EQ(second["frames"], Json::array({2}));
  EXPECT_EQ(second["words"]["RC_IN_RGB[0]"], "0x09040000");
  EXPECT_EQ(second["other_words"]["PSTextureModes"], "0x00000021");
  const Json draw = {{"line", 23}, {"frame", 2}, {"primitive", "triangles"}, {"vertices", 3}};
  EXPECT_EQ(second["draw_calls"], Json::array({draw}));
  EXPECT_EQ(second["equations"][0], "spare0 = 2·(tex1 × primary)");
  EXPECT_EQ(object["rows"][0]["first_line"], 34);  // in the frame
}

TEST(LogFiles, EveryVerbTakesASetUp) {
  const TempFolder folder;
  const std::string log = write_bytes(folder / "f.log", kLog), second = log + "#2";
  const std::string rows = write_bytes(folder / "in.csv", "tex1.r,primary.r\n100,255\n");
  const Outcome converted = ninebit(on_nv2a({"convert", second, "--to", "rc10"}));
  ASSERT_EQ(converted.code, 0) << converted.err;
  const std::string plain = write_bytes(folder / "f.rc", converted.out);
  EXPECT_EQ(converted.err, "");
  expect_parts(converted.out, {"!!TS1.0\ntexture_2d();\n"});
  for (const Words& arguments :
       {Words{"eval", "?", "--inputs", rows}, {"trace", "?", "--set", "tex1=100,0,0,255"}, {"validate", "?"}}) {
    Words of_log = arguments, of_file = arguments;
    of_log[1] = second;
    of_file[1] = plain;
    const Outcome a = ninebit(on_nv2a(of_log)), b = ninebit(on_nv2a(of_file));
    EXPECT_EQ(a.code, 0) << a.err;
    if (arguments[0] == "eval") {
      EXPECT_EQ(a.out, b.out);
    }
  }
  const Json explained = json_of(ninebit(on_nv2a({"explain", second, "--json"})));
  EXPECT_TRUE(explained["other_words"].empty());
  EXPECT_EQ(explained["texture_shader"][1], "tex1 = texture 1 at (s1, t1) / q1");
  EXPECT_EQ(ninebit(on_nv2a({"prove", "equivalent", second, plain})).code, 0);
  EXPECT_EQ(ninebit(on_nv2a({"prove", "equivalent", log + "#1", plain})).code, 1);
  const std::string a = folder / "a.png", b = folder / "b.png";
  EXPECT_EQ(ninebit(on_nv2a({"draw", second, "--size", "8x8", "-o", a})).code, 0);
  EXPECT_EQ(ninebit(on_nv2a({"draw", plain, "--size", "8x8", "-o", b})).code, 0);
  EXPECT_EQ(read_bytes(a), read_bytes(b));
}

TEST(LogFiles, SeveralSetUpsMustBePicked) {
  const TempFolder folder;
  const std::string log = write_bytes(folder / "f.log", kLog);
  const auto refused = [&](const Words& arguments, const std::string& why) {
    expect_parts(err_of(ninebit(on_nv2a(arguments)), 3), {why});
  };
  refused({"explain", log}, "the log has 2 combiner set-ups; pick one with #1 to #2 behind the file's name");
  refused({"explain", log + "#3"}, "the log has 2 combiner set-ups; expected a number from 1 to 2");
  refused({"explain", log + "#0"}, "#0 is out of range; combiner set-ups are counted from 1");
  refused({"convert", log, "--frame", "2", "--to", "rc10"}, "frame 2 has several combiner set-ups: #1, #2;");
  EXPECT_EQ(ninebit(on_nv2a({"convert", log, "--frame", "1", "--to", "rc10"})).code, 0);
  const std::string one = write_bytes(folder / "one.log", kHeader + program_writes(1) + kDraw);
  EXPECT_EQ(ninebit(on_nv2a({"validate", one})).code, 0);
}

TEST(LogFiles, NamesThatEndInANumberOpenAsTheyAre) {
  const TempFolder folder;
  const std::string log = write_bytes(folder / "f.log", kLog);
  const std::string named = write_bytes(folder / "f.log#1", "!!RC1.0\nout.rgb = col1;\n");
  const Outcome outcome = ninebit(on_nv2a({"explain", named}));
  expect_parts(outcome.out, {"rgb = secondary"});
  EXPECT_EQ(ninebit(on_nv2a({"explain", log + "#2"})).code, 0);
  expect_error(ninebit({"explain", folder / "none.log#1"}), 3, {"none.log", "could not be read"});
  const std::string calls = write_bytes(folder / "calls.gl", article_calls());
  expect_error(ninebit({"explain", calls + "#1"}), 3,
               {"calls.gl", "is neither a log of register writes nor a source file"});
}

TEST(LogFiles, FrameIsForLogsAlone) {
  const TempFolder folder;
  const std::string log = write_bytes(folder / "f.log", kLog), calls = write_bytes(folder / "c.gl", article_calls());
  expect_error(ninebit({"convert", calls, "--frame", "1", "--to", "rc10"}), 2,
               {"--frame is for logs of register writes"});
  expect_error(ninebit({"convert", calls, "--frame", "1"}), 2, {"--frame is for logs of register writes"});
  expect_error(ninebit(on_nv2a({"convert", log, "--frame", "3"})), 2, {"--frame 3", "the log has 2 frames with draws"});
  expect_error(ninebit({"convert", log, "--frame", "0"}), 2, {"--frame"});
  expect_error(ninebit({"convert", log + "#1"}), 2, {"--to is required"});
}

TEST(LogFiles, LogsFromStandardInput) {
  const TempFolder folder;
  const std::string outcome = out_of(ninebit(on_nv2a({"convert", "-"}), {.in = write_bytes(folder / "f.log", kLog)}));
  EXPECT_EQ(lines_of(outcome).size(), 4U) << outcome;
}

TEST(LogFiles, GuessesAndSkippedLinesAreNoted) {
  const TempFolder folder;
  const std::string log = write_bytes(folder / "g.log", "start\n0x1e60 0x101\n0x17fc 0x5\n0x17fc 0x0\n");
  expect_parts(err_of(ninebit(on_nv2a({"convert", log}))),
               {"ninebit: note: " + log + ":1:1: read as: method in column 1, data in column 2;",
                "1 line is not a register write; the first is line 1"});
  EXPECT_EQ(ninebit(on_nv2a({"convert", log, "--quiet"})).err, "");
}

TEST(LogFiles, ALogThatIsLongerThanAProgramIsStreamed) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const TempFolder folder;
  const std::string log = folder / "long.log";
  {
    std::ofstream out(log, std::ios::binary);
    out << kLog;
    std::string block;
    for (int i = 0; i < 4000; ++i) block += "0x97,0x1680,0x3f800000\n";
    for (int i = 0; i < 300; ++i) out << block;
    out << kDraw;
  }
  ASSERT_GT(std::filesystem::file_size(log), std::size_t{20} << 20);
  const Json object = json_of(ninebit(on_nv2a({"convert", log, "--json"})));
  EXPECT_EQ(object["draws"], 4);
  EXPECT_EQ(ninebit(on_nv2a({"explain", log + "#2"})).code, 0);
  EXPECT_EQ(ninebit(on_nv2a({"convert", log, "--frame", "1", "--to", "xbox"})).code, 0);
}

TEST(LogFiles, RowsThatDoNotFitTheHeaderAreErrors) {
  const TempFolder folder;
  const std::string log = write_bytes(folder / "bad.csv", kHeader + "0x97,0xac0,red\n0x97,?,1\n0x97,0x1e60,0x101\n");
  expect_parts(err_of(ninebit(on_nv2a({"convert", log})), 3),
               {log + ":2:12: 'red' in column 3 is not a number of 32 bits", log + ":3:6: '?' is not a method"});
  EXPECT_EQ(ninebit(on_nv2a({"validate", log})).code, 3);
}

TEST(LogFiles, RowsOfTablesDoNotReachOutsideThroughANumber) {
  const TempFolder folder, outside;
  write_bytes(outside / "f.log", kLog);
  std::filesystem::create_symlink(outside / "f.log", folder / "link.log");
  const std::string table = write_bytes(folder / "t.csv", "program,primary.r,tex1.r,out.r\nlink.log#2,255,100,200\n");
  expect_parts(err_of(ninebit(on_nv2a({"verify", table})), 3), {"is a link out of the folder"});
  write_bytes(folder / "f.log", kLog);
  const std::string inside = write_bytes(folder / "u.csv", "program,primary.r,tex1.r,out.r\nf.log#2,255,100,200\n");
  EXPECT_EQ(ninebit(on_nv2a({"verify", inside})).code, 0);
}

TEST(XboxFiles, EveryVerbReadsADefinition) {
  const TempFolder folder;
  const std::string file = write_bytes(folder / "psd.c", kDefinition);
  expect_parts(out_of(ninebit(on_nv2a({"explain", file}))),
               {"spare0 = 2·(tex0 × primary)", "words that combiners do not read\n",
                "texture shader\n  tex0 = texture 0 at (s0, t0) / q0\n  tex1 = texture 1 at (s1, t1, r1)\n"});
  EXPECT_EQ(ninebit(on_nv2a({"validate", file})).code, 0);
  EXPECT_EQ(ninebit(on_nv2a({"validate", file, "--from", "xbox"})).code, 0);
  const std::string wrong = write_bytes(folder / "wrong.c", "psd.PSCombinerCount = 9;\n");
  EXPECT_EQ(ninebit(on_nv2a({"validate", wrong})).code, 1);
  const std::string text = write_bytes(folder / "text.c", "psd.PSCombinerCounts = 9;\n");
  expect_parts(err_of(ninebit(on_nv2a({"validate", text})), 3),
               {text + ":1:5: 'PSCombinerCounts' is not a member of D3DPIXELSHADERDEF; did you mean"});
}

TEST(XboxFiles, OtherWordsAreKeptWhereTheyHaveAPlace) {
  const TempFolder folder;
  const std::string file = write_bytes(folder / "psd.c", kDefinition);
  for (const char* form : {"words", "words-json", "json", "xbox"}) {
    const Outcome outcome = ninebit(on_nv2a({"convert", file, "--to", form}));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "") << form;
    const std::string back = write_bytes(folder / "back", outcome.out);
    const Json again = json_of(ninebit(on_nv2a({"explain", back, "--json"})));
    EXPECT_EQ(again["other_words"].size(), 3U) << form;
    EXPECT_EQ(again["texture_shader"].size(), 2U) << form;
  }
  for (const char* form : {"gl", "rc10", "glsl", "glsl-es", "c"}) {
    EXPECT_EQ(err_of(ninebit(on_nv2a({"convert", file, "--to", form}))), "") << form;
  }
  const Outcome nv10 = ninebit({"convert", file, "--to", "words", "--chip", "nv10", "--quiet"});
  EXPECT_EQ(nv10.out.find("PSTextureModes"), std::string::npos);
  EXPECT_EQ(nv10.code, 0) << nv10.err;
}

TEST(XboxFiles, BinaryFilesOfAnotherSizeAreRefused) {
  const TempFolder folder;
  std::string bytes(240, '\0');
  bytes[4 * 53] = 1;
  EXPECT_EQ(ninebit(on_nv2a({"validate", write_bytes(folder / "psd.bin", bytes)})).code, 0);
  const std::string longer = write_bytes(folder / "longer.bin", bytes + bytes);
  expect_error(ninebit(on_nv2a({"validate", longer})), 3, {"longer.bin", "this is a binary file"});
  expect_parts(err_of(ninebit(on_nv2a({"validate", longer, "--from", "xbox"})), 3),
               {"480 bytes, which are 2 definitions; expected the 240"});
}

}  // namespace
}  // namespace tools_test
