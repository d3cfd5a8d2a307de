// Every flag of every verb that takes a value, found in the program's own help, with values that nobody means: the
// program answers soon, by a line that names the flag, the value and what is expected, and takes none silently for
// another.
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

// For flags that take a number or a list, and for others, where any number is as wrong as another.
const Words kNumbers{"", "nan", "inf", "-inf", "-1", "0", "1e308", "1000000000000000000000000000000", "1e-320"};
const Words kOthers{"nan", "0"};
const std::string kCompare = NINEBIT_SOURCE_DIR "/docs/programs/index_compare.gl";

// The values that a flag may have.
const std::map<std::string, std::set<std::string>> kRight{
    {"--threads", {"0"}},
    {"--floor", {"-1", "0"}},
    {"--bias", {"0"}},
    {"--biases", {"0"}},
    {"--budget", {"0", "1e-320"}},
    {"--most", {"0"}},
    {"--patch-angle", {"0"}},
    {"--timeout", {"0", "1e-320"}},
    {"--seed", {"0"}},
    {"--point-size", {"0", "1e-320"}},
    {"--polygon-stipple", {"0"}},
};

struct Flag {
  std::string name, type;
  [[nodiscard]] bool is_choice() const { return type.find('{') != std::string::npos; }
  [[nodiscard]] bool is_number() const {
    static const std::regex number(
        "((N|INT|UINT|FLOAT|DEGREES|SECONDS|PIXELS|DISTANCE|TEXELS|LIST)([=:].*)?|.*HEIGHT.*)");
    return std::regex_match(type, number);
  }
  // The same at flags of the same code: those of other verbs, with another default, and of other texture units.
  [[nodiscard]] std::string kind() const {
    static const std::regex own("[0-9]+ |=.*");
    return std::regex_replace(name + ' ' + type, own, " ");
  }
};

// Flags with values, but for those that name files or functions: any text may be such a name.
std::vector<Flag> flags_in(const std::string& help) {
  static const std::regex line("\n  (?:-[a-z],)?(--[a-z0-9-]+) ([^ \n]+)");
  static const std::regex name("(DIR|FILE|PROGRAM)([,.|\\[].*)?|NAME|Needs:|Excludes:");
  std::vector<Flag> flags;
  for (std::sregex_iterator found(help.begin(), help.end(), line), end; found != end; ++found) {
    const Flag flag{(*found)[1], (*found)[2]};
    if (!std::regex_match(flag.type, name)) flags.push_back(flag);
  }
  return flags;
}

// The rest of a command that is right without the flag, and over soon.
Words command(const Words& verb, const Flag& flag, const std::string& folder) {
  const std::string name = verb.back();
  std::map<std::string, std::string> given;
  Words files;
  const bool draws = name == "render" || name == "compare" || name == "frame" || name == "shadows" ||
                     (name == "trace" && flag.name != "--set" && !flag.is_choice());
  if (draws) {
    given["--size"] = "8x6";
    if (flag.name != "--map-sizes") given["--map-size"] = "8";
    if (name == "trace") {
      given["--scene"] = kRoom;
      given["--pixel"] = "1,1";
    } else {
      files = {kRoom};
    }
  }
  if (flag.name == "--bias" || flag.name == "--biases") given["--technique"] = "depth-cube";
  if (name == "render" || name == "compare" || verb.front() == "study") given["-o"] = folder + "/out";
  const bool reads = name == "explain" || name == "convert" || name == "validate" || name == "eval";
  if (reads || (name == "trace" && !draws)) files = {kCompare};
  if (name == "draw") {
    files = {kCompare};
    given["--size"] = "8x6";
    given["-o"] = folder + "/out/picture.png";
    if (flag.name == "--floor") given["--mesh"] = "cube";
    if (flag.name == "--point-size") given["--polygon-mode"] = "point";
    if (flag.name == "--line-width") given["--polygon-mode"] = "line";
  }
  if (name == "stable") files = {kCompare};
  if (name == "equivalent") files = {kCompare, kCompare};
  if (name == "discriminate" && flag.name == "--profile") given["--field"] = "half";
  if (name == "discriminate" && flag.name != "--profile" && flag.name != "--field") files = {"geforce2", "nv2a"};
  if (name == "kit") given["-o"] = folder + "/out";
  if (name == "vectors") given.insert({{"-o", folder + "/out"}, {"--programs", "100"}});
  if (name == "convert") given["--to"] = "json";
  if (name == "eval") given["--inputs"] = folder + "/in.csv";
  if (name == "verify") {
    files = {folder + "/rows.csv"};
    given["--program"] = kCompare;
  }
  if (name == "merge") files = {folder + "/part.jsonl"};
  if (name == "generate") files = {"man"};
  if (name == "index-steps") given.insert({{"--formats", "channel"}, {"--steps", "1"}, {"--profile", "geforce2"}});
  if (name == "datapath" && flag.name != "--forms") {
    given.insert({{"--program", kCompare}, {"--over", "tex0.r"}});
  }
  if (name == "depth-packing") given.insert({{"--packings", "rgba8-mod"}, {"--storages", "round"}, {"--depths", "16"}});
  given.erase(flag.name);
  if (flag.name == "--variants") given.erase("--formats");
  Words words = verb + files;
  for (const auto& [one, value] : given) words.insert(words.end(), {one, value});
  if (verb.front() == "bench") words.emplace_back("--quick");
  if (name == "datapath" && flag.name == "--forms") words.emplace_back("--exhaustive-sum");
  words.emplace_back("--quiet");
  return words;
}

