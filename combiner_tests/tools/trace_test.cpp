// `ninebit trace` as people and programs see it, against `eval` and `render`; what a trace holds is tested beside the
// library.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/support/stored_pictures.h"
#include "combiner_tests/tools/program_support.h"
#include "ninebit/shadow/ground_truth.h"

namespace tools_test {
namespace {

using namespace ninebit;  // NOLINT(google-build-using-namespace): states are spelled in its words

const std::string kToonEffect = NINEBIT_SOURCE_DIR "/scenes/effects/toon.json";

class TraceVerb : public testing::Test {
 protected:
  TempFolder folder_;
  std::string article_ = write_program(folder_, "article.json", article_state());
};

// The line of a section that begins with this label.
std::string line_of(const std::string& text, const std::string& section, const std::string& label) {
  const std::size_t from = text.find("\n" + section);
  if (from == std::string::npos) return "no section " + section;
  for (const std::string& line : lines_of(text.substr(from + 1))) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin != std::string::npos && line.compare(begin, label.size() + 1, label + ' ') == 0) return line;
  }
  return "no line " + label;
}

// The words of a line.
Words words_of(const std::string& line) {
  std::istringstream in(line);
  Words words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}
// The picture has every line of the text, and no name in it is markup.
TEST_F(TraceVerb, APictureForSlides) {
  const std::string hostile = folder_ / "<script>&.json";
  write_bytes(hostile, read_bytes(article_));
  const std::string picture = folder_ / "trace.svg";
  const Words arguments{"trace", hostile, "--set", "primary=102,0,0,0", "--set", "tex0=100,0,0,255"};
  EXPECT_EQ(json_of(ninebit(arguments + Words{"-o", picture, "--json", "--quiet"}))["files"], Json::array({picture}));
  const std::string svg = read_bytes(picture);
  EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\"")) << svg.substr(0, 100);
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  EXPECT_EQ(svg.find('\x1b'), std::string::npos);
  const Outcome text = ninebit(arguments);
  std::size_t lines = 0;
  for (std::string line : lines_of(text.out)) {
    if (line.empty() || line.find(hostile) != std::string::npos) continue;
    ++lines;
    EXPECT_NE(svg.find('>' + line + "</text>"), std::string::npos) << line;
  }
  EXPECT_GT(lines, 20U);
  expect_parts(svg, {"&lt;script&gt;&amp;.json"});
  EXPECT_NE(svg.find("class=\"loss\""), std::string::npos) << "the square loses its last digits";
}

