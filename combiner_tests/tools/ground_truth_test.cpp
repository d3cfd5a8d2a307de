// `ninebit render --ground-truth`: errors counted, shown and written.
#include <gtest/gtest.h>

#include <array>
#include <set>

#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/support/stored_pictures.h"
#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

Words judged_render(const TempFolder& folder, const Words& more) {
  return small_render(kRoom, folder / "out", Words{"--size", "160x120", "--map-size", "64", "--ground-truth"} + more);
}

// The words of a command whose words have no quotes, without the program's name.
Words words_of_command(const std::string& command) {
  Words words;
  for (std::size_t from = 0; from < command.size();) {
    const std::size_t end = std::min(command.find(' ', from), command.size());
    words.push_back(command.substr(from, end - from));
    from = end + 1;
  }
  EXPECT_EQ(words[0], "ninebit");
  words.erase(words.begin());
  return words;
}

// What a command ends with that traces a pixel says of it.
Json truth_by(const std::string& command) {
  return json_of(ninebit(words_of_command(command) + Words{"--json", "--quiet"}))["truth"];
}

// Every cause that occurs has a pixel, and its command finds that cause there; samples are pixels of a larger picture.
TEST(GroundTruthOfRender, TheWorstPixelsCanBeTraced) {
  const TempFolder folder;
  for (const Words& flags : {Words{"--index-step", "1", "--supersample", "2", "--up", "y"},
                             Words{"--technique", "shadow-map", "--polygon-offset", "0,0", "--profile", "nv2a"}}) {
    Words more = flags + Words{"--json"};
    const Json errors = json_of(ninebit(judged_render(folder, more)))["errors"];
    std::set<std::string> causes;
    for (const Json& worst : errors["worst"]) {
      EXPECT_EQ(truth_by(worst["command"])["cause"], worst["cause"]) << worst["command"];
      causes.insert(worst["cause"]);
    }
    for (const auto& [cause, count] : errors["by_cause"].items()) EXPECT_EQ(causes.contains(cause), count > 0) << cause;
    EXPECT_GE(causes.size(), 2U);
    more.pop_back();
    std::erase(more, "--quiet");
    Words spoken = judged_render(folder, more);
    std::erase(spoken, "--quiet");
    const Outcome said = ninebit(spoken);
    for (const std::string& cause : causes) {
      expect_parts(said.out, {"\n  " + cause + ": ninebit trace --scene "});
    }
  }
}

TEST(GroundTruthOfRender, QuotesNamesForTheShell) {
  const TempFolder folder;
  const std::string file = folder / "it's a room.gltf";
  write_bytes(file, read_bytes(kCornell));
  const Json answer = json_of(ninebit(small_render(file, folder / "out", {"--ground-truth", "--json"})));
  ASSERT_FALSE(answer["errors"]["worst"].empty());
  const std::string quoted = "--scene '" + std::string(folder / "it'\\''s a room.gltf") + "' --size";
  const std::string command = answer["errors"]["worst"][0]["command"];
  expect_parts(command, {quoted});
}

// Of compared pictures, too, and of the points of a study.
TEST(GroundTruthOfRender, OtherVerbsNameTheWorstPixels) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const TempFolder folder;
  const Words size{"--size", "160x120", "--quiet"};
  const Json compared = json_of(ninebit(
      Words{"compare", kRoom, "-o", folder / "c", "--json", "--vary", "technique=index-cube,shadow-volume"} + size));
  ASSERT_EQ(compared["rows"].size(), 2U);
  for (const Json& row : compared["rows"]) {
    ASSERT_FALSE(row["errors"]["worst"].empty());
    for (const Json& worst : row["errors"]["worst"]) {
      EXPECT_EQ(truth_by(worst["command"])["cause"], worst["cause"]) << worst["command"];
    }
  }
  const Outcome answer =
      ninebit(Words{"study", "shadows", kRoom, "--map-sizes", "32,64", "--steps", "1", "-o", folder / "s"} + size);
  ASSERT_EQ(answer.code, 0) << answer.err;
  std::size_t found = 0;
  for (const char* point : {"best", "worst"}) {
    const std::string start = std::string("A wrong pixel of the ") + point + " point, ";
    for (std::size_t at = answer.out.find(start); at != std::string::npos; at = answer.out.find(start, at + 1)) {
      const std::string line = answer.out.substr(at + start.size(), answer.out.find('\n', at) - at - start.size());
      const std::size_t colon = line.find(": ");
      EXPECT_EQ(truth_by(line.substr(colon + 2))["cause"], line.substr(0, colon)) << line;
      ++found;
    }
  }
  EXPECT_GE(found, 4U);
  const std::string report = read_bytes(folder / "s/report.html");
  expect_parts(report, {"Wrong pixels of the worst point"});
  // Its error pictures say what is wrong where: each with a plane of causes and a command.
  std::size_t planes = 0;
  for (std::size_t at = 0; (at = report.find("{\"wrong\":\"data:image/png;base64,", at)) != std::string::npos; ++at)
    ++planes;
  EXPECT_EQ(planes, 2U);
  expect_parts(report, {"\"command\":\"ninebit trace --scene "});
  expect_parts(read_bytes(folder / "s/worst.csv"), {"point,cause,x,y,radius,command\r\n"});
}

