// `ninebit render --ground-truth`: errors counted, shown and written.
#include <gtest/gtest.h>

#include <array>
#include <set>

#include "combiner_tests/support/stored_pictures.h"
#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

std::vector<std::string> judged_render(const TempFolder& folder, const std::vector<std::string>& more) {
  std::vector<std::string> flags{"--size", "160x120", "--map-size", "64", "--ground-truth"};
  flags.insert(flags.end(), more.begin(), more.end());
  return small_render(kRoom, folder / "out", flags);
}

TEST(GroundTruthOfRender, CountsWhatItsLayersShow) {
  const TempFolder folder;
  const Json answer = json_of(ninebit(judged_render(folder, {"--json", "--layers", "--index-step", "1"})));
  const Json& errors = answer["errors"];
  EXPECT_EQ(keys_of(errors), (std::vector<std::string>{"false_lit", "false_shadowed", "by_cause"}));
  const std::vector<std::string> causes{"truncation", "joint", "vanished", "shared", "sampling"};
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
  EXPECT_EQ(judged["errors"], expected) << "what these bits of the room have always come to";
  std::vector<std::string> plain = judged_render(folder, {"--json"});
  std::erase(plain, "--ground-truth");
  const Json unjudged = json_of(ninebit(plain));
  EXPECT_FALSE(unjudged.contains("errors"));
  EXPECT_EQ(unjudged["hash"], judged["hash"]);
  EXPECT_EQ(unjudged["pixels"], judged["pixels"]);
  EXPECT_EQ(unjudged["files"].size() + 1, judged["files"].size());
}

TEST(GroundTruthOfRender, TellsPeopleTheCounts) {
  const TempFolder folder;
  std::vector<std::string> arguments = judged_render(folder, {});
  std::erase(arguments, "--quiet");
  const Outcome outcome = ninebit(arguments);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("wrote " + (folder / "out/error.png")), std::string::npos) << outcome.err;
  const Json errors = json_of(ninebit(judged_render(folder, {"--json"})))["errors"];
  const std::string line = "ground truth: " + errors["false_lit"].dump() + " pixels falsely lit, " +
                           errors["false_shadowed"].dump() +
                           " falsely shadowed: " + errors["by_cause"]["joint"].dump() + " joint, ";
  EXPECT_NE(outcome.err.find(line), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace tools_test