void expect_answer(const Words& words, const Flag& flag, const std::string& value) {
  const auto begin = std::chrono::steady_clock::now();
  const Outcome outcome = ninebit(words);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(seconds.count(), 10.0);
  const auto right = kRight.find(flag.name);
  if (right != kRight.end() && right->second.contains(value)) {
    // A table of no rows or a part that is not there is another matter.
    EXPECT_EQ(outcome.code, words[1] == "merge" ? 3 : 0) << outcome.err;
    return;
  }
  expect_error(outcome, 2, {flag.name, value.empty() ? "requires a value" : value});
  if (value.empty()) return;
  const bool says = outcome.err.find("expected") != std::string::npos || outcome.err.find(" in ") != std::string::npos;
  EXPECT_TRUE(says) << outcome.err;
}

TEST(Flags, OfAllVerbsRefuseWhatNobodyMeans) {
  const TempFolder folder;
  write_bytes(folder / "in.csv", "primary.r\n1\n");
  write_bytes(folder / "rows.csv", "primary.r,tex0.r,out.a\n1,1,0\n");
  std::size_t runs = 0;
  std::set<std::string> seen;
  for (const auto& [names, help] : help_of_all_verbs()) {
    if (help.find("\nSubcommands:\n") != std::string::npos) continue;
    const std::vector<Flag> flags = flags_in(help);
    std::istringstream words_of(names);
    const Words verb{std::istream_iterator<std::string>(words_of), {}};
    for (const Flag& flag : flags) {
      // Each kind of value at one of the flags of the same code, one value at the others; choices need no other.
      const bool known = !seen.insert(flag.kind()).second;
      if (known && flag.is_choice()) continue;
      Words values = known || flag.is_choice() ? Words{"nan"} : flag.is_number() ? kNumbers : kOthers;
      if (&flag == &flags.front() && values.front() != "") values.emplace_back();
      for (const std::string& value : values) {
        const Words words = command(verb, flag, folder.path()) + Words{flag.name + '=' + value};
        SCOPED_TRACE(testing::PrintToString(words));
        expect_answer(words, flag, value);
        std::filesystem::remove_all(folder / "out");
        ++runs;
      }
    }
  }
  EXPECT_GT(runs, 300U);
  for (const auto& [flag, values] : kRight) {
    EXPECT_TRUE(std::any_of(seen.begin(), seen.end(), [&name = flag](const auto& one) {
      return one.starts_with(name);
    })) << flag;
  }
}

}  // namespace
}  // namespace tools_test