TEST_F(TraceVerb, TheArticlesDifferences) {
  const auto trace = [&](const char* primary) {
    const Outcome outcome = ninebit({"trace", article_, "--set", primary, "--set", "tex0=100,0,0,255"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(outcome.out.find('\x1b'), std::string::npos) << "colours, though stdout is no terminal";
    return outcome.out;
  };
  const std::string two = trace("primary=102,0,0,0");
  EXPECT_EQ(words_of(line_of(two, "stage 0, RGB", "spare0")),
            (Words{"spare0", "code", "r", "8", "0.03137", "0.03137"}));
  EXPECT_EQ(words_of(line_of(two, "stage 1, RGB", "· 4"))[4], "256");
  EXPECT_EQ(words_of(line_of(two, "stage 1, RGB", "dropped"))[3], "1");
  EXPECT_EQ(words_of(line_of(two, "stage 1, RGB", "spare1")),
            (Words{"spare1", "code", "rgb", "1", "0.00392", "0.00394"}));
  EXPECT_TRUE(two.ends_with("\nout: bytes 0, 0, 0, 1\n")) << two;
  expect_parts(two, {"stage 0, alpha portion: writes nothing\n"});

  const std::string one = trace("primary.r=101");
  EXPECT_EQ(words_of(line_of(one, "stage 1, RGB", "· 4"))[4], "64");
  expect_parts(line_of(one, "stage 1, RGB", "dropped"), {"<- everything"});
  EXPECT_EQ(words_of(line_of(one, "stage 1, RGB", "spare1")), (Words{"spare1", "code", "rgb", "0", "0", "0.00098"}));
  EXPECT_TRUE(one.ends_with("\nout: bytes 0, 0, 0, 0\n"));
}

// Columns of every row stand below each other, whatever characters the labels have.
TEST_F(TraceVerb, ColumnsAreAligned) {
  const std::string out = ninebit({"trace", article_, "--set", "primary.r=102"}).out;
  std::size_t rows = 0;
  for (const std::string& line : lines_of(out)) {
    const std::size_t code = std::max(line.find(" code "), line.find(" wide "));
    const std::size_t unit = std::min(line.find(" code "), line.find(" wide "));
    if (unit == std::string::npos || line.find("units") != std::string::npos || code == 0) continue;
    const auto continued = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80; };
    const auto before = line.begin() + static_cast<std::ptrdiff_t>(unit);
    EXPECT_EQ(unit - static_cast<std::size_t>(std::count_if(line.begin(), before, continued)), 27U) << line;
    ++rows;
  }
  EXPECT_GT(rows, 20U);
}

TEST_F(TraceVerb, Json) {
  const Json t = json_of(ninebit({"trace", article_, "--set", "primary.r=101", "--set", "tex0.r=100", "--json"}));
  EXPECT_EQ(keys_of(t), (Words{"command", "version", "profile", "program", "arithmetic", "one", "before", "stages",
                               "final", "out"}));
  EXPECT_EQ(t["command"], "trace");
  EXPECT_EQ(t["profile"], "geforce2");
  EXPECT_EQ(t["before"]["primary"]["codes"], Json({101, 0, 0, 0}));
  ASSERT_EQ(t["stages"].size(), 2U);
  EXPECT_FALSE(t["stages"][0]["alpha"]["writes"]);
  const Json& channel = t["stages"][0]["rgb"]["channels"][0];
  EXPECT_EQ(keys_of(channel),
            (Words{"channel", "a", "b", "ab_product", "ab", "c", "d", "cd_product", "cd", "outputs"}));
  EXPECT_EQ(channel["d"]["mapping"], "expand_normal");
  EXPECT_EQ(channel["d"]["read"]["code"], 0);
  EXPECT_EQ(channel["d"]["mapped"], Json({{"code", -255}, {"real", -1.0}, {"ideal", -1.0}}));
  const Json& square = t["stages"][1]["rgb"]["channels"][2]["outputs"][0];
  EXPECT_EQ(keys_of(square),
            (Words{"output", "target", "wide", "biased", "scaled", "dropped", "narrowed", "cut", "written"}));
  EXPECT_EQ(square["output"], "ab");
  EXPECT_EQ(square["target"], "spare1.b");
  EXPECT_EQ(square["dropped"], Json({{"units", 64}, {"real", 64 / 65025.0}, {"ideal", 0.0}}));
  EXPECT_EQ(square["written"], Json({{"code", 0}, {"real", 0.0}, {"ideal", 64 / 65025.0}}));
  EXPECT_EQ(t["out"], Json({{"codes", {0, 0, 0, 0}}, {"bytes", {0, 0, 0, 0}}}));
}

// Random programs of every profile, with random registers set: what leaves is what eval says of the same row.
TEST_F(TraceVerb, LeavesWhatEvalSays) {
  std::set<std::string> outputs;
  for (std::uint64_t index = 0; index < 12; ++index) {
    SCOPED_TRACE("case " + std::to_string(index));
    test::Random random(0x7EACE, index);
    const std::span<const HardwareProfile> all = hardware_profiles();
    const HardwareProfile& profile = all[index % all.size()];
    const std::string program = write_program(folder_, "random.json", test::random_state(random, profile));
    Words names{"const0", "const1", "fog", "primary", "secondary", "spare0", "spare1"};
    for (int unit = 0; unit < profile.texture_units; ++unit) names.push_back("tex" + std::to_string(unit));
    std::string header, row;
    Words arguments{"trace", program, "--profile", std::string(profile.name), "--json"};
    for (const std::string& name : names) {
      const bool whole = random.one_in(3);
      std::string codes;
      for (const char component : std::string_view("rgba")) {
        if (!whole && random.one_in(2)) continue;
        const std::string code = std::to_string(test::random_code(random, profile));
        header += (header.empty() ? "" : ",") + name + '.' + component;
        row += (row.empty() ? "" : ",") + code;
        codes += (codes.empty() ? "" : ",") + code;
        if (!whole) arguments.insert(arguments.end(), {"--set", name + '.' + component + '=' + code});
      }
      if (whole) arguments.insert(arguments.end(), {"--set", name + '=' + codes});
    }
    const std::string table = write_bytes(folder_ / "in.csv", header + '\n' + row + '\n');
    const Json expected = json_of(ninebit({"eval", program, "--inputs", table, "--profile", std::string(profile.name),
                                           "--json", "--registers"}))["rows"][0];
    const Json t = json_of(ninebit(arguments));
    const Json& last = t["stages"].back()["after"];
    for (std::size_t c = 0; c < 4; ++c) {
      const std::string component(1, "rgba"[c]);
      EXPECT_EQ(t["out"]["codes"][c], expected["out." + component]);
      for (const std::string& name : names) {
        if (name.starts_with("const")) continue;
        EXPECT_EQ(last[name]["codes"][c], expected[name + '.' + component]) << name;
      }
    }
    outputs.insert(t["out"].dump());
    expect_parts(out_of(ninebit([&] {
                   arguments.erase(std::find(arguments.begin(), arguments.end(), "--json"));
                   return arguments;
                 }())),
                 {"\nout: bytes "});
  }
  EXPECT_GT(outputs.size(), 7U);
}

TEST_F(TraceVerb, WrongUsage) {
  struct Case {
    Words arguments;
    Words words;
  };
  const std::vector<Case> cases{
      {{}, {"PROGRAM, --scene or --effect is required"}},
      {{article_, "--set"}, {"--set requires a value"}},
      {{article_, "--set", "tex0"}, {"'tex0' has no value", "REGISTER=R,G,B,A"}},
      {{article_, "--set", "tex2=1,2,3,4"}, {"unknown register 'tex2'", "tex0 to tex1"}},
      {{article_, "--set", "zero.r=1"}, {"unknown register 'zero.r'"}},
      {{article_, "--set", "tex0.x=1"}, {"'tex0.x'", ".r, .g, .b or .a"}},
      {{article_, "--set", "tex0=1,2,3"}, {"tex0 takes four whole numbers", "-255 to 255", "'1,2,3'"}},
      {{article_, "--set", "tex0=1,2,3,4,5"}, {"four whole numbers"}},
      {{article_, "--set", "tex0=1,2,3,256"}, {"-255 to 255"}},
      {{article_, "--set", "tex0.r=128", "--profile", "geforce256-8bit"}, {"-127 to 127", "'128'"}},
      {{article_, "--set", "tex0.r=1.5"}, {"tex0.r takes a whole number", "'1.5'"}},
      {{article_, "--set", "tex0.r="}, {"''"}},
      {{article_, "--set", "fog.r=1", "--set", "fog=1,2,3,4"}, {"fog.r is set twice"}},
      {{article_, "--set", "fog.r=1", "--scene", kRoom, "--pixel", "1,1"}, {"--set excludes --scene"}},
      {{article_, "--pixel", "1,1"}, {"--pixel requires --scene"}},
      {{article_, "--size", "64x64"}, {"--size requires --scene"}},
      {{article_, "--pass", "lit"}, {"--pass requires --scene or --effect"}},
      {{"--scene", kRoom}, {"--scene requires --pixel X,Y"}},
      {{"--effect", kToonEffect}, {"--effect requires --pixel X,Y"}},
      {{"--effect", kToonEffect, "--scene", kRoom, "--pixel", "1,1"}, {"--scene excludes --effect"}},
      {{article_, "--effect", kToonEffect, "--pixel", "1,1"}, {"not PROGRAM"}},
      {{"--scene", kRoom, "--pixel", "7"}, {"invalid pixel '7'"}},
      {{"--scene", kRoom, "--pixel", "2.5,3"}, {"invalid pixel '2.5,3'; expected X,Y, each a whole number"}},
      {{"--effect", kToonEffect, "--pixel", "1,1", "--frame", "2.5"}, {"invalid frame '2.5'; expected a whole number"}},
      {{"--scene", kRoom, "--pixel", "-1,3"}, {"invalid pixel '-1,3'"}},
      {{"--scene", kRoom, "--pixel", "64,0", "--size", "64x48"}, {"64,0 is outside", "0 to 63", "0 to 47"}},
      {{"--scene", kRoom, "--pixel", "0,48", "--size", "64x48"}, {"0,48 is outside"}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(testing::PrintToString(c.arguments));
    const Words arguments = Words{"trace"} + c.arguments;
    expect_error(ninebit(arguments), 2, c.words + Words{"(see: ninebit trace --help)"});
  }
  expect_error(ninebit({"trace", folder_ / "none", "--set", "fog.r=1"}), 3, {"none"});
  expect_error(ninebit({"trace", "--scene", folder_ / "none", "--pixel", "1,1"}), 3, {"none"});
}

// A grid of pixels of the room: what the trace says of each is what the rendered picture shows.
TEST_F(TraceVerb, PixelsOfTheRoom) {
  const Words size{"--size", "48x36", "--map-size", "32"};
  ASSERT_EQ(ninebit(small_render(kRoom, folder_ / "out", {"--layers", "--quiet"})).code, 0);
  const Image8 shadow = test::read_png(folder_ / "out/shadow.png");
  const Image8 color = test::read_png(folder_ / "out/color.png");
  std::map<std::string, std::vector<double>> layers;
  for (const test::StoredPart& part : test::read_exr(folder_ / "out/layers.exr")) {
    if (part.name == "polygon" || part.name == "output") layers[part.name] = part.channels.begin()->second.numbers();
  }
  std::map<std::string, int> states;
  for (int y = 1; y < 36; y += 9) {
    for (int x = 2; x < 48; x += 9) {
      SCOPED_TRACE(std::to_string(x) + "," + std::to_string(y));
      const Json t = json_of(ninebit(
          Words{"trace", "--scene", kRoom, "--json", "--pixel", std::to_string(x) + "," + std::to_string(y)} + size));
      const Json& scene = t["scene"];
      const auto at = static_cast<std::size_t>(y * 48 + x);
      ++states[scene["state"]];
      ASSERT_EQ(scene["state"], shadow.pixels[at] != 0 ? "shadowed" : "lit");
      ASSERT_EQ(scene["pass"], "comparison");
      const Json& traced = scene["passes"][1]["fragments"][scene["fragment"].get<std::size_t>()];
      EXPECT_EQ(traced["polygon"], layers["polygon"][at]);
      EXPECT_EQ(traced["fate"], shadow.pixels[at] != 0 ? "written" : "alpha test failed");
      EXPECT_EQ(t["out"]["bytes"][3], layers["output"][at]);
      EXPECT_EQ(t["out"]["bytes"][3] != 0, shadow.pixels[at] != 0);
      EXPECT_EQ(t["out"]["bytes"], traced["color"]);
      const Json& drawn = scene["passes"][shadow.pixels[at] != 0 ? 3 : 2]["fragments"];
      const auto written =
          std::find_if(drawn.rbegin(), drawn.rend(), [](const Json& f) { return f["fate"] == "written"; });
      ASSERT_NE(written, drawn.rend());
      for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ((*written)["color"][c], color.pixels[at * 3 + c]);
    }
  }
  EXPECT_GT(states["lit"], 5);
  EXPECT_GT(states["shadowed"], 2);
}

// The truth about some pixels, against the layers of a judged rendering; another pass than the one that decided.
TEST_F(TraceVerb, GroundTruthOfAPixel) {
  ASSERT_EQ(ninebit(small_render(kRoom, folder_ / "out", {"--layers", "--ground-truth", "--quiet"})).code, 0);
  std::map<std::string, std::vector<double>> layers;
  for (const test::StoredPart& part : test::read_exr(folder_ / "out/layers.exr")) {
    layers[part.name] = part.channels.begin()->second.numbers();
  }
  const std::vector<const char*> states{"background", "lit", "shadowed"};
  const auto trace = [&](std::size_t at, const Words& more) {
    return ninebit(Words{"trace", "--scene", kRoom, "--pixel", std::to_string(at % 48) + "," + std::to_string(at / 48),
                         "--size", "48x36", "--map-size", "32"} +
                   more);
  };
  int right = 0, wrong = 0;
  for (std::size_t at = 0; at < 48 * 36; ++at) {
    const auto cause = static_cast<std::size_t>(layers["cause"][at]);
    if (cause == 0 ? at % 331 != 0 : wrong >= 6) continue;
    SCOPED_TRACE(at);
    ++(cause == 0 ? right : wrong);
    const Json truth = json_of(trace(at, {"--ground-truth", "--json"}))["truth"];
    EXPECT_EQ(truth["state"], states[static_cast<std::size_t>(layers["truth"][at])]);
    EXPECT_EQ(truth["cause"], name_of(static_cast<ErrorCause>(cause)));
    EXPECT_EQ(truth["polygon"], layers["polygon"][at]);
    EXPECT_EQ(truth["occluder"].is_null(), truth["state"] == "lit");
    const std::string text = trace(at, {"--ground-truth"}).out;
    const std::string says =
        cause == 0 ? "the pixel is right" : "the pixel is wrong (" + truth["cause"].get<std::string>() + "): ";
    expect_parts(text, {says});
  }
  EXPECT_GE(right, 4);
  EXPECT_EQ(wrong, 6);
  const Json lit = json_of(trace(0, {"--pass", "lit", "--json"}));
  EXPECT_EQ(lit["scene"]["pass"], "lit");
  EXPECT_FALSE(lit.contains("truth"));
  expect_parts(err_of(trace(0, {"--pass", "blur"}), 2),
               {"--pass blur: there is no such pass; expected one of depth, comparison, lit, shadow"});
}

// A picture that shows the sky: the trace says so, and traces nothing.
TEST_F(TraceVerb, Background) {
  const Words sky{"trace", "--scene",  kRoom,    "--pixel",   "3,4",    "--size",  "20x20", "--light",
                  "0,1,0", "--camera", "0,50,0", "--look-at", "0,90,1", "--floor", "none",  "--quiet"};
  expect_parts(out_of(ninebit(sky)), {" background\n", "no fragment to trace\n"});
  const Json t = json_of(ninebit(sky + Words{"--json"}));
  EXPECT_EQ(t["scene"]["state"], "background");
  EXPECT_TRUE(t["scene"]["pass"].is_null());
  EXPECT_FALSE(t.contains("stages"));
}

// A program of one's own runs on the registers of the rendering's fragment.
TEST_F(TraceVerb, AnotherProgramOnTheSameFragment) {
  CombinerState state;
  state.final_combiner.a = state.final_combiner.b = state.final_combiner.c = CombinerInput{};
  state.final_combiner.d = {Register::texture0, InputMapping::unsigned_identity, ComponentUsage::rgb};
  const std::string program = write_program(folder_, "texel.json", state);
  const Words pixel{"--scene", kRoom, "--pixel", "20,30", "--size", "48x36", "--json"};
  const auto trace = [&](const Words& arguments) { return json_of(ninebit(arguments + pixel)); };
  const Json own = trace({"trace"}), other = trace({"trace", program});
  EXPECT_EQ(own["before"], other["before"]);
  EXPECT_EQ(own["scene"], other["scene"]);
  EXPECT_TRUE(own["program"].is_null());
  EXPECT_EQ(other["program"], program);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(other["out"]["codes"][c], own["before"]["tex0"]["codes"][c]);
  EXPECT_NE(other["out"]["codes"][0].get<int>() + other["out"]["codes"][1].get<int>(), 0);
}

TEST_F(TraceVerb, ThreadsAndOtherProfilesOfAScene) {
  const auto trace = [&](const char* threads, const char* profile) {
    return ninebit({"trace", "--scene", kRoom, "--pixel", "30,20", "--size", "48x36", "--threads", threads, "--profile",
                    profile, "--light-facing", "--index-step", "3", "--quiet"});
  };
  for (const HardwareProfile& profile : hardware_profiles()) {
    const std::string name(profile.name);
    const Outcome one = trace("1", name.c_str());
    EXPECT_EQ(one.code, 0) << one.err;
    EXPECT_EQ(one.err, "");
    expect_parts(one.out, {"profile " + name});
    EXPECT_EQ(trace("3", name.c_str()).out, one.out);
  }
}

}  // namespace
}  // namespace tools_test