// Whatever single values a study has: its question asks the same again, and its commands find what it counted.
TEST(GroundTruthOfRender, TheCommandsOfAStudyRun) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (const Words& flags : std::vector<Words>{
           {"--map-size", "64"},
           {"--map-size", "64", "--index-step", "1", "--index-scope", "object", "--index-format", "la",
            "--index-scales", "first-x4", "--up", "y", "--cull", "back", "--floor", "none"},
           {"--map-size", "64", "--steps", "1,2", "--index-order", "neighbour", "--patch-angle", "20"},
           {"--technique", "shadow-map", "--map-size", "64", "--polygon-offset", "0,0", "--spot-angle", "90"},
           {"--technique", "depth-cube", "--map-size", "64", "--depth-bits", "8", "--bias", "0", "--profile", "nv2a"},
           {"--technique", "shadow-volume", "--light-facing", "--fov", "70"}}) {
    const Json answer =
        json_of(ninebit(Words{"study", "shadows", kRoom, "--size", "80x60", "--json", "--quiet"} + flags));
    SCOPED_TRACE(answer["question"]);
    EXPECT_EQ(json_of(ninebit(words_of_command(answer["question"]) + Words{"--json", "--quiet"})), answer);
    EXPECT_EQ(answer.contains("worst"), answer["rows"][0]["wrong"] != 0);
    for (const Json& one : answer.contains("worst") ? answer["worst"] : Json::array()) {
      EXPECT_EQ(truth_by(one["command"])["cause"], one["cause"]) << one["command"];
    }
  }
}

// Those of a study's best and worst point are those of a rendering with the point's settings.
TEST(GroundTruthOfRender, AStudyNamesTheWorstPixelsOfRender) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const TempFolder folder;
  const Json study = json_of(ninebit({"study", "shadows", kRoom, "--map-sizes", "32,64,128", "--steps", "1", "--size",
                                      "160x120", "--json", "--quiet"}));
  std::map<int, Json> by_point;
  for (Json one : study["worst"]) {
    const int point = one["point"];
    one.erase("point");
    one.erase("command");  // says the same in other flags
    by_point[point].push_back(std::move(one));
  }
  ASSERT_EQ(by_point.size(), 2U);  // of three
  for (const auto& [point, found] : by_point) {
    const std::string map_size = study["rows"][static_cast<std::size_t>(point)]["map_size"].dump();
    const Words flags{"--size", "160x120", "--map-size", map_size, "--index-step", "1", "--ground-truth", "--json"};
    Json expected = json_of(ninebit(small_render(kRoom, folder / "out", flags)))["errors"]["worst"];
    ASSERT_FALSE(expected.empty());
    for (Json& one : expected) one.erase("command");
    EXPECT_EQ(found, expected) << map_size;
  }
}

