// `ninebit prove kit`, the C file that it writes, and `ninebit verify --decide`, which reads what a card showed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "combiner_tests/tools/program_support.h"
#include "ninebit/study/chip_kit.h"

namespace tools_test {
namespace {

bool has_program(const std::string& name) {
  return shell("command -v " + name).second == 0;
}

class Kit : public testing::Test {
 protected:
  // A family's kit in the test's folder; the answer of the program, which searches it once for all tests.
  Json write_kit(const std::string& family) {
    static const TempFolder kept;
    static std::map<std::string, Json> answers;
    const std::string kit = kept / family;
    if (!answers.contains(family)) {
      answers[family] = json_of(ninebit({"prove", "kit", "--family", family, "-o", kit, "--json"}));
    }
    std::filesystem::copy(kit, folder_ / family);
    return answers[family];
  }

  // The table that a card writes which shows these greys. The rows' beginnings come from the C file.
  std::string results(const std::string& family, const std::vector<int>& shown, const std::string& comments = "") {
    const std::string source = read_bytes(folder_ / (family + "/kit.c"));
    const std::string header = between(source, "#define HEADER \"", "\"", 0);
    std::string table = comments + header + "\n";
    std::size_t at = source.find("static const Row rows[]");
    for (std::size_t i = 0; i < shown.size(); ++i) {
      at = source.find("{\"k" + std::to_string(i + 1) + ",", at);
      const std::string byte = std::to_string(shown[i]);
      table += between(source, "{\"", "\"", at) + byte + "," + byte + "," + byte + "\n";
    }
    return write_bytes(folder_ / "results.csv", table);
  }

  static std::string between(const std::string& text, const std::string& begin, const std::string& end,
                             std::size_t from) {
    const std::size_t first = text.find(begin, from) + begin.size();
    return text.substr(first, text.find(end, first) - first);
  }

  static std::vector<int> expected_of(const Json& kit) {
    std::vector<int> shown;
    for (const Json& program : kit["programs"]) shown.push_back(program["expected"]);
    return shown;
  }