TEST(GroundTruthOfRender, CountsWhatItsLayersShow) {
  const TempFolder folder;
  const Json answer = json_of(ninebit(judged_render(folder, {"--json", "--layers", "--index-step", "1"})));
  const Json& errors = answer["errors"];
  EXPECT_EQ(keys_of(errors), (Words{"false_lit", "false_shadowed", "by_cause", "worst"}));
  const Words causes{"truncation", "joint", "vanished", "shared", "sampling"};
  EXPECT_EQ(keys_of(errors["by_cause"]), causes);

  std::map<std::string, std::vector<std::uint32_t>> planes;
  for (const auto& part : ninebit::test::read_exr(folder / "out/layers.exr")) {
    for (const char* name : {"truth", "cause", "stencil"}) {
      if (part.name == name) planes[name] = part.channels.at(name).integers;
    }
  }
  ASSERT_EQ(planes["truth"].size(), 160U * 120U);
  ASSERT_EQ(planes["cause"].size(), 160U * 120U);
  // As docs/techniques/ground-truth.md numbers them.
  const std::map<std::string, std::uint32_t> number{
      {"truncation", 1}, {"joint", 2}, {"vanished", 3}, {"shared", 4}, {"sampling", 7}};
  int false_lit = 0, false_shadowed = 0;
  std::map<std::uint32_t, int> by_cause;
  for (std::size_t i = 0; i < planes["truth"].size(); ++i) {
    const bool lit = planes["stencil"][i] == 0;
    const std::uint32_t truth = planes["truth"][i];
    false_lit += truth == 2 && lit ? 1 : 0;
    false_shadowed += truth == 1 && !lit ? 1 : 0;
    if (planes["cause"][i] != 0) ++by_cause[planes["cause"][i]];
  }
  EXPECT_EQ(errors["false_lit"], false_lit);
  EXPECT_EQ(errors["false_shadowed"], false_shadowed);
  int all = 0;
  for (const auto& [cause, n] : number) {
    EXPECT_EQ(errors["by_cause"][cause], by_cause[n]) << cause;
    all += by_cause[n];
  }
  EXPECT_EQ(all, false_lit + false_shadowed);
  EXPECT_GT(false_lit, 0);
  EXPECT_GT(false_shadowed, 0);

  EXPECT_EQ(answer["files"].size(), 7U);
  const ninebit::Image8 picture = ninebit::test::read_png(folder / "out/error.png");
  EXPECT_EQ(picture.width, 160);
  EXPECT_EQ(picture.height, 120);
  int coloured = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); i += static_cast<std::size_t>(picture.channels)) {
    coloured += picture.pixels[i] != picture.pixels[i + 2] ? 1 : 0;
  }
  EXPECT_EQ(coloured, all);
}

TEST(GroundTruthOfRender, ChangesNothingElse) {
  const TempFolder folder;
  const Json judged = json_of(ninebit(judged_render(folder, {"--json", "--threads", "1"})));
  const Json again = json_of(ninebit(judged_render(folder, {"--json", "--threads", "5"})));
  EXPECT_EQ(again["errors"], judged["errors"]);
  const Json expected{
      {"false_lit", 51},
      {"false_shadowed", 2417},
      {"by_cause", {{"truncation", 0}, {"joint", 1892}, {"vanished", 327}, {"shared", 0}, {"sampling", 249}}}};
  Json counts = judged["errors"];
  counts.erase("worst");
  EXPECT_EQ(counts, expected) << "what these bits of the room have always come to";
  Words plain = judged_render(folder, {"--json"});
  std::erase(plain, "--ground-truth");
  const Json unjudged = json_of(ninebit(plain));
  EXPECT_FALSE(unjudged.contains("errors"));
  EXPECT_EQ(unjudged["hash"], judged["hash"]);
  EXPECT_EQ(unjudged["pixels"], judged["pixels"]);
  EXPECT_EQ(unjudged["files"].size() + 1, judged["files"].size());
}

TEST(GroundTruthOfRender, TellsPeopleTheCounts) {
  const TempFolder folder;
  Words arguments = judged_render(folder, {});
  std::erase(arguments, "--quiet");
  const Outcome outcome = ninebit(arguments);
  EXPECT_EQ(outcome.code, 0);
  expect_parts(outcome.err, {"wrote " + (folder / "out/error.png")});
  const Json errors = json_of(ninebit(judged_render(folder, {"--json"})))["errors"];
  const std::string line = "ground truth: " + errors["false_lit"].dump() + " pixels falsely lit, " +
                           errors["false_shadowed"].dump() +
                           " falsely shadowed: " + errors["by_cause"]["joint"].dump() + " joint, ";
  expect_parts(outcome.out, {line});
}

}  // namespace
}  // namespace tools_test