  TempFolder folder_;
};

TEST_F(Kit, HasAProgramForEachQuestion) {
  const Json kit = write_kit("geforce2");
  EXPECT_EQ(keys_of(kit), (Words{"command", "version", "question", "family", "combinations", "told_apart", "complete",
                                 "fields", "programs", "files"}));
  EXPECT_EQ(kit["complete"], true);
  EXPECT_EQ(kit["files"].size(), 2 + kit["programs"].size());
  for (const Json& program : kit["programs"]) {
    const std::string file = folder_ / ("geforce2/" + std::string(program["name"]) + ".rc1");
    EXPECT_EQ(read_bytes(file), program["program"]);
    EXPECT_EQ(ninebit({"validate", file}).code, 0);
  }
  const std::string page = read_bytes(folder_ / "geforce2/README.md");
  for (const Json& field : kit["fields"]) expect_parts(page, {std::string(field["field"])});
}

TEST_F(Kit, CompilesForLinuxAndSaysWhatIsMissing) {
  write_kit("geforce2");
  const std::string source = folder_ / "geforce2/kit.c", program = folder_ / "kit";
  const auto [messages, status] =
      shell("cc -std=c99 -pedantic -Wall -Wextra -Werror '" + source + "' -o '" + program + "' -lGL -lX11");
  ASSERT_EQ(status, 0) << messages;
  const std::string table = folder_ / "results.csv";
  const auto [no_display, code] = shell("env -u DISPLAY '" + program + "' '" + table + "'");
  EXPECT_EQ(code, 2);
  EXPECT_EQ(no_display, "kit: there is no X display; is DISPLAY set?\n");
  if (has_program("xvfb-run")) {  // Mesa has no combiners
    const auto [no_combiners, end] = shell("xvfb-run -a -s '-screen 0 320x240x24' '" + program + "' '" + table + "'");
    EXPECT_EQ(end, 2) << no_combiners;
    expect_parts(no_combiners, {"this driver has no GL_NV_register_combiners"});
  }
  EXPECT_FALSE(std::filesystem::exists(table));
}

TEST_F(Kit, CompilesForWindows) {
  if (!has_program("x86_64-w64-mingw32-gcc")) GTEST_SKIP() << "needs the package gcc-mingw-w64-x86-64-win32";
  for (const char* family : {"geforce2", "nv2a"}) {
    write_kit(family);
    const auto [messages, status] =
        shell("x86_64-w64-mingw32-gcc -std=c99 -pedantic -Wall -Wextra -Werror '" +
              (folder_ / (std::string(family) + "/kit.c")) + "' -o '" + (folder_ / "kit.exe") + "' -lopengl32 -lgdi32");
    EXPECT_EQ(status, 0) << messages;
  }
}

TEST_F(Kit, TheFamilysOwnColoursDecideForItsValues) {
  for (const char* family : {"geforce2", "nv2a"}) {
    const Json kit = write_kit(family);
    const std::string table = results(family, expected_of(kit), "# family: x\n# renderer: GeForce2 MX/AGP\n");
    Words words{"verify", "--decide", table, "--json"};
    if (family != std::string("geforce2")) words = words + Words{"--family", family};  // it is the default
    const Json verdict = json_of(ninebit(words));
    EXPECT_EQ(verdict["fields"].size(), kit["fields"].size());
    for (std::size_t i = 0; i < kit["fields"].size(); ++i) {
      EXPECT_EQ(verdict["fields"][i]["fits"][0].dump(), [&] {
        const std::string word = kit["fields"][i]["values"][0];
        return word.find_first_not_of("-0123456789") == std::string::npos ? word : '"' + word + '"';
      }());
    }
    const std::string name = std::string(family) + "-card";
    EXPECT_EQ(verdict["profile"], Json({{"base", family}, {"name", name}, {"chip", "GeForce2 MX/AGP"}}));
  }
}

// A card with other values: the profile that is written shows its colours.
TEST_F(Kit, WritesTheProfileOfACard) {
  const Json kit = write_kit("nv2a");
  const std::string card =
      write_bytes(folder_ / "played.json",
                  R"({"base": "nv2a", "name": "played", "expand_offset": 256, "narrowing_point": "before-scale"})");
  std::vector<int> shown = expected_of(kit);
  const std::string page = read_bytes(folder_ / "nv2a/README.md");
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const std::string name = kit["programs"][i]["name"];
    // The inputs stand in the page: "| k1 | `…` | 181, 7, 0 | – | 5 |".
    const std::size_t row = page.find("| " + name + " |");
    const std::string inputs = between(page, "` | ", " |", row), rest = between(page, "` | ", "\n", row);
    if (rest.find("| 0 |") != std::string::npos) continue;  // unit 0 is off: not played here
    std::array<int, 3> byte{};
    ASSERT_EQ(std::sscanf(inputs.c_str(), "%d, %d, %d", &byte[0], &byte[1], &byte[2]), 3) << inputs;
    std::string header, values;
    for (const auto& [reg, value] : {std::pair{"tex0.", byte[0]}, {"tex1.", byte[1]}, {"primary.", byte[2]}}) {
      for (const char c : {'r', 'g', 'b', 'a'}) {
        header += std::string(header.empty() ? "" : ",") + reg + c;
        values += (values.empty() ? "" : ",") + std::to_string(value);
      }
    }
    const std::string table = write_bytes(folder_ / "in.csv", header + ",secondary.a\n" + values + ",0\n");
    shown[i] = json_of(ninebit({"eval", folder_ / ("nv2a/" + name + ".rc1"), "--inputs", table, "--profile", card,
                                "--json"}))["rows"][0]["out.r"];
  }
  const std::string output = folder_ / "card.json";
  expect_parts(err_of(ninebit({"verify", "--decide", results("nv2a", shown), "--family", "nv2a", "-o", output})),
               {"wrote "});
  EXPECT_EQ(
      Json::parse(read_bytes(output)),
      Json({{"base", "nv2a"}, {"name", "nv2a-card"}, {"expand_offset", 256}, {"narrowing_point", "before-scale"}}));
  EXPECT_EQ(ninebit({"explain", folder_ / "nv2a/k2.rc1", "--profile", output}).code, 0);
}

TEST_F(Kit, TablesThatDecideNothing) {
  const Json kit = write_kit("nv2a");
  const std::vector<int> right = expected_of(kit);
  const auto refuse = [&](const std::string& table, const Words& words) {
    const std::string output = folder_ / "card.json";
    expect_error(ninebit({"verify", "--decide", table, "--family", "nv2a", "-o", output, "--quiet"}), 3, words);
    EXPECT_FALSE(std::filesystem::exists(output));
  };
  std::vector<int> shown = right;
  shown[0] = 77;  // no value of any field
  refuse(results("nv2a", shown), {"results.csv", "k1 = 77"});

  // Colours that occur, but not on one card.
  const auto same = ninebit::make_chip_kit(ninebit::profiles::nv2a);
  for (std::size_t i = 0; i < same->shown.size(); ++i) {
    shown = right;
    shown.back() = same->shown[i].back();
    if (ninebit::decide(*same, shown).fitting.empty()) break;
  }
  ASSERT_NE(shown, right);
  refuse(results("nv2a", shown), {"k3 = ", " and k4 = ", "together: these rows exclude each other"});

  const std::string table = results("nv2a", right), text = read_bytes(table);
  write_bytes(table, text.substr(0, text.rfind("k4")));
  refuse(table, {"results.csv:4:1", "3 of 4 rows", "k4 is missing"});
  write_bytes(table, text.substr(0, text.size() - 6));
  refuse(table, {"results.csv:5:", "three equal numbers"});
  write_bytes(table, text + text.substr(text.rfind("k4")));
  refuse(table, {"results.csv:6:1", "k4 has two rows"});
  write_bytes(table, text + "k5,!!RC1.0 out.rgb = zero;,0,0,0,none,0,0,0\n");
  refuse(table, {"results.csv:6:1", "is no row of the kit for family nv2a"});
  write_bytes(table, "a,b\n1,2\n");
  refuse(table, {"results.csv:1:1", "expected the header name,program"});
  write_bytes(table, "");
  refuse(table, {"results.csv"});
  refuse(folder_ / "none.csv", {"none.csv"});
}

TEST_F(Kit, FlagsOfOtherTables) {
  const std::string table = folder_ / "results.csv";
  expect_error(ninebit({"verify", "--decide", table, "--profile", "nv2a"}), 2, {"--profile", "--decide"});
  expect_error(ninebit({"verify", table, "--family", "nv2a"}), 2, {"--family", "--decide"});
  expect_error(ninebit({"verify", table, "-o", folder_ / "card.json"}), 2, {"--output", "--decide"});
  expect_error(ninebit({"verify"}), 2, {"a table", "--decide"});
  expect_error(ninebit({"prove", "kit", "--family", "ideal", "-o", folder_ / "kit"}), 2, {"--family", "geforce2"});
}

// By name. Words that are 0 are not there.
using WordsOfProgram = std::map<std::string, unsigned long>;

// The words of a pack's programs before its combinations.
std::vector<WordsOfProgram> words_of_first_programs(const std::string& pack) {
  std::ifstream file(pack);
  std::map<unsigned long, std::string> names;
  std::map<unsigned long, unsigned long> base;
  std::vector<WordsOfProgram> programs;
  const auto read = [](std::istringstream& words, std::map<unsigned long, unsigned long>& to) {
    for (std::string word; words >> word;) {
      to[std::stoul(word)] = std::stoul(word.substr(word.find('=') + 1), nullptr, 16);
    }
  };
  for (std::string line, kind; std::getline(file, line) && !line.starts_with("group two-things");) {
    std::istringstream words(line);
    words >> kind;
    unsigned long number = 0, input = 0;
    if (kind == "word") {
      words >> number;
      words >> names[number];
    } else if (kind == "base") {
      base.clear();
      read(words, base);
    } else if (kind == "p") {
      words >> number >> input;
      auto values = base;
      read(words, values);
      auto& program = programs.emplace_back();
      for (const auto& [index, value] : values) {
        if (value != 0) program[names[index]] = value;
      }
    }
  }
  return programs;
}

// The kit for an Xbox, compiled with headers that have nxdk's calls: its push buffer, played by the two C files, gives
// the expected colours, and its methods are a log that has the pack's programs.
TEST_F(Kit, TheXboxsStreamGivesTheColorsOfThePack) {
  const std::string kit = folder_ / "xbox";
  const Json answer = json_of(ninebit({"prove", "kit", "--target", "xbox", "-o", kit, "--json"}));
  EXPECT_EQ(answer["family"], "nv2a");
  EXPECT_TRUE(std::filesystem::exists(kit + "/Makefile"));
  expect_parts(read_bytes(kit + "/README.md"), {"Nobody has run this program on an Xbox yet"});
  const std::string sources(NINEBIT_SOURCE_DIR), stubs = sources + "/combiner_tests/emulators/xbox",
                                                 combiner = sources + "/src/combiner/c99";
  const auto [messages, status] =
      shell("cc -std=c99 -pedantic -Wall -Wextra -Werror -DDRIVE='\"" + (folder_ / "") + "\"' -I '" + stubs + "' -I '" +
            combiner + "' '" + kit + "/kit.c' '" + stubs + "/player.c' '" + combiner + "/ninebit_combiner.c' -lm -o '" +
            (folder_ / "player") + "'");
  ASSERT_EQ(status, 0) << messages;
  const std::string log = folder_ / "trace.log";
  const auto [said, code] = shell("LOG='" + log + "' '" + (folder_ / "player") + "'");
  ASSERT_EQ(code, 0) << said;

  // What it wrote, as ninebit reads it.
  const Json decided =
      json_of(ninebit({"verify", "--decide", folder_ / "ninebit_kit.csv", "--family", "nv2a", "--json"}));
  // Nothing but names: the four fields have the values of the family.
  EXPECT_EQ(decided["profile"], Json({{"base", "nv2a"}, {"name", "nv2a-card"}, {"chip", "NV2A of an Xbox"}}));
  ASSERT_EQ(decided["fields"].size(), 4U);
  for (const Json& field : decided["fields"]) EXPECT_EQ(field["fits"].size(), 1U) << field;
  ASSERT_EQ(ninebit({"vectors", "--profile", "nv2a", "-o", folder_ / "pack", "--quiet"}).code, 0);
  const Json verified =
      json_of(ninebit({"verify", folder_ / "ninebit_pack.txt", "--vectors", folder_ / "pack", "--json"}));
  EXPECT_EQ(verified["differ"], 0);
  EXPECT_GT(verified["agree"], 3000);

  // Its methods as a log: the words of each set-up are those of a program that it has.
  const Json listed = json_of(ninebit({"convert", log, "--profile", "nv2a", "--json"}));
  ASSERT_GT(listed["setups"], 150);
  const auto programs = words_of_first_programs(folder_ / "pack/vectors.txt");
  std::size_t found = 0;
  for (const Json& row : listed["rows"]) {
    const bool is_there = std::any_of(programs.begin(), programs.end(), [&](const WordsOfProgram& words) {
      for (const auto& [name, value] : row["words"].items()) {
        const auto word = words.find(name);
        // Whether a constant that the program does not read is each stage's own.
        const unsigned long unread = name == "RC_ENABLE" ? 0x11000 : 0;
        const unsigned long expected = word == words.end() ? 0 : word->second;
        if (((std::stoul(std::string(value), nullptr, 16) ^ expected) & ~unread) != 0) return false;
      }
      return true;
    });
    found += is_there ? 1U : 0U;
  }
  // All but the kit's own.
  EXPECT_GE(found + 4, listed["rows"].size());
}

TEST_F(Kit, TheXboxHasAnNv2a) {
  const auto refused = ninebit({"prove", "kit", "--target", "xbox", "--family", "geforce2", "-o", folder_ / "kit"});
  EXPECT_EQ(refused.code, 2);
  expect_parts(refused.err, {"--target xbox: --family is geforce2, expected nv2a"});
}

}  // namespace
}  // namespace tools_test
